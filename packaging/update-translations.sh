#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Reads all texts of the window into the catalogues: from widgets/ and app/workbench/, from the
# sentences of the core (packaging/core-messages.py) and from the lists that it declares
# (translations/core_texts.cpp). New texts come in as unfinished, texts
# that are gone are dropped; then translate with Qt Linguist, or in an editor. The English catalogue
# holds what is said of one or of many alone.
#   packaging/update-translations.sh [FOLDER]   catalogues in FOLDER (default translations)
# CORE_TEXTS: the program built from translations/core_texts.cpp; without it, it is built first.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m "${1:-$root/translations}")

if [[ -z ${CORE_TEXTS:-} ]]; then
  cmake --build "$root/build/release" --target lvcalib_core_texts >&2
  CORE_TEXTS="$root/build/release/bin/lvcalib_core_texts"
fi
lupdate=${LUPDATE:-/usr/lib/qt6/bin/lupdate}
[[ -x $lupdate ]] || lupdate=lupdate

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$CORE_TEXTS" >"$work/core_texts.cpp"
python3 "$root/packaging/core-messages.py" "$root" >"$work/core_messages.cpp"
catalogue() {
  "$lupdate" -no-obsolete -locations none -I "$root/widgets" -I "$root/app" "$@" "$root/widgets" \
    "$root/app/workbench" "$work/core_texts.cpp" "$work/core_messages.cpp" -ts "$ts"
}
for ts in "$folder"/*.ts; do
  if [[ $ts == *_en.ts ]]; then
    catalogue -pluralonly
  else
    catalogue
  fi
done
