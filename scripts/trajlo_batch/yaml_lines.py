# SPDX-License-Identifier: MIT
"""YAML whose mappings know the lines of their keys, so that errors can name them."""
import pathlib

import yaml

from trajlo_report.names import suggestion


class SuiteError(Exception):
    """A suite, or another file that a batch reads, is not what it should be."""


class Mapping(dict):
    """A mapping with the line of each key, and the file that it stands in."""
    lines = {}
    file = ""

    def where(self, key=None):
        line = self.lines.get(key) or min(self.lines.values(), default=1)
        return f"{self.file}:{line}"


class _Loader(yaml.SafeLoader):
    pass


def _mapping(loader, node):
    result = Mapping()
    result.lines, result.file = {}, loader.name
    yield result
    for key_node, value_node in node.value:
        if key_node.tag == "tag:yaml.org,2002:merge":
            raise SuiteError(f"{loader.name}:{key_node.start_mark.line + 1}: merge keys (<<) are not "
                             "read; write the keys out, or use defaults")
        key = loader.construct_object(key_node, deep=True)
        line = key_node.start_mark.line + 1
        if not isinstance(key, str):
            raise SuiteError(f"{loader.name}:{line}: the key {key!r} is not a text; quote it")
        if key in result:
            raise SuiteError(f"{loader.name}:{line}: the key {key} appears twice")
        result[key] = loader.construct_object(value_node, deep=True)
        result.lines[key] = line


_Loader.add_constructor(yaml.resolver.BaseResolver.DEFAULT_MAPPING_TAG, _mapping)


def load(path):
    """The mapping that a YAML file holds. Throws SuiteError."""
    path = pathlib.Path(path)
    if path.exists() and not path.is_file():  # A pipe would never end.
        raise SuiteError(f"{path} is not a file")
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise SuiteError(f"{path} cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise SuiteError(f"{path} is not a text file: byte {error.start} is no UTF-8") from error
    try:
        loader = _Loader(text)  # Refuses characters that text does not have.
        loader.name = str(path)
        document = loader.get_single_data()
    except yaml.YAMLError as error:
        raise SuiteError(f"{path} is not YAML: {error}") from error
    if not isinstance(document, Mapping):
        raise SuiteError(f"{path} is no mapping of keys to values")
    return document


TYPE_NAMES = {str: "a text", int: "a whole number", float: "a number", list: "a list",
              dict: "a mapping", bool: "true or false"}


def check(mapping, types, what):
    """Every key is known and its value of the right type. Throws SuiteError naming the line."""
    for key, value in mapping.items():
        if key not in types:
            hint = suggestion(key, types) or f"; known are {', '.join(types)}"
            raise SuiteError(f"{mapping.where(key)}: {what} has no key {key}{hint}")
        wanted = types[key] if isinstance(types[key], tuple) else (types[key],)
        if isinstance(value, bool) and bool not in wanted or not isinstance(value, wanted):
            names = " or ".join(TYPE_NAMES[kind] for kind in wanted)
            raise SuiteError(f"{mapping.where(key)}: {key} must be {names}, not {value!r}")


def texts(mapping, key):
    """A list of texts, or a single one as a list of one."""
    value = mapping.get(key, [])
    value = [value] if isinstance(value, str) else value
    for item in value:
        if not isinstance(item, str):
            raise SuiteError(f"{mapping.where(key)}: {key} must hold texts, not {item!r}")
    return list(value)
