# SPDX-License-Identifier: MIT
"""A process with limits: of processor time, of time, of memory, of what it writes."""
import dataclasses
import os
import signal
import subprocess
import threading

from trajlo_batch.steps import megabytes

CPU_S = 60        # a run needs about one
WALL_S = 600      # for one that waits for ever; far above what a busy machine needs
MEMORY_BYTES = 8 << 30
FILE_BYTES = 1 << 30
HUNG = "hung"


@dataclasses.dataclass(frozen=True)
class Ended:
    code: object  # exit code, negative for a signal, or HUNG
    cpu_s: float
    peak_memory_mb: float


def execute(command, log_file, cpu_s=CPU_S, wall_s=WALL_S):
    """Runs a command, which dies with this process."""
    limits = ["prlimit", f"--cpu={cpu_s}:{cpu_s + 5}", f"--as={MEMORY_BYTES}",
              f"--fsize={FILE_BYTES}", "--core=0", "setpriv", "--pdeathsig", "KILL"]
    waited_too_long = threading.Event()
    with log_file.open("w") as log:
        process = subprocess.Popen([*limits, *map(str, command)], stdout=log,
                                   stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

        def give_up():
            waited_too_long.set()
            process.kill()
        timer = threading.Timer(wall_s, give_up)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
    code = os.waitstatus_to_exitcode(status)
    process.returncode = code  # it was waited for behind its back
    if waited_too_long.is_set() or code == -signal.SIGXCPU:
        code = HUNG
    return Ended(code, usage.ru_utime + usage.ru_stime, megabytes(usage))
