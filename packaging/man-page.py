#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a manual page from its template.

Usage: man-page.py TEMPLATE VERSION OUTPUT [PROGRAM]

@VERSION@ in the template is replaced by the version, @COMMANDS@ by the commands of the program with
all their arguments and options, read from its own --help: what the page says is what the program
does.
"""

import re
import subprocess
import sys
from pathlib import Path

# "  -o,--output TEXT REQUIRED   folder of ..." as CLI11 prints it.
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")
DESCRIPTION_COLUMN = 30
ITEM = "\0"  # Marks an item of a list within a description.
CONTINUATION = re.compile(r"^\s{20,}(\S.*)$")


def escape(text):
    """Plain text as roff."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in ".'" else text


def help_text(program, *arguments):
    done = subprocess.run([program, *arguments, "--help"], capture_output=True, text=True,
                          check=True)
    return done.stdout.splitlines()


def entries(lines, title):
    """Pairs of name and description below `title:`."""
    found = []
    inside = False
    for line in lines:
        if not line.startswith(" "):
            inside = line == title + ":"
            continue
        if not inside:
            continue
        more = CONTINUATION.match(line)
        if more and found:
            # Deeper than a description begins: an item of a list, on a line of its own.
            item = len(line) - len(line.lstrip()) > DESCRIPTION_COLUMN
            found[-1][1].append((ITEM if item else "") + more.group(1))
            continue
        entry = ENTRY.match(line)
        if entry:
            found.append((entry.group(1), [entry.group(2)] if entry.group(2) else []))
    return [(name, words) for name, words in found]


def prose(words):
    """A description's lines as roff; an item of a list begins a line."""
    out = ""
    for word in words:
        item = word.startswith(ITEM)
        out += ("\n.br\n" if item else " " if out else "") + escape(word.removeprefix(ITEM))
    return out


def signature(text):
    """"-o,--output TEXT REQUIRED" as a roff heading: names bold, values in italics."""
    required = " REQUIRED" in text
    text = text.replace(" REQUIRED", "")
    names, _, value = text.partition(" ")
    heading = ", ".join(f"\\fB{escape(name)}\\fR" for name in names.split(","))
    # "TEXT:{a,b}=a": the choices stand in the description, the default is worth keeping.
    kind, _, default = value.partition("=")
    repeats = kind.endswith(" ...")
    kind = re.sub(r":.*$", "", kind.removesuffix(" ...")).strip()
    if kind:
        heading += f" \\fI{escape(kind)}\\fR"
    if repeats:
        heading += " ..."
    if default:
        heading += f" (default {escape(default)})"
    return heading + (" (required)" if required else "")


def list_of(options):
    """Options or arguments with their descriptions."""
    out = []
    for name, words in options:
        out += [".TP", signature(name), prose(words) or escape(name)]
    return out


def command_section(program, command, about, common):
    lines = help_text(program, command)
    usage = next((line for line in lines if line.startswith("Usage: ")), "")
    out = [f".SS {escape(command)}", prose(about) + ".", ".PP",
           f".B {escape(usage.removeprefix('Usage: '))}"]
    out += list_of(entries(lines, "Positionals"))
    out += list_of(entry for entry in entries(lines, "Options") if entry not in common)
    # What follows the options (lists, notes) keeps its columns.
    start = next((n for n, line in enumerate(lines) if re.match(r"^[A-Z]{2,}", line)), len(lines))
    if start < len(lines):
        out += [".PP", ".nf"] + [escape(line) for line in lines[start:] if line.strip()] + [".fi"]
    return out


def commands_of(program):
    """Sections of all commands, and the options that all of them take, once."""
    commands = entries(help_text(program), "Subcommands")
    options = [entries(help_text(program, command), "Options") for command, _ in commands]
    common = [entry for entry in options[0] if all(entry in other for other in options)]
    out = [".SS Options of every command"] + list_of(common)
    for command, about in commands:
        out += command_section(program, command, about, common)
    return "\n".join(out)


def main():
    if len(sys.argv) not in (4, 5):
        print(__doc__, file=sys.stderr)
        return 2
    template = Path(sys.argv[1]).read_text(encoding="utf-8")
    page = template.replace("@VERSION@", sys.argv[2])
    if len(sys.argv) == 5:
        page = page.replace("@COMMANDS@", commands_of(sys.argv[4]))
    Path(sys.argv[3]).write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
