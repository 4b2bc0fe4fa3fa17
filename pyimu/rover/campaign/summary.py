"""What a campaign's runs say together: errors, honesty of the filter, faults and causes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pyarrow as pa
from scipy.stats import binom, binomtest, chi2

from pyimu.attitude.filter.status import STATUS_NAMES
from pyimu.rover.campaign.faults import NONE
from pyimu.rover.campaign.score import ANGLES, FREEDOM
from pyimu.rover.campaign.sensitivity import LEVEL, Index, chance, indices

QUANTILES = (0.5, 0.9, 0.95, 0.99)

CLAIM = np.deg2rad(2.0)
"""rad; the "range of two degrees after one sol" in heading and attitude that exploration rovers on
Mars set as a baseline (Hidalgo 2012, section 7)."""

TARGETS = tuple(f"{name}_error_max [rad]" for name in reversed(ANGLES))
"""The errors whose causes are looked for."""

FACTORS = ("temperature_", "start_", "terrain", "gyro_error.", "accel_error.")
"""How the names of columns with a drawn parameter begin."""


@dataclass(frozen=True)
class Share:
    """``count`` of ``runs``, with the exact interval of a binomial share (Clopper and Pearson)."""

    count: int
    runs: int

    @property
    def value(self) -> float:
        return self.count / self.runs

    @cached_property
    def interval(self) -> tuple[float, float]:
        found = binomtest(self.count, self.runs).proportion_ci(LEVEL, "exact")
        return float(found.low), float(found.high)


@dataclass(frozen=True)
class Quantile:
    """The value below which a share ``p`` of the runs lies, with an interval.

    The interval is between two of the runs in order (David and Nagaraja 2003, section 7.1); its
    upper end is NaN where more runs would be needed.
    """

    p: float
    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Honesty:
    """Normalised errors squared at the end of the runs, of ``freedom`` degrees.

    Their ``mean`` lies within ``bounds`` with probability ``LEVEL`` where the filter's covariance
    is right, and so many of the runs are ``inside`` the bounds of a single one. ``over_time`` is
    the mean over runs and instants.
    """

    freedom: int
    mean: float
    bounds: tuple[float, float]
    inside: Share
    over_time: float


class Summary:
    """A campaign's table, ``columns`` by name (n,), and what follows from it."""

    def __init__(self, table: pa.Table) -> None:
        self.columns = {name: table[name].to_numpy() for name in table.column_names}
        self.runs = len(table)

    @cached_property
    def sound(self) -> np.ndarray:
        """Whether a run (n,) had no fault."""
        return self.columns["fault"] == NONE

    @cached_property
    def fault_names(self) -> list[str]:
        """The faults of the runs, none first."""
        found = sorted(set(self.columns["fault"].tolist()) - {NONE})
        return [NONE] * bool(self.sound.any()) + found

    def of_fault(self, name: str, column: str) -> np.ndarray:
        return self.columns[column][self.columns["fault"] == name]

    def quantiles(self, column: str, fault: str = NONE) -> list[Quantile]:
        """Of the sizes of a column in the runs with that fault."""
        values = np.sort(np.abs(self.of_fault(fault, column)))
        return [quantile(values, p) for p in QUANTILES] if len(values) else []

    def within(self, kind: str) -> Share:
        """The runs without fault whose three errors, ``end`` or ``max``, are within ``CLAIM``."""
        found = [
            np.abs(self.of_fault(NONE, f"{name}_error_{kind} [rad]")) <= CLAIM for name in ANGLES
        ]
        return Share(int(np.all(found, axis=0).sum()), int(self.sound.sum()))

    def honesty(self, name: str) -> Honesty:
        freedom, end = FREEDOM[name], self.of_fault(NONE, f"nees_{name}_end [1]")
        ends, n = np.array([(1 - LEVEL) / 2, (1 + LEVEL) / 2]), len(end)
        low, high = chi2.ppf(ends, freedom)
        bounds = chi2.ppf(ends, n * freedom) / n
        return Honesty(
            freedom,
            float(end.mean()),
            (float(bounds[0]), float(bounds[1])),
            Share(int(((low <= end) & (end <= high)).sum()), n),
            float(self.of_fault(NONE, f"nees_{name}_mean [1]").mean()),
        )

    def flags(self, fault: str) -> dict[str, Share]:
        """How many runs with that fault had each bit of the filter's status, by its words."""
        status = self.of_fault(fault, "status")
        return {
            words: Share(int(((status & bit) != 0).sum()), len(status))
            for bit, words in STATUS_NAMES.items()
            if ((status & bit) != 0).any()
        }

    @cached_property
    def factors(self) -> dict[str, np.ndarray]:
        """The drawn parameters of the runs without fault that are not constant."""
        found = {
            name: self.of_fault(NONE, name).astype(float)
            for name in self.columns
            if name.startswith(FACTORS)
        }
        return {name: x for name, x in found.items() if len(x) and np.ptp(x) > 0}

    @cached_property
    def causes(self) -> dict[str, list[Index]]:
        """The indices of the factors for each of ``TARGETS``; empty with too few runs."""
        return {name: indices(self.factors, self.of_fault(NONE, name)) for name in TARGETS}

    @property
    def chance(self) -> float:
        return chance(int(self.sound.sum()), len(self.factors))


def quantile(ordered: np.ndarray, p: float) -> Quantile:
    """A quantile of n values in order."""
    n = len(ordered)
    low = int(binom.ppf((1 - LEVEL) / 2, n, p))
    high = int(binom.ppf((1 + LEVEL) / 2, n, p))
    return Quantile(
        p,
        float(np.quantile(ordered, p)),
        float(ordered[low - 1]) if low > 0 else float("nan"),
        float(ordered[high]) if high < n else float("nan"),
    )


def explained(causes: Iterable[Index]) -> float:
    """The share of the variance that the factors explain one by one, from 0 to 1.

    The indices below zero are in the sum: without them what chance makes of many would add up.
    """
    return min(1.0, max(0.0, sum(i.value for i in causes)))
