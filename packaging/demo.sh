#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds a release and shows it at work: simulates three scenes,
# calibrates them without a guess and compares the result with the truth.
#   packaging/demo.sh [FOLDER]     FOLDER: where to put the demo's files (default build/demo)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m "${1:-$root/build/demo}")

"$root/packaging/install-dependencies.sh"

cd "$root"
# Only the programs: tests and benchmarks need more packages.
cmake --preset release -DLVCALIB_BUILD_TESTS=OFF
cmake --build build/release --target lvcalib

lvcalib="$root/build/release/bin/lvcalib"
dataset="$folder/dataset"
rm -rf "$dataset" "$dataset-truth.json" "$folder/result"
mkdir -p "$folder"

run() {
  printf '\n$ lvcalib %s\n' "$*"
  "$lvcalib" "$@"
}
run simulate -o "$dataset" --seed 1 --scenes 3
run calibrate "$dataset" -o "$folder/result"
run evaluate "$folder/result/result.json" --truth "$dataset-truth.json"
printf '\nThe files are in %s\n' "$folder"
