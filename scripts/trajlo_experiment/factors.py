# SPDX-License-Identifier: MIT
"""What an experiment varies. A factor has levels; a level sets one or more options of a run."""
import dataclasses
import math
import re

from trajlo_batch.suite import scalar_text
from trajlo_batch.yaml_lines import Mapping, SuiteError, check

SIMULATE = "simulate."  # begins the name of a parameter of the simulated scenario
FACTOR_KEYS = {"values": list, "from": (int, float), "to": (int, float), "steps": int,
               "scale": str, "whole": bool, "keys": dict, "settings": dict, "label": str}
# How the keys of options end, and what that means; longer endings first.
UNITS = {"m2_s3": "m²/s³", "rad2_s3": "rad²/s³", "rad_s": "rad/s", "mps2": "m/s²", "mps": "m/s",
         "m": "m", "s": "s", "ms": "ms", "ns": "ns", "hz": "Hz", "rad": "rad", "deg": "°"}
LOG, LINEAR, CHOICE = "log", "linear", "choice"
# Without a word about the scale, values that span this much are taken as equal ratios.
WIDE = 8.0


@dataclasses.dataclass(frozen=True)
class Factor:
    name: str
    label: str
    scale: str              # LOG, LINEAR or CHOICE
    levels: tuple           # numbers or texts; empty for a range without steps
    low: float = math.nan   # of a range
    high: float = math.nan
    whole: bool = False
    keys: dict = dataclasses.field(default_factory=dict)      # key -> what a level is multiplied by
    settings: dict = dataclasses.field(default_factory=dict)  # level -> {key: text}

    @property
    def numeric(self):
        return self.scale != CHOICE

    @property
    def key(self):
        """The one option that the levels are values of; nothing if there is no such option."""
        return next(iter(self.keys)) if list(self.keys.values()) == [None] else None

    @property
    def is_range(self):
        """Not a list of values that somebody chose."""
        return not math.isnan(self.low)

    def options(self, level):
        """What a run with this level sets: {key: text}."""
        if self.settings:
            return self.settings[level]
        return {key: text_of(level if multiplier is None else multiplied(level, multiplier))
                for key, multiplier in self.keys.items()}

    def sample(self, share):
        """The level at this share, from 0 to 1, of the way through the range or the levels."""
        if not self.is_range:
            return self.levels[min(int(share * len(self.levels)), len(self.levels) - 1)]
        return self.at(share)

    def at(self, share):
        if self.scale == LOG:
            value = self.low * (self.high / self.low) ** share
        else:
            value = self.low + (self.high - self.low) * share
        return round(value) if self.whole else rounded(value)


def rounded(value):
    """Four digits are enough for a weight, and people have to read them."""
    return float(f"{value:.4g}")


def multiplied(level, multiplier):
    """Whole numbers stay what they are, with all their digits."""
    product = level * multiplier
    return product if isinstance(product, int) else rounded(product)


def text_of(level):
    """As `--set` wants it: options that count something refuse 4.0."""
    if isinstance(level, bool):
        return "true" if level else "false"
    if isinstance(level, float) and level.is_integer() and abs(level) < 1e15:
        level = int(level)
    return repr(level) if isinstance(level, (int, float)) else level


def number_or_text(value):
    """A level as Python has it: YAML takes 1e-3 for a text."""
    if isinstance(value, str):
        try:
            return float(value)
        except ValueError:
            return value
    return value


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def level_text(level):
    if isinstance(level, bool):
        return "true" if level else "false"
    return f"{level:g}" if is_number(level) else str(level)


def parts_of(label):
    """ "σ", "m" of the label "σ [m]" """
    parts = re.fullmatch(r"(.+) \[(.+)\]", label)
    return parts.groups() if parts else (label, "")


def level_of(factor, level):
    """ "σ = 0.1 m" of the label "σ [m]" """
    name, unit = parts_of(factor.label)
    return f"{name} = {level_text(level)} {unit}".rstrip()


def read_levels(mapping, key, values):
    if not values:
        raise SuiteError(f"{mapping.where(key)}: {key} has no values")
    holder = Mapping()
    holder.lines, holder.file = mapping.lines, mapping.file
    levels = []
    for value in values:
        holder[key] = value
        scalar_text(holder, key)  # refuses what --set cannot take
        level = number_or_text(value)
        if level in levels:
            raise SuiteError(f"{mapping.where(key)}: the value {value} of {key} appears twice")
        levels.append(level)
    return tuple(levels)


