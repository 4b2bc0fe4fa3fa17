"""Errors that no effect describes, and, but for one or two, no formula of signals at one instant:
what has a memory, a phase that drifts, or follows the slope of a signal.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from effect_logs.nameless import SIZES
from effect_logs.scene import T0
from effect_logs.term import BOTH, ROTATING, Case, Term

TURNS = 0.05
"""rad/s; a body that turns faster has a sense of turning."""


def slope_sign(x, case: Case):
    """A bias with the sign of the next axis's slope, as rubbing leaves it; none where it stands."""
    slope = np.roll(case.scene.slope(case.kind), -1, axis=1)
    least = 0.05 * slope.std(axis=0)
    return x + ((slope > least) * 1.0 - (slope < -least)) * case.c


def drifting_phase(x, case: Case):
    """Periodic in the angle turned about the axis, whose phase drifts as a belt that creeps."""
    turned = np.cumsum(case.scene.rate, axis=0) * case.scene.h
    drift = 2 * np.pi * case.scene.time / case.form["period"]
    return x + np.sin(case.form["order"] * turned + drift[:, None]) * case.c


def after_turns(x, case: Case):
    """A bias that each turn feeds and that fades within a minute, as moisture or creep do."""
    size = np.linalg.norm(case.scene.rate, axis=1)
    pole = np.exp(-case.scene.h / case.form["tau"])
    fed = lfilter([1 - pole], [1, -pole], size)
    return x + fed[:, None] * case.c


def droop(x, case: Case):
    """A gain that droops with the supply, and the more so the faster the body turns."""
    ripple = case.scene.supply - case.scene.supply.mean()
    return x + ripple[:, None] * np.abs(case.scene.rate) * case.scene.rate * case.c


def reseated(x, case: Case):
    """A bias that is another after each reversal of the turn about z."""
    rate, rng = case.scene.rate[:, 2], case.rng
    turning = np.flatnonzero(np.abs(rate) > TURNS)
    sense = np.sign(rate[turning])
    changes = turning[1:][np.diff(sense) != 0]
    place = np.searchsorted(changes, np.arange(len(rate)), side="right")
    return x + rng.standard_normal(len(rate) + 1)[place][:, None] * case.c


def warm_cross(x, case: Case):
    """The product of the other two axes' signals, times the temperature."""
    own = case.scene.own(case.kind)
    product = np.roll(own, -1, axis=1) * np.roll(own, -2, axis=1)
    return x + (case.scene.warmth - T0)[:, None] * product * case.c


def _drift(rng, scene):
    return {"order": int(rng.integers(1, 4)), "period": float(rng.uniform(40.0, 150.0))}


def _tau(rng, scene):
    return {"tau": float(rng.uniform(10.0, 60.0))}


def _term(function, kinds=BOTH, **more) -> Term:
    sizes = {kind: SIZES[kind] for kind in kinds}
    return Term(function.__name__, function, sizes, answer="", **more)


TERMS = (
    _term(slope_sign, motions=("tumble", "rover")),
    _term(drifting_phase, form=_drift),
    _term(after_turns, form=_tau),
    _term(droop, ("gyro",), needs=("supply",), motions=ROTATING),
    _term(reseated),
    _term(warm_cross, motions=("tumble",)),
)
