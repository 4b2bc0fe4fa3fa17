"""What a log tells of a sensor's surroundings: temperature and supply without their own sensors'
noise and steps, and the rates of the Earth and of the way over it.

A coefficient times the noise of a thermometer is a noise of the model that the sensor never had; it
meets the same noise in the thermal columns, and chance grows to an effect.
"""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np
from scipy.interpolate import CubicSpline

from pyimu.block.stepping import step_through
from pyimu.block.vectorised import over_rows
from pyimu.characterization.temperature.averages import Averages
from pyimu.characterization.temperature.thermometer import smoothed_by_order
from pyimu.model.signals import COLUMNS, SIGNALS
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.rate import Reference

INTERVAL = 1.0
"""s; means over so long are smoothed: surroundings change in seconds, not in samples."""

JUMP = 8.0
"""Standard deviations of the difference of readings beyond which one is no noise: in a log of a
million rows noise does so once in a billion."""

LEAST = 8
"""Intervals below which there is nothing to tell noise from change by."""


def without_noise(recording: Recording, values: np.ndarray) -> np.ndarray:
    """The slow signal behind ``values`` (n,), which have no gap, at the recording's rows.

    It is the expected value given all readings, of the interval means by their likeliest smoothing;
    between the middles of intervals it is a line where it wanders, and a cubic spline where its
    slope does (Wahba, J. R. Stat. Soc. B 40 (1978), 364-372). What is switched, as a supply is,
    stays a jump.
    """
    out, period = np.array(values), recording.sample_period
    for a, b in recording.segments:
        edges = [a, *(a + _jumps(values[a:b], max(1, round(INTERVAL / period)))).tolist(), b]
        for first, last in zip(edges[:-1], edges[1:], strict=True):
            piece = slice(first, last)
            out[piece] = _smoothed(recording.time[piece], values[piece], period)
    return out


def _jumps(values: np.ndarray, rows: int) -> np.ndarray:
    """The rows at which a signal jumps from one level to another that lasts for some ``rows``."""
    differences = np.abs(np.diff(values))
    moves = differences[differences > 0.0]
    if not len(moves):
        return np.zeros(0, dtype=int)
    # A step of the thermometer's own is no jump; half of the differences are within 0.67 sigma.
    noise = max(float(np.median(differences)) / 0.6745, float(moves.min()))
    found = np.flatnonzero(differences > JUMP * noise) + 1
    kept = (k for k in found if rows <= k <= len(values) - rows)
    lasts = (
        k
        for k in kept
        if abs(np.median(values[k : k + rows]) - np.median(values[k - rows : k]))
        > 0.5 * differences[k - 1]
    )
    return np.fromiter(lasts, dtype=int)


def _smoothed(time: np.ndarray, values: np.ndarray, period: float) -> np.ndarray:
    if not len(values) or np.ptp(values) == 0.0:
        return values
    interval = ((time - time[0] + 0.5 * period) / max(INTERVAL, period)).astype(int)
    present, number = np.unique(interval, return_inverse=True)
    if len(present) < LEAST:
        return values
    count = np.bincount(number).astype(float)
    middle, mean = (np.bincount(number, weights=v) / count for v in (time, values))
    averages = Averages(middle, mean, np.zeros((len(mean), 0)), count, period)
    level, order = smoothed_by_order(averages)
    return _between(middle, level, time) if order == 1 else CubicSpline(middle, level)(time)


def _between(middle: np.ndarray, level: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Lines between the levels, which go on at both ends."""
    left = np.clip(np.searchsorted(middle, time) - 1, 0, len(middle) - 2)
    slope = np.diff(level) / np.diff(middle)
    return level[left] + slope[left] * (time - middle[left])


PLACE = ("earth_rate", "transport_rate")
"""Signals that follow from where the body is, how it lies and how it moves over the Earth."""


def fill_place(
    u: np.ndarray, recording: Recording, reference: Reference, latitude: float | None
) -> frozenset[str]:
    """Fill the rates of the Earth and of the way over it in where attitude, latitude and velocity
    are in the log, and give the names of those that a reference does not hold already.

    A rate that was differentiated holds the Earth's where the latitude is known, and never the
    way's: an attitude is one against east, north and up.
    """
    found = set()
    for name in PLACE:
        values = [_of_place(recording, part, latitude) for part in SIGNALS[name].of]
        if any(v is None for v in values):
            continue
        u[:, COLUMNS[name]] = over_rows(_follows(name), np.hstack(values).T, np.zeros(0))
        if name != "earth_rate" or reference.kind == "rate" or not reference.earth_rate:
            found.add(name)
    return frozenset(found)


def _of_place(recording: Recording, signal: str, latitude: float | None) -> np.ndarray | None:
    """A signal (n, k) of the log with its gaps filled; None where nothing is known of it."""
    if signal == "latitude" and latitude is not None:
        return np.full((len(recording.time), 1), latitude)
    values = getattr(recording, SIGNALS[signal].group)
    if values is None:
        return None
    values = values.reshape(len(values), -1)
    known = np.isfinite(values).any(axis=0).all()
    return filled(recording.time, values) if known else None


@cache
def _follows(name: str) -> ca.Function:
    """A derived signal without memory as a function of one row of what it follows from."""
    parts = [ca.SX.sym(n, SIGNALS[n].size) for n in SIGNALS[name].of]
    value = SIGNALS[name].advance(ca.SX(0, 1), ca.SX(1), ca.SX(1), *parts)[0]
    return ca.Function(name, [ca.vertcat(*parts), ca.SX.sym("none", 0)], [ca.densify(value)])


def vibration_of(force: np.ndarray, recording: Recording) -> np.ndarray:
    """Mean square (n, 3) of the force's vibration, as a simulated part would see it."""
    now, memory, h = (
        ca.SX.sym("now", 3),
        ca.SX.sym("memory", SIGNALS["vibration"].memory),
        ca.SX.sym("h"),
    )
    started = ca.SX.sym("started")
    value, after = SIGNALS["vibration"].advance(memory, started, h, now)
    step = ca.Function(
        "vibration",
        [ca.vertcat(started, memory), now, ca.SX(0, 1), ca.SX(0, 1), h],
        [ca.vertcat(1, after), value],
    )
    out, none = np.zeros_like(force), np.zeros(0)
    for a, b in recording.segments:
        start = np.zeros(1 + SIGNALS["vibration"].memory)
        step_through(
            step,
            start,
            np.ascontiguousarray(force[a:b]),
            none,
            np.zeros((b - a, 0)),
            np.array([recording.sample_period]),
            out[a:b],
        )
    return out
