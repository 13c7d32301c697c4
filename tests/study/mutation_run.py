#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many small faults do the tests of core/model and core/selection notice?

    mutation_run.py FOLDER [--seed N] [--count N] [--minutes M] [--jobs N]

Takes a copy of the sources (what git lists) into FOLDER/source, builds the tests of the two rooms
there, and then makes one fault after another in the copy, drawn at random from all places where an
operator of the list below stands: it is built, the tests run, and it is taken back. A fault counts
as noticed if a test fails, the program dies, or it takes five times as long as without; what does
not compile does not count. The tests of the room run first, then those of the other (selection
stands on model).

    relation     < <= > >= == != taken for its neighbour     logic    && for ||, and back
    arithmetic   + for -, * for /, and back                  extreme  std::min for std::max, and back
    negation     ! left out in a condition                   truth    return true for false, and back
    jump         continue left out

Faults go to FOLDER/mutants.jsonl as they are judged; called again with the same FOLDER and seed the
run goes on. Prints the score with Wilson's 95 % interval, by room and operator, and what went
unnoticed: each of these is a test that is missing, or a fault that changes nothing. The exit status
is 0 if the run could be made.
"""
import argparse
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOMS = ("model", "selection")
# Operators stand between blanks in formatted code; brackets of templates do not.
OPERATORS = (
    ("relation", r" < ", " <= "), ("relation", r" <= ", " < "),
    ("relation", r" > ", " >= "), ("relation", r" >= ", " > "),
    ("relation", r" == ", " != "), ("relation", r" != ", " == "),
    ("arithmetic", r" \+ ", " - "), ("arithmetic", r" - ", " + "),
    ("arithmetic", r" \* ", " / "), ("arithmetic", r" / ", " * "),
    ("arithmetic", r" \+= ", " -= "), ("arithmetic", r" -= ", " += "),
    ("logic", r" && ", " || "), ("logic", r" \|\| ", " && "),
    ("extreme", r"std::min\(", "std::max("), ("extreme", r"std::max\(", "std::min("),
    ("negation", r"(?<=[( ])!(?=[a-z(])", ""),
    ("truth", r"return true;", "return false;"), ("truth", r"return false;", "return true;"),
    ("jump", r"continue;", ";"),
)
SLOW = 5.0  # As in the description.


def blank_out(line):
    """The line with strings and comments replaced by blanks of the same length."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda m: '"' + " " * (len(m[0]) - 2) + '"', line)
    return re.sub(r"//.*", lambda m: " " * len(m[0]), line)


def places(root):
    """Every place where a fault can be made: (file, line, column, length, operator, put there)."""
    out = []
    for room in ROOMS:
        for path in sorted((root / "core" / room).rglob("*.cpp")):
            for number, line in enumerate(path.read_text().split("\n")):
                code = blank_out(line)
                if code.lstrip().startswith("#"):
                    continue
                for kind, pattern, put in OPERATORS:
                    for found in re.finditer(pattern, code):
                        out.append({"file": str(path.relative_to(root)), "line": number,
                                    "column": found.start(), "length": len(found[0]),
                                    "operator": kind, "put": put})
    return out


def copy_sources(repository, source):
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=repository, check=True,
                            stdout=subprocess.PIPE).stdout.decode()
    for name in filter(None, listed.split("\0")):
        target = source / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(repository / name, target)
    # One file at a time is compiled again, not a batch of them.
    with open(source / "core/CMakeLists.txt", "a") as file:
        for room in ROOMS:
            file.write(f"set_target_properties(lvcalib_{room} PROPERTIES UNITY_BUILD OFF)\n")


