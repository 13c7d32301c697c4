#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes pictures of every page and dialog of the desktop application, without a screen.
#   packaging/screenshots.sh [FOLDER] [DATASET]     default folder build/screenshots, dataset: demo
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m "${1:-$root/build/screenshots}")

"$root/packaging/install-dependencies.sh" --tests

cd "$root"
cmake --preset release -DLVCALIB_BUILD_TESTS=ON
cmake --build build/release --target lvcalib-screenshots
mkdir -p "$folder"
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1600x1000x24" \
  build/release/bin/lvcalib-screenshots "$folder" "${@:2}"
ls "$folder"
