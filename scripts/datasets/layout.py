# SPDX-License-Identifier: MIT
"""What the preparation of data sets shares: find what was downloaded, check it, link it to where
config/suites expect it. Nothing is downloaded, copied or changed."""
import dataclasses
import json
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from trajlo_batch import command_line  # noqa: E402
from trajlo_batch.places import programs_in  # noqa: E402
from trajlo_report.names import counted  # noqa: E402, F401

EXIT_CODES = """Exit codes: 0 everything is there, 1 wrong usage, 2 nothing was found, 3 some is
missing or unfit (the rest is laid out), 5 a link or file cannot be written."""


@dataclasses.dataclass(frozen=True)
class Item:
    """A file or folder of the data set."""
    place: str                # where suites expect it, below the folder of data sets
    patterns: tuple           # relative names below the downloads, the first that is found wins
    topics: tuple = ()        # of a bag: (name, type) that it must have
    holds: str = ""           # of a folder: a pattern of which there must be one
    needed: bool = True       # false: said, but not missed
    fits: object = None       # called with what was found; raises Unfit where it is not whole


class Unfit(Exception):
    """Something was found, but it is not what it should be."""


class Unwritable(Exception):
    pass


def find(downloads, item):
    """The first file or folder that fits a pattern, at any depth; None if there is none."""
    for pattern in item.patterns:
        found = sorted(downloads.glob(f"**/{pattern}"))
        if found:
            return found[0]
    return None


def check(path, item, programs):
    """Raises Unfit with a sentence about what is wrong."""
    if path.is_dir():
        files = [f for f in path.glob(item.holds or "*") if f.is_file()]
        if not files:
            raise Unfit(f"{path} holds no {item.holds or 'files'}")
        empty = [f for f in files if f.stat().st_size == 0]
        if empty:
            raise Unfit(f"{len(empty)} of {len(files)} files in {path} are empty, "
                        f"the first is {empty[0].name}")
    elif path.stat().st_size == 0:
        raise Unfit(f"{path} is empty")
    if item.topics:
        check_topics(path, item.topics, programs)
    if item.fits is not None:
        item.fits(path)


def check_topics(path, wanted, programs):
    command = [str(programs / "trajlo_info"), "--json", "--quick", "--quiet", str(path)]
    try:
        process = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as error:
        raise Unfit(f"{path} cannot be checked: {command[0]}: {error.strerror}; "
                    "build the project, or name its folder with --build") from error
    if process.returncode not in (0, 3):
        raise Unfit(process.stderr.strip())
    recording = json.loads(process.stdout)["recordings"][0]
    there = {topic["name"]: topic for topic in recording["topics"]}
    for name, kind in wanted:
        if name not in there:
            raise Unfit(f"{path} has no topic {name}; there are: " + ", ".join(sorted(there)))
        if kind and there[name]["type"] != kind:
            raise Unfit(f"{path}: {name} is {there[name]['type']}, not {kind}")
        if there[name]["messages"] == 0:
            raise Unfit(f"{path}: {name} has no messages")
    if recording["damaged"]:
        raise Unfit(f"{path} is damaged: " + "; ".join(recording["warnings"][:2]) +
                    " (trajlo_convert can mend it)")


def link(source, place):
    """A symbolic link at `place`; one that is there already stays if it is the same."""
    try:
        if place.is_symlink() and place.resolve() == source.resolve():
            return
        if place.is_symlink() or place.exists():
            raise Unfit(f"{place} is there already and is something else: left as it is")
        place.parent.mkdir(parents=True, exist_ok=True)
        os.symlink(source.resolve(), place)
    except OSError as error:
        raise Unwritable(f"{place}: {error.strerror}") from error


def extract_poses(bag, topic, place, programs):
    """Writes the poses of a topic as TUM, unless the file is there."""
    if place.exists():
        return
    # What a damaged bag or an interruption leaves must not be taken for whole the next time.
    beside = place.with_name(f".part.{place.name}")
    command = [str(programs / "trajlo_convert"), str(bag), str(beside), f"--poses={topic}",
               "--quiet", "--overwrite"]
    process = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        if process.returncode == 0:
            beside.rename(place)
            return
        beside.unlink(missing_ok=True)
    except OSError as error:
        raise Unwritable(f"{place}: {error.strerror}") from error
    raise (Unwritable if process.returncode == 5 else Unfit)(process.stderr.strip())


def report(word, text):
    print(f"  {word:8}{text}")


def lay_out(items, downloads, data, programs, after=None):
    """Checks and links all items; returns the exit code."""
    found = missing = 0
    for item in items:
        path = find(downloads, item)
        if path is None:
            missing += item.needed
            report("MISSING" if item.needed else "without",
                   f"{item.place}: no {' or '.join(item.patterns)}"
                   f"{'' if item.needed else ' (can be done without)'}")
            continue
        try:
            check(path, item, programs)
            if data is not None:
                link(path, data / item.place)
                if after is not None:
                    after(item, path, data / item.place, programs)
        except Unfit as error:
            missing += 1
            report("UNFIT", f"{item.place}: {error}")
            continue
        found += 1
        report("ok", f"{item.place} <- {path}")
    if found == 0:
        return 2
    return 3 if missing else 0


def main(description, items, after=None, remarks=""):
    """The command of one data set. `description` says where to download it and how it is laid out."""
    parser = command_line.Parser(description=f"{description}\n\n{EXIT_CODES}")
    parser.add_argument("downloads", nargs="?", type=pathlib.Path,
                        help="the folder with what you downloaded, unpacked")
    parser.add_argument("--into", type=pathlib.Path, metavar="DATA",
                        help="the folder of data sets in which links are made "
                             "(scripts/batch --data=DATA); without it files are only checked")
    command_line.add_build_argument(parser)
    arguments = parser.parse_args()
    if arguments.downloads is None:
        print(description)
        return 0
    if not arguments.downloads.is_dir():
        parser.error(f"there is no folder {arguments.downloads}")
    try:
        code = lay_out(items, arguments.downloads, arguments.into, programs_in(arguments.build),
                       after)
    except Unwritable as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 5
    if remarks:
        print(remarks)
    return code
