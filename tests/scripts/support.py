# SPDX-License-Identifier: MIT
"""What the tests of the scripts share: import paths, temporary folders, little suites, programs
that only pretend."""
import os
import pathlib
import re
import stat
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
sys.path.insert(0, str(SCRIPTS))

# Shows its options like trajlo_run; {digest} makes builds differ.
PRETENDED_RUN = """#!/bin/sh
# {digest}
for argument in "$@"; do
  case "$argument" in
    --version) echo "trajlo_run 0.1.0 ({digest})"; exit 0 ;;
    --set=*bad*) echo "bad: there is no such option" >&2; exit 1 ;;
    --set=*) set="${{argument#--set=}}" ;;
  esac
done
echo "window:"
echo "  segments: 4  # $set"
"""
PRETENDED = "#!/bin/sh\necho '{name} 0.1.0'\n"


class FolderTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`, that is deleted afterwards."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="trajlo_scripts_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def pretend_build(self, digest="first"):
        """A build folder whose programs show options and versions, and do nothing else."""
        for name in ("trajlo_simulate", "trajlo_evaluate"):
            self.executable(f"build/apps/{name}", PRETENDED.format(name=name))
        self.executable("build/apps/trajlo_run", PRETENDED_RUN.format(digest=digest))
        return self.folder / "build"

    def called_in_build_dir(self, script, program, *arguments, **more):
        """Whether a script calls a program of the build that TRAJLO_BUILD_DIR names."""
        called = self.folder / "called.txt"
        self.executable(f"named/apps/{program}", f"#!/bin/sh\ntouch '{called}'\nexit 1\n")
        subprocess.run([sys.executable, "-B", SCRIPTS / script, *arguments], capture_output=True,
                       check=False, cwd=self.folder,
                       env={**os.environ, "TRAJLO_BUILD_DIR": str(self.folder / "named"), **more})
        return called.exists()

    def executable(self, name, text):
        path = self.write(name, text)
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def assert_self_contained(self, page):
        """Nothing in a page is fetched from anywhere: neither from the net nor from files."""
        text = pathlib.Path(page).read_text()
        # A library may know of addresses; RenderingTest sees that it asks for none.
        text = re.sub(r"<script data-library>.*?</script>", "", text, flags=re.DOTALL)
        bare = re.sub(r"base64,[A-Za-z0-9+/=]+", "base64,", text)
        addresses = re.findall(
            r"""(?<![\w-])(?:src|href|srcset|data|action)\s*=\s*["']?([^"'\s>]+)""", bare)
        # The pages of single runs are only linked.
        outside = [address for address in addresses
                   if not address.startswith(("data:", "#")) and not address.endswith("/run.html")]
        self.assertEqual(outside, [])
        self.assertNotRegex(bare, r"(?:https?|file)://|@import|url\((?!data:)")
        self.assertIn("</html>", text)


def described_columns(readme):
    """Patterns of the columns that the section results.csv of a README describes."""
    section = (ROOT / readme).read_text().partition("## results.csv\n")[2].partition("\n## ")[0]
    cells = [line.split(" | ")[0] for line in section.splitlines() if line.startswith("| ")]
    return [re.sub("X|LENGTH|FLAG", "[0-9a-z._]+", name) for cell in cells
            for name in re.findall("`(.+?)`", cell)]


def not_described(columns, *readmes):
    patterns = [pattern for readme in readmes for pattern in described_columns(readme)]
    return [name for name in columns
            if not any(re.fullmatch(pattern, name) for pattern in patterns)]


def built(name):
    """A program of the build that is tested; the test is skipped where it is not built."""
    build = pathlib.Path(os.environ.get("TRAJLO_BUILD_DIR", ROOT / "build"))
    program = build / "apps" / name
    if not program.is_file():
        raise unittest.SkipTest(f"{program} is not built")
    return program.resolve()
