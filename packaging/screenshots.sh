#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes pictures of every page and dialog of the desktop application, without a screen.
#   packaging/screenshots.sh [FOLDER] [DATASET|demo] [LANGUAGE]
#                                    default folder build/screenshots, dataset demo, language en
#   packaging/screenshots.sh --guide the guide's pictures, small, into resources/guide
# SCALE=2 draws as on a screen of twice the resolution.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
guide=
if [[ ${1:-} == --guide ]]; then
  guide="$root/resources/guide"
  shift
fi
folder=$(realpath -m "${1:-$root/build/screenshots}")
scale=${SCALE:-1}

"$root/packaging/install-dependencies.sh" --tests

cd "$root"
cmake --preset release -DLVCALIB_BUILD_TESTS=ON
cmake --build build/release --target lvcalib-screenshots
mkdir -p "$folder"
QT_SCALE_FACTOR=$scale LIBGL_ALWAYS_SOFTWARE=1 \
  xvfb-run -a -s "-screen 0 $((1600 * scale))x$((1000 * scale))x24" \
  build/release/bin/lvcalib-screenshots "$folder" "${@:2}"

# Few colours and less size: a guide's picture has 150 kB at most.
if [[ -n $guide ]]; then
  for name in welcome import-light running scene-light crop-light refinement-light extrinsic-light \
    extrinsic-2-light response-light exports-light scene-dark check-light plan-light watch-light \
    model-missing-light model-added-light model-unseen-light; do
    small="$guide/workbench-${name%-light}.png"
    # Thousands of coloured dots do not shrink as well as widgets do.
    width=1100 colors=96
    if [[ $name == check-light ]]; then width=880 colors=48; fi
    convert "$folder/$name.png" -resize "${width}x>" +dither -colors "$colors" -strip \
      -define png:compression-level=9 "PNG8:$small"
    if (($(stat -c %s "$small") > 150000)); then
      echo "screenshots: $small is larger than 150 kB" >&2
      exit 1
    fi
  done
fi
ls "$folder"
