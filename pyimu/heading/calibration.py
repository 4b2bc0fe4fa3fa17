"""Scale factor and bias of one gyro from a known motion, as Hong and Park 2008 have them.

The gyro measures r_m = (1 + s) r + b + w, and the corrected rate is r = s_bar r_m + b_bar with
s_bar = 1/(1 + s) and b_bar = -b/(1 + s) (eq. 3). The noisy measurement is the regressor, so s_bar
comes out too small by the share that noise has in the power of the measured rate (errors in
variables), and the sums over a noisy rate are a random walk that least squares takes for white
noise. ``pyimu.heading.fit`` has neither fault.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.errors import UserError
from pyimu.heading.motion import KnownMotion, Reference, Z, known_motion
from pyimu.identification.fit.columns import Linear, Stack
from pyimu.identification.fit.keys import Coefficient, LogBias
from pyimu.identification.fit.normal import normal_equations, variances
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.search.belief import FARTHEST
from pyimu.model.part import Part
from pyimu.model.typical import magnitudes
from pyimu.recording.recording import Recording

LEAST_KNOWN = magnitudes("scale_factor", "gyro")["consumer"].si
"""A calibration that knows the scale factor less well than a consumer part's data sheet promises it
anyhow (MPU-6050, 3 %) is none."""


MOST = FARTHEST * LEAST_KNOWN
"""A larger scale factor error is none of a gyro's, as the loop has it of every coefficient."""


@dataclass(frozen=True)
class Calibration:
    """Scale factor and bias of a gyro, r = ``s_bar`` r_m + ``b_bar`` (``b_bar`` in rad/s).

    ``method`` is the reference, and whether it was whitened. ``covariance`` (2, 2) is that of the
    two in this order: of plain least squares as if what is left were white. ``condition`` is the
    condition number of the columns, each scaled to length one. ``residual`` rad/s (rad for a
    heading that was not whitened) is what is left, RMS, of so many ``rows`` in so many
    ``segments``. ``late`` s is how late the reference's samples are, below zero where the gyro's
    are, with its standard deviation; None where it was not sought. ``noise`` are N rad/sqrt(s) and
    K rad/s/sqrt(s) of what is left, None where it was taken for white; ``window`` are the samples
    that were averaged to a row.
    """

    method: str
    name: str
    s_bar: float
    b_bar: float
    covariance: np.ndarray
    condition: float
    residual: float
    rows: int
    seconds: float
    segments: int
    late: float | None = None
    late_std: float | None = None
    noise: tuple[float, float] | None = None
    window: int = 1

    @property
    def s(self) -> float:
        """Scale factor error, s = 1/s_bar - 1: ``scale_factor.s`` of the axis."""
        return 1.0 / self.s_bar - 1.0

    @property
    def b0(self) -> float:
        """Bias in rad/s, -b_bar/s_bar: ``turn_on_bias.b0`` of the axis."""
        return -self.b_bar / self.s_bar

    @property
    def physical_covariance(self) -> np.ndarray:
        """Covariance (2, 2) of ``s`` and ``b0``."""
        slope = np.array(
            [[-1.0 / self.s_bar**2, 0.0], [self.b_bar / self.s_bar**2, -1.0 / self.s_bar]]
        )
        return slope @ self.covariance @ slope.T

    @property
    def s_std(self) -> float:
        return float(np.sqrt(self.physical_covariance[0, 0]))

    @property
    def b0_std(self) -> float:
        """rad/s."""
        return float(np.sqrt(self.physical_covariance[1, 1]))

    def rate(self, measured: np.ndarray) -> np.ndarray:
        """The corrected rate in rad/s of a measured one."""
        return self.s_bar * measured + self.b_bar

    def in_part(self, part: Part) -> Part:
        """The part with this scale factor and bias about the vertical."""
        gyro = part.gyro
        for effect, parameter, value in (
            ("scale_factor", "s", self.s),
            ("turn_on_bias", "b0", self.b0),
        ):
            values = np.array(gyro.values.get(effect, {}).get(parameter, np.zeros(3)))
            values[Z] = value
            gyro = gyro.with_values(effect, **{parameter: values})
        return part.with_sensor(gyro)

    def as_dict(self) -> dict[str, Any]:
        """The contents of report.json, in SI."""
        return {
            "method": self.method,
            "s": {"value": self.s, "std": self.s_std, "unit": "1"},
            "b0": {"value": self.b0, "std": self.b0_std, "unit": "rad/s"},
            "s_bar": self.s_bar,
            "b_bar": self.b_bar,
            "covariance": self.covariance,
            "condition": self.condition,
            "residual": self.residual,
            "rows": self.rows,
            "seconds": self.seconds,
            "segments": self.segments,
            "late": None
            if self.late is None
            else {"value": self.late, "std": self.late_std, "unit": "s"},
            "noise": None if self.noise is None else dict(zip("NK", self.noise, strict=True)),
            "window": self.window,
        }


