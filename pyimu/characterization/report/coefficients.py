"""Names and units of the noise coefficients as people use them, and coefficients in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pyimu.characterization.allan.readings import Floor
from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.characterization.outcome import SAMPLE
from pyimu.report.numbers import MISSING, SCRIPTS, in_unit, number

READING_ORDER = "NBKQR"
"""Letters of the coefficients in the order in which people read them."""

TERM_NAMES = {
    "gyro": {
        "Q": "angle quantization",
        "N": "angle random walk",
        "B": "bias instability",
        "K": "rate random walk",
        "R": "rate ramp",
    },
    "accel": {
        "Q": "velocity quantization",
        "N": "velocity random walk",
        "B": "bias instability",
        "K": "acceleration random walk",
        "R": "acceleration ramp",
    },
}
"""The field's names of the coefficients (IEEE Std 952, 1293)."""

MARKOV_NAME = "Gauss-Markov noise"
"""A drift that stops growing; IEEE Std 952 has it as exponentially correlated noise."""

UNITS = {
    "gyro": {"Q": "arcsec", "N": "deg/sqrt(h)", "B": "deg/h", "K": "deg/h/sqrt(h)", "R": "deg/h/h"},
    "accel": {"Q": "m/s", "N": "ug/sqrt(Hz)", "B": "mg", "K": "ug/sqrt(s)", "R": "ug/s"},
}
"""Units of the coefficients in data sheets and papers; that of B is also that of deviations."""

SECOND_N_UNIT = {"gyro": "deg/s/sqrt(Hz)", "accel": "m/s/sqrt(h)"}
"""The other usual unit of N."""

DENSITY_UNIT = {"gyro": "deg/s/sqrt(Hz)", "accel": "ug/sqrt(Hz)"}
"""Units of the root of a one-sided density in data sheets."""

SAMPLE_UNIT = {"gyro": "deg/s", "accel": "mg"}
"""Units of the samples for people."""


def with_interval(c: Coefficient, si: str, unit: str) -> str:
    """``2.42 (2.41 to 2.44)`` in a unit, ``< 3.5`` for a bound, or that there is none."""
    value, low, high = (float(in_unit(v, si, unit)) for v in (c.value, c.low, c.high))
    if not np.isfinite(high):
        return f"{number(value)} ({number(low)} or more)" if c.needed else "not bounded"
    if not c.needed:
        return f"< {number(high)}"
    figures = digits(c)
    return f"{number(value, figures)} ({number(low, figures)} to {number(high, figures)})"


def with_interval_si(c: Coefficient) -> str:
    """Value and interval in SI, on one power of ten."""
    if not c.needed:
        return f"< {number(c.high)}" if np.isfinite(c.high) else MISSING
    size = int(np.floor(np.log10(c.value)))
    scale = 1.0 if -3 <= size < 4 else 10.0**size
    value, low, high = (number(v / scale, digits(c)) for v in (c.value, c.low, c.high))
    if scale == 1.0:
        return f"{value} ({low} to {high})"
    return f"{value} ({low} to {high}) ×10{str(size).translate(SCRIPTS)}"


def value_or_bound(c: Coefficient, si: str, unit: str, factor: float = 1.0) -> str:
    """``factor`` times the value in a unit, or ``< 3.5`` for a bound."""
    if c.needed:
        return number(factor * float(in_unit(c.value, si, unit)))
    return f"< {number(factor * float(in_unit(c.high, si, unit)))}"


def floor_cell(floors: Sequence[Floor], kind: str, factor: float = 1.0) -> str:
    """``factor`` times the mean of the lowest Allan deviations of logs, in the unit of B.

    It is ``< 3.5`` where one of them is an upper bound, a dash where there is none.
    """
    if not floors:
        return MISSING
    mean = factor * np.mean([f.deviation for f in floors])
    text = number(float(in_unit(mean, SAMPLE[kind], UNITS[kind]["B"])))
    return f"< {text}" if any(f.bound for f in floors) else text


def digits(c: Coefficient) -> int:
    """Figures of a coefficient that give two of the width of its interval; at least three."""
    return int(
        np.clip(np.ceil(np.log10(2 * c.value / max(c.high - c.low, 1e-9 * c.value))) + 2, 3, 6)
    )
