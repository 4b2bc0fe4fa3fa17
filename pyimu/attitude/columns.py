"""A recording as the attitude filter's inputs: its columns on a regular grid, and what its own samples say of the sensors."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.attitude.rest import Rest
from pyimu.attitude.variables import EXTRA_INPUTS, UNKNOWN_LATITUDE
from pyimu.errors import UserError
from pyimu.imu import Part
from pyimu.recording import Recording
from pyimu.sensor import Sensor
from pyimu.signals import SIGNALS

NOMINAL_K = 2e-5
"""rad/s/sqrt(s); rate random walk that is taken for a sensor of which nothing is known, 4 deg/h/sqrt(s)."""

NOMINAL_RATE_NOISE = 4.5e-3
"""sqrt(s); rate noise that is taken for such a sensor: scale factors and axes off by a percent, for turns of the order of 0.2 s.
It was chosen by hand-held recordings (``benchmarks/attitude_real.py``)."""

LEAST_STUCK = 0.5
"""s; a triad is not called stuck sooner, nor within ``STUCK_RUNS`` times the longest run of equal samples of its rest."""

LEAST_STUCK_SAMPLES, STUCK_RUNS = 20, 5

LONGEST_GAP = 60.0
"""s; a gap in the recording counts at most as that long, by when the attitude is lost anyway."""

HEADING_STD = 0.035
"""rad; of a recorded heading that comes without a standard deviation."""

CHUNK = 65_536
"""Samples that are run at a time, so that a long log takes no more memory than its results do."""


def nominal_part(recording: Recording, rest: Rest) -> Part:
    """A part that knows of its sensors only the white noise that they show at rest."""
    n_gyro, n_accel = (s * np.sqrt(recording.sample_period) for s in (rest.rate_std, rest.force_std))
    gyro = Sensor("gyro", {"angle_random_walk": {"N": n_gyro}, "rate_random_walk": {"K": NOMINAL_K}})
    return Part("nominal", 1 / recording.sample_period, gyro, Sensor("accel", {"angle_random_walk": {"N": n_accel}}))


def latitude_of(recording: Recording, latitude: float | None) -> float:
    """``latitude`` [rad], else the recording's, else ``UNKNOWN_LATITUDE``.  Raises UserError beyond pi/2."""
    if latitude is None:
        column = getattr(recording, "latitude", None)
        known = column is not None and np.isfinite(column).any()
        return float(np.nanmedian(column)) if known else UNKNOWN_LATITUDE
    if not abs(latitude) <= np.pi / 2:
        raise UserError(f"latitude is {latitude} rad, expected -pi/2 to pi/2")
    return float(latitude)


def temperature_of(recording: Recording, part: Part) -> np.ndarray | float:
    """The recorded temperature, else the one at which the part has no thermal bias."""
    if recording.temperature is not None:
        return recording.temperature
    return float(part.gyro.values.get("thermal_bias", {}).get("T0", 25.0))


class Columns:
    """The block's inputs (m, nu) on a regular grid of the recording's sample period: its rows filled, the sensors' missing elsewhere."""

    def __init__(self, recording: Recording, part: Part, names: list[str]) -> None:
        self.rows = _grid(recording)
        groups = {"gyro": recording.gyro, "accel": recording.accel}
        groups["temperature"] = np.broadcast_to(temperature_of(recording, part), len(recording.time))
        groups |= {signal: extra_column(recording, part, signal) for signal in EXTRA_INPUTS}
        marks = {"stationary": getattr(recording, "stationary", None)}
        if getattr(recording, "heading", None) is not None:
            heading, std = recorded_heading(recording)
            valid = np.isfinite(heading) & np.isfinite(std)
            marks |= {"heading": np.where(valid, heading, 0), "heading_variance": np.where(valid, std ** 2, 0), "heading_valid": valid}
        self.columns = [self._column(name, groups, marks) for name in names]

    @staticmethod
    def _column(name: str, groups: dict, marks: dict) -> tuple[np.ndarray | None, float]:
        """The recorded values (n,) of an input where there are any, and what stands between them."""
        group, _, axis = name.partition("[")
        if group not in groups:
            return marks.get(name), 0.0
        values = groups[group]
        return (values if values is None or not axis else values[:, int(axis[:-1]) - 1]), np.nan

    def pieces(self) -> Iterator[tuple[np.ndarray, slice, np.ndarray]]:
        """Inputs of the next samples, in an array that is used again; the recording's rows among them, and where they stand."""
        u, start, end = np.empty((CHUNK, len(self.columns))), 0, self.rows[-1] + 1
        for first in range(0, end, CHUNK):
            size = min(CHUNK, end - first)
            stop = int(np.searchsorted(self.rows, first + size))
            rows, at = slice(start, stop), self.rows[start:stop] - first
            for i, (values, otherwise) in enumerate(self.columns):
                u[:, i] = otherwise
                if values is not None:
                    u[at, i] = values[rows]
            yield u[:size], rows, at
            start = stop


def extra_column(recording: Recording, part: Part, signal: str) -> np.ndarray | None:
    """A further input's column; a part whose effects depend on it cannot do without."""
    column = getattr(recording, signal, None)
    if column is None and signal in part.signals:
        raise UserError(f"{recording.name}: no column {signal} [{SIGNALS[signal].unit}], on which the errors of {part.name} depend")
    return column


def settings_of(recording: Recording, rest: Rest) -> dict[str, float]:
    """Settings that the log's own samples give: when a run of equal ones means a stuck sensor."""
    longest = 0
    for values in (recording.gyro, recording.accel):
        if values is not None:
            same = np.concatenate([[False], np.all(np.diff(values[rest.rows], axis=0) == 0, axis=1), [False]])
            ends = np.flatnonzero(~same)
            longest = max(longest, int(np.diff(ends).max(initial=1)) - 1)
    h, at_rest = recording.sample_period, rest.rows.stop - rest.rows.start
    if longest > at_rest / 4:  # Sensors without noise, or whose steps are coarser than it: equal samples say nothing.
        return {"stuck_time": 0.0}
    return {"stuck_time": max(LEAST_STUCK, LEAST_STUCK_SAMPLES * h, STUCK_RUNS * longest * h)}


def recorded_heading(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Heading and its standard deviation (n,) rad, NaN where there is none."""
    n = len(recording.time)
    if getattr(recording, "heading", None) is None:
        return np.full(n, np.nan), np.full(n, np.nan)
    std = getattr(recording, "heading_std", None)
    return recording.heading, np.full(n, HEADING_STD) if std is None else std


def _grid(recording: Recording) -> np.ndarray:
    """Sample number (n,) of each row on a regular grid: a gap becomes missing samples, over which the filter widens."""
    steps = np.diff(recording.time) / recording.sample_period
    if not (steps > 1.5).any():
        return np.arange(len(recording.time))
    longest = max(1, round(LONGEST_GAP / recording.sample_period))
    # Only a gap counts: jitter of the time stamps neither drops nor adds a sample.
    counts = np.where(steps > 1.5, np.minimum(np.round(steps), longest), 1).astype(int)
    return np.concatenate([[0], np.cumsum(counts)])
