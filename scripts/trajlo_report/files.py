# SPDX-License-Identifier: MIT
"""Reads what trajlo_run and trajlo_evaluate write, and writes pages."""
import contextlib
import csv
import dataclasses
import decimal
import io
import json
import os
import pathlib

import numpy as np


class ReportError(Exception):
    """A file that a report needs is missing or not what it should be."""


class WriteError(OSError):
    """A file or folder that cannot be written; other OSErrors are of reading."""


@contextlib.contextmanager
def writing(path):
    """What fails inside is about writing `path`, also where the system names no file."""
    try:
        yield
    except OSError as error:
        raise WriteError(error.errno, error.strerror, str(path)) from error


def make_folder(path):
    with writing(path):
        pathlib.Path(path).mkdir(parents=True, exist_ok=True)


def write_atomically(path, text):
    """Never leaves half a file: written beside, then renamed."""
    path = pathlib.Path(path)
    make_folder(path.parent)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    with writing(path):
        beside.write_text(text)
        beside.replace(path)


def read_tum(path):
    """Times in whole ns, positions (m) and quaternions (x y z w) of a TUM file; an unfinished last
    line is left out. Throws ReportError at any other that is no pose."""
    times_ns, values = [], []
    lines = pathlib.Path(path).read_text(errors="replace").splitlines(keepends=True)
    for number, line in enumerate(lines, 1):
        fields = line.split()
        if not fields or line.startswith("#"):
            continue
        try:
            # Stamps since 1970 have more digits than a float.
            time_ns = round(decimal.Decimal(fields[0]).scaleb(9))
            pose = [float(field) for field in fields[1:]]
            if len(pose) != 7:
                raise ValueError
        except (ArithmeticError, ValueError) as error:
            if not line.endswith("\n"):
                break
            raise ReportError(f"{path}: line {number} is not 'stamp x y z qx qy qz qw'") from error
        times_ns.append(time_ns)
        values.append(pose)
    values = np.array(values).reshape(-1, 7)
    return np.array(times_ns, dtype=np.int64), values[:, :3], values[:, 3:]


def read_poses(path):
    """The same with times in s. Throws ReportError where there are no poses."""
    times_ns, positions, quaternions = read_tum(path)
    if not len(times_ns):
        raise ReportError(f"{path} holds no poses")
    return times_ns / 1e9, positions, quaternions


PLY_KINDS = {"float": "<f4", "double": "<f8"}


def read_ply_columns(path):
    """The properties of the vertices of a binary little-endian PLY, floats or doubles: {name:
    values}."""
    data = pathlib.Path(path).read_bytes()
    head, _, _ = data.partition(b"end_header\n")
    lines = head.decode("ascii", errors="replace").splitlines()
    if "format binary_little_endian 1.0" not in lines:
        raise ReportError(f"{path} is not a binary little-endian PLY")
    counts = [int(line.split()[2]) for line in lines if line.startswith("element ")]
    properties = [line.split()[1:] for line in lines if line.startswith("property ")]
    if len(counts) != 1 or any(kind not in PLY_KINDS for kind, *_ in properties):
        raise ReportError(f"{path} has more than vertices of floats, which is not read")
    row = np.dtype([(name, PLY_KINDS[kind]) for kind, name in properties])
    begin = len(head) + len(b"end_header\n")
    if len(data) < begin + counts[0] * row.itemsize:
        raise ReportError(f"{path} ends early: {counts[0]} points were announced")
    values = np.frombuffer(data, row, counts[0], begin)
    return {name: values[name] for name in row.names}


def read_ply(path):
    """Points of such a PLY, a row each."""
    columns = read_ply_columns(path)
    return np.stack([columns[axis] for axis in "xyz"], axis=1)


def csv_cell(value):
    """A value as in the files of the commands: true and false as in JSON, nothing for None."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    return f"{value:.9g}" if isinstance(value, float) else "" if value is None else str(value)


def to_csv(rows):
    """Mappings with the same keys as text, a line each below the names."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    if rows:
        writer.writerow(rows[0])
    writer.writerows([csv_cell(value) for value in row.values()] for row in rows)
    return stream.getvalue()


def read_columns(path):
    """Columns of a CSV file as arrays of numbers; columns with other texts stay lists."""
    with pathlib.Path(path).open(newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {}
    for name in rows[0] if rows else ():
        texts = [row[name] for row in rows]
        try:
            columns[name] = np.array([float(text) if text else np.nan for text in texts])
        except (TypeError, ValueError):
            columns[name] = texts
    return columns


def read_flags(result):
    """Times (s) and flag names ("" is none) of the poses of a run. One that did not end has no
    flags.csv yet: those of its windows then, among which there is none for a gap."""
    for name, column in (("flags.csv", "t_s"), ("windows.csv", "end_s")):
        path = pathlib.Path(result) / name
        if path.is_file():
            columns = read_columns(path)
            times, names = columns.get(column, ()), columns.get("flag_names", ())
            if isinstance(names, np.ndarray):  # a column of nothing is read as numbers
                names = [""] * len(times)
            return times, [text or "" for text in names]
    return (), []


def read_json(path):
    try:
        return json.loads(pathlib.Path(path).read_text())
    except FileNotFoundError as error:
        raise ReportError(f"{path} is missing") from error
    except ValueError as error:
        raise ReportError(f"{path} is not JSON: {error}") from error


@dataclasses.dataclass
class Estimate:
    """One trajectory that was evaluated: its figures, and its errors pose by pose."""
    name: str
    metrics: dict
    errors: dict  # columns of errors_<name>.csv; empty when there are none

    @property
    def times(self):
        return self.errors["t_s"]

    @property
    def positions(self):
        return np.stack([self.errors[f"{axis}_m"] for axis in "xyz"], axis=1)

    @property
    def truth(self):
        return np.stack([self.errors[f"{axis}_true_m"] for axis in "xyz"], axis=1)

    @property
    def rotation_in_doubt(self):
        """Absolute errors of the rotation are mostly a turn that the alignment leaves open."""
        return (self.metrics.get("ate") or {}).get("rotation_determined") is False

    @property
    def diverged(self):
        return bool(self.metrics.get("diverged"))


def read_evaluation(folder):
    """evaluation.json of a folder that trajlo_evaluate wrote, and its estimates."""
    folder = pathlib.Path(folder)
    document = read_json(folder / "evaluation.json")
    estimates = []
    for metrics in document.get("estimates", []):
        table = folder / metrics["errors_csv"] if metrics.get("errors_csv") else None
        errors = read_columns(table) if table and table.is_file() else {}
        estimates.append(Estimate(metrics["name"], metrics, errors))
    if not estimates:
        raise ReportError(f"{folder / 'evaluation.json'} has no estimates")
    return document, estimates
