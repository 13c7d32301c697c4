#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints every sentence of the core library as source text for lupdate.

A sentence is what is written out in Message("..."), in core/ alone; not in core/simulation, of
which the window shows nothing. Usage: core-messages.py ROOT
"""
import pathlib
import re
import sys

LITERAL = r'"(?:[^"\\\n]|\\.)*"'
SENTENCE = re.compile(r"\bMessage\(\s*((?:" + LITERAL + r"\s*)+)")


def sentences(root):
    """The literals of all sentences below root/core, as written, each once and in order."""
    found = set()
    for path in sorted((root / "core").rglob("*.[hc]*")):
        if "simulation" in path.parts or not path.is_file():
            continue
        for match in SENTENCE.finditer(path.read_text(encoding="utf-8")):
            found.add("".join(text[1:-1] for text in re.findall(LITERAL, match.group(1))))
    return sorted(found - {""})


def main():
    print("static const char* const messages[] = {")
    for text in sentences(pathlib.Path(sys.argv[1])):
        print(f'  QT_TRANSLATE_NOOP("Core", "{text}"),')
    print("};")


if __name__ == "__main__":
    main()
