# SPDX-License-Identifier: MIT
"""Runs one number after the other, each in a folder that is deleted unless it is of interest."""
import dataclasses
import pathlib
import shutil
import threading

from trajlo_campaign import judge, scenes
from trajlo_campaign.draw import draw
from trajlo_campaign.execute import execute
from trajlo_campaign.prepare import prepare


@dataclasses.dataclass(frozen=True)
class Programs:
    run: pathlib.Path
    simulate: pathlib.Path


class Bases:
    """The recordings without faults, each made when it is first needed."""

    def __init__(self, programs, folder):
        self.programs, self.folder, self.lock = programs, folder, threading.Lock()

    def get(self, scene, kind):
        with self.lock:
            folder = self.folder / f"{scene.name}_{kind}"
            if not folder.is_dir():
                beside = folder.with_name(f"{folder.name}.part")
                scenes.simulate(self.programs.simulate, scene, kind, beside)
                beside.rename(folder)
            return folder


def run_command(program, prepared, rig, result):
    return [program, f"--input={','.join(map(str, prepared.inputs))}", f"--output={result}",
            f"--config={rig}", "--threads=1"]


@dataclasses.dataclass
class Campaign:
    """scratch: where recordings are made, a folder in memory at best. kept: where the folders of
    runs go that somebody should look at."""
    programs: Programs
    seed: int
    bases: Bases
    scratch: pathlib.Path
    kept: pathlib.Path
    keep_all: bool = False

    def run(self, number):
        """The row of a run in results.csv."""
        return self.run_drawn(draw(self.seed, number))

    def run_drawn(self, drawn):
        folder = self.scratch / f"{drawn.number:05d}"
        folder.mkdir(parents=True)
        try:
            recording, result = folder / "recording", folder / "result"
            base = self.bases.get(drawn.scene, drawn.kind)
            prepared = prepare(drawn, self.programs.simulate, base, recording)
            command = run_command(self.programs.run, prepared, recording / "rig.yaml", result)
            ended = execute(command, folder / "log.txt")
            log = (folder / "log.txt").read_text(errors="replace")
            verdict = judge.judge(ended, result, log, recording / "truth.tum", prepared)
            row = {"run": drawn.number, "scene": drawn.scene.name, "format": drawn.kind,
                   "faults": " + ".join(fault.name for fault in drawn.faults),
                   **dataclasses.asdict(verdict), "cpu_s": ended.cpu_s,
                   "memory_mb": ended.peak_memory_mb, "what": "; ".join(prepared.said)}
            self.keep(folder, verdict, row, command)
            return row
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def keep(self, folder, verdict, row, command):
        target = self.kept / folder.name
        # Also of a run that is well now: an interruption looks like a crash to the run it ends.
        shutil.rmtree(target, ignore_errors=True)
        if not self.keep_all and verdict.verdict not in judge.BAD:
            return
        target.mkdir(parents=True)
        lines = [f"{key}: {value}" for key, value in row.items()]
        lines.append("command: " + " ".join(map(str, command)))
        (target / "about.txt").write_text("\n".join(lines) + "\n")
        names = ("recording", "result", "log.txt") if self.keep_all else ("result", "log.txt")
        for name in names:
            if (folder / name).exists():
                shutil.move(folder / name, target / name)
