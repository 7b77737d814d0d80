# SPDX-License-Identifier: MIT
"""What goes wrong, by class. The messages are those of the commands."""

__all__ = [
    "Error", "ConfigError", "UsageError", "InputError", "EvaluationError", "OutputError",
    "StateError", "EstimatorError", "TrajloWarning", "PartialInputWarning", "LostWarning",
]


class Error(Exception):
    """Any error of trajlo."""


class ConfigError(Error, ValueError):
    """Options that cannot be used: an unknown key (the message names the nearest one), a value of
    the wrong type or out of range, options that contradict each other; or a scenario that cannot
    be simulated."""


class UsageError(Error, ValueError):
    """An argument that cannot be understood, such as the name of an alignment."""


class InputError(Error, ValueError):
    """A file, a recording, or arrays that cannot be used: shapes, types, times."""


class EvaluationError(Error, ValueError):
    """Two trajectories that cannot be compared: no overlap in time, too few poses, ..."""


class OutputError(Error, OSError):
    """A file that cannot be written, or that exists already."""


class StateError(Error, RuntimeError):
    """An object that is used at the wrong time, as an Odometry that is finished."""


class EstimatorError(Error, RuntimeError):
    """The estimator failed; what it has estimated until then can still be read."""


class TrajloWarning(UserWarning):
    """Something that a user should know about the input."""


class PartialInputWarning(TrajloWarning):
    """The result rests on a part of the input. trajlo_run ends with exit code 3 then."""


class LostWarning(TrajloWarning):
    """The scene is no longer followed. trajlo_run ends with exit code 4 then."""
