"""From the true motion of a run to the samples behind the low-pass, piece by piece.

The pieces stay in the processor's cache: to touch new memory for a whole drive costs more than the
sensor.
"""

from __future__ import annotations

import numpy as np

from pyimu.block.block import Block, Run
from pyimu.block.parameters import with_values
from pyimu.model.part import Part
from pyimu.rover.campaign.draws import Draws
from pyimu.rover.campaign.faults import OF_RANGE, SATURATING, Fault
from pyimu.rover.campaign.motion import Truth
from pyimu.rover.campaign.specimen import WHITE
from pyimu.rover.campaign.system import System


class Sensing:
    """What a run's specimen measures, successive samples of the filter at a time."""

    def __init__(
        self, system: System, true: Truth, draws: Draws, specimen: Part, fault: Fault
    ) -> None:
        values = specimen.start_values | system.of_range(range_of(fault, true))
        rows, seed, block = len(true.q) * true.every, draws.noise_seed, system.sensor
        self.true, self.draws, self.fault = true, draws, fault
        self.sensor = Run(block, rows, p=with_values(block, values), seed=seed)
        self.quiet = Run(block, rows, p=_without_white(block, values), seed=seed)
        self.nominal = Run(system.nominal, rows)
        self.low_pass = Run(system.low_pass, rows) if system.low_pass else None

    def advance(self, kept: slice) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Gyro and accelerometer (k, 6) behind the low-pass, temperature (k,) degC, and the bias.

        They are those of the filter's samples ``kept``; the bias (3,) rad/s is that of the last.
        """
        u, time = _inputs(self.true, self.draws, kept)
        y = self.sensor.advance(u)[:, :6]
        bias = self.quiet.advance(u)[-1, :3] - self.nominal.advance(u)[-1, :3]
        self.fault.in_gyro(y[:, :3], time)
        y = self.low_pass.advance(y) if self.low_pass else y
        every = self.true.every
        return y[every - 1 :: every], u[every - 1 :: every, 6], bias


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
