#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of the machine at any moment: killed, out of memory, disk full.

    fault_sweep.py BIN [--moments N] [--steps N] [--seed N]

BIN is the folder of the built programs. For each command that writes files a run without a fault
tells how long it takes, how much address space it needs and what it writes. Then

- it is killed (SIGKILL) at N moments drawn evenly over that time; every file of the result must be
  whole or absent, and json and yaml of one run;
- commands that replace an older result are killed while that is there, too: it must stay as it was
  or be replaced as a whole, and nothing unfinished may be left behind by the run after;
- it runs with N limits of its address space, from what the program cannot even start with to what
  it needs; it must end by itself, with status 0, or 1 or 3 and one message;
- it writes to a disk of so few kilobytes that it gets full; it must say so, status 3, and leave no
  file that is not whole. Needs the right to mount one; else that part is skipped, and says so.

Prints one row per command and fault; the exit status is the number of commands that failed (at most
one hundred).
"""
import argparse
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

KIB = 1024


def run(arguments, folder, limit_bytes=None, kill_after_s=None):
    """Runs a command: (status as a shell tells it, standard error, seconds, peak address space)."""

    def before():
        # A kernel's dump of a crash takes seconds and is of no use here.
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if limit_bytes is not None:
            resource.setrlimit(resource.RLIMIT_AS, (limit_bytes, limit_bytes))

    start = time.monotonic()
    process = subprocess.Popen(arguments, cwd=folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, preexec_fn=before)
    peak = 0
    error = ""
    deadline = start + (kill_after_s if kill_after_s is not None else 300.0)
    while True:
        wait = max(0.0, min(0.02 if kill_after_s is None else 1e9, deadline - time.monotonic()))
        try:
            error = process.communicate(timeout=wait)[1]
            break
        except subprocess.TimeoutExpired:
            if limit_bytes is None and kill_after_s is None:
                peak = max(peak, address_space(process.pid))
            if time.monotonic() >= deadline:
                process.kill()
                error = process.communicate()[1]
                if kill_after_s is None:
                    error += "\nHANGS"
                break
    status = process.returncode
    return (128 - status if status < 0 else status), error, time.monotonic() - start, peak


def address_space(pid):
    try:
        for line in Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmPeak:"):
                return int(line.split()[1]) * KIB
    except OSError:
        pass
    return 0


def whole(path):
    """Why a file is not whole; nothing if it is."""
    if path.suffix == ".json":
        try:
            json.loads(path.read_text())
        except ValueError as e:
            return f"{path.name}: {e}"
    elif path.suffix == ".html":
        if not path.read_text().rstrip().endswith("</html>"):
            return f"{path.name}: cut off"
    elif path.suffix == ".pcd":
        header = path.read_bytes()[:2000]
        if b"DATA " not in header:
            return f"{path.name}: no header"
        lines = header.split(b"DATA ")[0].decode().split("\n")
        field = {line.split()[0]: line.split()[1:] for line in lines if line.strip()}
        point = sum(int(s) * int(c) for s, c in zip(field["SIZE"], field["COUNT"]))
        begin = header.index(b"DATA ")
        begin = header.index(b"\n", begin) + 1
        if path.stat().st_size != begin + point * int(field["POINTS"][0]):
            return f"{path.name}: its length is not what its header says"
    elif path.stat().st_size == 0:
        return f"{path.name}: empty"
    return ""


def faults_of_files(folder, expected):
    """What is wrong with the files that a run has left."""
    problems = []
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        if path.name not in expected:
            continue  # Unfinished files have other names, which nothing reads.
        problem = whole(path)
        if problem:
            problems.append(problem)
    # Of one run: the numbers of the yaml are those of the json.
    result, yaml = folder / "result.json", folder / "result.yaml"
    if yaml.exists() and not result.exists():
        problems.append("result.yaml without result.json")
    if yaml.exists() and result.exists():
        numbers = json.loads(result.read_text())["T_camera_lidar"]["translation_m"]
        text = yaml.read_text()
        if not all(spelled(v, text) for v in numbers):
            problems.append("result.yaml is not of the run of result.json")
    return problems


def spelled(value, text):
    return any(f"{value:.{digits}g}" in text for digits in range(6, 18))


def killed(name, arguments, out, fresh, expected, moments, seconds, random_, stays=frozenset()):
    """`stays`: files, relative to `out`, that are there before and must be there after."""
    failures = []
    ended = 0
    for _ in range(moments):
        fresh()
        after = random_.uniform(0.0, 1.05 * seconds)
        status, error, _, _ = run(arguments, out.parent, kill_after_s=after)
        if status == 0:
            ended += 1
        elif status != 128 + signal.SIGKILL:
            failures.append(f"status {status} after {after:.2f} s: {error.strip()}")
        if out.exists():
            failures += faults_of_files(out if out.is_dir() else out.parent, expected)
        failures += [f"{path} is gone after {after:.2f} s" for path in sorted(stays)
                     if not (out / path).exists()]
    print(f"| {name} | killed at {moments} moments | {moments - ended} before the end | "
          f"{'all files whole' if not failures else '; '.join(failures[:3])} |", flush=True)
    return not failures


def starved(name, arguments, out, fresh, expected, steps, peak):
    failures = []
    statuses = {}
    for k in range(steps):
        fresh()
        # From the least in which a program of this size can be loaded.
        limit = int(peak * (0.1 + 1.1 * (k + 1) / steps))
        status, error, _, _ = run(arguments, out.parent, limit_bytes=limit)
        messages = [line for line in error.splitlines() if line.startswith("lvcalib: error: ")]
        statuses[status] = statuses.get(status, 0) + 1
        where = f"{limit // (1024 * KIB)} MiB"
        if status == 127 and "error while loading shared libraries" in error:
            continue  # The system's loader, before the program.
        if status not in (0, 1, 3):
            failures.append(f"status {status} with {where}: {error.strip()[-200:]}")
        elif status != 0 and len(messages) != 1:
            failures.append(f"{len(messages)} messages with {where}: {error.strip()[-200:]}")
        elif "HANGS" in error:
            failures.append(f"hangs with {where}")
        if out.exists():
            failures += faults_of_files(out if out.is_dir() else out.parent, expected)
    told = ", ".join(f"{n} × {s}" for s, n in sorted(statuses.items()))
    print(f"| {name} | {steps} memory limits to {peak // (1024 * KIB)} MiB | status {told} | "
          f"{'one message each' if not failures else '; '.join(failures[:3])} |", flush=True)
    return not failures


def full_disk(name, arguments, out, expected, size, steps):
    failures = []
    for k in range(steps):
        room = max(16 * KIB, int(size * (k + 0.5) / steps) // (4 * KIB) * 4 * KIB)
        disk = out.parent / "disk"
        disk.mkdir(exist_ok=True)
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={room}", "tmpfs", str(disk)],
                          stderr=subprocess.DEVNULL, check=False).returncode != 0:
            print(f"| {name} | full disk | skipped: no right to mount one | |", flush=True)
            return True
        try:
            target = disk / out.name
            there = [str(target) if a == str(out) else a for a in arguments]
            status, error, _, _ = run(there, out.parent)
            messages = [line for line in error.splitlines() if line.startswith("lvcalib: error: ")]
            if status != 3 or len(messages) != 1:
                failures.append(f"status {status} with {room // KIB} KiB: {error.strip()[-200:]}")
            failures += faults_of_files(disk, expected)
        finally:
            subprocess.run(["umount", str(disk)], check=False)
    print(f"| {name} | {steps} disks too small for {size // KIB} KiB | | "
          f"{'status 3, one message' if not failures else '; '.join(failures[:3])} |", flush=True)
    return not failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("bin", type=Path)
    parser.add_argument("--moments", type=int, default=100)
    parser.add_argument("--steps", type=int, default=24)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    program = str((options.bin / "lvcalib").resolve())
    random_ = random.Random(options.seed)
    failed = 0
    with tempfile.TemporaryDirectory(prefix="lvcalib-faults-") as name:
        folder = Path(name)

        def prepare(*arguments):
            status, error, _, _ = run([program, *map(str, arguments)], folder)
            if status != 0:
                sys.exit(f"{' '.join(map(str, arguments))} fails: {error}")

        rig, done = folder / "rig", folder / "done"
        prepare("simulate", "-o", rig, "--seed", "7", "--scenes", "3")
        prepare("calibrate", rig, "-o", done)
        pairs = folder / "pairs"
        pairs.mkdir()
        for scene in sorted((rig / "scenes").iterdir()):
            for file in scene.iterdir():
                if file.suffix in (".png", ".pcd"):
                    shutil.copy(file, pairs / (scene.name + file.suffix))
        out = folder / "out"
        target, camera = rig / "target.yaml", rig / "camera.yaml"
        commands = {
            "calibrate": ["calibrate", rig, "-o", out],
            "discover": ["discover", rig, "-o", out],
            "report": ["report", done, "-o", out / "report.html"],
            "export": ["export", done / "result.json", "--format", "ros2-tf", "-o", out / "tf.py"],
            "correct": ["correct", rig / "scenes" / "A" / "cloud.pcd", "--with",
                        done / "result.json", "-o", out / "fixed.pcd"],
            "import": ["import", pairs, "-o", out, "--target", target, "--camera", camera],
        }
        # What stands where the command writes, if it replaces it.
        older = {"calibrate": ["calibrate", rig, "-o", folder / "older-calibrate", "--tolerance",
                               "3,1"],
                 "import": ["import", pairs, "-o", folder / "older-import"]}
        for words in older.values():
            prepare(*words)
        older["discover"] = older["calibrate"]
        for command, words in commands.items():
            arguments = [program, *map(str, words)]

            def fresh():
                shutil.rmtree(out, ignore_errors=True)
                if str(out) not in arguments:
                    out.mkdir()

            fresh()
            status, error, seconds, peak = run(arguments, folder)
            if status not in (0, 1):
                print(f"| {command} | without a fault | status {status} | {error.strip()} |")
                failed += 1
                continue
            files = [p for p in out.rglob("*") if p.is_file()]
            expected = {p.name for p in files}
            size = sum(p.stat().st_size for p in files)
            ok = killed(command, arguments, out, fresh, expected, options.moments, seconds, random_)
            if command in older:
                before = older[command][3]

                def over_older():
                    fresh()
                    shutil.copytree(before, out)

                force = ["--force"] if command == "import" else []
                there = {p.relative_to(before) for p in before.rglob("*") if p.is_file()}
                ok = killed(f"{command} over an older one", arguments + force, out, over_older,
                            expected, options.moments, seconds, random_, there) and ok
                over_older()
                run(arguments + force, folder)
                left = [p.name for p in folder.glob(f".{out.name}.part*")]
                if left:
                    print(f"| {command} over an older one | the run after | | leaves {left} |")
                    ok = False
            ok = starved(command, arguments, out, fresh, expected, options.steps, peak) and ok
            fresh()
            if str(out) in arguments and size > 64 * KIB:
                ok = full_disk(command, arguments, out, expected, size, 4) and ok
            failed += 0 if ok else 1
    return min(failed, 100)


if __name__ == "__main__":
    sys.exit(main())
