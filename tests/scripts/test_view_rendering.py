# SPDX-License-Identifier: MIT
"""A browser without a network, and without a graphics card, draws the 3-D view of a run."""
import json
import re
import shutil
import subprocess
import unittest

from evaluation_folder import write_evaluation
from result_folder import write_result
from support import SCRIPTS, FolderTest

from trajlo_report import view

CHROMIUM = shutil.which("chromium")
# Draws in several states and counts pixels; leaves what it found in an attribute of the body.
PROBE = """<script>
const pixelsOf = (view) => {
  view.draw(1);
  const gl = view.gl, size = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const pixels = new Uint8Array(4 * size[0] * size[1]);
  gl.readPixels(0, 0, ...size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels;
};
const count = (pixels, test) => {
  let found = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i + 3] > 0 && test(pixels[i], pixels[i + 1], pixels[i + 2])) ++found;
  }
  return found;
};
const like = (r, g, b) => (x, y, z) => Math.abs(x - r) + Math.abs(y - g) + Math.abs(z - b) < 24;
const select = (view, text, value) => {
  const box = [...view.root.querySelectorAll('select')].find((item) =>
    [...item.options].some((option) => option.textContent === text));
  box.value = [...box.options].find((option) => option.textContent === value).value;
  box.dispatchEvent(new Event('change'));
};
const findings = (view) => {
  view.tick = () => {};
  const all = () => true, found = {};
  const first = pixelsOf(view);
  found.area = first.length / 4;
  found.drawn = count(first, all);
  found.ceiling = view.cloud.cut;
  found.flagged = count(first, like(0xd1, 0x24, 0x2f));
  view.cloud.setCut(Infinity);
  found.with_ceiling = count(pixelsOf(view), all);
  view.cloud.setCut(0.5);
  found.below_half_a_metre = count(pixelsOf(view), all);
  view.cloud.setCut(found.ceiling);
  const colors = [];
  for (const name of ['intensity', 'time of the scan', 'height']) {
    select(view, 'time of the scan', name);
    const pixels = pixelsOf(view);
    const sum = [0, 0, 0];
    for (let i = 0; i < pixels.length; ++i) if (i % 4 < 3) sum[i % 4] += pixels[i];
    colors.push(sum);
  }
  found.colors = colors;
  for (const name of ['speed', 'points with a plane', 'none']) select(view, 'none', name);
  found.scan_before = count(pixelsOf(view), like(0xc2, 0x00, 0x6b));
  const slider = view.root.querySelector('.time input');
  slider.value = 3.7;
  slider.dispatchEvent(new Event('input'));
  found.scan_after = count(pixelsOf(view), like(0xc2, 0x00, 0x6b));
  found.moment = view.page.cloud.moments_s[view.cloud.momentAt(view.timeline.time)];
  const range = view.cloud.scan.geometry.drawRange;
  found.scan_points = range.count;
  found.sample = Array.from({length: 20}, (_, i) => view.cloud.place(range.start + i));
  found.said = view.timeline.readout.textContent;
  found.views = [...view.root.querySelectorAll('.buttons button')].slice(0, 4).map((button) => {
    button.click();
    return count(pixelsOf(view), all);
  });
  // A point that was aimed at, or one before it.
  const width = view.stage.clientWidth, aim = new THREE.Vector3(...view.cloud.place(0));
  const [x, y] = view.viewer.project(aim, width);
  const picked = view.viewer.pick(view.cloud, x, y, width);
  const [px, py] = view.viewer.project(picked, width);
  found.picked = {pixels: Math.hypot(px - x, py - y),
    before: aim.distanceTo(view.viewer.camera.position) -
            picked.distanceTo(view.viewer.camera.position)};
  return found;
};
const wait = () => {
  const root = document.getElementById('view');
  if (!root || root.dataset.state === 'failed') {
    document.body.dataset.findings = JSON.stringify({failed: root.textContent});
  } else if (root.dataset.state === 'ready') {
    document.body.dataset.findings = JSON.stringify(findings(root.view));
  } else setTimeout(wait, 50);
};
wait();
</script></body>"""


