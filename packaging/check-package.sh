#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian package from a built tree, installs it into an empty root whose package database
# is a copy of this machine's (so that its dependencies are checked, and the machine is left alone),
# calibrates with the command line and opens the window from there, removes it again, and fails
# unless nothing is left.
#   packaging/check-package.sh [BUILD]     default build/release; must be built with the workbench
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath -m "${1:-$root/build/release}")
[[ -f $build/CPackConfig.cmake ]] || {
  echo "check-package: $build has not been configured; run cmake --preset release first" >&2
  exit 3
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
clean="$work/root"
database="$clean/var/lib/dpkg"

fail() {
  printf 'check-package: %s\n' "$*" >&2
  exit 1
}

in_root() {
  dpkg --force-not-root --force-script-chrootless --log="$work/dpkg.log" --instdir="$clean" --admindir="$database" "$@"
}

make_package() {
  (cd "$build" && cpack -G DEB -B "$work/made") >"$work/cpack.log" 2>&1 || {
    cat "$work/cpack.log" >&2
    fail "cpack failed"
  }
  package=$(echo "$work"/made/*.deb)
  name=$(dpkg-deb -f "$package" Package)
  printf 'made %s, %d KB\n' "${package##*/}" $(($(stat -c %s "$package") / 1024))
}

# Everything that belongs to the package, and nothing elsewhere in the root.
install_package() {
  mkdir -p "$database"/{info,updates,triggers}
  cp /var/lib/dpkg/status "$database/status"
  cp /var/lib/dpkg/info/*.list "$database/info/"
  in_root --install "$package" >"$work/install.log" 2>&1 || {
    cat "$work/install.log" >&2
    fail "the package cannot be installed"
  }
  local file
  for file in bin/lvcalib bin/lvcalib-workbench share/applications/lvcalib-workbench.desktop \
    share/icons/hicolor/scalable/apps/lvcalib-workbench.svg share/man/man1/lvcalib.1.gz \
    share/man/man1/lvcalib-workbench.1.gz share/metainfo/org.lvcalib.Workbench.metainfo.xml \
    share/mime/packages/lvcalib-workbench.xml share/doc/lvcalib-workbench/README.md \
    share/doc/lvcalib-workbench/copyright; do
    [[ -s $clean/usr/$file ]] || fail "/usr/$file is missing"
  done
  printf 'installed %d files\n' "$(dpkg-deb -c "$package" | grep -vc '/$')"
}

check_descriptions() {
  local share="$clean/usr/share" page
  if command -v desktop-file-validate >/dev/null; then
    desktop-file-validate "$share/applications/lvcalib-workbench.desktop" || fail "desktop file"
  fi
  if command -v appstreamcli >/dev/null; then
    appstreamcli validate --no-net "$share"/metainfo/*.xml || fail "metainfo"
  fi
  for page in "$share"/man/man1/*.gz; do
    if command -v man >/dev/null && [[ -n $(man --warnings -l "$page" 2>&1 >/dev/null) ]]; then
      fail "$(man --warnings -l "$page" 2>&1 >/dev/null | head -n 3)"
    fi
  done
}

# The programs must find their library in the root, and load one Qt.
check_libraries() {
  local program linked
  for program in lvcalib lvcalib-workbench; do
    linked=$(ldd "$clean/usr/bin/$program")
    ! grep -q 'not found' <<<"$linked" || fail "$program lacks libraries: $linked"
    grep -q "liblvcalib.* => $clean/" <<<"$linked" || fail "$program loads another liblvcalib"
    ! grep -q libQt5 <<<"$linked" || fail "$program loads Qt 5"
  done
}

run_command_line() {
  local data="$work/data" lvcalib="$clean/usr/bin/lvcalib"
  "$lvcalib" simulate -o "$data" --seed 1 --scenes 3 --points 120000 --quiet
  "$lvcalib" calibrate "$data" -o "$work/result" --quiet
  "$lvcalib" evaluate "$work/result/result.json" --truth "$data-truth.json"
}

# Under its own screen: opens the dataset, waits for the window to name it, and closes it.
cat >"$work/window.sh" <<'EOS'
set -euo pipefail
"$1" --settings "$3" "$2" &
program=$!
trap 'kill $program 2>/dev/null || true' EXIT
window=
for _ in $(seq 100); do
  window=$(xdotool search --onlyvisible --name '^data.* LV-Calib Workbench$' 2>/dev/null | head -n 1) || true
  [[ -z $window ]] || break
  kill -0 $program || exit 1
  sleep 0.1
done
[[ -n $window ]] || { echo "no window after 10 s" >&2; exit 1; }
echo "window: $(xdotool getwindowname "$window")"
xdotool windowfocus "$window" key ctrl+q
for _ in $(seq 50); do
  kill -0 $program 2>/dev/null || { wait $program; exit; }
  sleep 0.1
done
echo "the window does not close" >&2
exit 1
EOS
run_window() {
  command -v xvfb-run >/dev/null && command -v xdotool >/dev/null ||
    fail "xvfb and xdotool are needed (packaging/install-dependencies.sh --tests)"
  LIBGL_ALWAYS_SOFTWARE=1 timeout 60 xvfb-run -a -s "-screen 0 1600x1000x24" \
    bash "$work/window.sh" "$clean/usr/bin/lvcalib-workbench" "$work/data" "$work/settings" ||
    fail "the window could not be opened and closed"
}

remove_package() {
  in_root --purge "$name" >"$work/remove.log" 2>&1 || {
    cat "$work/remove.log" >&2
    fail "the package cannot be removed"
  }
  local left
  left=$(find "$clean" -path "$clean/var/lib/dpkg" -prune -o ! -type d -print)
  [[ -z $left ]] || fail "left behind: $left"
  [[ ! -e $clean/usr ]] || fail "left behind: $(find "$clean/usr")"
}

make_package
install_package
check_descriptions
check_libraries
run_command_line
run_window
remove_package
echo "check-package: ok"
