# SPDX-License-Identifier: MIT
"""Made by CMake: what the module was compiled for, a value of -march or empty."""

ARCH: str
