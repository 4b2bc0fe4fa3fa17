"""The threshold filter: a rate that may be noise counts as none (Hong and Park 2008, section 3.2).

Its form and value are not in the text of the paper; hard, a rate below the threshold is zero. With
hysteresis, a turn that has begun lasts until the rate has been below a lower threshold for a while.
"""

from __future__ import annotations

import numpy as np

from pyimu.errors import UserError

TYPICAL = float(np.radians(0.3))
"""rad/s; the threshold that is quoted with the paper elsewhere."""


def check_not_negative(name: str, value: float | None) -> None:
    """Raise UserError for a number that is negative or none; None is not given."""
    if value is not None and not (np.isfinite(value) and value >= 0):
        raise UserError(f"{name} is {value:g}, expected a finite number that is not negative")


def threshold_filter(
    rate: np.ndarray,
    threshold: float = TYPICAL,
    *,
    release: float | None = None,
    hold: float = 0.0,
    period: float | None = None,
) -> np.ndarray:
    """The rate (n,) rad/s with what is below the ``threshold`` rad/s set to zero.

    A turn begins with a rate of at least the threshold and lasts while rates are at least
    ``release`` rad/s (the threshold itself), and for ``hold`` s after the last of them, which needs
    the sample ``period`` s. A rate that is missing is no turn.

    Raises UserError for a threshold or a hold that is negative or no number, and a release above
    the threshold.
    """
    rate = np.asarray(rate, dtype=float)
    for name, value in (("threshold", threshold), ("release", release), ("hold", hold)):
        check_not_negative(name, value)
    lower = threshold if release is None else release
    if lower > threshold:
        raise UserError(
            f"release is {lower:g} rad/s and above the threshold of {threshold:g} rad/s: a turn "
            "would end before it begins"
        )
    if hold > 0 and not (period is not None and period > 0):
        raise UserError("hold needs the sample period in s, which must be positive")
    size = np.abs(np.nan_to_num(rate))
    turns = _carried(np.where(size >= threshold, 1, np.where(size < lower, 0, -1)))
    if hold > 0:
        rows = np.arange(len(rate))
        last = np.maximum.accumulate(np.where(turns, rows, -len(rate) - round(hold / period)))
        turns = turns | (rows - last <= round(hold / period))
    return np.where(turns, rate, 0.0)


def _carried(marks: np.ndarray) -> np.ndarray:
    """Whether it turns (n,), by marks 1 (begins), 0 (ends) and -1 (goes on as before)."""
    said = np.maximum.accumulate(np.where(marks >= 0, np.arange(len(marks)), -1))
    return (said >= 0) & (marks[said] == 1)
