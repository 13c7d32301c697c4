# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual page must name every command and option of the program.

Usage: man_page_test.py LVCALIB
"""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop()


def output_of(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


class ManPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "lvcalib.1"
            subprocess.run([sys.executable, ROOT / "packaging/man-page.py",
                            ROOT / "resources/man/lvcalib.1.in", "1.2.3", page, PROGRAM], check=True)
            cls.raw = page.read_text(encoding="utf-8")
        cls.text = re.sub(r"\\f[BIR]", "", cls.raw).replace("\\-", "-").replace("\\&", "")
        subcommands = output_of("--help").split("Subcommands:")[1]
        cls.commands = re.findall(r"^  ([a-z]\w*) ", subcommands, re.MULTILINE)

    def section(self, command):
        return self.text.split(f".SS {command}\n")[1].split(".SS ")[0].split(".SH ")[0]

    def test_every_command_and_option(self):
        self.assertGreater(len(self.commands), 5)
        common = self.section("Options of every command")
        for command in self.commands:
            section = self.section(command)
            names = re.findall(r"(?<![\w-])--[a-z][\w-]*", output_of(command, "--help"))
            self.assertIn("--threads", names)
            for name in names:
                self.assertIn(name, section + common, f"{command} {name}")

    def test_descriptions_defaults_and_lists(self):
        self.assertIn("leave out this scene (repeatable)", self.section("calibrate"))
        self.assertIn("-o, --output TEXT (required)", self.section("calibrate"))
        self.assertIn("(default 128)", self.section("simulate"))
        # Lists keep their lines.
        self.assertRegex(self.section("export"), r"\n\.br\nkalibr: ")
        self.assertRegex(self.section("simulate"), r"\n\.nf\nEFFECTS(.|\n)*\n  range_walk .*\n")

    def test_nothing_is_left_of_the_template(self):
        self.assertNotIn("@", self.text)
        self.assertIn("lvcalib 1.2.3", self.text)
        for line in self.raw.splitlines():
            if line.startswith("."):
                self.assertRegex(line, r'^\.(\\"|TH|SH|SS|TP|PP|B|BR|BI|I|IR|RI|RB|nf|fi|br|RS|RE)\b|^\.\\"')


if __name__ == "__main__":
    unittest.main()
