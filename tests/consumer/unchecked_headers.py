# SPDX-License-Identifier: MIT
"""Prints the headers below this folder that reach Eigen without manifolds/eigen_abi.h."""
import pathlib
import re
import sys

texts = {str(path): path.read_text() for path in pathlib.Path().rglob("*.h")}


def reached(name, seen):
    if name in texts and name not in seen:
        seen.add(name)
        for included in re.findall(r'#include "([^"]+)"', texts[name]):
            reached(included, seen)
    return seen


def unchecked(name):
    seen = reached(name, set())
    return ("manifolds/eigen_abi.h" not in seen
            and any(re.search(r"#include <Eigen/", texts[header]) for header in seen))


wrong = sorted(filter(unchecked, texts))
print("\n".join(wrong))
sys.exit(bool(wrong) or not texts)
