"""Whether a sensor is at rest.

At rest its mean does not change from one second to the next by more than noise makes it, nor does
it ever go far.

This is the package's one answer to that question, for whole logs and for the seconds of one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.clock import runs
from pyimu.recording.recording import Recording

SECOND = 1.0
"""Length [s] over which means are taken."""

LENGTHS = (SECOND, 10.0)
"""Lengths [s] over which motion is looked for."""

DRIFT = {"gyro": 2e-3, "accel": 0.03}
"""Largest change of a mean in a second that is no noise and that a sensor at rest may show [rad/s
and m/s^2]: flicker, and temperature."""

SIGMAS = 5.0
"""Standard deviations by which noise may change a mean beside ``DRIFT``."""

FARTHEST = {"gyro": 0.05, "accel": 0.5}
"""Largest distance [rad/s and m/s^2] of a second's mean from the median of all: that of a consumer
part's bias over some tens of kelvin (LSM6DSO, BMI270: 0.02 to 0.03 deg/s/K, 0.3 mg/K)."""

LARGEST_RATE = 0.1
"""rad/s; a larger mean rate is no bias: data sheets of consumer gyros allow up to 5 deg/s."""

VIBRATION = {"gyro": 0.02, "accel": 0.2}
"""Standard deviation [rad/s and m/s^2] within a second from which on it is not still, if it is no
noise either."""

FEW, BLOCK = 5, 16
"""Samples in a second up to which their differences tell hardly any noise, and the quietest seconds
far too little of it; of so slow a log those of so many samples in a row do."""

SCATTER = {"gyro": 5e-3, "accel": 0.1}
"""rad/s and m/s^2; the noise of a sample, at most, that is believed there (0.3 deg/s and 10 mg: no
filter stands before it): what moves all the time scatters more."""

RARE = 0.005
"""Share of the seconds with larger changes up to which these are shocks, and not motion."""

ONE_SHOCK = 2
"""Changes that a single shock makes, there and back."""

PHASES = 10
"""Parts of a second at which the seconds of a rest may begin: a rest of a few is not to be cut to
whole ones of the log's."""

PIECE = 1 << 20
"""Samples that are looked at together, at most: a column may be longer than memory."""


@dataclass(frozen=True)
class Seconds:
    """The seconds of one column, (k,).

    ``mean``, ``std`` and ``first`` are the mean, standard deviation and first sample of each;
    ``joined`` says whether it follows the one before without gap; ``white`` is the standard
    deviation of a sample's noise.
    """

    mean: np.ndarray
    std: np.ndarray
    first: np.ndarray
    joined: np.ndarray
    length: int
    white: float

    @property
    def change(self) -> np.ndarray:
        """Change (k,) of the mean from the second before, zero where there is none."""
        return np.where(self.joined, np.diff(self.mean, prepend=self.mean[:1]), 0.0)

    def moving(self, kind: str) -> np.ndarray:
        """Mask (k,) of the seconds in which a gyro or an accelerometer moves, or has just moved."""
        white = min(self.white, SCATTER[kind]) if self.length <= FEW else self.white
        noise = SIGMAS * np.sqrt(2.0 / self.length) * white
        return np.abs(self.change) > DRIFT[kind] + noise

    def far(self, kind: str) -> np.ndarray:
        """Mask (k,) of the seconds that are too far from the others for a sensor at rest."""
        middle = np.median(self.mean) if len(self.mean) else 0.0
        return np.abs(self.mean - middle) > FARTHEST[kind]

    def vibrating(self, kind: str) -> np.ndarray:
        """Mask (k,) of the seconds in which it vibrates."""
        return self.std > max(VIBRATION[kind], 3 * self.white)


