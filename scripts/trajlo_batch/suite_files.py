# SPDX-License-Identifier: MIT
"""Which files the words of a suite mean."""
import os
import pathlib

from trajlo_batch.places import ROOT, file_digest
from trajlo_batch.yaml_lines import SuiteError
from trajlo_report.names import did_you_mean, nearest, suggestion

YAML = (".yaml", ".yml")


def named_configs():
    """{name: file} of the configurations that `trajlo_run --config=NAME` finds."""
    folder = pathlib.Path(os.environ.get("TRAJLO_CONFIG_DIR") or ROOT / "config")
    return {file.stem: file for where in (folder, folder / "datasets")
            for file in sorted(where.glob("*.y*ml"))}


def of_project(word, kind):
    """The suite or the experiment that a user names: a file, or one of config/suites or
    config/experiments by its name."""
    path = pathlib.Path(word)
    known = {file.stem: file for file in sorted((ROOT / "config" / kind).glob("*.yaml"))}
    if path.name == word and path.stem in known and path.suffix in ("", ".yaml") and (
            not path.is_file()):  # a folder may well have that name: the results
        return known[path.stem]
    if path.exists():
        return path
    if path.name == word and path.suffix not in YAML:
        raise SuiteError(f"there is no file {word}, and no {kind.removesuffix('s')} of this name"
                         + (suggestion(word, known) or f"; there are {', '.join(known)}"))
    beside = {file.stem: file for file in (*known.values(), *path.parent.glob("*.y*ml"))}
    near = nearest(path.stem, beside)
    raise SuiteError(f"there is no file {path}"
                     + did_you_mean(beside[near[0]] if near else ""))


def find(suite_file, word, names=None):
    """A file that a suite names: below the suite's own folder, else below the project's. A word
    without a slash and .yaml is one of `names`."""
    path = pathlib.Path(os.path.expanduser(os.path.expandvars(word)))
    is_name = names is not None and "/" not in word and path.suffix not in YAML
    if is_name and word in names:
        return names[word]
    own = pathlib.Path(suite_file).absolute().parent
    found = next((folder / path for folder in (own, ROOT) if (folder / path).exists()), None)
    if found:
        return found
    # Stems: the same ending does not make names alike.
    beside = {} if is_name else {file.stem: file.name for folder in (own, ROOT)
                                 for file in (folder / path).parent.glob("*")}
    near = [*(beside[stem] for stem in nearest(path.stem, beside)), *nearest(path.stem, names or {})]
    hint = did_you_mean(near[0] if near else "")
    raise SuiteError(f"{suite_file}: there is no configuration {word}{hint}" if is_name else
                     f"{suite_file}: there is no {own / path}"
                     + ("" if path.is_absolute() else f", nor {ROOT / path}") + hint)


def configs(places, suite, sequence, configuration):
    """Those of the sequence, then those of the configuration. What lies below the folder of data
    sets may be missing, with the data."""
    names = named_configs()
    return [pathlib.Path(word.replace("{data}", str(places.data))) if word.startswith("{data}/")
            else find(suite.file, word, names) for word in (*sequence.config, *configuration.config)]


# Options of trajlo_run, and flags of it and of trajlo_evaluate, that name files.
FILES = ("input.stamps_file", "config", "times", "kitti_calib")


def located(places, suite, values):
    """Options or flags of a suite with their files as absolute paths, found as `config` is: jobs
    work in another folder. Throws SuiteError where one is missing that does not come with the data."""
    def file(key, word):
        if "{data}" in word:
            return places.with_data(word)
        return str(find(suite.file, word, named_configs() if key == "config" else None).absolute())

    return {key: ",".join(file(key, word) for word in value.split(","))
            if key in FILES and value else places.with_data(value)
            for key, value in values.items()}


def digests(values):
    """Of the files that options or flags name: what was made with them is made anew when they
    change."""
    paths = [pathlib.Path(word) for key, value in sorted(values.items()) if key in FILES and value
             for word in value.split(",")]
    return [file_digest(path) for path in paths if path.is_file()]
