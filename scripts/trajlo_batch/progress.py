# SPDX-License-Identifier: MIT
"""The progress of a batch on a terminal."""
import shutil
import time


def clock(seconds):
    minutes, seconds = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"


class ProgressBar:
    """One line that is complete over itself; silent where `stream` is not a terminal."""

    def __init__(self, total, already, stream):
        self.total, self.already, self.stream = total, already, stream
        self.begin = time.monotonic()
        self.shown = stream.isatty()

    def line(self, done, failed, complete, elapsed, width):
        text = f" {done}/{self.total} runs, {failed} x, {clock(elapsed)}"
        if done == self.total and complete < self.total:
            text += f", {complete} of them complete"
        new = done - self.already
        if new > 0 and done < self.total:
            text += f", {clock(elapsed / new * (self.total - done))} left"
        cells = max(5, min(40, width - len(text) - 3))
        filled = cells * done // max(self.total, 1)
        return f"[{'#' * filled}{'-' * (cells - filled)}]{text}"

    def update(self, done, failed, complete):
        if not self.shown:
            return
        width = shutil.get_terminal_size().columns
        line = self.line(done, failed, complete, time.monotonic() - self.begin, width)
        self.stream.write(f"\r\x1b[K{line[:width - 1]}")
        self.stream.flush()

    def close(self):
        if self.shown:
            self.stream.write("\n")
            self.stream.flush()
