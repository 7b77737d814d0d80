# SPDX-License-Identifier: MIT
"""The progress of a batch: a bar on a terminal, elsewhere a line for each run that has ended."""
import shutil
import time

from trajlo_batch.results import FAILED
from trajlo_report import names


def clock(seconds):
    minutes, seconds = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"


class ProgressLines:
    """For pipes and files."""

    def __init__(self, total, ended, stream):
        self.total, self.said, self.stream = total, set(ended), stream

    def update(self, ended, _):
        for folder, run in ended.items():
            if folder in self.said:
                continue
            self.said.add(folder)
            took = clock(run.wall_s) if run.wall_s >= 60 else f"{run.wall_s:.1f} s"
            mark = "x, " if run.result == FAILED else ""
            print(f"{len(self.said)}/{self.total} {folder}: {mark}{run.reason}, {took}",
                  file=self.stream, flush=True)

    def close(self):
        pass


class ProgressBar:
    """One line that is written over itself."""

    def __init__(self, total, ended, stream):
        self.total, self.already, self.stream = total, len(ended), stream
        self.begin = time.monotonic()

    def line(self, done, failed, complete, elapsed, width):
        text = f" {done}/{names.counted(self.total, 'run')}, {failed} x, {clock(elapsed)}"
        if done == self.total and complete < self.total:
            text += f", {complete} of them complete"
        new = done - self.already
        if new > 0 and done < self.total:
            text += f", {clock(elapsed / new * (self.total - done))} left"
        cells = max(5, min(40, width - len(text) - 3))
        filled = cells * done // max(self.total, 1)
        return f"[{'#' * filled}{'-' * (cells - filled)}]{text}"

    def update(self, ended, complete):
        width = shutil.get_terminal_size().columns
        failed = sum(run.result == FAILED for run in ended.values())
        line = self.line(len(ended), failed, complete, time.monotonic() - self.begin, width)
        self.stream.write(f"\r\x1b[K{line[:width - 1]}")
        self.stream.flush()

    def close(self):
        self.stream.write("\n")
        self.stream.flush()
