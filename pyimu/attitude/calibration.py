"""A magnetometer's calibration as a value, and as a TOML file.

It has two keys, ``bias = {value = [12.1, -3.0, 40.2], unit = "uT"}`` and the three rows of
``matrix``.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import UserError
from pyimu.files import read_toml, write_text
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, START
from pyimu.recording.recording import Recording
from pyimu.units import convert, did_you_mean

KEYS = ("bias", "matrix")
"""The keys of the file."""

MOST_UNLIKE = 1e3
"""Largest ratio of what the matrix makes of two directions: beyond it is one that shows nothing of
an axis."""


@dataclass(frozen=True, eq=False)
class MagnetometerCalibration:
    """What a magnetometer shows of a field f (3,) T in the accelerometer's axes: matrix f + bias.

    ``bias`` (3,) T is the hard iron, with the sensor's own offset; ``matrix`` (3, 3) has scale
    factors, soft iron, and how the axes lie against the accelerometer's (Vasconcelos et al. 2011,
    eq. 5). Raises UserError for other than so many finite numbers, and for a matrix that cannot be
    undone.
    """

    bias: np.ndarray = field(default_factory=lambda: np.zeros(3))
    matrix: np.ndarray = field(default_factory=lambda: np.eye(3))

    def __post_init__(self) -> None:
        for name, shape in (("bias", (3,)), ("matrix", (3, 3))):
            object.__setattr__(self, name, _array(name, getattr(self, name), shape))
        if not np.linalg.cond(self.matrix) < MOST_UNLIKE:
            raise UserError("matrix of a magnetometer's calibration: cannot be undone, is singular")

    def field(self, mag: np.ndarray) -> np.ndarray:
        """The field (n, 3) T in the accelerometer's axes, of samples ``mag`` (n, 3) T.

        Zeros stay zeros: they stand for no sample.
        """
        found = (mag - self.bias) @ np.linalg.inv(self.matrix).T
        return np.where(np.any(mag != 0, axis=1)[:, None], found, 0.0)

    def write(self, path: str | os.PathLike) -> Path:
        """Write the calibration to a TOML file, which reads back as the same numbers.

        Raises UserError where the file cannot be written.
        """
        path = Path(path)
        rows = ",\n".join(f"    {row}" for row in self.matrix.tolist())
        bias = f'bias = {{value = {self.bias.tolist()}, unit = "T"}}\n'
        write_text(path, f"{HEAD}{bias}matrix = [\n{rows},\n]\n")
        return path

    @classmethod
    def read(cls, path: str | os.PathLike) -> MagnetometerCalibration:
        """The calibration in a TOML file.

        Raises UserError, with file and key, where it cannot be read or is none.
        """
        data = read_toml(Path(path))
        for key in data:
            if key not in KEYS:
                raise UserError(
                    f"{path}: {key}: unknown key of a magnetometer's calibration"
                    f"{did_you_mean(key, KEYS)}; known are {', '.join(KEYS)}"
                )
        try:
            return cls(*(_entry(key, data) for key in KEYS))
        except UserError as error:
            raise UserError(f"{path}: {error}") from None


HEAD = "# mag = matrix @ field + bias, in the axes of the accelerometer\n"


def calibration_of(
    given: bool | MagnetometerCalibration | str | os.PathLike,
) -> MagnetometerCalibration | None:
    """A calibration as it is, or the one in a TOML file, None for a truth value.

    Raises UserError for anything else.
    """
    if isinstance(given, (bool, np.bool_)):
        return None
    if isinstance(given, MagnetometerCalibration):
        return given
    if isinstance(given, (str, os.PathLike)):
        return MagnetometerCalibration.read(given)
    raise UserError(
        f"magnetometer is {str(given)[:40]!r}, expected True, False, a MagnetometerCalibration or "
        "the path of its TOML file"
    )


def of_sensor(sensor: Sensor) -> MagnetometerCalibration | None:
    """The calibration that a part knows of its magnetometer, None where it knows none.

    Its effects are affine in the field: they are taken from what they make of none and of its axes.
    """
    if not any(sensor.acts(e.name) for e in sensor.effects if not e.stochastic):
        return None
    u = np.repeat(START[:, None], 4, axis=1)
    u[COLUMNS[sensor.output.own]] = np.column_stack([np.zeros(3), np.eye(3)])
    silent, h = np.zeros(len(sensor.noise)), 1.0
    made = [sensor.step(sensor.chain.start, v, sensor.p, silent, h)[1] for v in u.T]
    y = [np.array(v, dtype=float).ravel() for v in made]
    return MagnetometerCalibration(y[0], np.column_stack(y[1:]) - y[0][:, None])


def as_values(calibration: MagnetometerCalibration) -> dict[str, dict[str, np.ndarray]]:
    """The values of a part's effects that make the same of a field: the inverse of ``of_sensor``.

    Of ``matrix = (1 + S) (1 + M)`` S is diagonal and M has no diagonal.
    """
    matrix = calibration.matrix
    scale = np.diag(matrix)
    return {
        "misalignment": {"m": matrix / scale[:, None] - np.eye(3)},
        "scale_factor": {"s": scale - 1},
        "turn_on_bias": {"b0": calibration.bias},
    }


def calibrated(recording: Recording, calibration: MagnetometerCalibration) -> Recording:
    """The recording with its magnetometer's calibration undone.

    Raises UserError where it has no magnetometer.
    """
    if recording.mag is None:
        raise UserError(
            f"{recording.name}: a calibration of the magnetometer, but no column mag_x [T]"
        )
    cadence = recording.cadence
    return replace(
        recording,
        mag=calibration.field(recording.mag),
        period=cadence.period,
        longest=cadence.longest,
    )


def _entry(key: str, data: dict[str, Any]) -> np.ndarray:
    """The SI value of a key. Raises UserError where it is missing or no table with a unit."""
    if key not in data:
        raise UserError(f"{key} is missing")
    value = data[key]
    if key == "matrix":
        return value
    if not isinstance(value, dict) or set(value) != {"value", "unit"}:
        raise UserError(f'{key}: expected {{value = [x, y, z], unit = "uT"}}')
    array = _array(key, value["value"], (3,))
    try:
        return np.asarray(convert(array, value["unit"], "T"))
    except UserError as error:
        raise UserError(f"{key}: {error}") from None


def _array(name: str, value: Any, shape: tuple[int, ...]) -> np.ndarray:
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        array = np.zeros(0)
    if array.shape != shape or not np.isfinite(array).all():
        size = " x ".join(str(n) for n in shape)
        raise UserError(f"{name} is {str(value)[:60]}, expected {size} finite numbers")
    return array
