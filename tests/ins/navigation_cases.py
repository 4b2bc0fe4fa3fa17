"""Drives and sensors that the tests of ``pyimu.ins`` share."""

from dataclasses import replace
from functools import cache

import numpy as np
from places import CHECKOUT

import pyimu
from pyimu.model.sensor import Sensor
from pyimu.rover.trajectory import Drive, motion, stop_times

PART = CHECKOUT / "examples" / "sparkfun6dof_assumed.toml"

SHORT = Drive(legs=2, stops=2.0, first_rest=5.0, vibration=0.3, tilt=(0.01, 0.006))
"""Two legs and two turns, 32 s."""


@cache
def assumed():
    return pyimu.part(PART)


@cache
def calibrated():
    """The part, whose errors but noise and turn-on bias are known to be none."""
    return replace(assumed(), tolerances=())


def perfect(drive, rate=100.0):
    """What sensors without errors measure along a drive."""
    truth = motion(drive, rate)
    return replace(truth, gyro=truth.ref_rate, accel=truth.ref_force)


def declared(recording, drive):
    """The recording with its rests marked, the truth's own."""
    still = np.zeros(len(recording.time))
    for start, stop in stop_times(drive):
        still[(recording.time > start - 1e-9) & (recording.time < stop)] = 1.0
    return replace(recording, stationary=still)


def noisy(recording, part, seed):
    """White noise of the part's size on a perfect recording, and nothing else."""
    rng = np.random.default_rng(seed)
    out = {}
    for kind in ("gyro", "accel"):
        std = part.sensor(kind).values["angle_random_walk"]["N"] / np.sqrt(recording.sample_period)
        samples = getattr(recording, kind)
        out[kind] = samples + std * rng.standard_normal(samples.shape)
    return replace(recording, **out)


def white(part):
    """The part with its white noise alone."""
    sensors = {}
    for kind in ("gyro", "accel"):
        values = part.sensor(kind).values
        own = {"angle_random_walk": dict(values["angle_random_walk"])}
        # a part that says nothing of its gyro's wander is given a nominal one
        sensors[kind] = Sensor(kind, own | {"rate_random_walk": {"K": np.full(3, 1e-9)}})
    return replace(part, tolerances=(), **sensors)


def square(track, place):
    """The square of the last position's error (3,) over its variance: of three normal numbers."""
    off, std = track.position[-1] - place, track.position_std[-1]
    spread = np.diag(std**2)
    spread[0, 1] = spread[1, 0] = track.correlation[-1] * std[0] * std[1]
    return float(off @ np.linalg.solve(spread, off))


def first_heading(own):
    """rad; of a walk's first step."""
    first = own.place[np.argmax(np.linalg.norm(own.place[:, :2], axis=1) > 0.5)]
    return float(np.arctan2(first[1], first[0]))
