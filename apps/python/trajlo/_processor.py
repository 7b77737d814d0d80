# SPDX-License-Identifier: MIT
"""Says what is wrong where the compiled half would end the process with an illegal instruction."""

import pathlib

# The flags of /proc/cpuinfo that tell it.
_NEEDED = {"x86-64-v3": ("avx2", "bmi2", "fma")}


def require(arch: str, cpuinfo: pathlib.Path = pathlib.Path("/proc/cpuinfo")) -> None:
    """Raises ImportError if this CPU lacks what the module was compiled for."""
    needed = _NEEDED.get(arch)
    if needed is None or not cpuinfo.exists():
        return
    for line in cpuinfo.read_text(errors="replace").splitlines():
        if line.startswith("flags"):
            missing = sorted(set(needed) - set(line.split()))
            if missing:
                raise ImportError(
                    f"this trajlo was compiled for {arch}, and this CPU has no "
                    f"{', '.join(missing)}; build it for any CPU: "
                    "pip install . -C cmake.define.TRAJLO_ARCH=x86-64")
            return
