"""A recording with the errors undone that its part declares, for integration without a filter."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np

from pyimu.attitude.columns import extra_column, temperature_of
from pyimu.block.block import Block, Run
from pyimu.block.plain import plain_function
from pyimu.block.variables import Variable
from pyimu.ins.filter import prediction
from pyimu.ins.filter.layout import Layout, Memory
from pyimu.model.part import Part
from pyimu.recording.recording import Recording
from pyimu.symbolic import quaternion


def compensated(recording: Recording, part: Part) -> Recording:
    """The recording with gyro and accelerometer as the part's inverse restores them.

    What cannot be restored, beyond the range or of missing samples, is missing (NaN).
    """
    layout = Layout(part)
    block, n = _block(layout), len(recording.time)
    u = np.zeros((n, len(block.inputs)))
    u[:, :3], u[:, 3:6] = recording.gyro, recording.accel
    u[:, 6] = temperature_of(recording, part)
    at = {v.name: i for i, v in enumerate(block.inputs)}
    for signal in layout.compensation.extra:
        column = np.reshape(extra_column(recording, part, signal), (n, -1))
        for i, values in enumerate(column.T):
            u[:, at[f"{signal}[{i + 1}]" if column.shape[1] > 1 else signal]] = values
    y = Run(block, n, sample_period=recording.sample_period).advance(u)
    lost = np.where(y[:, 6:] > 0.5, np.nan, 0.0)
    cadence = recording.cadence
    return replace(
        recording,
        gyro=y[:, :3] + lost[:, :3],
        accel=y[:, 3:6] + lost[:, 3:],
        period=cadence.period,
        longest=cadence.longest,
    )


def _block(layout: Layout) -> Block:
    """The part's inverse as a block; its state is the filter's memory."""
    sizes = (sum(layout.memory_sizes), len(layout.inputs), len(layout.parameters), 1)
    s, u, p, h = (ca.SX.sym(name, size) for name, size in zip("suph", sizes, strict=True))
    settings = prediction.settings_of(layout, p)
    memory = Memory.unpack(s, layout)
    level = quaternion.from_euler(ca.SX(0), ca.SX(0), ca.SX(0))
    sample = prediction.read(layout, memory, level, ca.SX.zeros(3), u, settings, h)
    motion = memory.mean_rate, memory.counted, memory.mean_force
    after = prediction.remembered(memory, sample, motion, h).pack()
    y = ca.vertcat(sample.rate, sample.force, sample.gyro_lost, sample.accel_lost)
    names = tuple(Variable(f"y[{i + 1}]") for i in range(y.numel()))
    start = prediction.empty(layout, settings).pack(), ca.SX.zeros(len(names))
    ends = (["s", "u", "p", "w", "h"], ["s_next", "y"])
    return Block(
        name="Compensated",
        description=f"the inverse of {layout.part.name}",
        step=plain_function("step", [s, u, p, ca.SX(0, 1), h], [after, y], *ends, {"cse": True}),
        initial=plain_function("initial", [u, p], [*start], ["u", "p"], ["s", "y"]),
        inputs=layout.inputs,
        parameters=layout.parameters,
        outputs=names,
        noise=(),
        sample_period=layout.part.sample_period,
    )
