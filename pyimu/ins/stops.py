"""The rests of a recording: that at the start, and those by which the filter corrects itself."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import casadi as ca
import numpy as np

from pyimu.attitude.columns import NOISIER
from pyimu.attitude.filter.compensation import noise_of
from pyimu.attitude.rest import FORCE_OFF, Rest, find_rest, finite_rows
from pyimu.errors import Finding, UserError
from pyimu.ins.between import Change
from pyimu.ins.compensated import compensated
from pyimu.ins.detector import Detected, detect
from pyimu.ins.filter.layout import open_std
from pyimu.ins.filter.prediction import LASTS
from pyimu.ins.noise import Noise
from pyimu.ins.quiet import quiet_until
from pyimu.ins.shoves import shoved
from pyimu.ins.speeds import driven
from pyimu.ins.witnesses import REFERENCE, Witness, denied
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording
from pyimu.recording.rest import LARGEST_RATE, rests

ZUPT = ("auto", "live", "foot", "declared", "off")
"""Where zero-velocity updates come from: the column ``stationary``, else the samples before and
after; what the filter finds by itself, as the unit does, in the samples until now; as auto, and the
stances of a sensor on a foot besides; that column alone; nowhere."""

FIRST = 0.5
"""s; over which the means are taken that a part with wide tolerances may have at rest."""

LATER = 2.0
"""s; length at least of a rest within a log that tells noise and bias of one that begins in motion:
a second of a smooth drive may be as still."""

SIGMAS = 3.0
"""Standard deviations of a tolerance up to which a mean is taken for an error of the part."""

ALIKE = 3.0
"""Times what the axes across gravity show: the null of the axis along it is no larger, in 19 of 20
that lie in any direction."""


def rest_at_start(recording: Recording, part: Part | None, gravity: float) -> Rest:
    """The rest at the start, of samples without the errors that a ``part`` knows.

    A rest of a gyro of unknown null has a mean rate of up to what the part's tolerance allows, and
    its force another size: both are taken off before the rest is looked for, and put back. A turn
    that is no faster than that cannot be told from a null. What is louder than the rest before it
    is a motion that begins.
    """
    rest = _rest_at_start(recording, part, gravity)
    if rest.declared or not shows_noise(rest):
        return rest
    stop = quiet_until(recording, rest.rows.stop)
    if stop == rest.rows.stop:
        return rest
    quiet = _rest_at_start(recording.slice(0, stop), part, gravity)
    return quiet if shows_noise(quiet) else rest


def _rest_at_start(recording: Recording, part: Part | None, gravity: float) -> Rest:
    if part is None:
        null, size = _beside_gravity(recording), 1.0
    else:
        null, size = _by_tolerance(recording, part, gravity)
    rest = find_rest(
        replace(recording, gyro=recording.gyro - null, accel=recording.accel / size), gravity
    )
    force = None if rest.force is None else rest.force * size
    return replace(rest, rate=rest.rate + null, force=force)


def shows_noise(rest: Rest) -> bool:
    """Whether a rest at the start shows the sensors' noise, be its force gravity or not."""
    return rest.seen or rest.other_force is not None


def later_rest(recording: Recording, part: Part | None, gravity: float) -> Rest | None:
    """What the longest rest of a recording that begins in motion shows, of ``LATER`` s at least and
    by its samples, whatever it declares; None where there is none.
    """
    recording = replace(recording, stationary=None)
    found = [(b - a, a) for a, b in rests(recording) if (b - a) * recording.sample_period >= LATER]
    for _, start in sorted(found, reverse=True):
        rest = rest_at_start(recording.slice(start), part, gravity)
        if shows_noise(rest):
            return rest
    return None


def _beside_gravity(recording: Recording) -> np.ndarray:
    """The null (3,) rad/s of the first samples of a gyro of which nothing is known; else 0.

    A rest of it has rates that are too large for a bias. A turn across gravity would turn the
    force, which a rest keeps. One about it would not, but where the other axes show a large null,
    this axis has one, too, and its rate is no turn unless it is much larger.
    """
    stop = max(2, round(FIRST / recording.sample_period))
    first = [finite_rows(v, stop) for v in (recording.gyro, recording.accel)]
    if not all(map(len, first)):
        return np.zeros(3)
    rate, force = (v.mean(axis=0) for v in first)
    up = force / max(float(np.linalg.norm(force)), 1e-9)
    across = float(np.linalg.norm(rate - up * (rate @ up)))
    null = across > LARGEST_RATE and abs(rate @ up) <= ALIKE * across
    return rate if null else np.zeros(3)


