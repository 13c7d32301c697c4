# SPDX-License-Identifier: GPL-3.0-or-later
"""The catalogues must hold every text of the window, translated.

Usage: translations_test.py CORE_TEXTS
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORE_TEXTS = sys.argv.pop()
HINT = "run packaging/update-translations.sh and translate what is unfinished"


def messages(path):
    """{(context, source): (state, translations)} of a catalogue."""
    found = {}
    for context in ElementTree.parse(path).getroot().findall("context"):
        name = context.findtext("name")
        for message in context.findall("message"):
            translation = message.find("translation")
            forms = [form.text or "" for form in translation.findall("numerusform")]
            found[name, message.findtext("source")] = (
                translation.get("type", "finished"), forms or [translation.text or ""])
    return found


def places(text):
    return sorted(re.findall(r"%(?:[0-9]|n)", text))


class Translations(unittest.TestCase):
    def setUp(self):
        self.catalogues = sorted((ROOT / "translations").glob("*.ts"))
        self.assertTrue(self.catalogues)

    def test_catalogues_hold_what_the_sources_say(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in self.catalogues:
                shutil.copy(path, folder)
            subprocess.run([ROOT / "packaging/update-translations.sh", folder], check=True,
                           env={**os.environ, "CORE_TEXTS": CORE_TEXTS}, capture_output=True)
            for path in self.catalogues:
                kept, wanted = messages(path), messages(Path(folder) / path.name)
                self.assertEqual(set(wanted) - set(kept), set(), f"missing: {HINT}")
                self.assertEqual(set(kept) - set(wanted), set(), f"no longer said: {HINT}")

    def test_everything_is_translated(self):
        for path in self.catalogues:
            for (context, source), (state, forms) in messages(path).items():
                with self.subTest(catalogue=path.name, context=context, source=source):
                    self.assertEqual(state, "finished", HINT)
                    for text in forms:
                        self.assertTrue(text.strip(), HINT)

    def test_places_keys_and_ends_are_kept(self):
        for path in self.catalogues:
            for (context, source), (_, forms) in messages(path).items():
                for text in forms:
                    with self.subTest(catalogue=path.name, context=context, source=source):
                        self.assertEqual(places(text), places(source))
                        self.assertEqual(len(re.findall(r"&\w", text)),
                                         len(re.findall(r"&\w", source)), "keys")
                        self.assertEqual("…" in text, "…" in source, "an ellipsis asks for more")


if __name__ == "__main__":
    unittest.main()