@unittest.skipUnless(CHROMIUM, "chromium is not installed")
@unittest.skipIf(view.missing_library(), "libjs-three is not installed")
class ViewRenderingTest(FolderTest):
    def browse(self, page, *arguments):
        """The page after it was drawn, and what the browser complained about."""
        done = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--enable-logging=stderr", "--dump-dom",
             "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={self.folder / 'profile'}",
             "--virtual-time-budget=60000", *arguments, page.as_uri()],
            capture_output=True, text=True, check=False, timeout=280)
        self.assertIn("</html>", done.stdout, done.stderr)
        # What WebGL itself says about reading pixels is the probe's fault, not the page's.
        lines = [line for line in done.stderr.splitlines()
                 if "CONSOLE" in line and "GPU stall due to ReadPixels" not in line]
        return done.stdout, lines

    def drawn(self, *arguments):
        result = write_result(self.folder / "result", seconds=40, points_per_moment=800,
                              map_points=20000, flags={100: "not_converged", 200: "gap"})
        write_evaluation(self.folder / "evaluation", {"one": 0.05}, of=result)
        subprocess.run([SCRIPTS / "draw_run.py", result, *arguments], check=True,
                       capture_output=True)
        return result / "run.html"

    def find(self, page):
        copy = self.write("probed.html", page.read_text().replace("</body>", PROBE))
        text, lines = self.browse(copy, "--window-size=1300,1000")
        self.assertEqual(lines, [])
        match = re.search(r'data-findings="([^"]*)"', text)
        self.assertTrue(match, "the view was not ready in time")
        return json.loads(match.group(1).replace("&quot;", '"').replace("&amp;", "&"))

    def test_map_path_scan_and_controls_draw_what_they_should(self):
        found = self.find(self.drawn("--evaluation", self.folder / "evaluation"))
        self.assertNotIn("failed", found)
        self.assertGreater(found["drawn"], 0.1 * found["area"])
        # The room has a ceiling, which is left away at first.
        self.assertTrue(1.2 < found["ceiling"] < 3.0)
        self.assertGreater(found["with_ceiling"], found["drawn"])
        self.assertLess(found["below_half_a_metre"], found["drawn"])
        self.assertGreater(found["flagged"], 20)
        self.assertEqual(len({tuple(color) for color in found["colors"]}), 3)
        # The scan of 3.5 s is seen as soon as the slider is moved to 3.7 s.
        self.assertLess(found["scan_before"], 20)
        self.assertGreater(found["scan_after"], 300)
        self.assertEqual((found["moment"], found["scan_points"]), (3.5, 800))
        self.assertIn("3.70 s of 40.00 s", found["said"].replace("3.69", "3.70"))
        for place in found["sample"]:  # on a wall of the room
            distance = min(min(abs(value - low), abs(value - high)) for value, low, high in
                           zip(place, (-10, -6, 0), (10, 6, 3)))
            self.assertLess(distance, 1e-3)
        self.assertEqual(len(set(found["views"])), 4)
        self.assertGreater(min(found["views"]), 0.02 * found["area"])
        self.assertLess(found["picked"]["pixels"], 10)
        self.assertGreater(found["picked"]["before"], -0.05)

    def test_a_broken_page_is_noticed(self):
        page = self.drawn()
        broken = self.write("broken.html", page.read_text().replace('"cloud_x"', '"cloud_w"'))
        text, lines = self.browse(broken)
        self.assertIn('data-state="failed"', text)
        self.assertIn("The 3-D view cannot be shown", text)
        self.assertTrue(lines)

    def test_without_a_truth_or_scans_the_view_draws_too(self):
        result = write_result(self.folder / "result", scans=False)
        subprocess.run([SCRIPTS / "draw_run.py", result], check=True, capture_output=True)
        text, lines = self.browse(result / "run.html", "--window-size=600,900")
        self.assertEqual(lines, [])
        self.assertIn('data-state="ready"', text)


if __name__ == "__main__":
    unittest.main()
