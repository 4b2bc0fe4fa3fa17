"""The trials of a recording: gyro and accelerometer, each beside what the reference says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.bad_rows import bad_samples, filled_rows, missing_or_spikes, repeated
from pyimu.identification.fit.place import SCALED, Place
from pyimu.identification.fit.surroundings import fill_place, vibration_of, without_noise
from pyimu.identification.fit.trial import MEASURED, NO_DIGITS, OWN_LAG, Trial
from pyimu.model.kinds import OWN
from pyimu.model.signals import COLUMNS, SIGNALS, START, SURROUNDINGS
from pyimu.recording.clock import runs
from pyimu.recording.coarse import came_in_bursts
from pyimu.recording.complete import completed
from pyimu.recording.quality.healing import healed, short_runs
from pyimu.recording.quality.resolution import last_digit, least_relevant
from pyimu.recording.recording import Recording, filled
from pyimu.recording.reference.filled import FILLED
from pyimu.recording.reference.force import reference_force
from pyimu.recording.reference.play import PLAY
from pyimu.recording.reference.rate import reference_rate
from pyimu.recording.reference.stamps import at_times, evenly_sampled
from pyimu.recording.reference.unfiltered_places import LATE, SIDEWAYS
from pyimu.recording.reference.unlagged import ADAPTS, LAG
from pyimu.recording.reference.unsmoothed import SMOOTHED

DIGITS = "reference_digits"
"""The finding of a reference whose numbers are rounded."""


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
        seen_at=reference.seen_at if reference.kind == "attitude" else None,
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
    bad = missing_or_spikes(own, recording.segments) | (repeats | drawn)[:, None]
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
    findings += tuple(f for f in other if f.kind in (*OWN_LAG, PLAY, SMOOTHED, LATE, SIDEWAYS))
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
