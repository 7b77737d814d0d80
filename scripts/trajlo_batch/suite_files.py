# SPDX-License-Identifier: MIT
"""Which files the words of a suite mean."""
import os
import pathlib

from trajlo_batch.places import ROOT
from trajlo_batch.yaml_lines import SuiteError
from trajlo_report.names import nearest, suggestion

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
                     + (f"; did you mean {beside[near[0]]}?" if near else ""))


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
    hint = f"; did you mean {near[0]}?" if near else ""
    raise SuiteError(f"{suite_file}: there is no configuration {word}{hint}" if is_name else
                     f"{suite_file}: there is no {own / path}"
                     + ("" if path.is_absolute() else f", nor {ROOT / path}") + hint)


def configs(places, suite, sequence, configuration):
    """Those of the sequence, then those of the configuration. What lies below the folder of data
    sets may be missing, with the data."""
    names = named_configs()
    return [pathlib.Path(word.replace("{data}", str(places.data))) if word.startswith("{data}/")
            else find(suite.file, word, names) for word in (*sequence.config, *configuration.config)]
