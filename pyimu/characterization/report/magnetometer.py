"""A magnetometer's calibration in sentences, and as data."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from pyimu.characterization.outcome import Outcome
from pyimu.report.numbers import number

if TYPE_CHECKING:
    from pyimu.characterization.magnetometer.estimate import MagnetometerFit


def magnetometer_lines(c: Outcome) -> list[str]:
    """What the logs show of their magnetometers; nothing of those that do not turn."""
    found = []
    for log in c.logs:
        if log.magnetometer is not None:
            found += [f"{log.name}: magnetometer: {text}" for text in _sentences(log.magnetometer)]
        elif log.magnetometer_reason:
            found.append(log.magnetometer_reason)
    return found


def _sentences(f: MagnetometerFit) -> Iterator[str]:
    from pyimu.attitude.magnetometer import EARTH, ROOM

    matrix, std = f.calibration.matrix, f.matrix_std
    diagonal = np.diag_indices(3)
    rows = "; ".join(" ".join(f"{v:.4f}" for v in row) for row in matrix)
    yield f"bias {_with_std(1e6 * f.calibration.bias, 1e6 * f.bias_std)} uT (x, y, z)"
    yield (
        f"matrix {rows}, std {number(np.max(std[diagonal]), 2)} on the diagonal and "
        f"{number(np.max(std), 2)} beside it at most; the log does not tell the scale of all axes"
    )
    turn = _with_std(np.degrees(f.misalignment), np.degrees(f.misalignment_std))
    yield f"turned against the accelerometer by {turn} deg (x, y, z)"
    yield (
        f"field of {number(1e6 * f.strength, 4)} ± {number(1e6 * f.strength_std, 2)} uT, dip "
        f"{np.degrees(f.dip):.2f} ± {number(np.degrees(f.dip_std), 2)} deg in {f.attitudes:,} "
        f"attitudes; off by {number(1e6 * f.along, 2)} uT along itself and "
        f"{number(1e6 * f.across, 2)} uT across; a direction is then known to "
        f"{number(np.degrees(f.direction_std), 2)} deg"
    )
    noise = ", ".join(number(1e9 * n) for n in f.noise)
    at_rest = f"N {noise} nT*sqrt(s) at rest" if np.isfinite(f.noise).all() else "no rest for N"
    yield (
        f"{at_rest}; {number(1e3 * f.delay)} ± {number(1e3 * f.delay_std, 2)} ms behind the "
        "accelerometer"
    )

    if not EARTH[0] / ROOM <= f.strength <= EARTH[1] * ROOM:
        yield "that is not the Earth's field, of 22 to 67 uT: see to the unit of mag_x in the log"


def _with_std(values: np.ndarray, std: np.ndarray) -> str:
    return ", ".join(f"{v:.3f} ± {number(s, 2)}" for v, s in zip(values, std, strict=True))


def magnetometer_entry(f: MagnetometerFit) -> dict[str, Any]:
    """The calibration as data, in SI."""
    return {
        "bias": _entry(f.calibration.bias, f.bias_std, "T"),
        "matrix": _entry(f.calibration.matrix, f.matrix_std, "1"),
        "misalignment": _entry(f.misalignment, f.misalignment_std, "rad"),
        "strength": _entry(f.strength, f.strength_std, "T"),
        "dip": _entry(f.dip, f.dip_std, "rad"),
        "delay": _entry(f.delay, f.delay_std, "s"),
        "noise": {"value": f.noise, "unit": "T*sqrt(s)"},
        "along": {"value": f.along, "unit": "T"},
        "across": {"value": f.across, "unit": "T"},
        "covariance": f.covariance,
        "attitudes": f.attitudes,
    }


def _entry(value, std, unit: str) -> dict[str, Any]:
    return {"value": value, "std": std, "unit": unit}
