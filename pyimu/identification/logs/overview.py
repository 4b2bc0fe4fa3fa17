"""What a log holds, before anything is asked of it: length, rate, rests, excitation, faults."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from pyimu.display.brief import Brief
from pyimu.errors import Finding
from pyimu.files import plain
from pyimu.identification.fit.trial import Trial
from pyimu.recording.recording import Recording
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.rest import DRIFT, SECOND, still_rows
from pyimu.report.figures import envelope


@dataclass(frozen=True, repr=False)
class Strip(Brief):
    """A signal of a log for a picture: least and largest value (m,) at ``time`` (m,) s."""

    time: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True, repr=False)
class Overview(Brief):
    """One log: ``duration`` [s], ``rate`` of the samples [Hz], share of its rows at ``rest``.

    Of each axis (3,), as measured: root mean square and largest ``turning`` [rad/s], and rms
    ``force`` about its mean [m/s^2]; ``temperature`` least and largest [degC]. ``gaps`` and the
    seconds ``missing`` in them; ``clipped`` samples by column. ``speed`` (size of the rate) and
    ``warmth`` (temperature) are drawn, and ``held`` are the spans [s] that were held out.
    """

    duration: float
    rate: float
    rest: float
    turning: tuple[np.ndarray, np.ndarray] | None
    force: np.ndarray | None
    temperature: tuple[float, float] | None
    gaps: int
    missing: float
    clipped: dict[str, int]
    speed: Strip | None
    warmth: Strip | None
    held: tuple[tuple[float, float], ...] = ()

    def as_dict(self) -> dict[str, Any]:
        turning = self.turning and dict(zip(("rms", "largest"), self.turning, strict=True))
        return plain(
            {
                "duration": {"value": self.duration, "unit": "s"},
                "sample_rate": {"value": self.rate, "unit": "Hz"},
                "at_rest": self.rest,
                "rate": turning and turning | {"unit": "rad/s"},
                "specific_force": None
                if self.force is None
                else {"rms_about_mean": self.force, "unit": "m/s^2"},
                "temperature": self.temperature
                and {"least": self.temperature[0], "most": self.temperature[1], "unit": "degC"},
                "gaps": self.gaps,
                "missing": {"value": self.missing, "unit": "s"},
                "clipped": self.clipped,
            }
        )


def overview(r: Recording, held: Iterable[Trial], findings: Iterable[Finding]) -> Overview:
    """Of a recording, whose trials ``held`` were not fitted; ``findings`` are those of the log."""
    last = np.array([a for a, _ in r.segments[1:]], dtype=int)
    steps = r.time[last] - r.time[last - 1] - r.sample_period
    gyro, accel = _seen(r.gyro), _seen(r.accel)
    with np.errstate(invalid="ignore"):
        turning = None if gyro is None else (_rms(gyro), np.nanmax(np.abs(gyro), axis=0))
        force = None if accel is None else _rms(accel - np.nanmean(accel, axis=0))
    spans = {(float(t.time[0]), float(t.time[-1])) for t in held if len(t.time)}
    return Overview(
        duration=float(r.time[-1] - r.time[0]),
        rate=r.sample_rate,
        rest=_at_rest(r),
        turning=turning,
        force=force,
        temperature=_range(r.temperature),
        gaps=len(last),
        missing=float(steps.sum()),
        clipped=_clipped(findings),
        speed=None if gyro is None else _strip(r.time, np.linalg.norm(np.nan_to_num(gyro), axis=1)),
        warmth=None if _range(r.temperature) is None else _strip(r.time, r.temperature),
        held=tuple(sorted(spans)),
    )


def _at_rest(r: Recording) -> float:
    """Share of the rows in seconds at rest.

    As the log says, else steady seconds in which no reference turns.
    """
    if r.stationary is not None:
        return float(np.mean(r.stationary > 0.5))
    rate, rows = reference_rate(r).rate if r.gyro is not None else None, 0
    length = max(round(SECOND / r.sample_period), 1)
    for start, stop in still_rows(r):
        for a in range(start, stop, length):
            piece = None if rate is None else rate[a : min(a + length, stop)]
            if piece is None or not np.any(np.abs(_mean(piece)) > DRIFT["gyro"]):
                rows += min(a + length, stop) - a
    return rows / len(r)


def _mean(values: np.ndarray) -> np.ndarray:
    """Means of the columns, NaN of one without samples."""
    known = np.isfinite(values)
    count = known.sum(axis=0)
    return np.where(count, np.where(known, values, 0.0).sum(axis=0) / np.maximum(count, 1), np.nan)


def _seen(values: np.ndarray | None) -> np.ndarray | None:
    """The columns of a group where all have samples; an axis without stays NaN."""
    if values is None or not np.isfinite(values).any():
        return None
    empty = ~np.isfinite(values).any(axis=0)
    return np.where(empty, 0.0, values)


def _rms(values: np.ndarray) -> np.ndarray:
    return np.sqrt(np.nanmean(values**2, axis=0))


def _range(values: np.ndarray | None) -> tuple[float, float] | None:
    if values is None or not np.isfinite(values).any():
        return None
    return float(np.nanmin(values)), float(np.nanmax(values))


def _strip(time: np.ndarray, values: np.ndarray) -> Strip:
    known = np.isfinite(values)
    return Strip(*envelope(time[known], values[known]))


def _clipped(findings: Iterable[Finding]) -> dict[str, int]:
    counts: dict[str, int] = {}
    for f in findings:
        if f.kind == "clipping":
            counts[f.column] = counts.get(f.column, 0) + f.count
    return counts