def seconds_of(
    column: np.ndarray, segments: Sequence[tuple[int, int]], period: float, seconds: float = SECOND
) -> Seconds:
    """The seconds of a column (n,) with sample period ``period`` [s], segment by segment.

    ``seconds`` sets another length [s]. What remains at the end of a segment is left out, and so
    are seconds without a sample.
    """
    length = max(round(seconds / period), 1)
    parts = [
        _summary(column, a, min((stop - a) // length, PIECE // length or 1), length, a > start)
        for start, stop in segments
        for a in range(start, stop - length + 1, max(PIECE // length, 1) * length)
    ]
    none = tuple(np.empty(0) for _ in range(3)) + (np.empty(0, dtype=int), np.empty(0, dtype=bool))
    mean, std, curvature, first, joined = map(np.concatenate, zip(none, *parts, strict=True))
    if length <= FEW:
        curvature = _in_a_row(column, segments)
    quiet = np.sort(curvature)[: max(1, len(curvature) // 4)]
    # Third differences of white noise have 20 times its variance, and next to nothing of a motion
    # below a tenth of the sample rate.
    white = float(np.sqrt(np.mean(quiet) / 20)) if len(quiet) else 0.0
    return Seconds(mean, std, first, joined, length, white)


def _summary(
    column: np.ndarray, start: int, count: int, length: int, follows: bool
) -> tuple[np.ndarray, ...]:
    """Statistics of each of ``count`` seconds.

    Mean, standard deviation, mean square of the third differences, first sample, and whether it
    follows another without gap.
    """
    values = np.asarray(column[start : start + count * length]).reshape(count, length)
    known = np.isfinite(values)
    seen = known.any(axis=1)
    size = np.maximum(known.sum(axis=1), 1)
    mean = np.where(known, values, 0.0).sum(axis=1) / size
    square = np.where(known, (values - mean[:, None]) ** 2, 0.0).sum(axis=1) / size
    third = np.diff(values, n=3, axis=1) ** 2 if length > 3 else np.empty((count, 0))
    usable = np.isfinite(third)
    curvature = np.where(usable, third, 0.0).sum(axis=1) / np.maximum(usable.sum(axis=1), 1)
    joined = np.concatenate([[follows], seen[:-1]])
    first = start + length * np.arange(count)
    return tuple(v[seen] for v in (mean, np.sqrt(square), curvature, first, joined))


def _in_a_row(column: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    """Mean squares (b,) of the third differences of ``BLOCK`` samples, segment by segment."""
    means = [np.zeros(0)]
    for start, stop in segments:
        third = np.diff(np.asarray(column[start:stop], dtype=float), n=3) ** 2
        blocks = third[: len(third) // BLOCK * BLOCK].reshape(-1, BLOCK).mean(axis=1)
        means.append(blocks[np.isfinite(blocks)])
    return np.concatenate(means)


def motion_of(
    kind: str, column: np.ndarray, segments: Sequence[tuple[int, int]], period: float
) -> Finding | None:
    """A finding ``motion`` where a gyro or accelerometer column moves in more than a few seconds.

    It has their number, the ``largest`` change, and the first row of the first of them.

    Looked at second by second, and for what is slower and lost in noise over ten seconds.
    """
    for length in LENGTHS:
        seconds = seconds_of(column, segments, period, length)
        moving = seconds.moving(kind) | seconds.far(kind)
        if np.count_nonzero(moving) > max(RARE * len(moving), ONE_SHOCK):
            detail = {
                "largest": float(np.abs(seconds.change).max()),
                "first_row": int(seconds.first[np.argmax(moving)]),
            }
            return Finding("motion", kind, round(length * np.count_nonzero(moving)), detail)
    return None


def is_at_rest(recording: Recording) -> bool:
    """Whether a log is one of a sensor at rest.

    It is where it says so (``stationary``), and is not where it has a reference of motion or says
    that it moves (``moving``); else its samples tell.
    """
    if recording.stationary is not None and np.all(recording.stationary > 0.5):
        return True
    return not (_says_motion(recording) or motion_in(recording))


def motion_in(recording: Recording) -> list[Finding]:
    """A finding ``motion`` for each measured column that moves."""
    found = []
    for kind in ("gyro", "accel"):
        values = getattr(recording, kind)
        for axis, column in zip("xyz", () if values is None else values.T, strict=False):
            one = motion_of(kind, column, recording.segments, recording.sample_period)
            if one is not None:
                found.append(Finding("motion", f"{kind}_{axis}", one.count, one.detail))
    return found


REFERENCES = ("ref_rate", "ref_q", "ref_heading", "ref_force", "ref_north", "ref_east")
"""Groups that a log of a sensor at rest has no need of."""


def _says_motion(recording: Recording) -> bool:
    groups = (*REFERENCES, "ref_velocity", "reference")
    given = any(getattr(recording, group) is not None for group in groups)
    moving = recording.moving is not None and bool(np.any(recording.moving > 0))
    return given or moving


def still_rows(recording: Recording, seconds: float = SECOND) -> list[tuple[int, int]]:
    """Segments of rows, as long as possible, in which no measured column moves or vibrates.

    They are made of whole intervals of ``seconds`` [s].

    A second at whose end the motion begins is not among them.
    """
    still, length = None, 1
    for kind in ("gyro", "accel"):
        values = getattr(recording, kind)
        for column in () if values is None else values.T:
            if not np.isfinite(column).any():
                continue
            one = seconds_of(column, recording.segments, recording.sample_period, seconds)
            moving = one.moving(kind) | one.vibrating(kind)
            if kind == "gyro":
                moving |= np.abs(one.mean) > LARGEST_RATE
            # The change is known at the later of two seconds: it may lie in either.
            begins = np.append(
                moving[1:] & one.joined[1:], np.zeros(min(len(moving), 1), dtype=bool)
            )
            rows = set(one.first[~(moving | begins)].tolist())
            still, length = rows if still is None else still & rows, one.length
    return _joined(sorted(still or ()), length)


def rests(recording: Recording) -> list[tuple[int, int]]:
    """Segments of rows at rest: as the column ``stationary`` says, else as the samples tell, whose
    still seconds may begin at any tenth of one.
    """
    if recording.stationary is None:
        return _at_any_phase(recording)
    marked = recording.stationary > 0.5
    return [(a + i, a + j) for a, b in recording.segments for i, j in runs(marked[a:b])]


def _at_any_phase(recording: Recording) -> list[tuple[int, int]]:
    if len(recording) < 2:
        return []
    still, step = np.zeros(len(recording), dtype=bool), SECOND / recording.sample_period / PHASES
    for start in sorted({round(k * step) for k in range(PHASES)}):
        for a, b in still_rows(recording.slice(start)) if start + 2 < len(recording) else ():
            still[start + a : start + b] = True
    return [(a + i, a + j) for a, b in recording.segments for i, j in runs(still[a:b])]


def _joined(first: list[int], length: int) -> list[tuple[int, int]]:
    """Segments made of seconds that follow each other."""
    found: list[tuple[int, int]] = []
    for row in first:
        if found and found[-1][1] == row:
            found[-1] = (found[-1][0], row + length)
        else:
            found.append((row, row + length))
    return found
