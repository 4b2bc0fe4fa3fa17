"""Errors that no effect describes, and, but for one or two, no formula of signals at one instant:
what has a memory, a phase or a size that wanders, stairs, or follows the slope of a signal.
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


def wandering_line(x, case: Case):
    """Periodic in time, at a frequency that wanders about a mean, as a motor's that nobody logs."""
    slow = _wandering(case, case.form["over"])[:, 0]
    cycles = np.cumsum(case.form["hz"] * (1.0 + 0.2 * slow)) * case.scene.h
    return x + np.sin(2 * np.pi * cycles)[:, None] * case.c


def wandering_gain(x, case: Case):
    """A gain that wanders by chance, each axis's by itself."""
    share = _wandering(case, case.form["over"])
    return x + share * case.scene.own(case.kind) * case.c


def play(x, case: Case):
    """What the force leaves of itself behind play: it must go back by so much to be seen."""
    force, half = np.roll(case.scene.force, -1, axis=1), case.form["half"]
    out = np.array(force)
    for axis in range(3):
        seen = force[0, axis]
        for k, value in enumerate(force[:, axis]):
            seen = min(max(seen, value - half), value + half)
            out[k, axis] = seen
    return x + out * case.c


def stairs(x, case: Case):
    """A bias that steps with the temperature, as a table of few entries leaves it."""
    return x + np.floor(case.scene.warmth / case.form["step"])[:, None] * case.c


def rubbing(x, case: Case):
    """What the next axis's turns bend until it slips, and bend back (Dahl 1968)."""
    rate, bend = np.roll(case.scene.rate, -1, axis=1), np.zeros(3)
    out = np.empty_like(rate)
    for k, w in enumerate(rate):
        bend = bend + case.scene.h * (w - np.abs(w) * bend / case.form["slip"])
        out[k] = bend
    return x + out * case.c


def cable(x, case: Case):
    """A bias that is another at each angle turned, as a cable that is dragged along pulls."""
    turned = np.cumsum(np.linalg.norm(case.scene.rate, axis=1)) * case.scene.h
    at = np.arange(0.0, turned[-1] + 10.0, 2.0)
    pulls = case.rng.standard_normal((len(at), 3))
    return x + np.column_stack([np.interp(turned, at, p) for p in pulls.T]) * case.c


def _wandering(case: Case, seconds: float) -> np.ndarray:
    """Random numbers (n, 3) of variance one that change over so many seconds."""
    pole = np.exp(-case.scene.h / seconds)
    draw = case.rng.standard_normal((len(case.scene.time) + 1, 3))
    gain = [np.sqrt(1 - pole**2)]
    return lfilter(gain, [1, -pole], draw[1:], axis=0, zi=pole * draw[:1])[0]


def _line(rng, scene):
    return {"hz": float(rng.uniform(0.05, 0.5)), "over": float(rng.uniform(20.0, 100.0))}


def _over(rng, scene):
    return {"over": float(rng.uniform(20.0, 200.0))}


def _half(rng, scene):
    return {"half": float(rng.uniform(0.5, 2.0))}


def _step(rng, scene):
    return {"step": float(rng.uniform(1.0, 3.0))}


def _slip(rng, scene):
    return {"slip": float(rng.uniform(0.1, 0.5))}


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
    _term(wandering_line, form=_line),
    _term(wandering_gain, form=_over, motions=ROTATING),
    _term(play, form=_half, motions=("tumble",)),
    _term(stairs, form=_step),
    _term(rubbing, form=_slip, motions=ROTATING),
    _term(cable, motions=ROTATING),
)
