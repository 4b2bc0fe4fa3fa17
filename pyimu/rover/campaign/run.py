"""One run of a campaign: a drive with its own draws, through sensor, low-pass and filter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.block.block import Run
from pyimu.rover.campaign.draws import Draws, draws_of
from pyimu.rover.campaign.motion import Truth, truth
from pyimu.rover.campaign.sensing import Sensed, sensed
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.system import STD0, System, system_of

INSTANTS = 32
"""Instants of a drive at which its normalised errors are taken, the last one its end."""


@dataclass(frozen=True)
class Drive:
    """A run as it was: its draws, truth, and what the filter took and gave.

    ``inputs`` (m, nu) and ``outputs`` (m, ny) are the filter's. ``instants`` (k,) are the samples
    after which ``states`` (k, ns) are its states, and ``bias`` (k, 3) rad/s what is then left of
    the gyro's error.
    """

    system: System
    draws: Draws
    truth: Truth
    inputs: np.ndarray
    outputs: np.ndarray
    instants: np.ndarray
    states: np.ndarray
    bias: np.ndarray

    def output(self, name: str, size: int = 0) -> np.ndarray:
        """An output (m,) by its name, or the ``size`` of them from there on (m, size)."""
        first = [v.name for v in self.system.filter.outputs].index(name)
        return self.outputs[:, first : first + size] if size else self.outputs[:, first]


def driven(settings: Settings, number: int) -> Drive:
    """The run of that ``number``."""
    system, draws = system_of(settings), draws_of(settings, number)
    true = truth(settings.drive, draws.terrain, settings.sensor_rate, settings.every)
    instants = np.linspace(true.first, len(true.q), INSTANTS + 1)[1:].astype(int)
    measured = sensed(system, true, draws, instants)
    inputs = _inputs(system, measured, draws, true)
    p = system.parameters(_start(true, draws), measured.limit)
    outputs, states = _filtered(system, inputs, p, instants)
    return Drive(system, draws, true, inputs, outputs, instants, states, measured.bias)


def _inputs(system: System, measured: Sensed, draws: Draws, true: Truth) -> np.ndarray:
    """The inputs (m, nu) of the filter."""
    names = [v.name for v in system.filter.inputs]
    x = np.empty((len(true.q), len(names)))
    x[:] = system.filter.start_inputs
    x[:, :6] = measured.samples
    heading, valid = _headings(system.settings, draws, true)
    given = {
        "temperature": measured.temperature,
        "heading": heading,
        "heading_variance": np.where(valid, system.settings.heading_std**2, 0.0),
        "heading_valid": valid,
        "stationary": true.standing,
    }
    for name, values in given.items():
        x[:, names.index(name)] = values
    return x


def _headings(settings: Settings, draws: Draws, true: Truth) -> tuple[np.ndarray, np.ndarray]:
    """Headings (m,) rad, and whether they are valid (m,)."""
    heading, valid = np.zeros(len(true.q)), np.zeros(len(true.q))
    if settings.heading_every:
        time = true.time
        count = int(time[-1] // settings.heading_every)
        due = np.searchsorted(time, settings.heading_every * np.arange(1, count + 1))
        due = due[due < len(time)]
        noise = settings.heading_std * draws.normals("heading", len(due))
        heading[due], valid[due] = true.euler[due, 2] + noise, 1.0
        draws.fault.in_heading(heading, valid, time)
    return heading, valid


def _start(true: Truth, draws: Draws) -> np.ndarray:
    """The attitude (4,) at which the filter starts: the true one with an error of its own."""
    error = Rotation.from_rotvec(draws.start_error * STD0[:3])
    return (Rotation.from_quat(true.q[0], scalar_first=True) * error).as_quat(scalar_first=True)


def _filtered(
    system: System, inputs: np.ndarray, p: np.ndarray, instants: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Outputs (m, ny), and the states (k, ns) after so many samples."""
    outputs = np.empty((len(inputs), len(system.filter.outputs)))
    steps = Run(system.filter, len(inputs), p=p)
    states = np.empty((len(instants), len(steps.state)))
    for i, (first, last) in enumerate(zip([0, *instants[:-1]], instants, strict=True)):
        steps.advance(inputs[first:last], y=outputs[first:last])
        states[i] = steps.state
    return outputs, states
