"""By how much the standard deviations of a log are too small, as the ends of its drives show."""

from __future__ import annotations

import numpy as np
from scipy.special import chdtrc

from pyimu.ins.filtered import Filtered

LASTS = 0.1
"""Share of the samples of a stop from which on it may be none: of one the first few contradict the
estimate at most, and the others follow them."""

BY_CHANCE = 1e-4
"""Probability that velocities are called too far off where the standard deviations are right."""

WRONG_REST = 2
"""Bit of the status of a zero velocity that contradicted the estimate."""


def too_sure(found: Filtered, stops: list[tuple[int, int]]) -> float:
    """How many times as far off as they say the velocities are at the first samples of ``stops``;
    1 where that may be chance.

    Their normalised innovations squared are those of three normal numbers each (Bar-Shalom, Li and
    Kirubarajan 2001, section 5.4.2). Stops that go on contradicting the estimate may be none, and
    do not count where the others agree with it and are more. Where these are too far off, too, the
    cause is the same, and all count, as the estimate is held to what they say.
    """
    nis, wrong = found.scalar("zupt_nis"), found.scalar("status").astype(int) & WRONG_REST > 0
    known = [(nis[k], wrong[k:end].mean() < LASTS) for k, end in stops if nis[k] > 0]
    first = np.array([n for n, _ in known])
    sound = np.array([n for n, agrees in known if agrees])
    sound = sound if 2 * len(sound) > len(first) else first
    if not len(sound) or chdtrc(3 * len(sound), sound.sum()) > BY_CHANCE:
        return 1.0
    return float(np.sqrt(first.mean() / 3))
