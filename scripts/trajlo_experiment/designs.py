# SPDX-License-Identifier: MIT
"""Which combinations of levels an experiment tries: points, each {name of a factor: level}."""
import itertools
import math

import numpy as np
from scipy.stats import qmc

GRID, ONE_AT_A_TIME = "grid", "one_at_a_time"
RANDOM, LATIN_HYPERCUBE, SOBOL = "random", "latin_hypercube", "sobol"
SAMPLED = (RANDOM, LATIN_HYPERCUBE, SOBOL)
KINDS = (GRID, ONE_AT_A_TIME, *SAMPLED)


def grid(factors):
    """All combinations."""
    names = [factor.name for factor in factors]
    return [dict(zip(names, levels))
            for levels in itertools.product(*(factor.levels for factor in factors))]


def same(one, other):
    numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool)
                  for value in (one, other))
    return math.isclose(one, other) if numbers else one == other


def one_at_a_time(factors, center, shown):
    """The centre, then each other level of each factor alone.

    center: {name: level}, what the centre sets; shown: {name: level}, what factors that are not in
    it have by themselves. No point of either is repeated."""
    points = [dict(center)]
    for factor in factors:
        at_center = center.get(factor.name, shown.get(factor.name))
        points += [{**center, factor.name: level} for level in factor.levels
                   if at_center is None or not same(level, at_center)]
    return points


def unit_samples(kind, dimensions, samples, seed):
    """Rows in the unit cube; the same for the same arguments."""
    if kind == RANDOM:
        return np.random.default_rng(seed).random((samples, dimensions))
    if kind == LATIN_HYPERCUBE:
        return qmc.LatinHypercube(dimensions, seed=seed).random(samples)
    return qmc.Sobol(dimensions, scramble=True, seed=seed).random(samples)


def sampled(kind, factors, samples, seed):
    """Points all over the ranges; lists of values are sampled by their index."""
    return [{factor.name: factor.sample(share) for factor, share in zip(factors, row)}
            for row in unit_samples(kind, len(factors), samples, seed).tolist()]
