# SPDX-License-Identifier: MIT
"""What the command lines of all scripts share: how usage ends, and how files that fail do."""
import argparse
import errno
import os
import sys

from trajlo_report.files import ReportError, WriteError
from trajlo_report.names import suggestion

USAGE, UNREADABLE, NOT_WRITABLE = 1, 2, 5
MENDS = {errno.ENOENT: "check the path", errno.ENOSPC: "free some space",
         errno.ENOTDIR: "a part of the path is a file, so name another",
         errno.EEXIST: "a file is in the place of a folder, so name another",
         errno.EISDIR: "name a file, not a folder",
         errno.EACCES: "change its permissions, or name another",
         errno.EROFS: "name a place that can be written"}


class Parser(argparse.ArgumentParser):
    """Wrong usage ends with 1, as it does with the other programs."""

    def __init__(self, **keywords):
        super().__init__(formatter_class=argparse.RawDescriptionHelpFormatter, **keywords)

    def error(self, message):
        unknown = [word.partition("=")[0] for word in message.split() if word.startswith("--")]
        if unknown and message.startswith("unrecognized arguments: "):
            message += suggestion(unknown[0], self._option_string_actions)
        self.print_usage(sys.stderr)
        self.exit(USAGE, f"{self.prog}: {message}\n")


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return number


def sentence(error, cannot):
    """Which file, why, and what mends it; `cannot` is "be read" or "be written"."""
    if error.filename is None:
        return str(error)
    mend = MENDS.get(error.errno)
    why = (error.strerror or "it failed").lower()
    return f"{error.filename} cannot {cannot}: {why}" + (f"; {mend}" if mend else "")


def unless_unread(work, arguments):
    """work(arguments); where whoever reads its output leaves, as `head` does, that is no error."""
    try:
        code = work(arguments)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return NOT_WRITABLE


def guarded(parser, work):
    """Calls work(arguments); what cannot be read or written ends with a sentence and its code."""
    arguments = parser.parse_args()
    try:
        return unless_unread(work, arguments)
    except ReportError as error:
        said, code = str(error), UNREADABLE
    except WriteError as error:
        said, code = sentence(error, "be written"), NOT_WRITABLE
    except OSError as error:
        said, code = sentence(error, "be read"), UNREADABLE
    print(f"{parser.prog}: {said}", file=sys.stderr)
    return code
