"""A recording as the attitude filter's inputs: its columns on a regular grid, and what its own
samples say of the sensors.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.attitude.rest import Rest
from pyimu.attitude.variables import EXTRA_INPUTS, UNKNOWN_LATITUDE
from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS
from pyimu.recording.quality.clipping import clipping_level
from pyimu.recording.quality.resolution import quantization_step
from pyimu.recording.recording import Recording

NOMINAL_K = 2e-5
"""rad/s/sqrt(s); rate random walk that is taken for a sensor of which nothing is known, 4
deg/h/sqrt(s)."""

NOMINAL_RATE_NOISE = 4.5e-3
"""sqrt(s); rate noise that is taken for such a sensor: scale factors and axes off by a percent, for
turns of the order of 0.2 s. It was chosen by hand-held recordings
(``benchmarks/attitude_real.py``)."""

LEAST_STUCK = 0.5
"""s; a triad is not called stuck sooner, nor within ``STUCK_RUNS`` times the longest run of equal
samples of its rest."""

LEAST_STUCK_SAMPLES, STUCK_RUNS = 20, 5

COARSE = 1.7
"""Standard deviations of a sample at rest above which its steps are coarse: with the noise of half
a step it is 0.58 of a step, and where a sample with next to no noise changes between two values it
is half a step at most."""

LONGEST_GAP = 60.0
"""s; a gap has samples that are missing for so long, by when the attitude is lost; over the rest of
it only the bias still walks."""

HEADING_STD = 0.035
"""rad; of a recorded heading that comes without a standard deviation."""

CHUNK = 65_536
"""Samples that are run at a time, so that a long log takes no more memory than its results do."""


def nominal_part(recording: Recording, rest: Rest) -> Part:
    """A part that knows of its sensors only the white noise that they show at rest, and where they
    are clipped.
    """
    n_gyro, n_accel = (
        s * np.sqrt(recording.sample_period) for s in (rest.rate_std, rest.force_std)
    )
    gyro = Sensor(
        "gyro",
        {
            "angle_random_walk": {"N": n_gyro},
            "rate_random_walk": {"K": NOMINAL_K},
            **_clipped(recording.gyro),
        },
    )
    return Part(
        "nominal",
        1 / recording.sample_period,
        gyro,
        Sensor("accel", {"angle_random_walk": {"N": n_accel}, **_clipped(recording.accel)}),
    )


def number(name: str, value) -> float:
    """``value`` as a number. Raises UserError for what is none."""
    if isinstance(value, (int, float, np.number)) and np.isfinite(value):
        return float(value)
    raise UserError(f"{name} is {str(value)[:40]!r}, expected a finite number")


def latitude_of(recording: Recording, latitude: float | None) -> float:
    """``latitude`` [rad], else the recording's, else ``UNKNOWN_LATITUDE``. Raises UserError beyond
    pi/2.
    """
    column, whose = getattr(recording, "latitude", None), "latitude"
    if latitude is None:
        if column is None or not np.isfinite(column).any():
            return UNKNOWN_LATITUDE
        latitude, whose = (
            float(np.median(column[np.isfinite(column)])),
            f"{recording.name}: column latitude",
        )
    if not abs(number(whose, latitude)) <= np.pi / 2:
        raise UserError(f"{whose} is {latitude} rad, expected -pi/2 to pi/2")
    return float(latitude)


def temperature_of(recording: Recording, part: Part) -> np.ndarray | float:
    """The recorded temperature, else the one at which the part has no thermal bias."""
    if recording.temperature is not None:
        return recording.temperature
    return float(part.gyro.values.get("thermal_bias", {}).get("T0", 25.0))


class Columns:
    """The block's inputs (m, nu) on a regular grid of the recording's sample period: its rows
    filled, the sensors' missing elsewhere.
    """

    def __init__(self, recording: Recording, part: Part, names: list[str]) -> None:
        self.rows, gaps, self.left_out = _grid(recording)
        self.after_gap = 1 + gaps
        groups = {"gyro": recording.gyro, "accel": recording.accel}
        groups["temperature"] = np.broadcast_to(
            temperature_of(recording, part), len(recording.time)
        )
        groups |= {signal: extra_column(recording, part, signal) for signal in EXTRA_INPUTS}
        marks = {"stationary": getattr(recording, "stationary", None)}
        if getattr(recording, "heading", None) is not None:
            heading, std = recorded_heading(recording)
            valid = np.isfinite(heading) & np.isfinite(std)
            marks |= {
                "heading": np.where(valid, heading, 0),
                "heading_variance": np.where(valid, std**2, 0),
                "heading_valid": valid,
            }
        self.columns = [self._column(name, groups, marks) for name in names]

    @staticmethod
    def _column(name: str, groups: dict, marks: dict) -> tuple[np.ndarray | None, float]:
        """The recorded values (n,) of an input where there are any, and what stands between
        them.
        """
        group, _, axis = name.partition("[")
        if group not in groups:
            return marks.get(name), 0.0
        values = groups[group]
        return (values if values is None or not axis else values[:, int(axis[:-1]) - 1]), np.nan

    def pieces(self) -> Iterator[tuple[np.ndarray, slice, np.ndarray, float]]:
        """Inputs of the next samples, in an array that is used again; the recording's rows among
        them, and where they stand; the s of a gap that are left out before them.
        """
        u, start = np.empty((CHUNK, len(self.columns))), 0
        for first, size, left_out in self._cuts():
            stop = int(np.searchsorted(self.rows, first + size))
            rows, at = slice(start, stop), self.rows[start:stop] - first
            for i, (values, otherwise) in enumerate(self.columns):
                u[:, i] = otherwise
                if values is not None:
                    u[at, i] = values[rows]
            yield u[:size], rows, at, left_out
            start = stop

    def _cuts(self) -> Iterator[tuple[int, int, float]]:
        """First sample and size of each piece, and the s left out before it: pieces end where a
        long gap does.
        """
        long = np.flatnonzero(self.left_out)
        starts, before = (
            [0, *self.rows[self.after_gap[long]].tolist()],
            [0.0, *self.left_out[long].tolist()],
        )
        for start, end, left_out in zip(
            starts, [*starts[1:], int(self.rows[-1]) + 1], before, strict=True
        ):
            for first in range(start, end, CHUNK):
                yield first, min(CHUNK, end - first), left_out if first == start else 0.0


def extra_column(recording: Recording, part: Part, signal: str) -> np.ndarray | None:
    """A further input's column; a part whose effects depend on it cannot do without."""
    column = getattr(recording, signal, None)
    if column is None and signal in part.signals:
        raise UserError(
            f"{recording.name}: no column {signal} [{SIGNALS[signal].unit}], on which the errors "
            f"of {part.name} depend"
        )
    return column


