"""The rate transfer test: what a gyro shows on a rate table, plateau by plateau.

Slope, its asymmetry and the residual in percent of the range, as IEEE Std 1431 (and the paper's
section 2.2, whose figures are not in our text) has them: r_m = b + (1 + s) r + sa |r|, by the
regression of ``pyimu close`` over the plateaus' means.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.ndimage import uniform_filter1d

from pyimu.errors import UserError
from pyimu.identification.fit.columns import Linear, Stack
from pyimu.identification.fit.keys import Coefficient, Key, LogBias
from pyimu.identification.fit.normal import normal_equations, solve, variances
from pyimu.identification.fit.whiten import LEAST_VARIANCE, RandomWalk
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording

STEADY = 0.002
"""Share of the table's range by which a plateau may differ from its mean over a second: tables keep
their rate to a tenth of that."""

SHORTEST = 1.0
"""s; of a plateau."""

LEAST = 5
"""Plateaus of rates that differ, on both sides of zero, that a transfer test has at least: three
coefficients, and two more to see what they leave."""


@dataclass(frozen=True)
class RateTransfer:
    """The transfer of one ``axis``, by its plateaus (k,).

    ``rate`` rad/s is the table's, ``measured`` rad/s the mean of the gyro's, ``residual`` rad/s
    what the three coefficients leave of it. ``s``, ``asymmetry`` and ``bias`` rad/s come with their
    standard deviations; ``range`` rad/s is the largest rate.
    """

    name: str
    axis: str
    rate: np.ndarray
    measured: np.ndarray
    residual: np.ndarray
    s: float
    s_std: float
    asymmetry: float
    asymmetry_std: float
    bias: float
    bias_std: float
    range: float

    @property
    def percent(self) -> np.ndarray:
        """The residual (k,) in percent of the range."""
        return 100.0 * self.residual / self.range

    @property
    def worst(self) -> float:
        """The largest residual in percent of the range."""
        return float(np.max(np.abs(self.percent)))

    def as_dict(self) -> dict[str, Any]:
        """As in report.json, in SI."""
        return vars(self) | {"percent_of_range": self.percent, "worst_percent": self.worst}


def shows_transfer(recording: Recording) -> bool:
    """Whether a recording is one of a rate table that stood at enough rates."""
    return recording.gyro is not None and recording.ref_rate is not None and bool(_axes(recording))


def rate_transfer(recording: Recording, axis: str | None = None) -> RateTransfer:
    """The rate transfer of a rate table's log, about the axis that turned fastest, or about
    ``axis`` ("x", "y" or "z").

    Raises UserError for a log without gyro or reference rate, and one that stood at too few rates.
    """
    if recording.gyro is None or recording.ref_rate is None:
        raise UserError(
            f"{recording.name}: a rate transfer needs gyro and ref_rate columns in rad/s"
        )
    axes = _axes(recording)
    wanted = [i for i in axes if axis is None or "xyz"[i] == axis]
    if not wanted:
        raise UserError(
            f"{recording.name}: a rate transfer needs {LEAST} plateaus or more of {SHORTEST:g} s "
            f"at rates that differ, on both sides of zero{f', about {axis}' if axis else ''}"
        )
    return _transfer(recording, max(wanted, key=lambda i: np.ptp(axes[i][0])))


def _axes(recording: Recording) -> dict[int, tuple[np.ndarray, list[tuple[int, int]]]]:
    """Rates and rows of the plateaus of each axis that has enough of them."""
    found = {}
    for i in range(3):
        rate = recording.ref_rate[:, i]
        if not np.isfinite(rate).all() or np.ptp(rate) == 0.0:
            continue
        pieces = _plateaus(rate, recording)
        means = np.array([rate[a:b].mean() for a, b in pieces])
        tolerance = 2 * STEADY * np.ptp(rate)
        distinct = np.count_nonzero(np.diff(np.sort(means)) > tolerance) + bool(len(means))
        if distinct >= LEAST and means.min() < -tolerance and means.max() > tolerance:
            found[i] = (means, pieces)
    return found


def _plateaus(rate: np.ndarray, recording: Recording) -> list[tuple[int, int]]:
    length = max(round(SHORTEST / recording.sample_period), 2)
    found = []
    for a, b in recording.segments:
        one = rate[a:b]
        near = np.abs(one - uniform_filter1d(one, length, mode="nearest")) < STEADY * np.ptp(rate)
        found += [(a + i, a + j) for i, j in runs(near) if j - i >= length]
    return found


def _transfer(recording: Recording, axis: int) -> RateTransfer:
    name, (rates, pieces) = "xyz"[axis], _axes(recording)[axis]
    rows = np.concatenate([np.arange(a, b) for a, b in pieces])
    ends = np.cumsum([b - a for a, b in pieces]).tolist()
    segments = list(zip([0, *ends[:-1]], ends, strict=True))
    measured = recording.gyro[rows, axis]
    if not np.isfinite(measured).all():
        raise UserError(f"{recording.name}: gyro_{name} is missing in a plateau of the rate table")
    means = np.array([measured[a:b].mean() for a, b in segments])
    columns = np.column_stack([rates, np.ones(len(rates)), np.abs(rates)])
    keys: list[Key] = [
        Coefficient("scale_factor", "s", (axis,)),
        LogBias(recording.name, axis),
        Coefficient("scale_factor_asymmetry", "sa", (axis,)),
    ]
    rest = means - rates
    rest = rest - columns @ np.linalg.lstsq(columns, rest)[0]
    # What is left of a plateau is no noise of its samples: the standard errors hold it.
    noise = RandomWalk(max(float(rest @ rest) / (len(rest) - len(keys)), LEAST_VARIANCE), 0.0)
    time = np.array([recording.time[a] for a, _ in pieces])
    every = [(0, len(rates))]
    linear = Linear(time, every, (means - rates)[:, None], {0: keys}, {0: Stack.of(columns)})
    normal = normal_equations([linear], {0: noise})
    answer, std = solve(normal.gram, normal.score), np.sqrt(variances(normal.gram))
    return RateTransfer(
        recording.name,
        name,
        rates,
        means,
        means - rates - columns @ answer,
        *(float(v) for i in (0, 2, 1) for v in (answer[i], std[i])),
        float(np.max(np.abs(rates))),
    )
