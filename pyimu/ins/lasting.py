"""Errors of measured positions that last, as those of a satellite receiver do.

A filter that takes each for a draw of its own follows the part that lasts, is much too sure, and
finds its innovations small: their normalised squares are below what chance allows. How large and
how long the part is shows in the difference r of measured positions and the smoothed path, which is
good over seconds: half the mean square of r(t + u) - r(t) is w^2 + s^2 (1 - exp(-u / T)), with the
part w that is new each time and a Gauss-Markov process of the standard deviation s and the time
constant T (the variogram of an exponential process and its nugget; Cressie 1993, section 2.3.1).
The path itself follows what lasts: w^2 + s^2 is what is claimed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.special import chdtr

from pyimu.errors import Finding
from pyimu.ins.filtered import Filtered
from pyimu.ins.measured import Fixes
from pyimu.ins.track import Track

BY_CHANCE = 1e-4
"""Probability with which innovations of errors that do not last are called too small."""

LAG = 1.0
"""s; the least step of the spans u, of which ``LAGS`` are looked at: the path is good over them."""

LAGS = 5

LEAST = 10
"""Pairs of positions to a span, of fewer nothing is said."""

TINY = 1e-6
"""Share of the claimed variance that is new each time at least."""


@dataclass(frozen=True)
class Lasting:
    """What lasts of the errors of positions: its standard deviation ``std`` m and time constant
    ``time`` s, and the ``share`` of their claimed variance that is new each time.
    """

    std: float
    time: float
    share: float

    @property
    def settings(self) -> dict[str, float]:
        """Parameters of the filter that follow."""
        return {"position_lasting_std": self.std, "position_lasting_time": self.time}

    def rest(self, fixes: Fixes) -> Fixes:
        """The positions with what does not last as their error."""
        name = "position_variance"
        columns = {**fixes.columns, name: self.share * fixes.columns[name]}
        first = np.sqrt(max(fixes.std**2 - self.std**2, TINY * fixes.std**2))
        return replace(fixes, columns=columns, std=float(first))

    @property
    def finding(self) -> Finding:
        new = self.std * np.sqrt(self.share / (1 - self.share))
        detail = {"std": self.std, "time": self.time, "new": float(new)}
        return Finding("lasting_fixes", "position", 1, detail)


def too_small(found: Filtered, fixes: Fixes) -> bool:
    """Whether the innovations of the positions are smaller than chance allows of errors that do not
    last; their normalised squares are chi-square distributed with a degree each axis.
    """
    if len(fixes.rows) < 2:
        return False
    nis = found.scalar("position_nis")[fixes.rows[1:]]
    axes = np.isfinite(fixes.position[1:][nis > 0]).sum()
    return bool(axes > 0 and chdtr(axes, nis.sum()) < BY_CHANCE)


def lasting(fixes: Fixes, track: Track, arm: np.ndarray) -> Lasting | None:
    """What lasts, beside the smoothed ``track`` of errors that do not, of an antenna at the ``arm``
    (3,) m in body axes; None where too few positions follow each other.
    """
    rows, at = fixes.rows, track.time[fixes.rows]
    turn = Rotation.from_quat(track.q[rows], scalar_first=True)
    off = fixes.position - track.position[rows] - turn.apply(arm)
    claimed = float(np.mean(fixes.columns["position_variance"][rows[1:]]))
    step = float(np.median(np.diff(at)))
    every = max(1, round(LAG / step))
    spans, halves = [], []
    for k in every * np.arange(1, LAGS + 1):
        near = np.abs(at[k:] - at[:-k] - k * step) < step / 2
        if np.count_nonzero(near) < LEAST:
            return None
        spans.append(k * step)
        halves.append(np.nanmean((off[k:] - off[:-k])[near] ** 2) / 2)
    # what changes by nothing that is seen lasts as long as the log
    time, share = _fitted(np.array(spans), np.array(halves) / claimed, (step, float(np.ptp(at))))
    std = float(np.sqrt((1 - share) * claimed))
    return Lasting(std, time, share) if time > step * (1 + NEAR) else None


NEAR = 1e-2
"""Share by which a time constant is found."""


def _fitted(
    spans: np.ndarray, halves: np.ndarray, times: tuple[float, float]
) -> tuple[float, float]:
    """The time constant, one between two ``times`` in s, and the share of the variance that is new,
    of the variogram ``halves`` (k,) at ``spans`` (k,) in s over that variance, by least squares.

    Not by a line: that takes what bends down within the spans for a smaller slope, and finds a time
    constant of 10 s a third too long by spans up to 5 s.
    """

    def share_of(time: float) -> float:
        left = np.exp(-spans / time)
        return float(np.clip((halves - 1 + left) @ left / (left @ left), TINY, 1.0))

    def off(log_time: float) -> float:
        left = np.exp(-spans / np.exp(log_time))
        return float(np.sum((halves - 1 + left - share_of(float(np.exp(log_time))) * left) ** 2))

    tried = np.arange(np.log(times[0]), np.log(times[1]) + NEAR, NEAR)
    time = min(float(np.exp(min(tried.tolist(), key=off))), times[1])
    return time, share_of(time)
