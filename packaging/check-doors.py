#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the architecture's doors, the tests' mirror and the licence lines.

Reads the #include lines of core/, widgets/ and app/ and fails if
- a room of core/ or a folder of widgets/ includes one it has no door to,
- widgets/ includes app/, or a header of widgets/ includes VTK,
- anything in core/ includes widgets/, app/, Qt or VTK,
- a header in core/ includes a library that must stay in source files,
- a source of core/ or widgets/ has neither a test of its name nor is told to be tested elsewhere,
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
    "style": ["words"],
    "runner": ["words"],
    "models": ["words", "style", "runner"],
    "views": ["words", "style"],
    "pages": ["words", "style", "views"],
    "modelling": ["words", "style", "views", "runner"],
    "dialogs": ["words", "style", "runner"],
    "intrinsics": ["words", "style", "views", "pages", "runner", "modelling", "dialogs"],
    "tools": ["words", "style", "views", "runner", "modelling", "dialogs"],
    "importing": ["words", "style", "runner", "dialogs", "tools"],
    "docks": ["words", "style", "views", "models"],
    "start": ["words", "style"],
}

# Headers of cloud/ that the simulator may use: it writes clouds and shares no estimation code.
SIMULATION_CLOUD_HEADERS = {"cloud/cloud.h"}

# Sources without a test file of their own, by the test file of what hands their work on; without
# the folder where it is the same. Effects are held against the simulator's.
TESTED_BY = {
    "core/camera": {"camera_deviations": "camera_yaml"},
    "core/detection": {"marker_detector": "charuco_view"},
    "core/model": {
        "beam_blur": "core/solve/print_table", "camera_intrinsics": "core/selection/sensitivity_budget",
        "channel": "linear_model", "covariate_effect": "user_effect", "curve_effect": "user_effect",
        "formula_effect": "user_effect", "measurement_table": "residuals",
        "sensor_errors": "core/selection/effect_search"},
    "core/model/effects": {"*": "core/selection/hidden_effects"},
    "core/pipeline": {
        "board_agreement": "diagnosis", "board_images": "camera_calibration", "board_surface": "widgets/views/cloud_scene",
        "camera_figures": "camera_calibration", "forward_stage": "calibration",
        "fresh_data": "widgets/tools/check_dialog", "modelled_movements": "without_effects",
        "print_verdict": "quality", "refusals": "scene_edits", "resolve_calibration": "calibration",
        "scaled_board": "bad_board", "turned_images": "diagnosis"},
    "core/recording": {
        "container": "recording", "mcap": "recording", "random_file": "recording",
        "ros1_bag": "recording", "rosbag2_sqlite": "recording"},
    "core/refinement": {"transition_noise": "transition"},
    "core/report": {
        "boundary_export": "exports", "evidence_json": "result_file", "export_input": "exports",
        "model_section": "html_report", "report_sections": "html_report",
        "response_section": "html_report", "result_inputs": "cli/evidence_command", "scene_section": "html_report"},
    "core/selection": {
        "contradictions": "effect_search", "print_contrast": "effect_search"},
    "core/solve": {
        "covered_places": "board_returns", "forward_problem": "forward_solver",
        "global_solution": "forward_solver", "print_size": "forward_solver",
        "scene_rows": "print_table", "total_uncertainty": "scan_faults"},
    "core/target": {"sheet_drawing": "sheet", "tag_pattern": "target"},
    "widgets/importing": {"board_choice": "import_form"},
    "widgets/pages": {
        "cloud_brush": "colors_pane", "cloud_pane": "scene_page", "image_pane": "scene_page", "selection_bar": "scene_page"},
    "widgets/runner": {
        "camera_work": "widgets/intrinsics/camera_page", "edge_work": "widgets/tools/check_dialog",
        "files_work": "widgets/importing/files_dialog", "memory": "widgets/workbench/window_marks",
        "run_story": "workspace"},
    "widgets/style": {"edits_text": "widgets/models/scene_model"},
    "widgets/tools": {
        "camera_form": "target_camera_dialog", "camera_preview": "target_camera_dialog",
        "key_form": "target_camera_dialog", "target_form": "target_camera_dialog"},
    "widgets/views": {
        "board_figure": "board_map_plot", "cloud_canvas": "cloud_view",
        "cloud_pipeline": "cloud_actors", "plot_view": "plot_legend",
        "tool_row": "widgets/modelling/where_pane"},
}

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


def check_mirrors(root):
    if not (root / "tests").is_dir():
        return
    told = {f"{folder}/{name}" for folder, names in TESTED_BY.items() for name in names}
    for path in sorted(p for top in ("core", "widgets") for p in (root / top).rglob("*.cpp")):
        folder = path.relative_to(root).parent.as_posix()
        names = TESTED_BY.get(folder, {})
        name = path.stem if path.stem in names else "*"
        told.discard(f"{folder}/{name}")
        by = names.get(name)
        own = root / "tests" / folder / f"{path.stem}_test.cpp"
        if by is None and not own.is_file():
            yield f"{path.relative_to(root)}: neither a test of its name nor in TESTED_BY"
        elif by is not None:
            other = root / "tests" / (by if "/" in by else f"{folder}/{by}")
            if own.is_file() or not other.with_name(f"{other.name}_test.cpp").is_file():
                yield f"{path.relative_to(root)}: TESTED_BY is out of date"
    for name in sorted(told):
        if (root / name).parent.is_dir():
            yield f"{name}: TESTED_BY names what is not there"


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
    complaints = [*check_doors(root), *check_widgets(root), *check_mirrors(root), *check_licences(root)]
    for complaint in complaints:
        print(complaint)
    print(f"doors, mirrors and licences: {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
