# SPDX-License-Identifier: MIT
"""Where things are: the project, its programs, the data sets, the results of a batch."""
import dataclasses
import hashlib
import json
import os
import pathlib
import subprocess

from trajlo_batch.yaml_lines import SuiteError
from trajlo_report.files import write_atomically

ROOT = pathlib.Path(__file__).resolve().parents[2]
# An installation has these scripts in share/trajlo/scripts, the programs in bin/ beside share/, and
# nothing of the user's: data and results are then below the current folder.
INSTALLED = not (ROOT / "CMakeLists.txt").is_file()
BUILD = ROOT.parents[1] if INSTALLED else ROOT / "build"
WORK = pathlib.Path.cwd() if INSTALLED else ROOT


def programs_in(build):
    return build / ("bin" if INSTALLED else "apps")


@dataclasses.dataclass(frozen=True)
class Places:
    build: pathlib.Path   # holds apps/trajlo_run and the others, an installation bin/trajlo_run
    data: pathlib.Path    # relative recordings and truths of suites are below it
    output: pathlib.Path

    def program(self, name):
        return programs_in(self.build) / name

    def with_data(self, text):
        """A flag or an option of a suite, with {data} filled in."""
        return text.replace("{data}", str(self.data))

    def find(self, path):
        """A recording or a truth of a suite, with $VARIABLES filled in."""
        return self.data / os.path.expanduser(os.path.expandvars(path))


def digest(value):
    """A short text that changes whenever `value` does."""
    text = json.dumps(value, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def file_digest(path):
    sha = hashlib.sha256()
    with pathlib.Path(path).open("rb") as file:
        while block := file.read(1 << 20):
            sha.update(block)
    return sha.hexdigest()[:16]


def data_identity(path):
    """What changes when a file, or the files in a folder, do: names, sizes and times. Recordings have
    many gigabytes, and a digest of their bytes would take minutes."""
    files = sorted(file for file in (path, *path.rglob("*")) if file.is_file())
    stats = [(str(file.relative_to(path)), file.stat()) for file in files]
    return {"files": len(stats), "bytes": sum(item.st_size for _, item in stats),
            "digest": digest([(name, item.st_size, item.st_mtime_ns) for name, item in stats])}


def identify(program):
    """What --version says, and a digest of the file: a rebuilt program is another program."""
    if not program.is_file():
        raise SuiteError(f"{program} is missing; build it with scripts/build.sh --target "
                         f"{program.name}, or name another build folder with --build")
    done = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    # gflags prints versions to standard output, and some programs have none.
    version = (done.stdout or done.stderr).strip().splitlines()
    return {"path": str(program), "version": version[0] if version else "",
            "digest": file_digest(program)}


def write_json(path, value):
    write_atomically(path, json.dumps(value, indent=2, sort_keys=True) + "\n")


def read_json_if(path):
    """The value in a JSON file; nothing if it is not there or was cut off."""
    try:
        return json.loads(pathlib.Path(path).read_text())
    except (FileNotFoundError, NotADirectoryError, ValueError):
        return None
