"""One run of a campaign: a drive with its own draws, through sensor, low-pass and filter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.block.block import Run
from pyimu.model.part import Part
from pyimu.rover.campaign.draws import Draws, draws_of
from pyimu.rover.campaign.faults import OF_RANGE, SATURATING, Fault, Samples, fail
from pyimu.rover.campaign.motion import Truth, truth
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.system import (
    STD0,
    System,
    coefficients,
    system_of,
    with_values,
)

INSTANTS = 32
"""Instants of a drive at which its normalised errors are taken, the last one its end."""


@dataclass(frozen=True)
class Drive:
    """A run as it was: its draws, truth, and what the filter took and gave.

    ``inputs`` (m, nu) and ``outputs`` (m, ny) are the filter's. ``instants`` (k,) are the samples
    after which ``states`` (k, ns) are its states, and ``bias`` (k, 3) rad/s what remains then of
    the true rate's measurement, white noise apart, where a nominal part's errors are undone.
    """

    settings: Settings
    draws: Draws
    truth: Truth
    part: Part
    specimen: Part
    inputs: np.ndarray
    outputs: np.ndarray
    instants: np.ndarray
    states: np.ndarray
    bias: np.ndarray
    names: tuple[str, ...]


def driven(settings: Settings, number: int) -> Drive:
    """The run of that ``number``."""
    system, draws = system_of(settings), draws_of(settings, number)
    true = truth(settings.drive, draws.terrain, settings.sensor_rate, settings.every)
    specimen = system.specimen(draws.specimen_seed)
    limit = _range(draws.fault, true)
    u = _sensor_inputs(true, draws)
    p = _with_range(system, coefficients(specimen), limit)
    y, _ = system.sensor.run(u, p=p, seed=draws.noise_seed)
    samples = Samples(y[:, :3], y[:, 3:], system.period, *_headings(settings, draws, true))
    instants = _instants(true)
    bias = _bias(system, u, p, draws.noise_seed, instants * settings.every)
    fail(draws.fault, samples)
    inputs = _filter_inputs(system, samples, u, true)
    outputs, states = _filtered(system, inputs, _start(true, draws), limit, instants)
    return Drive(
        settings,
        draws,
        true,
        system.part,
        specimen,
        inputs,
        outputs,
        instants,
        states,
        bias,
        tuple(v.name for v in system.filter.outputs),
    )


# What the sensors measure


def _sensor_inputs(true: Truth, draws: Draws) -> np.ndarray:
    time = np.arange(len(true.rate)) * true.period
    return np.column_stack([true.rate, true.force, draws.temperature(time)])


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


def _bias(
    system: System, u: np.ndarray, p: np.ndarray, seed: int, samples: np.ndarray
) -> np.ndarray:
    """The bias (k, 3) rad/s after so many ``samples`` (k,), to first order in the errors."""
    names = [v.name for v in system.sensor.parameters]
    white = {n: 0.0 for n in names if n.startswith("gyro_error.angle_random_walk.N")}
    measured, _ = system.sensor.run(u, p=with_values(system.sensor, p, white), seed=seed)
    nominal, _ = system.part.block.run(u)
    return (measured - nominal)[samples - 1, :3]


def _headings(settings: Settings, draws: Draws, true: Truth) -> tuple[np.ndarray, ...]:
    """Headings (m,) rad, whether they are valid (m,), and the time (m,) s."""
    time, heading, valid = true.time, np.zeros(len(true.q)), np.zeros(len(true.q))
    if settings.heading_every:
        count = int(time[-1] // settings.heading_every)
        due = np.searchsorted(time, settings.heading_every * np.arange(1, count + 1))
        noise = settings.heading_std * draws.normals("heading", len(due))
        heading[due], valid[due] = true.euler[due, 2] + noise, 1.0
    return heading, valid, time


# What the filter makes of it


def _filter_inputs(system: System, samples: Samples, u: np.ndarray, true: Truth) -> np.ndarray:
    """The inputs (m, nu) of the filter."""
    every, names = true.every, [v.name for v in system.filter.inputs]
    rows = slice(every - 1, len(true.q) * every, every)
    x = np.empty((len(true.q), len(names)))
    x[:] = system.filter.start_inputs
    x[:, :6] = system.passed(np.hstack([samples.gyro, samples.accel]))[rows]
    given = {
        "temperature": u[rows, 6],
        "heading": samples.heading,
        "heading_variance": np.where(samples.valid, system.settings.heading_std**2, 0.0),
        "heading_valid": samples.valid,
        "stationary": true.standing,
    }
    for name, values in given.items():
        x[:, names.index(name)] = values
    return x


def _start(true: Truth, draws: Draws) -> np.ndarray:
    """The attitude (4,) at which the filter starts: the true one with an error of its own."""
    error = Rotation.from_rotvec(draws.start_error * STD0[:3])
    return (Rotation.from_quat(true.q[0], scalar_first=True) * error).as_quat(scalar_first=True)


def _instants(true: Truth) -> np.ndarray:
    """Numbers (k,) of samples, evenly over the drive, the last one its end."""
    return np.linspace(true.first, len(true.q), INSTANTS + 1)[1:].astype(int)


def _filtered(
    system: System,
    inputs: np.ndarray,
    q0: np.ndarray,
    limit: np.ndarray | None,
    instants: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Outputs (m, ny), and the states (k, ns) after so many samples."""
    outputs = np.empty((len(inputs), len(system.filter.outputs)))
    steps = Run(system.filter, len(inputs), p=system.parameters(q0, limit))
    states = np.empty((len(instants), len(steps.state)))
    for i, (first, last) in enumerate(zip([0, *instants[:-1]], instants, strict=True)):
        steps.advance(inputs[first:last], y=outputs[first:last])
        states[i] = steps.state
    return outputs, states