def self_calibrate(recording: Recording, reference: Reference | None = None) -> Calibration:
    """The calibration of the gyro about the vertical as Hong and Park 2008 print it.

    By a heading reference (eqs. 4 to 6), psi_n - psi_0 = [T sum r_m, n T] [s_bar, b_bar]^T with the
    rows of growing n stacked, each segment of the log from a heading of its own; or by a rate
    reference, r = [r_m, 1] [s_bar, b_bar]^T. Without ``reference`` it is the one that the log has,
    the heading where it has both.

    Raises UserError as ``known_motion`` does, for a motion that does not show the scale factor to
    what a data sheet promises, and where s_bar is not positive.
    """
    one = known_motion(recording, reference)
    reference = reference or one.references[0]
    _, found = observed(one, reference)
    check_seen(one, *found)
    columns, right = _heading_rows(one) if reference == "heading" else _rate_rows(one)
    answer = np.linalg.lstsq(columns, right)[0]
    left = right - columns @ answer
    variance = left @ left / max(len(left) - 2, 1)
    return checked(
        Calibration(
            reference,
            one.name,
            *map(float, answer),
            covariance=variance * np.linalg.inv(columns.T @ columns),
            condition=condition_number(columns),
            residual=float(np.sqrt(left @ left / len(left))),
            rows=len(left),
            seconds=len(left) * one.period,
            segments=len(one.segments),
        )
    )


def _heading_rows(one: KnownMotion) -> tuple[np.ndarray, np.ndarray]:
    """G (m, 2) and psi_n - psi_0 (m,) of eq. 6, segment below segment."""
    columns, right = [], []
    for a, b in one.segments:
        turned = one.period * np.cumsum(one.measured[a + 1 : b])
        columns.append(np.column_stack([turned, one.period * np.arange(1, b - a)]))
        right.append(one.heading[a + 1 : b] - one.heading[a])
    return np.concatenate(columns), np.concatenate(right)


def _rate_rows(one: KnownMotion) -> tuple[np.ndarray, np.ndarray]:
    return np.column_stack([one.measured, np.ones(len(one.measured))]), one.rate


# Whether the motion shows the coefficients at all


def observed(one: KnownMotion, reference: Reference) -> tuple[np.ndarray, tuple[float, float]]:
    """True rates (n,) by the reference, and of [r, 1] the condition number and the standard error
    of s by the rows' own scatter.
    """
    rate = one.rate if reference == "rate" else _mean_rates(one)
    columns = np.column_stack([rate, np.ones(len(rate))])
    left = one.measured - columns @ np.linalg.lstsq(columns, one.measured)[0]
    scatter = np.diff(left) @ np.diff(left) / (2 * max(len(left) - 1, 1))
    noise = RandomWalk(max(float(scatter), 1e-30), 0.0)
    names = [Coefficient("scale_factor", "s", (Z,)), LogBias(one.name, Z)]
    linear = Linear(one.time, one.segments, left[:, None], {0: names}, {0: Stack.of(columns)})
    std = float(np.sqrt(variances(normal_equations([linear], {0: noise}).gram)[0]))
    return rate, (condition_number(columns), std)


def _mean_rates(one: KnownMotion) -> np.ndarray:
    """Mean rate (n,) of the period that ends with each row; of a segment's first that of the
    next.
    """
    rate = np.empty(len(one.time))
    for a, b in one.segments:
        rate[a + 1 : b] = np.diff(one.heading[a:b]) / one.period
        rate[a] = rate[a + 1]
    return rate


def check_seen(one: KnownMotion, condition: float, std: float) -> None:
    """Raise UserError for a motion that does not tell the scale factor from the bias."""
    if not std < LEAST_KNOWN:
        error = f"{100 * std:.3g} %" if np.isfinite(std) else "unbounded"
        raise UserError(
            f"{one.name}: the motion does not show the scale factor: its standard error would be "
            f"{error} (condition number {condition:.3g}), that of a data sheet is "
            f"{100 * LEAST_KNOWN:.3g} %; the known motion must turn at rates that differ, and for "
            "longer or faster"
        )


def condition_number(columns: np.ndarray) -> float:
    """Condition number of columns scaled to length one."""
    lengths = np.linalg.norm(columns, axis=0)
    values = np.linalg.svd(columns / np.where(lengths > 0, lengths, 1.0), compute_uv=False)
    return float(values[0] / values[-1]) if values[-1] > 0 else np.inf


def checked(found: Calibration) -> Calibration:
    """The calibration. Raises UserError where no gyro has such a scale factor."""
    if not found.s_bar > 0.0:
        raise UserError(
            f"{found.name}: s_bar is {found.s_bar:.4g}, which is not positive: gyro and reference "
            "turn opposite ways, or do not belong together"
        )
    if abs(found.s) > MOST:
        raise UserError(
            f"{found.name}: the scale factor would be off by {100 * found.s:.3g} %, and no gyro's "
            f"is by more than {100 * MOST:.3g} %: gyro and reference do not belong together, or "
            "one has another unit"
        )
    return found
