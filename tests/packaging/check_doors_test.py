# SPDX-License-Identifier: GPL-3.0-or-later
"""check-doors.py must accept the doors that are there and refuse the others."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "packaging" / "check-doors.py"
BSD = "// SPDX-License-Identifier: BSD-3-Clause\n"
GPL = "// SPDX-License-Identifier: GPL-3.0-or-later\n"


def run(files):
    """Exit status and output for a project made of the given files."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {"core/base/error.h": BSD, **files}.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout


class CheckDoors(unittest.TestCase):
    def accept(self, name, text):
        status, output = run({name: text})
        self.assertEqual(status, 0, output)

    def refuse(self, name, text, reason):
        status, output = run({name: text})
        self.assertEqual(status, 1, output)
        self.assertIn(name, output)
        self.assertIn(reason, output)

    def test_doors_that_are_there(self):
        self.accept("core/detection/a.cpp", BSD + '#include "camera/camera.h"\n')
        self.accept("core/cloud/a.cpp", BSD + '#include "cloud/cloud.h"\n#include <opencv2/core.hpp>\n')
        self.accept("core/simulation/a.cpp", BSD + '#include "cloud/cloud.h"\n')
        self.accept("core/selection/a.cpp", BSD + '#include "diagnostics/structure_scan.h"\n')
        self.accept("core/report/a.h", BSD + '#include "pipeline/session.h"\n')
        self.accept("app/cli/a.cpp", GPL + '#include "report/result.h"\n')
        self.accept("widgets/views/a.cpp", GPL + "#include <QWidget>\n#include <vtkActor.h>\n")

    def test_doors_that_are_not(self):
        self.refuse("core/base/a.cpp", BSD + '#include "cloud/cloud.h"\n', "from base to cloud")
        self.refuse("core/camera/a.cpp", BSD + '#include "target/target.h"\n', "camera to target")
        self.refuse("core/simulation/a.cpp", BSD + '#include "model/a.h"\n', "simulation to model")
        self.refuse("core/simulation/a.cpp", BSD + '#include "cloud/plane.h"\n', "only write")
        self.refuse("core/pipeline/a.cpp", BSD + '#include "report/a.h"\n', "pipeline to report")
        self.refuse("core/report/a.cpp", BSD + '#include "simulation/a.h"\n', "to simulation")
        self.refuse("core/design/a.cpp", BSD + '#include "selection/a.h"\n', "design to selection")
        self.refuse("core/base/a.cpp", BSD + '#  include "widgets/a.h"\n', "widgets/")
        self.refuse("core/kitchen/a.cpp", BSD, "not in a room")

    def test_libraries(self):
        for header in ("QString", "QtCore/QString", "vtkActor.h"):
            self.refuse("core/cloud/a.cpp", BSD + f"#include <{header}>\n", "Qt or VTK")
        for header in ("opencv2/core.hpp", "ceres/ceres.h", "pcl/point_types.h",
                       "yaml-cpp/yaml.h", "apriltag/apriltag.h", "apriltag.h"):
            self.refuse("core/cloud/a.h", BSD + f"#include <{header}>\n", "out of headers")

    def test_mirrors(self):
        mirror = {"core/cloud/a.cpp": BSD, "tests/core/cloud/a_test.cpp": GPL}
        self.assertEqual(run(mirror)[0], 0)
        elsewhere = {"core/target/sheet_drawing.cpp": BSD, "core/target/tag_pattern.cpp": BSD,
                     "tests/core/target/sheet_test.cpp": GPL,
                     "tests/core/target/target_test.cpp": GPL}
        self.assertEqual(run(elsewhere)[0], 0)
        for files, said in (
                (mirror | {"core/cloud/b.cpp": BSD}, "core/cloud/b.cpp: neither"),
                (elsewhere | {"tests/core/target/tag_pattern_test.cpp": GPL},
                 "core/target/tag_pattern.cpp: TESTED_BY is out of date"),
                ({k: v for k, v in elsewhere.items() if "sheet_test" not in k},
                 "core/target/sheet_drawing.cpp: TESTED_BY is out of date"),
                ({k: v for k, v in elsewhere.items() if "drawing" not in k},
                 "core/target/sheet_drawing: TESTED_BY names what is not there")):
            status, output = run(files)
            self.assertEqual(status, 1, output)
            self.assertIn(said, output)

    def test_licences(self):
        self.refuse("core/cloud/a.cpp", GPL, "BSD-3-Clause")
        self.refuse("app/cli/a.cpp", "int main() {}\n", "GPL-3.0-or-later")
        self.refuse("packaging/a.sh", "#!/bin/sh\n\n# SPDX\n", "GPL-3.0-or-later")


if __name__ == "__main__":
    unittest.main()
