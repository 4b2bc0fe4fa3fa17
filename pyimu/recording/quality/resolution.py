"""The step on whose multiples the samples of a column lie."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.recording.quality.scatter import scatter

CONCENTRATION = 0.8
"""|mean exp(2 pi i v / q)| above which values lie on a comb of step q."""


FEW, CHANCE = 4096, 0.1
"""Levels by which a comb is refused where there are many, and by how much less than all of them
these may be concentrated by chance: six standard errors, of one over the root of their number."""

RELEVANT_STEP = 0.1
"""A step below this part of the noise is the rounding of the file, and does nothing."""

QUIET = 0.1
"""Quantile of the scatter of windows that is taken for the noise."""

SHARES = (0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.0)
"""Quantiles of the gaps between levels that are tried as a step, the largest first: of a fine comb
few levels are taken, and few of them are neighbours."""

LEAST_LEVELS = 100
"""Fewer levels may lie on some fine comb by chance."""

DISTINCT = 1e-12
"""Share of the largest value below which two levels are one: arithmetic rounds them."""

TEETH = 0.5
"""Share of the levels that must be multiples of their own: where most lie closer together than a
step, they agree on its multiples whatever it is."""

ROUND = 1e-4
"""Relative difference below which a step is a number of one digit: of any other step some 4 in
100000 are by chance, for each unit that is asked about."""

SINGLE = 2.0**-22
"""Share of the largest value up to which a power of two is the last bits of a 32-bit number, whose
mantissa has 24."""


def quantization_step(values: np.ndarray) -> float | None:
    """The step q of the comb on which ``values`` (n,) lie, in their unit, or None.

    The step starts as the typical distance of neighbouring levels and is refined over a growing
    range, so that it is right to a small part of a level even at the extremes; then the phases v /
    q must agree. They need not agree exactly: a file rounds the levels once more. A step far
    below the noise is the file's rounding, and is not reported.
    """
    known = values[np.isfinite(values)]
    ordered = np.sort(known)
    levels = ordered[np.diff(ordered, prepend=-np.inf) > 0]
    if len(levels) < 4:
        return (
            float(np.diff(levels).min())
            if len(levels) > 1 and len(known) > 20 * len(levels)
            else None
        )
    step = _first_step(ordered, levels)
    if step is None or step < least_relevant(known):
        return None
    return _on_comb(step, known, levels)


def least_relevant(values: np.ndarray) -> float:
    """The step below which rounding does nothing to ``values`` (n,): a part of their noise, which
    second differences show 6 times as strong in power, where it is quiet.
    """
    return RELEVANT_STEP * scatter(np.abs(np.diff(values, 2)), QUIET) / np.sqrt(6)


def comb_step(values: np.ndarray) -> float | None:
    """The step q of the comb on which ``values`` (n,) lie, however fine it is against their noise.

    None where there is none that the digits of the values resolve.
    """
    known = values[np.isfinite(values)]
    levels = _levels(known)
    if len(levels) < LEAST_LEVELS:
        return quantization_step(values)
    gaps = np.diff(levels)
    tried = np.unique([np.quantile(gaps, s, method="lower") for s in SHARES])[::-1]
    for first in map(float, tried):
        step = _on_comb(first, known, levels)
        if step and len(np.unique(np.round(levels / step))) > TEETH * len(levels):
            return step
    return None


def last_digit(values: np.ndarray) -> float:
    """The step to which the numbers of a signal (n,) were rounded, 0 where none is seen. Few levels
    show none: a table that somebody set has those that it was set to.
    """
    many = len(_levels(values[np.isfinite(values)])) >= LEAST_LEVELS
    return (comb_step(values) or 0.0) if many else 0.0


def resolution(values: np.ndarray) -> float:
    """The distance at which two of ``values`` (n,) are told apart: the step of their comb, or else
    the smallest that there is between any two.
    """
    known = values[np.isfinite(values)]
    levels = _levels(known)
    return comb_step(known) or (float(np.diff(levels).min()) if len(levels) > 1 else 0.0)


def is_written(step: float, largest: float, units: Iterable[float]) -> bool:
    """Whether a step is the last digit that numbers up to ``largest`` are written with in any of
    ``units`` (their sizes in the step's unit): a power of ten, or the last bits of 32.
    """
    for unit in units:
        digit = np.log10(step / unit)
        bit = np.log2(step / unit)
        if abs(digit - round(digit)) < ROUND / np.log(10.0):
            return True
        if abs(bit - round(bit)) < ROUND / np.log(2.0) and step <= SINGLE * largest:
            return True
    return False


def _levels(known: np.ndarray) -> np.ndarray:
    """The values that there are, in order, those that are one counted once."""
    levels = np.unique(known)
    if not len(levels):
        return levels
    apart = np.diff(levels, prepend=-np.inf) > DISTINCT * np.abs(levels[[0, -1]]).max()
    return levels[apart]


def _on_comb(step: float, known: np.ndarray, levels: np.ndarray) -> float | None:
    """A step refined, if the levels lie on its multiples."""
    centre = levels - levels[np.argmin(np.abs(levels - np.median(known)))]
    step = _refined(step, centre)
    some = np.random.default_rng(1).integers(len(centre), size=FEW) if len(centre) > FEW else []
    if len(some) and _concentration(step, centre[some]) < CONCENTRATION - CHANCE:
        return None
    return step if _concentration(step, centre) > CONCENTRATION else None


def _concentration(step: float, centre: np.ndarray) -> float:
    """|mean exp(2 pi i v / q)| of levels ``centre`` (n,)."""
    return float(np.abs(np.exp(2j * np.pi / step * centre).mean()))


def _first_step(ordered: np.ndarray, levels: np.ndarray) -> float | None:
    """The median distance between levels, where they are dense: the samples' middle half."""
    quarter = (len(ordered) - 1) // 4
    low, high = ordered[quarter], ordered[-1 - quarter]
    dense = levels[slice(*np.searchsorted(levels, (low, np.nextafter(high, np.inf))))]
    gaps = np.diff(dense if len(dense) > 8 else levels)
    gaps = gaps[gaps > 1e-9 * (levels[-1] - levels[0])]
    return float(np.median(gaps)) if len(gaps) else None


def _slope(number: np.ndarray, near: np.ndarray) -> float:
    """Of the line through levels by number; through the origin where there are too few."""
    if len(number) >= 3:
        number, near = number - number.mean(), near - near.mean()
    return float(number @ near / (number @ number))


def _refined(step: float, centre: np.ndarray) -> float:
    """A step refined by the levels (n,), in order, ever farther on both sides of the ``centre``."""
    reach, farthest = 8 * step, max(-centre[0], centre[-1])
    while True:
        near = centre[slice(*np.searchsorted(centre, (-reach, np.nextafter(reach, np.inf))))]
        number = np.round(near / step)
        if np.ptp(number):
            slope = _slope(number, near)
            step = slope if abs(slope - step) < 0.1 * step else step
        if reach >= farthest:
            return step
        reach *= 2
