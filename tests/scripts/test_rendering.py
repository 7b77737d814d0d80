# SPDX-License-Identifier: MIT
"""A browser without a network shows the pages: all pictures, nothing wider than the window."""
import re
import shutil
import subprocess
import unittest

from evaluation_folder import write_evaluation
from support import SCRIPTS, FolderTest

CHROMIUM = shutil.which("chromium")
# Tells in attributes of the body what can only be known by rendering.
PROBE = """<script>
addEventListener("load", () => {
  const images = [...document.images];
  const body = document.body;
  body.dataset.images = images.length;
  body.dataset.broken = images.filter(i => !i.complete || i.naturalWidth === 0).length;
  body.dataset.overflow = document.documentElement.scrollWidth - innerWidth;
  body.dataset.outside = performance.getEntriesByType("resource")
      .filter(entry => !entry.name.startsWith("data:")).length;
});
</script></body>"""


@unittest.skipUnless(CHROMIUM, "chromium is not installed")
class RenderingTest(FolderTest):
    def probe(self, page, *arguments):
        """The attributes that the probe leaves in a copy of the page."""
        copy = self.write("probed.html", page.read_text().replace("</body>", PROBE))
        done = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={self.folder / 'profile'}",
             "--virtual-time-budget=10000", *arguments, copy.as_uri()],
            capture_output=True, text=True, check=False, timeout=120)
        self.assertIn("</html>", done.stdout, done.stderr)
        return {name: int(value) for name, value in
                re.findall(r'data-(images|broken|overflow|outside)="(-?\d+)"', done.stdout)}

    def evaluated(self, of=None):
        return write_evaluation(self.folder / "evaluation", {"ours": 0.01, "theirs": 0.2}, of=of)

    def test_the_page_of_an_evaluation_shows_all_its_figures(self):
        subprocess.run([SCRIPTS / "draw_evaluation.py", self.evaluated()], check=True,
                       capture_output=True)
        seen = self.probe(self.folder / "evaluation" / "report.html", "--window-size=1300,1000")
        self.assertEqual((seen["images"], seen["broken"], seen["outside"]), (5, 0, 0))
        self.assertLessEqual(seen["overflow"], 0)

    def test_the_page_of_a_run_fits_a_narrow_window(self):
        lines = [f"{0.1 * i} {i} 0 0 0 0 0 1" for i in range(30)]
        self.write("result/trajectory.tum", "\n".join(lines) + "\n")
        subprocess.run([SCRIPTS / "draw_run.py", self.folder / "result", "--evaluation",
                        self.evaluated(self.folder / "result")], check=True, capture_output=True)
        seen = self.probe(self.folder / "result" / "run.html", "--window-size=520,900")
        self.assertEqual((seen["images"], seen["broken"], seen["outside"]), (7, 0, 0))
        self.assertLessEqual(seen["overflow"], 0)


if __name__ == "__main__":
    unittest.main()
