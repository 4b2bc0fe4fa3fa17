"""Errors that no effect of the catalogue describes.

Periodic in the heading, in a shaft's angle or in time; products of signals that the catalogue does
not have; jumps between levels.
"""

from __future__ import annotations

import numpy as np

from effect_logs.scene import T0
from effect_logs.term import BOTH, SHAKEN, Case, Term


def heading_harmonic(x, case: Case):
    """A bias that goes twice or three times round with the heading, as a bearing leaves it."""
    angle = case.form["order"] * case.scene.heading + case.form["phase"]
    return x + np.sin(angle)[:, None] * case.c


def heading_locked(x, case: Case):
    """A bias that follows the heading once round, as what stands fast in the world leaves it."""
    return x + np.cos(case.scene.heading - case.form["phase"])[:, None] * case.c


def shaft(x, case: Case):
    """Periodic in the angle turned about the axis itself, as gears or cogging leave it."""
    turned = np.cumsum(case.scene.rate, axis=0) * case.scene.h
    return x + np.sin(case.form["order"] * turned + case.form["phase"]) * case.c


def popcorn(x, case: Case):
    """A random telegraph: jumps between two levels, at Poisson's instants."""
    rng, span = case.rng, case.scene.time[-1]
    jumps = np.cumsum(rng.exponential(case.form["dwell"], 10 + int(4 * span / case.form["dwell"])))
    level = np.searchsorted(jumps, case.scene.time) % 2
    return x + level[:, None] * case.c


def own_product(x, case: Case):
    """Bilinear: an axis's rate times the next axis's."""
    return x + case.scene.rate * np.roll(case.scene.rate, -1, axis=1) * case.c


def warm_force(x, case: Case):
    """Bilinear: temperature times the specific force along the next axis."""
    force = np.roll(case.scene.force, -1, axis=1)
    return x + (case.scene.warmth - T0)[:, None] * force * case.c


def rate_times_supply(x, case: Case):
    """Bilinear: the supply's ripple times the rate about the next axis."""
    ripple = case.scene.supply - case.scene.supply.mean()
    return x + ripple[:, None] * np.roll(case.scene.rate, -1, axis=1) * case.c


def switched_by_turn(x, case: Case):
    """Switching: a bias that is there only while the body turns to the left about its z axis."""
    return x + (case.scene.rate[:, 2] > case.form["beyond"])[:, None] * case.c


def switched_by_speed(x, case: Case):
    """Switching: a bias that is there only while the body turns fast."""
    size = np.linalg.norm(case.scene.rate, axis=1)
    return x + (size > case.form["beyond"])[:, None] * case.c


def _round(rng, scene):
    return {"order": int(rng.integers(2, 4)), "phase": float(rng.uniform(0, 2 * np.pi))}


def _phase(rng, scene):
    return {"phase": float(rng.uniform(0, 2 * np.pi))}


def _dwell(rng, scene):
    return {"dwell": float(rng.uniform(5.0, 20.0))}


def _beyond(rng, scene):
    return {"beyond": float(rng.uniform(0.02, 0.1))}


def _fast(rng, scene):
    """The speed that three rows of ten are above, or as many more as it takes to lie beside those
    at which the body is kept: there the last digits of a rate would switch, which no log shows.
    """
    size = np.sort(np.linalg.norm(scene.rate, axis=1))

    def is_kept(speed: float) -> bool:
        low, high = np.searchsorted(size, [speed * (1 - NEAR), speed * (1 + NEAR)])
        return high - low > KEPT * len(size)

    return {"beyond": float(min(np.quantile(size, np.arange(0.7, 0.1, -0.01)), key=is_kept))}


NEAR, KEPT = 1e-3, 0.02
"""Relative width about a speed, and share of the rows in it, from which on a body is kept at it."""

SIZES = {"gyro": 1.7e-3, "accel": 5e-2}
"""About the size of a consumer part's g-sensitivity, of an accelerometer 5 mg."""


def _term(function, kinds=BOTH, **more) -> Term:
    sizes = {kind: SIZES[kind] for kind in kinds}
    return Term(function.__name__, function, sizes, answer="", **more)


PERIODIC = (
    _term(heading_harmonic, form=_round, needs=("ref_q",)),
    _term(heading_locked, form=_phase, needs=("ref_q",)),
    _term(shaft, form=_round),
)
# An accelerometer's are in the catalogue: vibropendulous and thermal_misalignment.
BILINEAR = (
    _term(own_product, ("gyro",), motions=("tumble",)),
    _term(warm_force, ("gyro",), motions=SHAKEN),
    _term(rate_times_supply, needs=("supply",)),
)
SWITCHING = (_term(switched_by_turn, form=_beyond), _term(switched_by_speed, form=_fast))
RANDOM = (_term(popcorn, form=_dwell),)

TERMS = (*PERIODIC, *BILINEAR, *SWITCHING, *RANDOM)
