#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds a release and runs every test.
# Arguments go to ctest, e.g. packaging/test.sh -R cloud
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

"$root/packaging/install-dependencies.sh" --tests

cd "$root"
cmake --preset release -DLVCALIB_BUILD_TESTS=ON
cmake --build build/release
ctest --preset release --parallel "$(nproc)" "$@"