def _by_tolerance(recording: Recording, part: Part, gravity: float) -> tuple[np.ndarray, float]:
    """The null (3,) rad/s of the first samples, and their force over gravity, as far as the part's
    tolerances explain them and no rest would be found without; else 0 and 1.
    """
    rows = slice(0, max(2, round(FIRST / recording.sample_period)))
    null = np.nan_to_num(np.nanmean(recording.gyro[rows], axis=0))
    force = np.nanmean(recording.accel[rows], axis=0)
    wide, off = (
        SIGMAS * open_std(replace(part, estimate=frozenset()), (kind, "turn_on_bias", "b0"), 0.0)
        for kind in ("gyro", "accel")
    )
    size = float(np.linalg.norm(force) / gravity)
    explained = abs(size - 1) * gravity <= np.linalg.norm(off) + FORCE_OFF
    return (
        null if np.all(np.abs(null) <= wide) else np.zeros(3),
        size if explained and np.isfinite(size) else 1.0,
    )


def clean_of(recording: Recording, part: Part | None) -> Recording:
    """The recording without the errors that the part knows; itself where it knows none."""
    if part is None or not any(
        e.invertible and e.law is None for sensor in (part.gyro, part.accel) for e in sensor.effects
    ):
        return recording
    return compensated(recording, part)


def stops_of(
    recording: Recording,
    noise: Noise,
    zupt: str,
    findings: list[Finding],
    witnesses: Sequence[Witness] = (),
) -> tuple[np.ndarray, Detected | None]:
    """Marks (n,) of rest of a recording less known errors, none where the filter finds them.

    What ``witnesses`` say to move is no rest that was found.

    Raises UserError where rests are to be declared and are not.
    """
    if zupt in ("off", "live"):
        return np.zeros(len(recording.time), dtype=bool), None
    if recording.stationary is not None:
        return np.nan_to_num(recording.stationary) > 0.5, None
    if zupt == "declared":
        raise UserError(
            f"{recording.name}: no column 'stationary [1]' that declares rests; --zupt auto finds "
            "them in the samples"
        )
    found = detect(recording.time, recording.gyro, recording.accel, noise, recording.sample_period)
    shoves, noise = shoved(recording.accel, found.still, noise, recording.sample_period)
    still = found.still & ~shoves
    drives, moves, said = _driven(recording, still, noise, witnesses)
    findings += said
    still &= ~moves
    for kind, stretches in (("steady_turn", found.steady), ("steady_drive", drives)):
        for start, stop in stretches:
            still[start:stop] = False
            seconds = float(recording.time[stop - 1] - recording.time[start])
            detail = {"first": float(recording.time[start]), "seconds": seconds}
            findings.append(Finding(kind, "gyro", stop - start, detail))
    return still, found


def _driven(
    recording: Recording, still: np.ndarray, noise: Noise, witnesses: Sequence[Witness]
) -> tuple[list[tuple[int, int]], np.ndarray, list[Finding]]:
    """The stretches of ``still`` (n,) that the samples tell to be driven, marks (n,) of those that
    only ``witnesses`` tell, and what these say.

    Measurements are heeded at once. A reference, by which a path is judged, is asked of what is
    left alone, and the samples once more where it objects.
    """
    samples = recording.time, recording.gyro, recording.accel
    moves, said, drives, doubt, unsure = np.zeros(len(still), dtype=bool), [], [], 0, []
    told: dict[tuple[int, ...], Change | None] = {}
    for judges in (False, True):
        left = still & ~moves
        for start, stop in drives:
            left[start:stop] = False
        asked = [w for w in witnesses if (w.name == REFERENCE) == judges]
        more, own = denied(recording.time, left, asked)
        if not judges or more.any():
            moves, said = moves | more, said + own
            known = noise, recording.sample_period, moves, told
            drives, doubt, unsure = driven(*samples, still, *known)
    said += [Finding("rests_or_drives", "", doubt, {})] if doubt else []
    if unsure:
        first = {"first": float(recording.time[unsure[0]])}
        said.append(Finding("unsure_rests", "", len(unsure), first))
    return drives, moves, said


def noise_at_rest(recording: Recording, part: Part, rest: Rest, declared: Part | None) -> Noise:
    """What a detector needs of the sensors: the part's noise, or that of the first rest where it is
    larger. ``declared`` is the part as its maker has it.
    """
    still = shows_noise(rest)
    stds, walks = [], []
    for kind, seen in (("gyro", rest.rate_std), ("accel", rest.force_std)):
        white, walk = _noise(part.sensor(kind), recording.sample_period)
        most = np.full(3, np.inf)
        if declared is not None:
            most = NOISIER * _noise(declared.sensor(kind), recording.sample_period)[0]
        shown = np.minimum(seen, most) if still else np.zeros(3)
        stds.append(np.maximum(np.maximum(white, shown), 1e-9))
        walks.append(walk)
    bias = rest.rate if still else np.zeros(3)
    shown = still or declared is not None or bool(rests(recording))
    return Noise(stds[0], stds[1], walks[0], bias, shown)


def _noise(sensor: Sensor, period: float) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviation (3,) of a sample's white noise, and the random walk (3,), of a sensor."""
    noise = noise_of(sensor, ca.SX(ca.DM(sensor.p)), period, LASTS)
    white, walk = (np.array(ca.evalf(v), dtype=float).ravel() for v in (noise.white, noise.walk))
    return white / np.sqrt(period), walk