def settings_of(recording: Recording, part: Part, rest: Rest) -> dict[str, float]:
    """Settings that the log's own samples give: when a run of equal ones means a stuck sensor."""
    longest, coarse = 0, False
    for sensor, values, std in (
        (part.gyro, recording.gyro, rest.rate_std),
        (part.accel, recording.accel, rest.force_std),
    ):
        if values is not None:
            same = np.concatenate(
                [[False], np.all(np.diff(values[rest.rows], axis=0) == 0, axis=1), [False]]
            )
            ends = np.flatnonzero(~same)
            longest = max(longest, int(np.diff(ends).max(initial=1)) - 1)
            coarse |= bool(np.all(_step(sensor, values) > COARSE * std))
    h, at_rest = recording.sample_period, rest.rows.stop - rest.rows.start
    if (
        coarse or longest > at_rest / 4
    ):  # Sensors without noise, or whose steps are coarser than it: equal samples say nothing.
        return {"stuck_time": 0.0}
    return {"stuck_time": max(LEAST_STUCK, LEAST_STUCK_SAMPLES * h, STUCK_RUNS * longest * h)}


def _step(sensor: Sensor, values: np.ndarray) -> np.ndarray:
    """The step (3,) between the values that an output can have: the sensor's, or that of its first
    samples; 0 where there is none.
    """
    found = [quantization_step(column) or 0.0 for column in values[:CHUNK].T]
    return np.maximum(found, sensor.values.get("quantization", {}).get("q", 0.0))


def _clipped(values: np.ndarray | None) -> dict[str, dict[str, np.ndarray]]:
    """The saturation of a triad whose samples (n, 3) show where it is clipped; nothing where they
    do not.
    """
    if values is None:
        return {}
    levels = [
        [abs(level) for level in clipping_level(column) if level is not None] for column in values.T
    ]
    limit = np.array([min(level) if level else 0.0 for level in levels])
    return {"saturation": {"limit": limit}} if limit.any() else {}


def recorded_heading(recording: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Heading and its standard deviation (n,) rad, NaN where there is none."""
    n = len(recording.time)
    if getattr(recording, "heading", None) is None:
        return np.full(n, np.nan), np.full(n, np.nan)
    std = getattr(recording, "heading_std", None)
    return recording.heading, np.full(n, HEADING_STD) if std is None else std


def _grid(recording: Recording) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sample number (n,) of each row on a regular grid; the rows before a gap; the s (gaps,) of
    each that exceed its missing samples.

    A gap becomes missing samples, over which the filter widens.
    """
    period = recording.sample_period
    steps = np.diff(recording.time) / period
    gaps = np.flatnonzero(steps > recording.cadence.longest / period)
    if not len(gaps):
        return np.arange(len(recording.time)), gaps, np.zeros(0)
    # Only a gap counts: jitter of the time stamps neither drops nor adds a sample.
    counts, whole = np.ones(len(steps), dtype=int), np.round(steps[gaps])
    counts[gaps] = np.minimum(whole, max(1, round(LONGEST_GAP / period)))
    return np.concatenate([[0], np.cumsum(counts)]), gaps, (whole - counts[gaps]) * period
