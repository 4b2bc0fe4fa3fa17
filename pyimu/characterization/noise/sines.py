"""Lines of a spectrum in the Allan variance, with whatever else is left free in the fit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

LINES = 4
"""Groups of lines whose strength is left free: each of the most important lines by itself, and all
others together."""

SLIGHT = 1e-4
"""A line that makes up no more than this share of any Allan variance is ignored."""


class Sine(NamedTuple):
    """A line in cycles a sample: its frequency, the spread of that, and its squared amplitude."""

    frequency: float
    spread: float
    square: float


Groups = tuple[tuple[Sine, ...], ...]
"""Lines by group; the strength of each group is left free."""


def relevant(m: np.ndarray, measured: np.ndarray, lines: Sequence[Sine]) -> Groups:
    """The lines by group, those first that have the largest share of any Allan variance."""
    share = np.array([np.max(sine_variance(m, v) / measured) for v in lines])
    order = [lines[i] for i in np.argsort(-share) if share[i] > SLIGHT]
    single = LINES if len(order) <= LINES else LINES - 1
    return tuple((v,) for v in order[:single]) + (
        (tuple(order[single:]),) if order[single:] else ()
    )


def sine_variance(m: np.ndarray, line: Sine) -> np.ndarray:
    """Allan variance (t,) of a line at cluster sizes (t,)."""
    f, spread, square = line
    x, s = np.pi * f * m, np.pi * spread * m
    fourth = 3 / 8 - np.cos(2 * x) * np.exp(-2 * s**2) / 2 + np.cos(4 * x) * np.exp(-8 * s**2) / 8
    return square * fourth / (m * np.sin(np.pi * f)) ** 2


def free_variances(m: np.ndarray, lines: Groups, free: bool) -> np.ndarray:
    """Allan variances (t, k) at cluster sizes ``m`` (t,) of what is left free, of strength one.

    These are each group of lines and, if it is ``free``, the term 1 / m^2.
    """
    m = np.asarray(m, dtype=float)
    columns = [sum(sine_variance(m, v) for v in group) for group in lines]
    return np.column_stack([*columns, *([1 / m**2] if free else []), np.empty((len(m), 0))])