def build(source, jobs):
    targets = [f"{room}_tests" for room in ROOMS]
    return subprocess.run(["cmake", "--build", "build/release", "--parallel", str(jobs), "--target",
                           *targets], cwd=source, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def run_tests(source, room, limit_s, jobs):
    """None if all tests pass, else the first that fails, or how the program ended."""
    end = time.monotonic() + limit_s
    parts = []
    for part in range(jobs):
        output = tempfile.TemporaryFile()
        environment = {**os.environ, "GTEST_TOTAL_SHARDS": str(jobs), "GTEST_SHARD_INDEX": str(part)}
        parts.append((output, subprocess.Popen(
            [f"build/release/bin/{room}_tests", "--gtest_fail_fast", "--gtest_brief=1"], cwd=source,
            env=environment, stdout=output, stderr=subprocess.STDOUT)))
    try:
        waiting = list(parts)
        while waiting:
            for output, program in list(waiting):
                if program.poll() is None:
                    continue
                waiting.remove((output, program))
                if program.returncode == 0:
                    continue
                output.seek(0)
                failed = re.search(rb"\[  FAILED  \] (\S+)", output.read())
                return (failed[1].decode().rstrip(",") if failed
                        else f"ended with status {program.returncode}")
            if time.monotonic() > end:
                return "takes too long"
            time.sleep(0.05)
        return None
    finally:
        for output, program in parts:
            program.kill()
            program.wait()
            output.close()


def judge(source, mutant, usual_s, jobs):
    path = source / mutant["file"]
    text = path.read_text()
    lines = text.split("\n")
    at, to = mutant["column"], mutant["column"] + mutant["length"]
    line = lines[mutant["line"]]
    lines[mutant["line"]] = line[:at] + mutant["put"] + line[to:]
    mutant["was"], mutant["is"] = line.strip(), lines[mutant["line"]].strip()
    try:
        path.write_text("\n".join(lines))
        if build(source, jobs).returncode != 0:
            mutant["noticed"] = "not compiled"
            return
        own = Path(mutant["file"]).parts[1]
        mutant["noticed"] = None
        for room in (own, *[other for other in ROOMS if other != own]):
            mutant["noticed"] = run_tests(source, room, SLOW * usual_s[room] + 10.0, jobs)
            if mutant["noticed"] is not None:
                return
    finally:
        path.write_text(text)


def wilson(noticed, all_of):
    z = 1.96
    p = noticed / all_of
    middle = (p + z * z / (2 * all_of)) / (1 + z * z / all_of)
    half = z / (1 + z * z / all_of) * math.sqrt(p * (1 - p) / all_of + z * z / (4 * all_of**2))
    return f"{100 * (middle - half):.0f}–{100 * (middle + half):.0f} %"


def table(judged):
    counted = [m for m in judged if m["noticed"] != "not compiled"]
    rows = [("all", counted)]
    rows += [(f"core/{room}", [m for m in counted if m["file"].startswith(f"core/{room}/")])
             for room in ROOMS]
    rows += [(kind, [m for m in counted if m["operator"] == kind])
             for kind in dict.fromkeys(kind for kind, _, _ in OPERATORS)]
    print("| faults in | made | noticed | score (95 % interval) |\n| --- | --- | --- | --- |")
    for name, mutants in rows:
        if not mutants:
            continue
        noticed = sum(m["noticed"] is not None for m in mutants)
        print(f"| {name} | {len(mutants)} | {noticed} | {100 * noticed / len(mutants):.0f} % "
              f"({wilson(noticed, len(mutants))}) |")
    print(f"\n{len(judged) - len(counted)} more did not compile. Not noticed:\n")
    for m in counted:
        if m["noticed"] is None:
            print(f"- {m['file']}:{m['line'] + 1}: `{m['was']}` → `{m['is']}`")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--minutes", type=float, default=240.0)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    end = time.monotonic() + 60.0 * options.minutes

    repository = Path(__file__).resolve().parents[2]
    source = options.folder.resolve() / "source"
    shutil.rmtree(source / "core", ignore_errors=True)  # What an interrupted run left broken.
    copy_sources(repository, source)
    configured = subprocess.run(["cmake", "--preset", "release", "-DLVCALIB_BUILD_WORKBENCH=OFF"],
                                cwd=source, stdout=subprocess.DEVNULL)
    if configured.returncode != 0 or build(source, options.jobs).returncode != 0:
        sys.exit(f"the sources do not build in {source}")
    usual_s = {}
    for room in ROOMS:
        start = time.monotonic()
        failed = run_tests(source, room, 3600.0, options.jobs)
        usual_s[room] = time.monotonic() - start
        if failed is not None:
            sys.exit(f"{room}_tests fail without a fault: {failed}")

    drawn = places(source)
    random.Random(options.seed).shuffle(drawn)
    records = options.folder / "mutants.jsonl"
    judged = [json.loads(line) for line in records.read_text().splitlines()] \
        if records.exists() else []
    judged = [m for m in judged if m["seed"] == options.seed]
    print(f"{len(drawn)} places; {min(options.count, len(drawn))} faults asked for", flush=True)
    for mutant in drawn[len(judged):options.count]:
        if time.monotonic() > end:
            break
        mutant["seed"] = options.seed
        judge(source, mutant, usual_s, options.jobs)
        judged.append(mutant)
        with open(records, "a") as file:
            file.write(json.dumps(mutant) + "\n")
        print(f"{len(judged)}: {mutant['file']}:{mutant['line'] + 1} {mutant['operator']}: "
              f"{mutant['noticed'] or 'NOT NOTICED'}", flush=True)
    table(judged)


if __name__ == "__main__":
    main()
