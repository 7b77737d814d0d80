# SPDX-License-Identifier: MIT
import os
import warnings
from typing import Any, Dict, Iterator, Optional, Sequence, Union

from . import _trajlo
from ._config import ConfigNames, Options, make_config
from ._trajlo import Scan
from .errors import InputError, PartialInputWarning, TrajloWarning

Paths = Union[str, os.PathLike, Sequence[Union[str, os.PathLike]]]

_PRINTED_WARNINGS = 10


def _unread(report: Dict[str, Any]) -> str:
    parts = [f"scans missing: {report['scans_skipped']}", f"damaged: {report['scans_damaged']}"]
    if report["scans_left_out"]:
        parts.append(f"left out: {report['scans_left_out']}")
    if report["points_undeclared"]:
        parts.append(f"points that no header declares: {report['points_undeclared']}")
    parts += [f"no message of {topic}" for topic in report["topics_without_messages"]]
    if report["file_is_cut"]:
        parts.append("and a part of the file is missing or broken")
    return f"a part of the recording could not be read: {', '.join(parts)}; report() says more"


class Recording:
    """The scans of a recording; each iteration begins anew. See open()."""

    def __init__(self, inputs: list, config: _trajlo.Config):
        self._inputs = inputs
        self._config = config
        self._newest = _trajlo.Reader(inputs, config)
        self._fresh: Optional[_trajlo.Reader] = self._newest

    def __iter__(self) -> Iterator[Scan]:
        # Taken now, not at the first scan: two iterations at a time have a reader each.
        reader, self._fresh = self._fresh or _trajlo.Reader(self._inputs, self._config), None
        self._newest = reader
        return self._read(reader)

    @staticmethod
    def _read(reader: _trajlo.Reader) -> Iterator[Scan]:
        yield from reader
        report = reader.report()
        for text in report["warnings"][:_PRINTED_WARNINGS]:
            warnings.warn(text, TrajloWarning, stacklevel=2)
        if report["is_partial"]:
            warnings.warn(_unread(report), PartialInputWarning, stacklevel=2)

    def __len__(self) -> int:
        """The scans that the recording lists, broken ones included."""
        return self._newest.size

    @property
    def description(self) -> str:
        """What is read, and how its stamps and times are understood; several lines."""
        return self._newest.description

    def report(self) -> Dict[str, Any]:
        """What the newest iteration has met so far.

        scans_listed, scans_read, scans_damaged (in part), scans_skipped (nothing could be read),
        scans_left_out (files of another format); file_is_cut, topics_without_messages;
        points_read, points_without_time, points_undeclared (not read: no header declares them);
        warnings, a sentence each; is_partial: trajlo_run would end with 3
        """
        return self._newest.report()

    def __repr__(self) -> str:
        return f"<trajlo.Recording of {len(self)} scans: {self.description.splitlines()[0]}>"


def open(path: Paths, options: Optional[Options] = None, *,
         config: Optional[ConfigNames] = None) -> Recording:
    """Opens a recording: `for scan in trajlo.open("flight.bag")`.

    path     a bag (.bag, .db3, .mcap), a capture (.pcap), a folder of bags or of scans; or a list
             of them, whose LiDARs are counted through
    options  as for Odometry, which can be given the same: `input.*` says how to read
    config   as for Odometry

    Raises InputError for what cannot be read. When the end is reached, warns with
    PartialInputWarning if a part could not be read, and with TrajloWarning about what is odd.
    """
    if isinstance(path, (str, bytes, os.PathLike)):
        inputs = _trajlo.input_paths(path)
    else:
        inputs = [os.fsencode(part) for part in path]
    if not inputs:
        raise InputError("path: is empty")
    made = make_config(options, config)
    _trajlo.check_extrinsics(inputs, made)
    return Recording(inputs, made)
