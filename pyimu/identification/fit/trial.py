"""One log as one sensor's regression sees it.

What was measured, what the reference says went in, which rows count.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cached_property

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.band import Band
from pyimu.identification.fit.clock import Clock
from pyimu.identification.fit.place import SCALED, Place
from pyimu.identification.fit.reduction import Reduction, Rows
from pyimu.identification.fit.surroundings import fill_place, vibration_of, without_noise
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, SIGNALS, START, SURROUNDINGS
from pyimu.recording.clock import runs
from pyimu.recording.coarse import came_in_bursts
from pyimu.recording.complete import completed
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.quality.healing import healed, short_runs
from pyimu.recording.quality.resolution import last_digit, least_relevant
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.filled import FILLED, filled_in, resolution
from pyimu.recording.reference.force import ORDER, reference_force
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.stamps import at_times, evenly_sampled
from pyimu.recording.reference.unfiltered_places import LATE, SIDEWAYS
from pyimu.recording.reference.unlagged import ADAPTS, LAG
from pyimu.recording.reference.unsmoothed import SMOOTHED

SETTLE = 32
"""Rows at the start of a segment that are not counted: nobody knows what a lag or delay remembers
from before it."""

HELD_OUT = 0.3
"""Share of each log, mostly its end, that is held out where no log is named for it."""

ASKED, LEAST_FITTED, LEAST_HELD, TRIED = 0.01, 0.2, 0.1, 21
"""Of an axis, its power over that of the strongest from which on it must be fitted; the share of
its power that the fitted rows must have; the mean share that the others have at least; and how many
places for these are tried."""

ROUNDED = 1e-18
"""Power over that of what stays the same, below which nothing but rounding changes."""

HEAD = 30.0
"""Seconds of motion at the start of a held-out log from which what belongs to the log is
estimated."""

MOVING = 0.2
"""Share of the reference's root mean square above which a row counts as moving: at rest it shows no
mounting and no clock, but its own noise."""


OWN_LAG = frozenset({"time_offset", LAG, ADAPTS})
"""Findings of a reference whose clock somebody has set by hand, or which lagged: what is late
beside it is what they left."""


MEASURED = ("rate", "force")
"""References that were measured themselves, and not differentiated."""

NO_DIGITS = (0.0, 0.0, 0.0)

DIGITS = "reference_digits"
"""The finding of a reference whose numbers are rounded."""


def leaves_a_lag(finding: Finding) -> bool:
    """Whether a finding says where a lag is from that is none of the sensor's: what was done to the
    reference, or samples that waited to be read.
    """
    return finding.kind in OWN_LAG or came_in_bursts(finding)


class Doubt(IntEnum):
    """Whether a reference has noise that is not white: ``NONE`` where that is known, ``OPEN`` where
    an effect may have left what looks like it, ``LIKELY`` where the sensor's own signal has little
    of it, and it is there in quiet as in motion.
    """

    NONE, OPEN, LIKELY = range(3)


@dataclass(frozen=True)
class Trial:
    """Rows of one log for one sensor.

    ``y`` (n, 3) measured, ``u`` (n, N_INPUT) reference inputs (at their start values where nobody
    knows them), ``known`` the signals that are really known, ``axes`` those that the reference
    covers, ``segments`` the ranges without gap. ``reference`` is "rate", "attitude", "heading",
    "course", "force", "position", "velocity", "gravity" or "static"; ``free_rotation`` says that
    the reference's mounting is not known, ``place`` what is not known of where its force acts.
    ``parent`` names the fitted trial that has the same power-on, if any, and
    ``earlier`` (m, N_INPUT) are the inputs of the log before the first row, if any; ``left_out``
    (n,) marks samples that are missing or carry no information (spikes, repeats, at a limit),
    heeded where no band mixes them with their neighbours. ``band_hz`` is the band of a derived
    reference, at most ``band_limit``; ``clock`` what was taken out of the reference's clock; ``up``
    (3,) the direction upward in the sensor's axes where the reference knows only the turn about it;
    ``digits`` (3,) the steps to which the numbers of a measured reference were rounded, 0 where
    none is seen; ``noise`` (n, 3) a draw of the reference's noise, where it has any to speak of,
    and ``noise_error`` (3,) the standard error of its power over that power, ``doubt`` whether it
    may have noise that was not drawn. ``reduction`` is how samples become rows where these are
    whole stretches of the log. ``samples`` (m, 3) are those of the reference at times of its own,
    where it was measured itself. ``healed`` (n, 3) is what was taken off samples that look like
    spikes, where there are any; ``limited`` (n, 3) marks those that lie where the output stops and
    that a band would spread. ``reference_apart`` says that another clock gave the reference its
    times.
    """

    name: str
    kind: str
    h: float
    time: np.ndarray
    y: np.ndarray
    u: np.ndarray
    segments: list[tuple[int, int]]
    known: frozenset[str]
    reference: str
    band_hz: float | None = None
    axes: tuple[int, ...] = (0, 1, 2)
    free_rotation: bool = False
    parent: str | None = None
    earlier: np.ndarray | None = None
    left_out: np.ndarray | None = None
    findings: tuple[Finding, ...] = ()
    band_limit: float | None = None
    clock: Clock | None = None
    digits: tuple[float, ...] = NO_DIGITS
    noise: np.ndarray | None = None
    noise_error: tuple[float, ...] = (0.0, 0.0, 0.0)
    doubt: Doubt = Doubt.NONE
    up: np.ndarray | None = None
    reduction: Reduction | None = None
    place: Place | None = None
    samples: np.ndarray | None = None
    healed: np.ndarray | None = None
    limited: np.ndarray | None = None
    reference_apart: bool = False

    @cached_property
    def band(self) -> Band:
        return Band() if self.band_hz is None else Band.below(self.band_hz, 1.0 / self.h)

    @cached_property
    def row_segments(self) -> list[tuple[int, int]]:
        """Ranges of rows that regression draws on.

        The segments once settled, less what is left out.
        """
        settled = [
            (a + (0 if self.reference == "static" else min(SETTLE, (b - a) // 4)), b)
            for a, b in self.segments
        ]
        if self.left_out is None or self.band_hz is not None:
            return settled
        return [(a + i, a + j) for a, b in settled for i, j in runs(~self.left_out[a:b])]

    @cached_property
    def row_time(self) -> np.ndarray:
        """Times (m,) s of the rows that its band gives."""
        return self.time[self.band.centres(self.row_segments)]

    @cached_property
    def moved(self) -> dict[int, Trial]:
        """The trial with its reference moved by its noise up (1) and down (-1), as
        ``errors_in_variables`` puts it here once it is asked for.
        """
        return {}

    @property
    def derivatives(self) -> int:
        """How often what the reference is from was differentiated, at least once."""
        return ORDER.get(self.reference, 1)

    @property
    def differs(self) -> bool:
        """Whether its reference was differentiated once."""
        measured = self.band_hz is None or self.reference in MEASURED
        return not measured and self.derivatives == 1

    @property
    def any_turn(self) -> bool:
        """Whether a turn of the whole triad is not the sensor's to answer for."""
        return self.free_rotation or (self.reduction is not None and self.reduction.any_turn)

    def precedes(self, held: Trial) -> bool:
        """Whether its rows all come before those that are ``held`` out of the same log, or none are
        held out at once.
        """
        if held.reduction is not None or not len(held.time):
            return True
        last = self.segments[-1][1] - 1 if self.segments else len(self.time) - 1
        return bool(held.time[0] > self.time[last])

    @property
    def count(self) -> int:
        if self.reduction is not None:
            return self.reduction.samples
        return sum(b - a for a, b in self.row_segments)

    def rows(self, sensor: Sensor, bias: np.ndarray) -> Rows:
        """What the stretches that are this trial's rows say under a model and a ``bias`` (3,)."""
        return self.reduction.rows(sensor, self.y - bias, self.u, self.segments, self.h)

    def part(self, start: int, stop: int, **changes) -> Trial:
        """Rows start to stop as a trial of their own."""
        inside = [
            (max(a, start) - start, min(b, stop) - start)
            for a, b in self.segments
            if b > start and a < stop
        ]
        flags = None if self.left_out is None else self.left_out[start:stop]
        earlier = self.u[:start]
        if self.earlier is not None:
            earlier = np.concatenate([self.earlier, earlier])
        return replace(
            self,
            time=self.time[start:stop],
            y=self.y[start:stop],
            u=self.u[start:stop],
            segments=inside,
            left_out=flags,
            healed=None if self.healed is None else self.healed[start:stop],
            limited=None if self.limited is None else self.limited[start:stop],
            earlier=earlier if len(earlier) else None,
            noise=None if self.noise is None else self.noise[start:stop],
            place=None if self.place is None else self.place.part(start, stop),
            **changes,
        )

    def split(self, held_out: float) -> tuple[Trial, Trial]:
        """The rows to fit, and the ``held_out`` of those that a reference covers to judge by: the
        last of them, or where these have nearly all that turns or pushes an axis, as where one axis
        is turned after another, others that leave each of them more.

        Of rows that are not samples none is held out: each is judged by a fit to the others.
        """
        if self.reduction is not None:
            return self, replace(self, parent=self.name)
        rows = np.concatenate([np.arange(a, b) for a, b in self.segments] or [np.arange(0)])
        if len(rows) < 2:
            return self, self.part(len(self.time), len(self.time), parent=self.name)
        count = len(rows) - round(len(rows) * (1.0 - held_out))
        first = self._held_from(rows, count)
        start = int(rows[first]) if first < len(rows) else len(self.time)
        if first + count >= len(rows):
            return self.part(0, start), self.part(start, len(self.time), parent=self.name)
        stop = int(rows[first + count])
        around = [(a, min(b, start)) for a, b in self.segments if a < start]
        around += [(max(a, stop), b) for a, b in self.segments if b > stop]
        return replace(self, segments=around), self.part(start, stop, parent=self.name)

    def _held_from(self, rows: np.ndarray, count: int) -> int:
        """The first of ``count`` of the ``rows`` (m,) to hold out."""
        last = len(rows) - count
        if self.place is not None or self.reference == "static" or not 0 < count < len(rows):
            return last
        x = self.u[:, OWN[self.kind]][rows][:, list(self.axes)]
        sums = np.vstack([np.zeros(x.shape[1]), np.cumsum((x - x.mean(axis=0)) ** 2, axis=0)])
        rounding = ROUNDED * np.sum(x**2)
        sums = sums[:, sums[-1] > max(ASKED * float(sums[-1].max()), rounding)]
        if not sums.size:
            return last
        starts = np.unique(np.linspace(0, last, TRIED).astype(int))
        held = (sums[starts + count] - sums[starts]) / sums[-1]
        fitted = 1.0 - held.max(axis=1)
        if fitted[-1] >= LEAST_FITTED:
            return last
        fitted[held.mean(axis=1) < LEAST_HELD] = 0.0
        best = int(np.argmax(fitted))
        return int(starts[best]) if fitted[best] >= LEAST_FITTED else last

    def head(self) -> tuple[Trial, Trial]:
        """The rows with the first ``HEAD`` seconds of motion, at most half, and the rest."""
        moved = np.cumsum(self._moves()) * self.h
        at = int(np.searchsorted(moved, HEAD)) + 1
        at = min(at, len(self.time) // 2)
        return self.part(0, at), self.part(at, len(self.time))

    def _moves(self) -> np.ndarray:
        """The rows (n,) that move; all of them where nothing but rest is to be seen."""
        x = self.u[:, OWN[self.kind]]
        inside = marked(self.segments, len(x))
        if not self.free_rotation or not inside.any():
            return np.ones(len(x), dtype=bool)
        # A force is gravity mostly, also at rest: what is differentiated has an attitude beside it.
        speed = np.linalg.norm(x if self.place is None else self.u[:, OWN["gyro"]], axis=1)
        return inside & (speed >= MOVING * np.sqrt(np.mean(speed[inside] ** 2)))


def gyro_trial(recording: Recording, latitude: float | None = None) -> Trial | None:
    """The gyro of a recording against its reference rate; None where the log has no gyro."""
    if recording.gyro is None:
        return None
    recording = completed(recording)
    bad = bad_samples(recording.gyro, recording.segments)
    sound = healed(recording.time, recording.gyro, bad, most=1)
    reference = reference_rate(replace(recording, gyro=sound), latitude=latitude)
    if reference.kind == "none":
        return None
    if reference.time is not None:
        recording = at_times(recording, reference.time)
    axes = tuple(i for i in _live(recording.gyro) if np.isfinite(reference.rate[:, i]).any())
    # A second unit's force is on that unit's clock, and in its axes.
    u, known = environment(recording, measured=recording.reference is not None)
    u[:, OWN["gyro"]] = np.where(np.isfinite(reference.rate), reference.rate, 0.0)
    known = known | {"rate"} | _slope(u, recording, "rate", "angular_acceleration")
    known = known | fill_place(u, recording, reference, latitude)
    known = known | (set() if latitude is None and recording.latitude is None else {"latitude"})
    known = known | (_turned(u, recording) if len(axes) == 3 else set())
    if reference.kind == "static":
        # What an accelerometer at rest shows beside its mean is its own noise, not a force.
        u[:, OWN["accel"]] = u[:, OWN["accel"]].mean(axis=0)
        u[:, COLUMNS["vibration"]] = 0.0
    covered = np.isfinite(reference.rate[:, list(axes)]).all(axis=1)
    return _trial(
        recording,
        "gyro",
        recording.gyro,
        u,
        covered,
        known,
        reference.kind,
        band_hz=reference.band_hz,
        band_limit=reference.band_limit,
        axes=axes,
        free_rotation=reference.kind == "attitude" and len(axes) == 3,
        findings=reference.findings,
        up=reference.up,
        samples=None if _was_filtered(recording) else reference.samples,
    )


def _was_filtered(recording: Recording) -> bool:
    """Whether the reference had been in a filter that was undone: that makes its noise larger the
    faster it is.
    """
    other = recording.reference
    return other is not None and any(f.kind in (LAG, ADAPTS, SMOOTHED) for f in other.findings)


def accel_trial(recording: Recording, static: bool, latitude: float | None = None) -> Trial | None:
    """The accelerometer against a reference force, that of positions or velocities, or its own mean
    where ``static``; else None.
    """
    if recording.accel is None:
        return None
    if recording.ref_force is None and not static:
        return _place_trial(recording, latitude)
    force = recording.ref_force
    even = None if force is None else evenly_sampled(recording, force)
    recording = recording if even is None else at_times(recording, even)
    u, known = environment(recording)
    if force is None:
        force = np.broadcast_to(np.nanmean(recording.accel, axis=0), recording.accel.shape)
    u[:, OWN["accel"]] = np.where(np.isfinite(force), force, 0.0)
    if recording.ref_rate is not None:
        u[:, OWN["gyro"]] = np.nan_to_num(recording.ref_rate)
        known = known | {"rate"} | _slope(u, recording, "rate", "angular_acceleration")
        known = known | _turned(u, recording)
    if recording.ref_force is None:
        u[:, COLUMNS["vibration"]] = 0.0
    else:
        known = known | _slope(u, recording, "specific_force", "jerk")
    axes = _live(recording.accel)
    given = recording.ref_force is not None
    return _trial(
        recording,
        "accel",
        recording.accel,
        u,
        np.isfinite(force[:, list(axes)]).all(axis=1),
        known | {"specific_force"},
        "force" if given else "static",
        axes=axes,
        place=Place.of(u, recording.time) if given and "rate" in known else None,
    )


def _place_trial(recording: Recording, latitude: float | None) -> Trial | None:
    """The accelerometer against the force of a body whose attitude and places a reference saw; None
    where it did not.
    """
    force = reference_force(recording, latitude)
    axes = _live(recording.accel)
    if force is None or len(axes) < 3:
        return None
    if force.time is not None:
        recording = at_times(recording, force.time)
    u, known = environment(recording)
    u[:, OWN["accel"]] = np.nan_to_num(force.value)
    u[:, OWN["gyro"]] = np.nan_to_num(force.rate)
    u[:, COLUMNS["attitude"]] = np.nan_to_num(force.attitude)
    # Nothing is asked of the angular acceleration: the noise of the attitude is in it as its second
    # derivative, and as a tilt of gravity in the force, and the two go together.
    _slope(u, recording, "rate", "angular_acceleration")
    known = known | _slope(u, recording, "specific_force", "jerk") | _turned(u, recording)
    return _trial(
        recording,
        "accel",
        recording.accel,
        u,
        np.isfinite(force.value).all(axis=1),
        known | {"rate", "attitude"},
        force.kind,
        axes=axes,
        band_hz=force.band_hz,
        band_limit=force.band_limit,
        free_rotation=True,
        findings=force.findings,
        place=Place.of(
            u,
            recording.time,
            force.gravity,
            force.gravity_std,
            shown_hz=force.shown_hz,
            scale_std=SCALED if force.kind == "position" else 0.0,
        ),
    )


def _live(values: np.ndarray) -> tuple[int, ...]:
    """The axes of samples (n, 3) that tell something: not those that show one value all the time
    beside others that do not, which are dead, or at their limit.
    """
    known = [v[np.isfinite(v)] for v in values.T]
    moves = [i for i, v in enumerate(known) if len(v) and np.ptp(v) > 0.0]
    return tuple(moves or (i for i, v in enumerate(known) if len(v)))


def environment(
    recording: Recording, *, measured: bool = False
) -> tuple[np.ndarray, frozenset[str]]:
    """Inputs (n, N_INPUT) that are not the sensor's own, and which of them are known; the force as
    the reference says it, or as it was ``measured``, where there is the one or the other.

    The others stand at their start values.
    """
    # Column by column, as what works on whole signals reads them; what stays zero takes no memory.
    u, known = np.zeros((len(START), len(recording.time))).T, {"time"}
    for k in np.flatnonzero(START):
        u[:, k] = START[k]
    u[:, OWN["accel"]] = 0.0
    u[:, COLUMNS["time"]] = (recording.time - recording.time[0])[:, None]
    told = recording.accel, recording.ref_force
    force = next((f for f in (told if measured else told[::-1]) if f is not None), None)
    if force is not None:
        u[:, OWN["accel"]] = np.nan_to_num(filled(recording.time, force))
        u[:, COLUMNS["vibration"]] = vibration_of(u[:, OWN["accel"]], recording)
        known |= {"specific_force", "vibration"}
    for name in SURROUNDINGS:
        values = getattr(recording, SIGNALS[name].group)
        if values is not None and np.isfinite(values).any():
            found = np.nan_to_num(filled(recording.time, values.reshape(len(values), -1)))
            # A field turns with the body: only what is a scalar is slow.
            slow = found.shape[1] == 1
            u[:, COLUMNS[name]] = without_noise(recording, found[:, 0])[:, None] if slow else found
            known.add(name)
    if recording.ref_q is not None and np.isfinite(recording.ref_q).any():
        u[:, COLUMNS["attitude"]] = np.nan_to_num(filled(recording.time, recording.ref_q))
        known.add("attitude")
    if "temperature" in known:
        known |= _slope(u, recording, "temperature", "temperature_rate")
    return u, frozenset(known)


def _slope(u: np.ndarray, recording: Recording, signal: str, into: str) -> set[str]:
    """Fill the rate of a signal in, segment by segment: between neighbours on both sides."""
    values = u[:, COLUMNS[signal]]
    for a, b in recording.segments:
        if b - a > 1:
            u[a:b, COLUMNS[into]] = np.gradient(values[a:b], recording.time[a:b], axis=0)
    return {into}


def _turned(u: np.ndarray, recording: Recording) -> set[str]:
    """Fill in the angle turned about each axis."""
    steps = recording.sample_period * u[:, COLUMNS["rate"]]
    u[:, COLUMNS["turned"]] = np.cumsum(steps, axis=0)
    return {"turned"}


def _digits(values: np.ndarray, y: np.ndarray) -> tuple[float, ...]:
    """The steps (3,) to which a reference's numbers (m, 3) were rounded, 0 where they are far below
    the noise of the samples (n, 3).
    """
    steps = [last_digit(np.ascontiguousarray(v)) for v in values.T]
    least = map(least_relevant, y.T)
    return tuple(s if s > at_least else 0.0 for s, at_least in zip(steps, least, strict=True))


def _said_of_digits(digits: tuple[float, ...], reference: str) -> tuple[Finding, ...]:
    step = max(digits)
    return (Finding(DIGITS, f"ref_{reference}", 1, {"step": step}),) if step else ()


def _trial(
    recording: Recording,
    kind: str,
    y: np.ndarray,
    u: np.ndarray,
    covered: np.ndarray,
    known: frozenset[str],
    reference: str,
    *,
    axes: tuple[int, ...],
    band_hz: float | None = None,
    findings: tuple[Finding, ...] = (),
    **more,
) -> Trial | None:
    """A trial of the rows that the reference covers.

    A bad sample is left out. Where a band would spread it, its neighbours stand in for it, or,
    where they cannot, it ends a segment.
    """
    if not axes:
        return None
    own, taken_off = y[:, list(axes)], None
    repeats, drawn = repeated(own), filled_rows(own, recording.segments)
    bad = _missing_or_spikes(own, recording.segments) | (repeats | drawn)[:, None]
    if band_hz is not None:
        most = max(1, int(0.25 / (band_hz * recording.sample_period)) - 1)
        measured, y = y, np.array(y)
        y[:, list(axes)] = healed(recording.time, own, bad, most)
        taken_off = np.where(repeats[:, None], 0.0, np.nan_to_num(measured - y))
        bad &= ~short_runs(bad, most)
    bad = bad.any(axis=1)
    inside = covered if band_hz is None else covered & ~bad
    segments = [(a + i, a + j) for a, b in recording.segments for i, j in runs(inside[a:b])]
    for what, rows in (("repeated_samples", repeats), (FILLED, drawn)):
        if rows.any():
            findings += (Finding(what, kind, int(rows.sum())),)
    other = () if recording.reference is None else recording.reference.findings
    findings += tuple(f for f in other if f.kind in (*OWN_LAG, SMOOTHED, LATE, SIDEWAYS))
    if recording.reference is not None:
        # Stamps that a reference does not share.
        findings += tuple(filter(came_in_bursts, recording.findings))
    digits = NO_DIGITS
    if reference in MEASURED:
        samples = more.get("samples")
        digits = _digits(u[:, OWN[kind]] if samples is None else samples, y)
        findings += _said_of_digits(digits, reference)
    return Trial(
        recording.name,
        kind,
        recording.sample_period,
        recording.time,
        np.nan_to_num(y),
        u,
        segments,
        known,
        reference,
        axes=axes,
        band_hz=band_hz,
        findings=findings,
        digits=digits,
        left_out=bad,
        reference_apart=recording.reference_apart,
        healed=taken_off if taken_off is not None and taken_off.any() else None,
        **more,
    )


def bad_samples(values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    """Flags (n, k) of samples that are missing, spikes, filled in, or repeat the row before.

    ``segments`` are the row ranges (start, stop) without gap.
    """
    no_samples = repeated(values) | filled_rows(values, segments)
    return _missing_or_spikes(values, segments) | no_samples[:, None]


def _missing_or_spikes(values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    missing = ~np.isfinite(values)
    return missing | spikes(np.where(missing, np.nan, values), segments)


def filled_rows(values: np.ndarray, segments: Sequence[tuple[int, int]]) -> np.ndarray:
    """Rows (n,) that a program filled in where samples were lost."""
    known, out = np.isfinite(values).all(axis=1), np.zeros(len(values), dtype=bool)
    last_digit = resolution(values[known])
    for a, b in segments:
        rows = a + np.flatnonzero(known[a:b])
        out[rows] = filled_in(values[rows], last_digit)
    return out


def repeated(values: np.ndarray) -> np.ndarray:
    """Rows (n,) that repeat the row before on every axis, where the values are fine enough for that
    not to happen by itself, and not as all axes lie at their limits.
    """
    same = np.concatenate([[False], (np.diff(values, axis=0) == 0).all(axis=1)])
    if same.any():
        same &= ~np.all([clipped(column) for column in values.T], axis=0)
    by_axis = [np.mean(np.diff(column) == 0) for column in values.T]
    return (
        same
        if 0 < same.mean() < 0.2 and same.mean() > 10 * np.prod(by_axis)
        else np.zeros(len(values), dtype=bool)
    )


def known_to_all(trials: Iterable[Trial]) -> frozenset[str]:
    """The signals that every one of trials knows."""
    return frozenset.intersection(*(t.known for t in trials))


def counted(trial: Trial, axis: int) -> np.ndarray:
    """The samples (k,) of an axis that regression draws on, less what stands in for others."""
    rows = marked(trial.row_segments, len(trial.y))
    if trial.healed is not None:
        rows &= trial.healed[:, axis] == 0.0
    return trial.y[rows, axis]


def marked(segments: list[tuple[int, int]], n: int) -> np.ndarray:
    """Flags (n,) that are true inside the ranges (start, stop): the contrary of ``runs``."""
    flags = np.zeros(n, dtype=bool)
    for a, b in segments:
        flags[a:b] = True
    return flags
