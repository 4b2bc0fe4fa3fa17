"""From the true motion of a run to the samples behind the low-pass, piece by piece.

A piece stays in the processor's cache: arrays of a whole drive would cost more than the sensor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pyimu.block.block import Block, Run
from pyimu.block.parameters import with_values
from pyimu.model.part import Part
from pyimu.rover.campaign.draws import Draws
from pyimu.rover.campaign.faults import OF_RANGE, SATURATING, Fault
from pyimu.rover.campaign.motion import Truth
from pyimu.rover.campaign.specimen import WHITE
from pyimu.rover.campaign.system import System

PIECE = 512
"""Samples of the filter in a piece."""


@dataclass(frozen=True)
class Sensed:
    """The samples (m, 6) of gyro and accelerometer as the filter gets them.

    ``temperature`` (m,) degC goes with them; ``bias`` (k, 3) rad/s is that at the instants that
    were asked for.
    """

    samples: np.ndarray
    temperature: np.ndarray
    bias: np.ndarray


def sensed(
    system: System,
    true: Truth,
    draws: Draws,
    specimen: Part,
    fault: Fault,
    instants: np.ndarray,
) -> Sensed:
    """What a run's specimen measures; ``instants`` (k,) are numbers of the filter's samples."""
    values = specimen.start_values | system.of_range(range_of(fault, true))
    rows, seed = len(true.q) * true.every, draws.noise_seed
    sensor = Run(system.sensor, rows, p=with_values(system.sensor, values), seed=seed)
    quiet = Run(system.sensor, rows, p=_without_white(system.sensor, values), seed=seed)
    nominal = Run(system.nominal, rows)
    low_pass = Run(system.low_pass, rows) if system.low_pass else None
    samples, temperature = np.empty((len(true.q), 6)), np.empty(len(true.q))
    bias = np.empty((len(instants), 3))
    for first in range(0, len(true.q), PIECE):
        kept = slice(first, min(first + PIECE, len(true.q)))
        u, time = _inputs(true, draws, kept)
        y = sensor.advance(u)[:, :6]
        at = (instants > kept.start) & (instants <= kept.stop)
        left = quiet.advance(u)[:, :3] - nominal.advance(u)[:, :3]
        bias[at] = left[(instants[at] - kept.start) * true.every - 1]
        fault.in_gyro(y[:, :3], time)
        y = low_pass.advance(y) if low_pass else y
        samples[kept] = y[true.every - 1 :: true.every]
        temperature[kept] = u[true.every - 1 :: true.every, 6]
    return Sensed(samples, temperature, bias)


def range_of(fault: Fault, true: Truth) -> np.ndarray | None:
    """The gyro's range (3,) rad/s where it is too small."""
    if fault.name != SATURATING:
        return None
    return np.full(3, OF_RANGE * np.abs(true.rate).max())


def _inputs(true: Truth, draws: Draws, kept: slice) -> tuple[np.ndarray, np.ndarray]:
    """Rate, force and temperature (n, 7) of the sensors' samples, and their time (n,) s."""
    rows = slice(kept.start * true.every, kept.stop * true.every)
    time = np.arange(rows.start + 1, rows.stop + 1) * true.period
    u = np.empty((len(time), 7))
    u[:, :3], u[:, 3:6], u[:, 6] = true.rate[rows], true.force[rows], draws.temperature(time)
    return u, time


def _without_white(block: Block, values: dict) -> np.ndarray:
    """The parameters of a gyro without white noise.

    What it measures less what a nominal one measures is, to first order in the errors, the bias
    that is left where the nominal part's errors are undone.
    """
    names = [v.name for v in block.parameters if v.name.startswith(f"gyro_error.{WHITE}.")]
    return with_values(block, {**values, **dict.fromkeys(names, 0.0)})
