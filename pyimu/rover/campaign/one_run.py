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
from pyimu.rover.campaign.sensing import Sensing, range_of
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.system import System, system_of

INSTANTS = 32
"""Instants of a drive at which its normalised errors are taken, the last one its end."""


PIECE = 512
"""Samples of the filter that are computed at a time, at most."""


@dataclass(frozen=True)
class Drive:
    """A run as it was: its draws, truth, specimen and fault, and what the filter made of it.

    ``errors`` (m, 3) rad of roll, pitch and yaw are the estimate less the truth, ``status`` (m,)
    what the filter said. ``instants`` (k,) are the samples after which ``states`` (k, ns) are its
    states, and ``bias`` (k, 3) rad/s what it should then have for it. Where they were asked for,
    ``inputs`` (m, nu) and ``outputs`` (m, ny) are the filter's, else (0, nu) and (0, ny).
    """

    system: System
    draws: Draws
    truth: Truth
    specimen: Part
    fault: Fault
    errors: np.ndarray
    status: np.ndarray
    instants: np.ndarray
    states: np.ndarray
    bias: np.ndarray
    inputs: np.ndarray
    outputs: np.ndarray

    def output(self, name: str, size: int = 0) -> np.ndarray:
        """An output (m,) by its name, or the ``size`` of them from there on (m, size)."""
        first = _place(self.system, name)
        return self.outputs[:, first : first + size] if size else self.outputs[:, first]


def driven(settings: Settings, number: int, keep: bool = False) -> Drive:
    """The run of that ``number``; with ``keep`` it has the filter's inputs and outputs."""
    system, draws = system_of(settings), draws_of(settings, number)
    place = (settings.drive, draws.terrain, settings.sensor_rate, settings.every, settings.on)
    true, specimen = truth(*place), system.specimen(draws.specimen_seed)
    fault = draws.fault(true.time[true.first], true.time[-1])
    instants = np.linspace(true.first, len(true.q), INSTANTS + 1)[1:].astype(int)
    sensing = Sensing(system, true, draws, specimen, fault)
    heading = _headings(settings, draws, true, fault)
    p = system.parameters(_start(system, true, draws), range_of(fault, true))
    steps = Run(system.filter, len(true.q), p=p)
    errors, status = np.empty((len(true.q), 3)), np.empty(len(true.q), dtype=np.int16)
    states, biases = [], []
    inputs = [np.empty((0, len(system.filter.inputs)))]
    outputs = [np.empty((0, len(system.filter.outputs)))]
    roll, flags = _place(system, "roll"), _place(system, "status")
    for kept in _pieces(len(true.q), instants):
        samples, temperature, bias = sensing.advance(kept)
        x = _inputs(system, samples, temperature, heading[:, kept], true.standing[kept])
        y = steps.advance(x)
        errors[kept] = (y[:, roll : roll + 3] - true.euler[kept] + np.pi) % (2 * np.pi) - np.pi
        status[kept] = y[:, flags]
        if kept.stop in instants:
            states.append(steps.state.copy())
            biases.append(bias)
        if keep:
            inputs.append(x)
            outputs.append(y)
    return Drive(
        system,
        draws,
        true,
        specimen,
        fault,
        errors,
        status,
        instants,
        np.array(states),
        np.array(biases) + _rotation(system, true, instants),
        np.concatenate(inputs),
        np.concatenate(outputs),
    )


def _place(system: System, name: str) -> int:
    """Where the filter has an output of that name."""
    return [v.name for v in system.filter.outputs].index(name)


def _pieces(samples: int, instants: np.ndarray) -> list[slice]:
    """The samples in pieces that end at the instants, and else where ``PIECE`` says."""
    ends = sorted({*range(PIECE, samples, PIECE), *instants.tolist()})
    return [slice(a, b) for a, b in zip([0, *ends[:-1]], ends, strict=True)]


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
    system: System,
    samples: np.ndarray,
    temperature: np.ndarray,
    heading: np.ndarray,
    standing: np.ndarray,
) -> np.ndarray:
    """The inputs (k, nu) of the filter; ``heading`` (2, k) are headings and their validity."""
    names = [v.name for v in system.filter.inputs]
    x = np.empty((len(samples), len(names)))
    x[:] = system.filter.start_inputs
    x[:, :6] = samples
    given = {
        "temperature": temperature,
        "heading": heading[0],
        "heading_variance": heading[1] * system.settings.heading_std**2,
        "heading_valid": heading[1],
        "stationary": standing,
    }
    for name, values in given.items():
        x[:, names.index(name)] = values
    return x


def _headings(settings: Settings, draws: Draws, true: Truth, fault: Fault) -> np.ndarray:
    """Headings (m,) rad, and below them whether they are valid (m,)."""
    heading, valid = np.zeros(len(true.q)), np.zeros(len(true.q))
    if settings.heading_every:
        time = true.time
        count = int(time[-1] // settings.heading_every)
        due = np.searchsorted(time, settings.heading_every * np.arange(1, count + 1))
        due = due[due < len(time)]
        noise = settings.heading_std * draws.normals("heading", len(due))
        heading[due], valid[due] = true.euler[due, 2] + noise, 1.0
        fault.in_heading(heading, valid, time)
    return np.vstack([heading, valid])


def _start(system: System, true: Truth, draws: Draws) -> np.ndarray:
    """The attitude (4,) at which the filter starts: the true one with an error of its own."""
    error = Rotation.from_rotvec(draws.start_error * system.start_std[:3])
    return (Rotation.from_quat(true.q[0], scalar_first=True) * error).as_quat(scalar_first=True)
