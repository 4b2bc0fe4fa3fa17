"""Slow noise that the motion drives: a bias that changes as the sensor turns, or as its input
changes, and hardly while that rests; or one that is its input times a gain that wanders.

Noise changes as fast at rest as in motion. What a motion leaves in a residual and no column
explains (rubbing, a belt that creeps, a cable that is dragged along, a seat with play) is slow,
too, and its spectrum comes near that of a kind of noise; but it goes on with the motion and not
with time. A Gauss-Markov process along what moved in place of time, or of a gain in place of a
bias, tells them apart: it has as many numbers, so that the likelihoods are compared as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from pyimu.identification.noise.explained import Explained
from pyimu.identification.noise.jumps import Jump, Jumping
from pyimu.identification.noise.levels import MARKOV, gain_likelihood, markov_likelihood
from pyimu.identification.noise.rows import Rows
from pyimu.identification.search.choice import SET_WIDTH

TURNED = "a bias that changes as the sensor turns"
FOLLOWS = "a bias that changes with its input"
GAIN = "a scale factor that wanders"

DRIVEN = {
    TURNED: "it goes on with the angle turned, and hardly while the sensor rests",
    FOLLOWS: "it goes on as that changes, and hardly while it stays",
    GAIN: "it is a share of the input, which is another from minute to minute",
}
"""By name what the motion drives and no effect describes, and how that looks."""

Speed = Callable[[Rows, int], np.ndarray]

SPEEDS: tuple[tuple[str, Speed], ...] = (
    (TURNED, lambda one, i: np.linalg.norm(_rate(one), axis=1)),
    (TURNED, lambda one, i: np.abs(_rate(one)[:, i])),
    (FOLLOWS, lambda one, i: np.abs(one.slope)),
)
"""What may drive an axis, and how fast (n,) it moves."""

CHOICES = len(SPEEDS) + 1
"""Ways in which an axis may be driven."""

AT_REST = 0.1
"""Share of a log's time that goes by where nothing moves: what is slow never stands quite still."""


def driven_of(found: Explained) -> dict[int, Jump]:
    """The axes whose slow noise the motion drives, each with what moves it most clearly: where one
    axis is, another of the sensor has the same cause, unless noise is clearly likelier there.
    """
    looked = Jumping(found)
    best = {i: _most(looked, i) for i in found.state.axes if looked.wanders(i)}
    least = SET_WIDTH + np.log(CHOICES)
    if all(one.gain <= least for one in best.values()):
        return {}
    return {i: one for i, one in best.items() if one.gain > -SET_WIDTH}


def _most(looked: Jumping, i: int) -> Jump:
    """What drives an axis most, with the log-likelihood [nat] by which it is likelier than noise,
    that of what was chosen or of the same law along time.
    """
    by_time = looked.of(markov_likelihood, [i], MARKOV)
    known = max(by_time, looked.slow_noise([i]))
    best, name = max(_each(looked, i))
    return Jump(best - known, name)


def _each(looked: Jumping, i: int) -> Iterator[tuple[float, str]]:
    """The log-likelihood [nat] of each way in which an axis may be driven."""
    for name, speed in SPEEDS:
        yield looked.of(markov_likelihood, [i], MARKOV, partial(_along, speed, i)), name
    yield looked.of(gain_likelihood, [i], MARKOV), GAIN


def _along(speed: Speed, i: int, one: Rows) -> Rows | None:
    """The rows of an axis with what moved in place of time, as long in all; None where nothing
    does.
    """
    moved = np.cumsum(speed(one, i) * one.steps)
    if not len(moved) or not moved[-1] > 0.0:
        return None
    since = one.time - one.time[0]
    passed = AT_REST * since + (1.0 - AT_REST) * since[-1] * moved / moved[-1]
    return replace(one, time=passed)


def _rate(one: Rows) -> np.ndarray:
    return np.zeros((len(one.time), 3)) if one.rate is None else one.rate
