# SPDX-License-Identifier: MIT
"""Options from dicts and files."""

import difflib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Optional, Sequence, Union

import numpy

from . import _trajlo
from .errors import ConfigError

Options = Mapping[str, Any]
ConfigNames = Union[str, os.PathLike, Sequence[Union[str, os.PathLike]]]

_FOLDER = Path(__file__).parent / "config"


def options() -> dict:
    """Every option: {key: {"allowed": ..., "default": ..., "doc": ...}}, as YAML and words."""
    return _trajlo.keys()


def configs() -> list:
    """The names of the configurations that come with trajlo, for `config=`."""
    return sorted(file.stem for file in _FOLDER.glob("*.yaml"))


def make_config(values: Optional[Options], names: Optional[ConfigNames]) -> _trajlo.Config:
    """The defaults, changed by the files in their order, then by the values."""
    config = _trajlo.Config()
    if names is not None:
        for name in [names] if isinstance(names, (str, os.PathLike)) else names:
            config.load_file(_find(name))
    if values is not None:
        if not isinstance(values, Mapping):
            raise ConfigError(f"options: must be a dict of keys and values, found {values!r}")
        config.load_values(_yaml(values), "options")
    config.check()
    return config


def _find(name: Union[str, os.PathLike]) -> Union[str, os.PathLike]:
    if Path(name).exists() or Path(name).suffix or len(Path(name).parts) != 1:
        return name
    file = _FOLDER / f"{name}.yaml"
    if file.exists():
        return file
    near = difflib.get_close_matches(str(name), configs(), n=1)
    mend = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(configs())}"
    raise ConfigError(f"config: there is no file and no configuration '{name}'; {mend}")


def _yaml(values: Options) -> str:
    """JSON is YAML, but for numbers that are not finite, which no option takes."""
    try:
        return json.dumps(values, default=_plain, ensure_ascii=False)
    except (TypeError, ValueError) as error:
        raise ConfigError(f"options: {error}") from None


def _plain(value: Any) -> Any:
    if isinstance(value, (numpy.ndarray, numpy.generic)):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"a value of the type {type(value).__name__} cannot be used: {value!r}")
