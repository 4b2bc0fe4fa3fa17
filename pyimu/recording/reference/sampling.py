"""A reference that is quicker than the log's rows, as these can show it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

PASSES, STOPS = 0.3, 0.5
"""Of the rows' rate: up to the first a reference is as it was, from the second on, where what it
has would be seen as something slower, nothing of it is left but ``LEFT``."""

LEFT = 60.0
"""dB; by so much what is stopped is less."""

QUICKER = 1.2
"""Times the rows' rate from which on a reference is quicker."""


def for_rows(values: np.ndarray, period: float, row: float) -> np.ndarray:
    """Values (m, k), ``period`` s apart, to be looked up at rows ``row`` s apart: without what
    these cannot show, where the values come more often than they do.

    The noise of attitudes and positions rises with the frequency once they are differentiated, and
    most of it lies above what rows can show: looked up as it is, it would come down on the motion.
    """
    if not is_quicker(period, row):
        return values
    from scipy.signal import firwin, kaiserord, oaconvolve  # a quarter of a second, for few

    count, beta = kaiserord(LEFT, (STOPS - PASSES) * 2.0 * period / row)
    half = count // 2
    low = firwin(
        2 * half + 1, 0.5 * (PASSES + STOPS) / row, fs=1.0 / period, window=("kaiser", beta)
    )
    return oaconvolve(extended(values, half), low[:, None], mode="valid", axes=0)


def is_quicker(period: float, row: float) -> bool:
    """Whether samples ``period`` s apart tell more than rows ``row`` s apart can show."""
    return row > QUICKER * period


def slope_at(
    time: np.ndarray,
    curve: Callable[..., np.ndarray],
    nodes: np.ndarray,
    row: float,
    order: int = 1,
) -> np.ndarray:
    """A derivative (n, k) of a curve through ``nodes`` (m,) s at times (n,) s of rows ``row`` s
    apart, as these can show it.
    """
    period = float(np.diff(nodes).mean())
    if not is_quicker(period, row):
        return curve(time, order)
    return through(nodes, for_rows(curve(nodes, order), period, row))(time)


def through(time: np.ndarray, values: np.ndarray, degree: int = 3) -> Callable[..., np.ndarray]:
    """The spline of a ``degree`` through values (n, k) at ``time`` (n,) s: of times its values, and
    with a second argument of 1 its slopes.
    """
    from scipy.interpolate import make_interp_spline  # a tenth of a second, and few logs need it

    return make_interp_spline(time, values, k=min(degree, (len(time) - 2) // 2 * 2 + 1))


def extended(values: np.ndarray, more: int) -> np.ndarray:
    """Values (n, k) and ``more`` rows at either end, mirrored at the last one, so that a filter
    is symmetric there, too.
    """
    whole = [(min(more, len(values) - 1),) * 2, (0, 0)]
    rest = [(max(more - len(values) + 1, 0),) * 2, (0, 0)]
    return np.pad(np.pad(values, whole, "reflect", reflect_type="odd"), rest, "edge")