def default_label(name):
    """The last part of a key, with its unit in brackets."""
    key = name.rpartition(".")[2]
    for ending, unit in UNITS.items():
        if key.endswith(f"_{ending}"):
            return f"{key[:-len(ending)].replace('_', ' ')}[{unit}]"
    return key.replace("_", " ")


def scale_of(spec, name, levels):
    """LOG, LINEAR or CHOICE, as the file says or as the levels suggest."""
    numeric = all(is_number(level) for level in levels)
    said = spec.get("scale", "") if isinstance(spec, dict) else ""
    if said not in ("", LOG, LINEAR):
        raise SuiteError(f"{spec.where('scale')}: the scale of {name} is {LOG} or {LINEAR}, not "
                         f"{said}")
    if said == LOG and not (numeric and min(levels) > 0):
        raise SuiteError(f"{spec.where('scale')}: {name} has values that no logarithmic axis shows")
    if not numeric:
        return CHOICE
    wide = min(levels) > 0 and max(levels) >= WIDE * min(levels)
    return said or (LOG if wide else LINEAR)


def read_keys(spec, name):
    """key -> multiplier; without `keys` the name itself is the key."""
    multipliers = spec.get("keys") if isinstance(spec, dict) else None
    if multipliers is None:
        return {name: None}
    for key, multiplier in multipliers.items():
        if not is_number(multiplier):
            raise SuiteError(f"{multipliers.where(key)}: {key} needs the number that a value of "
                             f"{name} is multiplied by, not {multiplier!r}")
    return dict(multipliers)


def read_range(spec, name, common):
    low, high, steps = spec["from"], spec.get("to"), spec.get("steps", 0)
    if high is None or not low < high:
        raise SuiteError(f"{spec.where('from')}: the range of {name} needs a `to` above its `from`")
    if steps == 1 or steps < 0:
        raise SuiteError(f"{spec.where('steps')}: the range of {name} needs at least 2 steps")
    scale = scale_of(spec, name, (low, high))
    factor = Factor(name=name, scale=scale, levels=(), low=low, high=high,
                    whole=spec.get("whole", False), **common)
    levels = dict.fromkeys(factor.at(i / (steps - 1)) for i in range(steps))
    return dataclasses.replace(factor, levels=tuple(levels))


def read_named_sets(spec, name, label):
    """Levels that are names of sets of options."""
    sets = {}
    for level, options in spec["settings"].items():
        if not isinstance(options, dict):
            raise SuiteError(f"{spec['settings'].where(level)}: {level} must be a mapping of "
                             "options")
        sets[level] = {key: scalar_text(options, key) for key in options}
    if not sets:
        raise SuiteError(f"{spec.where('settings')}: {name} has no settings")
    return Factor(name=name, label=label, scale=CHOICE, levels=tuple(sets), settings=sets)


def read_factor(vary, name):
    """One entry of `vary`. Throws SuiteError with the line."""
    spec = vary[name]
    if isinstance(spec, list):
        levels = read_levels(vary, name, spec)
        return Factor(name=name, label=default_label(name), scale=scale_of(spec, name, levels),
                      levels=levels, keys={name: None})
    if not isinstance(spec, dict):
        raise SuiteError(f"{vary.where(name)}: {name} needs a list of values, or a mapping with "
                         f"from and to, values, or settings")
    check(spec, FACTOR_KEYS, f"the factor {name}")
    kinds = [key for key in ("values", "from", "settings") if key in spec]
    if len(kinds) != 1:
        raise SuiteError(f"{vary.where(name)}: {name} needs one of values, from with to, settings")
    label = spec.get("label", default_label(name))
    if kinds == ["settings"]:
        return read_named_sets(spec, name, label)
    common = {"label": label, "keys": read_keys(spec, name)}
    if kinds == ["from"]:
        return read_range(spec, name, common)
    levels = read_levels(spec, "values", spec["values"])
    if "keys" in spec and not all(is_number(level) for level in levels):
        raise SuiteError(f"{spec.where('values')}: the values of {name} are multiplied, and must "
                         "be numbers")
    return Factor(name=name, scale=scale_of(spec, name, levels), levels=levels, **common)
