#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages that LV-Calib Workbench needs, as far as they are missing.
#   packaging/install-dependencies.sh          to build and run the programs
#   packaging/install-dependencies.sh --tests  and to build and run the tests
#   packaging/install-dependencies.sh --ci     and for the checks of .ci/run
set -euo pipefail

build_packages=(
  build-essential clang cmake ninja-build ccache pkg-config
  libeigen3-dev libopencv-dev libopencv-contrib-dev libceres-dev libapriltag-dev
  libyaml-cpp-dev nlohmann-json3-dev libcli11-dev libcairo2-dev liblzf-dev libboost-dev libssl-dev
  libpng-dev libjpeg-dev libtiff-dev zlib1g-dev libmuparser-dev libzstd-dev liblz4-dev libbz2-dev libsqlite3-dev
  qt6-base-dev libqt6opengl6-dev qt6-svg-dev libqt6svg6 qt6-tools-dev qt6-l10n-tools
  qt6-qpa-plugins libvtk9-dev libqcustomplot-dev libgl1-mesa-dev libegl-dev fonts-dejavu-core
)
test_packages=(libgtest-dev libgmock-dev libbenchmark-dev libpcl-dev python3
  xvfb xauth xdotool imagemagick poppler-utils libgl1-mesa-dri lld fonts-wqy-microhei)
ci_packages=(clang-format clang-tidy libclang-rt-dev desktop-file-utils appstream man-db)

packages=("${build_packages[@]}")
case "${1:-}" in
  "") ;;
  --tests) packages+=("${test_packages[@]}") ;;
  --ci) packages+=("${test_packages[@]}" "${ci_packages[@]}") ;;
  *)
    sed -n '3,6s/^# \?//p' "$0" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "This is not a Debian system; please install the counterparts of: ${packages[*]}" >&2
  exit 3
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $state == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "All ${#packages[@]} Debian packages are there."
  exit 0
fi

echo "Installing ${#missing[@]} missing Debian packages: ${missing[*]}"
as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "Root rights are needed. Please run as root: apt-get install ${missing[*]}" >&2
    exit 3
  fi
  echo "(sudo may ask for your password)"
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}"
