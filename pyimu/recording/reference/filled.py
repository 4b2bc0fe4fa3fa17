"""Rows that a program filled in where samples were lost, of a reference or of a sensor: along a
straight arc, or a smooth curve, from the last to the next.

What is measured scatters from row to row: white noise makes fourth differences 8 times as large as
itself. Those of a curve of third degree are nothing but the rounding of its numbers.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.clock import runs
from pyimu.recording.quality.resolution import quantization_step
from pyimu.recording.reference.repeats import without_repeats
from pyimu.recording.reference.track import fresh

FILLED = "filled_in"
"""The finding of such rows."""

ORDER = 4

BY_ROUNDING = 8.0
"""Steps of the last digit that rounding makes of a fourth difference at most: half of one, and of
its neighbours 4, 6, 4 and 1 times that."""

SINGLE = 2.0**-23
"""Share of the largest number that the last digit of single precision is at most; few numbers in
files have more, whatever they are stored as."""

CLEARLY = 30.0
"""Times what rounding makes that most fourth differences near a curve must be."""

NEAR = 16
"""Fourth differences on either side that are near a curve."""

LEAST = 12
"""Fourth differences in a row, below which what lies on a curve may do so by chance."""

SELDOM = 0.3
"""Share of the rows that may be filled in: of more, as of a slow reference along lines, each curve
lies between two samples."""

FALSE_ALARMS = 1e-3
"""Curves that are seen in values without any."""


def measured(
    values: np.ndarray, column: str, curve: Callable[[np.ndarray], np.ndarray] = np.asarray
) -> tuple[np.ndarray, list[Finding]]:
    """The rows (k,) of a reference (n, d) that show a sample of their own, without jumps of sign or
    turn, and what others were: those that repeat one, and those that were filled in. What is
    straight is so of the ``curve`` that known rows make.
    """
    rows = fresh(values)
    new = without_repeats(values, rows)
    own = new
    if len(new) >= 4 * NEAR:
        own = new[~filled_in(curve(values[new]), resolution(values[new]))]
    lost = {"repeated_samples": len(rows) - len(new), FILLED: len(new) - len(own)}
    return own, [Finding(kind, column, count) for kind, count in lost.items() if count]


def resolution(values: np.ndarray) -> float:
    """The last digit of values (k, d)."""
    steps = (quantization_step(np.ascontiguousarray(v)) for v in values.T)
    least = SINGLE * float(np.abs(values).max(initial=0.0))
    return max((step for step in steps if step is not None), default=0.0) + least


def filled_in(values: np.ndarray, last_digit: float) -> np.ndarray:
    """Marks (k,) of the rows of ``values`` (k, d), all known to a ``last_digit``, that were filled
    in; of none where there are so many that curves are the rule.
    """
    filled = np.zeros(len(values), dtype=bool)
    if len(values) < 4 * NEAR:
        return filled
    third, fourth = (np.linalg.norm(np.diff(values, n, axis=0), axis=1) for n in (3, ORDER))
    rounding = BY_ROUNDING * last_digit
    curves = runs(fourth < rounding)
    longest = _longest_by_chance([b - a for a, b in curves])
    # One that rests, or was held, is on no curve from one sample to another.
    still = np.linalg.norm(np.diff(values, axis=0), axis=1) == 0.0
    for first, stop in (c for c in curves if c[1] - c[0] > longest):
        last = stop + ORDER - 1
        near = np.r_[max(first - NEAR, 0) : first, stop : min(stop + NEAR, len(fourth))]
        scatters = _scatter(third[near], fourth[near], CLEARLY * rounding)
        if scatters and not still[first:last].any():
            filled[first + 1 : last] = True
    return filled if filled.mean() < SELDOM else np.zeros(len(values), dtype=bool)


def _scatter(third: np.ndarray, fourth: np.ndarray, least: float) -> bool:
    """Whether most values scatter whose differences (k,) these are: noise grows with each of them,
    and a motion that rows can follow shrinks.
    """
    return len(fourth) > 0 and float(np.median(fourth)) > max(least, float(np.median(third)))


def _longest_by_chance(lengths: list[int]) -> float:
    """Rows of the longest curve that chance makes, by the law of the short ones, which is
    geometric.
    """
    short = [n for n in lengths if n < LEAST]
    goes_on = 1.0 - len(short) / sum(short) if short else 0.0
    if goes_on <= 0.0:
        return LEAST
    return max(LEAST, float(np.log(FALSE_ALARMS / len(short)) / np.log(goes_on)))
