"""One run of a campaign: a drive with its own draws, through sensor, low-pass and filter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.block.block import Run
from pyimu.model.part import Part
from pyimu.plant.bodies import BODIES
from pyimu.rover.campaign.draws import Draws, draws_of
from pyimu.rover.campaign.faults import Fault
from pyimu.rover.campaign.motion import Truth, truth
from pyimu.rover.campaign.sensing import Sensed, range_of, sensed
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.system import System, system_of

INSTANTS = 32
"""Instants of a drive at which its normalised errors are taken, the last one its end."""


@dataclass(frozen=True)
class Drive:
    """A run as it was: its draws, truth, specimen and fault, and what the filter took and gave.

    ``inputs`` (m, nu) and ``outputs`` (m, ny) are the filter's. ``instants`` (k,) are the samples
    after which ``states`` (k, ns) are its states, and ``bias`` (k, 3) rad/s what the filter should
    then have for it.
    """

    system: System
    draws: Draws
    truth: Truth
    specimen: Part
    fault: Fault
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
    place = (settings.drive, draws.terrain, settings.sensor_rate, settings.every, settings.on)
    true, specimen = truth(*place), system.specimen(draws.specimen_seed)
    fault = draws.fault(true.time[true.first], true.time[-1])
    instants = np.linspace(true.first, len(true.q), INSTANTS + 1)[1:].astype(int)
    measured = sensed(system, true, draws, specimen, fault, instants)
    inputs = _inputs(system, measured, draws, true, fault)
    p = system.parameters(_start(system, true, draws), range_of(fault, true))
    outputs, states = _filtered(system, inputs, p, instants)
    bias = measured.bias + _rotation(system, true, instants)
    return Drive(system, draws, true, specimen, fault, inputs, outputs, instants, states, bias)


def _rotation(system: System, true: Truth, instants: np.ndarray) -> np.ndarray:
    """The ground's rate (k, 3) rad/s in body axes where the filter does not know of it.

    To a filter that takes the ground for at rest it is a part of the bias.
    """
    if system.knows_rotation:
        return np.zeros((len(instants), 3))
    north_up = np.array([0.0, np.cos(true.latitude), np.sin(true.latitude)])
    attitude = Rotation.from_quat(true.q[instants - 1], scalar_first=True)
    return attitude.inv().apply(BODIES[system.settings.on].rotation_rate * north_up)


def _inputs(
    system: System, measured: Sensed, draws: Draws, true: Truth, fault: Fault
) -> np.ndarray:
    """The inputs (m, nu) of the filter."""
    names = [v.name for v in system.filter.inputs]
    x = np.empty((len(true.q), len(names)))
    x[:] = system.filter.start_inputs
    x[:, :6] = measured.samples
    heading, valid = _headings(system.settings, draws, true, fault)
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


def _headings(
    settings: Settings, draws: Draws, true: Truth, fault: Fault
) -> tuple[np.ndarray, np.ndarray]:
    """Headings (m,) rad, and whether they are valid (m,)."""
    heading, valid = np.zeros(len(true.q)), np.zeros(len(true.q))
    if settings.heading_every:
        time = true.time
        count = int(time[-1] // settings.heading_every)
        due = np.searchsorted(time, settings.heading_every * np.arange(1, count + 1))
        due = due[due < len(time)]
        noise = settings.heading_std * draws.normals("heading", len(due))
        heading[due], valid[due] = true.euler[due, 2] + noise, 1.0
        fault.in_heading(heading, valid, time)
    return heading, valid


def _start(system: System, true: Truth, draws: Draws) -> np.ndarray:
    """The attitude (4,) at which the filter starts: the true one with an error of its own."""
    error = Rotation.from_rotvec(draws.start_error * system.start_std[:3])
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
