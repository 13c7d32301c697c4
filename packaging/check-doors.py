#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the architecture's doors and the licence lines.

Reads the #include lines of core/, widgets/ and app/ and fails if
- a room of core/ or a folder of widgets/ includes one it has no door to,
- widgets/ includes app/, or a header of widgets/ includes VTK,
- anything in core/ includes widgets/, app/, Qt or VTK,
- a header in core/ includes a library that must stay in source files,
- a source file's first lines lack the SPDX line of its folder.

Usage: check-doors.py [ROOT]
"""

import re
import sys
from pathlib import Path

# Which rooms a room may include, besides itself.
DOORS = {
    "base": [],
    "target": ["base"],
    "camera": ["base"],
    "cloud": ["base"],
    "recording": ["base", "camera", "cloud"],
    "detection": ["base", "target", "camera", "cloud"],
    "localization": ["base", "target", "camera", "cloud", "detection"],
    "refinement": ["base", "target", "camera", "cloud", "detection", "localization"],
    "model": ["base", "target", "camera", "cloud", "detection"],
    "solve": ["base", "target", "camera", "cloud", "detection", "localization", "refinement",
              "model"],
    "response": ["base", "target", "camera", "cloud", "detection", "localization", "refinement"],
    "verification": ["base", "camera", "cloud", "detection"],
    "diagnostics": ["base", "target", "camera", "cloud", "detection", "model", "solve"],
    "design": ["base", "target", "camera", "cloud", "detection", "model", "solve"],
    "selection": ["base", "target", "camera", "cloud", "detection", "model", "solve", "diagnostics",
                  "design"],
    "simulation": ["base", "target", "camera", "cloud"],
}
# The simulation is a library of its own, which the installed core does not carry.
DOORS["pipeline"] = sorted(set(DOORS) - {"simulation"})
DOORS["report"] = sorted(set(DOORS) - {"simulation"})

# Which folders of widgets/ a folder may include, besides itself.
WIDGET_DOORS = {
    "words": [],
    "style": [],
    "runner": ["words"],
    "models": ["words", "style", "runner"],
    "views": ["words", "style"],
    "pages": ["words", "style", "views"],
    "modelling": ["words", "style", "views", "runner"],
    "dialogs": ["words", "style", "runner"],
    "intrinsics": ["words", "style", "views", "pages", "runner", "modelling", "dialogs"],
    "tools": ["words", "style", "views", "runner", "modelling", "dialogs"],
    "importing": ["words", "style", "runner", "dialogs", "tools"],
    "docks": ["words", "style", "models"],
    "start": ["words", "style"],
}

# Headers of cloud/ that the simulator may use: it writes clouds and shares no estimation code.
SIMULATION_CLOUD_HEADERS = {"cloud/cloud.h"}

GUI = re.compile(r"^(Q[A-Z]\w*(/\w+)?|Qt\w*/.*|vtk\w*\.h(xx)?)$")
HIDDEN = re.compile(r"^(opencv2|ceres|pcl|yaml-cpp|apriltag|cairo|muParser)(/|\.h$)|^(apriltag|cairo|tag|muParser)\w*\.h$")
# Not installed (see core/CMakeLists.txt): cost functions are Ceres types by nature.
INTERNAL_HEADERS = {"cost_functions.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
SOURCE_SUFFIXES = {".h", ".hpp", ".cpp", ".cc", ".c", ".py", ".sh", ".cmake"}
TOP_LEVEL = ["core", "widgets", "app", "tests", "packaging", "resources", "translations", ".ci"]


def includes(path):
    text = path.read_text(encoding="utf-8", errors="replace")
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start(2)) + 1
        yield line, match.group(2)


def check_core_include(room, path, header):
    """The complaint about one include in core/, or nothing."""
    if GUI.match(header):
        return f"core may not include Qt or VTK: {header}"
    if path.suffix in {".h", ".hpp"} and path.name not in INTERNAL_HEADERS and HIDDEN.search(header):
        return f"{header} must stay in source files, out of headers"
    other = header.split("/")[0]
    if other in {"widgets", "app"}:
        return f"core may not include {other}/: {header}"
    if other not in DOORS or other == room:
        return None
    if other not in DOORS[room]:
        return f"there is no door from {room} to {other}: {header}"
    if room == "simulation" and other == "cloud" and header not in SIMULATION_CLOUD_HEADERS:
        return f"simulation may only write clouds: {header}"
    return None


def check_widgets_include(folder, path, header):
    """The complaint about one include in widgets/, or nothing."""
    other = header.split("/")[0]
    if other in {"app", "workbench", "cli"}:
        return f"widgets may not include app/: {header}"
    if path.suffix == ".h" and re.match(r"^vtk\w*\.h$", header):
        return f"{header} must stay in source files, out of headers"
    if other in WIDGET_DOORS and "/" in header and other not in [folder, *WIDGET_DOORS[folder]]:
        return f"there is no door from {folder} to {other}: {header}"
    return None


def check_widgets(root):
    for path in sorted((root / "widgets").rglob("*")):
        if path.suffix not in {".h", ".hpp", ".cpp", ".cc"}:
            continue
        parts = path.relative_to(root / "widgets").parts
        if len(parts) < 2 or parts[0] not in WIDGET_DOORS:
            yield f"{path.relative_to(root)}: not in a folder of widgets/"
            continue
        for line, header in includes(path):
            complaint = check_widgets_include(parts[0], path, header)
            if complaint:
                yield f"{path.relative_to(root)}:{line}: {complaint}"


def check_doors(root):
    for path in sorted((root / "core").rglob("*")):
        if path.suffix not in {".h", ".hpp", ".cpp", ".cc"}:
            continue
        parts = path.relative_to(root / "core").parts
        room = parts[0]
        if len(parts) < 2 or room not in DOORS:
            yield f"{path.relative_to(root)}: not in a room of core/"
            continue
        for line, header in includes(path):
            complaint = check_core_include(room, path, header)
            if complaint:
                yield f"{path.relative_to(root)}:{line}: {complaint}"


def check_licences(root):
    for top in TOP_LEVEL:
        licence = "BSD-3-Clause" if top == "core" else "GPL-3.0-or-later"
        for path in sorted((root / top).rglob("*")):
            named = path.name in {"CMakeLists.txt", "run"}
            if not path.is_file() or not (path.suffix in SOURCE_SUFFIXES or named):
                continue
            start = path.read_text(encoding="utf-8", errors="replace").split("\n")[:2]
            if not any(line.endswith(f"SPDX-License-Identifier: {licence}") for line in start):
                yield f"{path.relative_to(root)}:1: lacks 'SPDX-License-Identifier: {licence}'"


def main():
    default = Path(__file__).resolve().parent.parent
    root = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else default
    if not (root / "core").is_dir():
        print(f"{root}: no folder core/", file=sys.stderr)
        return 2
    complaints = [*check_doors(root), *check_widgets(root), *check_licences(root)]
    for complaint in complaints:
        print(complaint)
    print(f"doors and licences: {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
