# SPDX-License-Identifier: MIT
"""`pip install .` into a clean virtual environment, and the same bytes from there."""
import os
import subprocess
import sys
import unittest
import urllib.error
import urllib.request

import trajlo
from support import BUILD, ROOT, FolderTest

PROGRAM = """
import sys, trajlo
odometry = trajlo.Odometry(config="ouster")
for scan in trajlo.simulate("hall_os1_16", duration_s=1.5):
    odometry.add(scan)
odometry.finish()
odometry.trajectory.save_tum(sys.argv[1])
print(trajlo.__file__)
"""


def why_not():
    """What is missing for an installation by pip; empty if nothing is."""
    if subprocess.run([sys.executable, "-c", "import venv, ensurepip"],
                      capture_output=True, check=False).returncode != 0:
        return "python3-venv is not installed"
    try:
        urllib.request.urlopen("https://pypi.org/simple/scikit-build-core/", timeout=20).close()
    except (urllib.error.URLError, OSError) as error:
        return f"PyPI cannot be reached: {error}"
    return ""


class WheelTest(FolderTest):

    def test_pip_install(self):
        reason = why_not()
        if reason:
            self.skipTest(reason)
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        environment.setdefault("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))

        def run(*command):
            done = subprocess.run(list(map(str, command)), cwd=self.folder, env=environment,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, f"{done.stdout}\n{done.stderr}")
            return done.stdout

        python = self.folder / "venv" / "bin" / "python"
        run(sys.executable, "-m", "venv", self.folder / "venv")
        # Compiler, flags and depth of the build tree, so that ccache has most of it.
        run(python, "-m", "pip", "install", "--quiet",
            f"--config-settings=build-dir={BUILD.resolve()}-wheel",
            "--config-settings=cmake.define.TRAJLO_WERROR=ON", ROOT)
        (self.folder / "program.py").write_text(PROGRAM)
        where = run(python, "program.py", "installed.tum")
        self.assertIn(str(self.folder / "venv"), where)

        odometry = trajlo.Odometry(config="ouster")
        for scan in trajlo.simulate("hall_os1_16", duration_s=1.5):
            odometry.add(scan)
        odometry.finish()
        self.assertEqual((self.folder / "installed.tum").read_bytes(),
                         self.tum_of(odometry.trajectory))


if __name__ == "__main__":
    unittest.main()
