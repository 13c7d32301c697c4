#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes pictures of every page and dialog of the desktop application, without a screen.
#   packaging/screenshots.sh [FOLDER] [DATASET|demo] [LANGUAGE]
#                                    default folder build/screenshots, dataset demo, language en
#   packaging/screenshots.sh --all [FOLDER] [DATASET|demo]
#                                    at 1280x720, 1920x1080 and 3840x2160 with scale 2, in English
#                                    and Chinese, the window as large as the screen; a folder each
#   packaging/screenshots.sh --guide the guide's pictures, small, into resources/guide
# Every picture is taken in light and in dark colours. SCALE=2 draws as on a screen of twice the
# resolution. Chinese needs a Chinese font (fonts-noto-cjk).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
guide=
all=
if [[ ${1:-} == --guide ]]; then
  guide="$root/resources/guide"
  shift
elif [[ ${1:-} == --all ]]; then
  all=1
  shift
fi
folder=$(realpath -m "${1:-$root/build/screenshots}")
scale=${SCALE:-1}

"$root/packaging/install-dependencies.sh" --tests

cd "$root"
cmake --preset release -DLVCALIB_BUILD_TESTS=ON
cmake --build build/release --target lvcalib-screenshots
mkdir -p "$folder"

# take SCALE SCREEN FOLDER ARGUMENTS…
take() {
  QT_SCALE_FACTOR=$1 LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 $2x24 -nolisten tcp" \
    build/release/bin/lvcalib-screenshots "${@:3}"
}

if [[ -n $all ]]; then
  if [[ -z $(fc-list :lang=zh) ]]; then
    echo "screenshots: there is no Chinese font: its texts would be boxes" >&2
    exit 1
  fi
  for size in 1280x720 1920x1080 3840x2160; do
    scale=1 window=$size
    if [[ $size == 3840x2160 ]]; then scale=2 window=1920x1080; fi
    for language in en zh_CN; do
      take $scale $size "$folder/$size-$language" "${2:-demo}" $language $window
    done
  done
  ls "$folder"
  exit
fi
take "$scale" "$((1600 * scale))x$((1000 * scale))" "$folder" "${@:2}"

# Few colours and less size: a guide's picture has 150 kB at most.
if [[ -n $guide ]]; then
  take "$scale" "$((1600 * scale))x$((1000 * scale))" "$folder" demo en 1500x940 covered
  for name in welcome import-light running scene-light crop-light refinement-light extrinsic-light \
    extrinsic-2-light response-light camera-page-alone-light exports-light scene-dark check-light plan-light watch-light \
    model-missing-light model-added-light model-unseen-light covered-light; do
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
