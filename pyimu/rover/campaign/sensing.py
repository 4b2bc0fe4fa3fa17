"""From the true motion of a run to the samples behind the low-pass, piece by piece.

A piece stays in the processor's cache: arrays of a whole drive would cost more than the sensor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.signal import sosfilt, sosfilt_zi

from pyimu.block.block import Run
from pyimu.rover.campaign.draws import Draws
from pyimu.rover.campaign.faults import OF_RANGE, SATURATING, Fault
from pyimu.rover.campaign.motion import Truth
from pyimu.rover.campaign.system import WHITE, System, coefficients, with_values

PIECE = 512
"""Samples of the filter in a piece."""


@dataclass(frozen=True)
class Sensed:
    """The samples (m, 6) of gyro and accelerometer as the filter gets them, and ``temperature``
    (m,); ``bias`` (k, 3) rad/s at the instants that were asked for; ``limit`` (3,) rad/s of the
    gyro where its range is too small.
    """

    samples: np.ndarray
    temperature: np.ndarray
    bias: np.ndarray
    limit: np.ndarray | None


def sensed(system: System, true: Truth, draws: Draws, instants: np.ndarray) -> Sensed:
    """What a run's specimen measures; ``instants`` (k,) are numbers of the filter's samples."""
    limit, rows = _range(draws.fault, true), len(true.q) * true.every
    p = _with_range(system, coefficients(system.specimen(draws.specimen_seed)), limit)
    sensor = Run(system.sensor, rows, p=p, seed=draws.noise_seed)
    bias = _Bias(system, rows, p, draws.noise_seed)
    low_pass = _LowPass(system.sections)
    samples, temperature = np.empty((len(true.q), 6)), np.empty(len(true.q))
    found = np.empty((len(instants), 3))
    for first in range(0, len(true.q), PIECE):
        kept = slice(first, min(first + PIECE, len(true.q)))
        u, time = _inputs(true, draws, kept)
        y = sensor.advance(u)
        at = (instants > kept.start) & (instants <= kept.stop)
        found[at] = bias.advance(u)[(instants[at] - kept.start) * true.every - 1]
        draws.fault.in_gyro(y[:, :3], time)
        samples[kept] = low_pass.advance(y)[true.every - 1 :: true.every]
        temperature[kept] = u[true.every - 1 :: true.every, 6]
    return Sensed(samples, temperature, found, limit)


def _inputs(true: Truth, draws: Draws, kept: slice) -> tuple[np.ndarray, np.ndarray]:
    """Rate, force and temperature (n, 7) of the sensors' samples, and their time (n,) s."""
    rows = slice(kept.start * true.every, kept.stop * true.every)
    time = np.arange(rows.start, rows.stop) * true.period
    u = np.empty((len(time), 7))
    u[:, :3], u[:, 3:6], u[:, 6] = true.rate[rows], true.force[rows], draws.temperature(time)
    return u, time


class _Bias:
    """What is left of the gyro's error, to first order in the errors, where the nominal part's
    errors are undone: its white noise apart.
    """

    def __init__(self, system: System, rows: int, p: np.ndarray, seed: int) -> None:
        names = [v.name for v in system.sensor.parameters]
        quiet = {n: 0.0 for n in names if n.startswith(f"gyro_error.{WHITE}.")}
        self.real = Run(system.sensor, rows, p=with_values(system.sensor, p, quiet), seed=seed)
        self.nominal = Run(system.nominal, rows)

    def advance(self, u: np.ndarray) -> np.ndarray:
        return self.real.advance(u)[:, :3] - self.nominal.advance(u)[:, :3]


class _LowPass:
    """The low-pass of all channels, which starts as if the first sample had always been."""

    def __init__(self, sections: np.ndarray | None) -> None:
        self.sections, self.state = sections, None

    def advance(self, y: np.ndarray) -> np.ndarray:
        if self.sections is None:
            return y
        if self.state is None:
            self.state = sosfilt_zi(self.sections)[:, :, None] * y[0]
        passed, self.state = sosfilt(self.sections, y, axis=0, zi=self.state)
        return passed


def _range(fault: Fault, true: Truth) -> np.ndarray | None:
    """The gyro's range (3,) rad/s where it is too small."""
    if fault.name != SATURATING:
        return None
    return np.full(3, OF_RANGE * np.abs(true.rate).max())


def _with_range(system: System, p: np.ndarray, limit: np.ndarray | None) -> np.ndarray:
    if limit is None:
        return p
    values = {f"gyro_error.saturation.limit[{i + 1}]": v for i, v in enumerate(limit)}
    return with_values(system.sensor, p, values)
