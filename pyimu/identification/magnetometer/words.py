"""What was found of a magnetometer in sentences, and as data."""

from __future__ import annotations

from typing import Any

import numpy as np

from pyimu.files import plain
from pyimu.identification.magnetometer.examine import (
    FOUND,
    NOTHING,
    UNCONFIRMED,
    UNEVEN,
    Examined,
)
from pyimu.report.numbers import joined, number, quantity

ENOUGH = "; the logs do not tell the scale of all axes together"


def remark(seen: Examined) -> str:
    """What must be said of the magnetometer beside the verdict."""
    fall = _fall(seen)
    return {
        NOTHING: "the magnetometer: nothing is missing, it shows a constant field as it should",
        UNCONFIRMED: f"the magnetometer: {_size(seen)} would be found, but on held-out rows {fall}",
        UNEVEN: (
            f"the magnetometer: {_size(seen)} would be found, and {fall}; yet that is "
            f"{number(seen.times_noise, 2)} times its noise: the field is not the same everywhere "
            f"in these logs, or the reference is off by {_angle(seen)}, and a part of that would "
            "be taken for the sensor's. It is left out of the model: to be measured outdoors"
        ),
        FOUND: f"the magnetometer: {_size(seen)} found, {fall}{ENOUGH}",
    }[seen.outcome]


def _fall(seen: Examined) -> str:
    before, after = (quantity(e.total, "T") for e in (seen.errors.before, seen.errors.after))
    return f"what a constant field leaves goes from {before} to {after}"


def _angle(seen: Examined) -> str:
    strength = np.mean([f.strength for f in seen.after.fields.values()])
    return quantity(seen.errors.after.total / strength, "rad", 2)


def _size(seen: Examined) -> str:
    """How large the change is."""
    new = seen.after.calibration
    bias = float(np.max(np.abs(new.bias - seen.before.bias)))
    shape = float(np.max(np.abs(new.matrix - seen.before.matrix)))
    return f"hard iron of up to {quantity(bias, 'T')} and soft iron of up to {quantity(shape, '1')}"


def notes(seen: Examined) -> list[str]:
    """The logs' own fields, and how the fit was made."""
    fields = [
        f"{name}: {quantity(f.strength, 'T')}, dip {np.degrees(f.dip):.1f} deg, "
        f"{1e3 * f.delay:.1f} ± {number(1e3 * f.delay_std, 2)} ms late"
        for name, f in seen.after.fields.items()
    ]
    made = f"{seen.after.attitudes:,} attitudes in {seen.after.blocks} blocks of time"
    each = f"field of each log, and how late the magnetometer is: {joined(fields)}."
    evidence = f"Found in {made}; statistic {number(seen.gain)}, gate {number(seen.gate)}{ENOUGH}."
    return [f"{each} {evidence}"]


def as_dict(seen: Examined) -> dict[str, Any]:
    """The contents of report.json about it, in SI."""
    new, std = seen.after.calibration, np.sqrt(np.diag(seen.after.covariance))
    return plain(
        {
            "outcome": seen.outcome,
            "in_model": seen.adopted,
            "bias": {"value": new.bias, "std": std[:3], "unit": "T"},
            "matrix": {"value": new.matrix, "std": std[3:].reshape(3, 3), "unit": "1"},
            "evidence": {"gain": seen.gain, "gate": seen.gate},
            "noise": {"value": seen.N, "unit": "T*sqrt(s)"},
            "attitudes": seen.after.attitudes,
            "logs": {
                name: {
                    "strength": {"value": f.strength, "unit": "T"},
                    "dip": {"value": f.dip, "unit": "rad"},
                    "delay": {"value": f.delay, "std": f.delay_std, "unit": "s"},
                }
                for name, f in seen.after.fields.items()
            },
        }
    )
