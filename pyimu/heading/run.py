"""The heading of logs by several methods, and the error of each against the logs' reference."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
from scipy.ndimage import uniform_filter1d

from pyimu.display.silent import silent
from pyimu.errors import UserError
from pyimu.heading.calibration import Calibration, self_calibrate
from pyimu.heading.filter import HeadingFilter, HeadingTrack, compensated
from pyimu.heading.fit import fit
from pyimu.heading.motion import KnownMotion, Reference, Z, known_motion
from pyimu.heading.notes import of_clock, of_log, of_part
from pyimu.heading.outcome import Method, Track
from pyimu.heading.result import HeadingResult
from pyimu.heading.threshold import TYPICAL, check_not_negative, threshold_filter
from pyimu.heading.transfer import rate_transfer, shows_transfer
from pyimu.model.part import Part
from pyimu.model.part_file import part as part_of
from pyimu.model.sensor import Sensor
from pyimu.model.typical import magnitudes
from pyimu.recording.clock import runs
from pyimu.recording.log import Given, recording_of
from pyimu.recording.recording import Recording, filled
from pyimu.recording.rest import SECOND
from pyimu.units import did_you_mean

START_UP = 20.0
"""s at the start of a log that are its known motion, where no other log is."""

CALIBRATED = ("self-calibration", "paper")
"""Methods that need a known motion."""

METHODS: dict[str, str] = {
    "integrate": "the measured rate, added up",
    "self-calibration": "scale factor and bias by least squares on the known motion",
    "threshold": "a rate below the threshold counts as none",
    "paper": "both, as Hong and Park 2008 propose",
    "filter": "Kalman filter on heading, bias and scale factor with updates at rest",
}
"""The methods, and what each is in a few words."""

ALL = "all"

TURN = np.radians(10.0)
"""rad; what turns by less one way is steering."""

TYPICAL_WALK = magnitudes("rate_random_walk", "gyro")["consumer"].si
"""rad/s/sqrt(s); of a gyro whose known motion is too short to show how its bias walks."""

TURNING = 1e-3
"""Share of the fastest rate from which on a body turns."""


def run(
    recordings: Given | Sequence[Given],
    part: Part | str | os.PathLike | None = None,
    method: str | Sequence[str] = ALL,
    *,
    known: Given | Sequence[Given] | None = None,
    start_up: float = START_UP,
    reference: Reference | None = None,
    threshold: float = TYPICAL,
    release: float | None = None,
    hold: float = 0.0,
    slip_std: float = 0.0,
    say: Callable[..., None] = silent,
) -> HeadingResult:
    """The heading of logs of one robot by each ``method``, and its error where they have a
    reference.

    The known motion is that of the recordings ``known``, one for each log or one for all, else the
    first ``start_up`` s of each log; the heading begins after it at the reference's. ``reference``
    is what calibrates, "heading" or "rate". ``threshold``, ``release`` rad/s and ``hold`` s are
    those of the threshold filter, ``slip_std`` is by which share the known motion may have been
    another. Without a ``part`` the filter's noise is what the known motion leaves.

    Raises UserError for an unknown method, a start-up or a slip that is negative, a log that is no
    longer than its start-up, one without a reference for a method that needs one, and as
    ``self_calibrate`` and ``threshold_filter`` do.
    """
    names = chosen(method)
    check_not_negative("start_up", start_up)
    check_not_negative("slip", slip_std)
    logs = _logs(recordings)
    model = None if part is None else part_of(part)
    motions = [None] * len(logs) if known is None else _paired_up(_logs(known), len(logs))
    per_log, notes = [], []
    for i, (log, motion) in enumerate(zip(logs, motions, strict=True)):
        say(f"log {log.name}", i / len(logs))
        one = _OneLog(log, motion, model, start_up, reference, (threshold, release, hold), slip_std)
        per_log.append(one.tracks(names, explicit=method != ALL))
        notes += one.notes
    done = [n for n in names if all(n in tracks for tracks in per_log)]
    methods = tuple(Method(n, METHODS[n], tuple(t[n] for t in per_log)) for n in done)
    transfer = next((rate_transfer(log) for log in logs if shows_transfer(log)), None)
    settings = {
        "threshold": threshold,
        "release": release,
        "hold": hold,
        "start_up": None if known is not None else start_up,
        "slip_std": slip_std,
        "part": None if model is None else model.name,
    }
    return HeadingResult(tuple(logs), methods, tuple(dict.fromkeys(notes)), settings, transfer)


def chosen(method: str | Sequence[str]) -> list[str]:
    """The names of the methods. Raises UserError for one that is not known."""
    given = method.split(",") if isinstance(method, str) else list(method)
    names = [n.strip() for n in given]
    for n in names:
        if n not in METHODS and n != ALL:
            raise UserError(
                f"--method {n}: unknown{did_you_mean(n, METHODS)}; known are "
                f"{', '.join([*METHODS, ALL])}"
            )
    return list(METHODS) if ALL in names else list(dict.fromkeys(names))


def _logs(given) -> list[Recording]:
    several = isinstance(given, (list, tuple))
    logs = [recording_of(g) for g in (given if several else [given])]
    if not logs:
        raise UserError("no log: a heading needs one at least")
    return logs


def _paired_up(known: list[Recording], count: int) -> list[Recording]:
    if len(known) not in (1, count):
        raise UserError(
            f"{len(known)} known motions for {count} logs: give one for all, or one for each"
        )
    return known * count if len(known) == 1 else known


class _OneLog:
    """One log on its way through the methods."""

    def __init__(self, log, motion, part, start_up, reference, threshold, slip_std) -> None:
        if log.gyro is None:
            raise UserError(f"{log.name}: no gyro, a heading needs gyro_z")
        self.reference, self.threshold, self.slip_std = reference, threshold, slip_std
        self.notes: list[str] = []
        if motion is None:
            stop = int(np.searchsorted(log.time, log.time[0] + start_up, side="right"))
            if stop > len(log) - 2:
                raise UserError(
                    f"{log.name}: {log.time[-1] - log.time[0]:.4g} s long, no longer than its "
                    f"start-up motion of {start_up:.4g} s: give --start-up SECONDS, or --known LOG"
                )
            motion, first = log.slice(0, stop), stop
        else:
            first = 1
        self.known, self.part = motion, part
        self.log, self.before = log.slice(first), log.slice(0, first)
        self.true = _true_heading(log, reference)
        self.first = first
        self.notes += of_log(log, self.true)
        self.notes += [] if part is None else of_part(log, part)

    def tracks(self, names: list[str], explicit: bool) -> dict[str, Track]:
        """The track of each method; one that lacks a reference is left out and said to be, unless
        it was asked for by name.
        """
        found: dict[str, Track] = {}
        left_out: dict[str, list[str]] = {}
        for name in names:
            try:
                found[name] = self._track(name)
            except UserError as error:
                if explicit or name not in CALIBRATED:
                    raise
                left_out.setdefault(str(error), []).append(name)
        for reason, without in left_out.items():
            verb = "is" if len(without) == 1 else "are"
            self.notes.append(f"{' and '.join(without)} {verb} left out: {reason}")
        return found

    def _track(self, name: str) -> Track:
        if name == "filter":
            return self._filtered()
        found = None
        rate = filled(self.log.time, self.log.gyro[:, Z])
        if name in CALIBRATED:
            found = self._calibration
            rate = found.rate(rate)
        if name in ("threshold", "paper"):
            self._check_threshold()
            level, release, hold = self.threshold
            rate = threshold_filter(
                rate, level, release=release, hold=hold, period=self.log.sample_period
            )
        steps = np.diff(self.log.time, prepend=self.log.time[0] - self.log.sample_period)
        heading = self._start() + np.cumsum(rate * steps)
        return self._against(heading, found)

    @cached_property
    def _calibration(self) -> Calibration:
        return self_calibrate(self.known, self.reference)

    def _start(self) -> float:
        """The reference's heading at the row before the first, 0 where it has none."""
        if self.true is None or not np.isfinite(self.true[self.first - 1]):
            return 0.0
        return float(self.true[self.first - 1])

    def _against(
        self,
        heading: np.ndarray,
        found: Calibration | None,
        track: HeadingTrack | None = None,
    ) -> Track:
        error = None
        if self.true is not None:
            off = heading - self.true[self.first :]
            known = np.flatnonzero(np.isfinite(off))
            # A reference that is missing where the heading begins sets it right where it begins.
            if len(known) and not np.isfinite(self.true[self.first - 1]):
                off -= off[known[0]]
            error = (off + np.pi) % (2 * np.pi) - np.pi
        return Track(self.log.name, self.log.time, heading, error, found, track)

    def _check_threshold(self) -> None:
        """Refuse a threshold above the slowest turn of the log, which it would take for noise."""
        slowest = _slowest_turn(self.log, self.reference)
        if slowest is not None and self.threshold[0] > slowest:
            raise UserError(
                f"{self.log.name}: the threshold of {np.degrees(self.threshold[0]):.3g} deg/s is "
                f"above the slowest turn of the log, {np.degrees(slowest):.3g} deg/s: that turn "
                "would be lost; give a lower one with --threshold"
            )

    def _filtered(self) -> Track:
        part, log, found = self.part, self.log, None
        try:
            known = self.known if part is None else compensated(self.known, part)
            found = fit(known, self.reference)
            self.notes += of_clock(found, known.sample_period)
        except UserError as error:
            self.notes.append(f"filter without a known motion: {error}")
        if part is None:
            part = _part_of(found, log)
        track = HeadingFilter(part, found, self.slip_std).run(log, self._start())
        if not track.at_rest.any():
            self.notes.append(f"{log.name}: no rest, so that no zero rate corrected the filter")
        return self._against(track.heading, found, track)


def _judging(log: Recording, reference: Reference | None) -> KnownMotion:
    """The log beside the ``reference`` that is believed, or beside what it has."""
    has = {"heading": log.ref_heading is not None or log.ref_q is not None}
    has["rate"] = log.ref_rate is not None
    return known_motion(log, reference if reference is not None and has[reference] else None)


def _true_heading(log: Recording, reference: Reference | None) -> np.ndarray | None:
    """The reference's heading (n,) rad, NaN where it is missing; a rate is added up."""
    try:
        one = _judging(log, reference)
    except UserError:
        if log.ref_heading is None and log.ref_q is None and log.ref_rate is None:
            return None
        raise
    true = np.full(len(log), np.nan)
    rows = np.searchsorted(log.time, one.time)
    if one.heading is not None:
        true[rows] = one.heading
        return true
    true[rows] = np.cumsum(one.rate) * one.period
    return true


def _slowest_turn(log: Recording, reference: Reference | None) -> float | None:
    """The rate in rad/s of the slowest turn that the reference shows; None without one.

    A turn goes one way, without a second's stop, by ``TURN`` or more; its rate is the mean over
    its angle, which steering before and after hardly changes.
    """
    try:
        one = _judging(log, reference)
    except UserError:
        return None
    slowest = []
    for a, b in one.segments:
        rate = one.rate[a:b] if one.heading is None else np.gradient(one.heading[a:b], one.period)
        mean = uniform_filter1d(rate, max(round(SECOND / one.period), 1), mode="nearest")
        fast = np.max(np.abs(mean), initial=0.0)
        for sign in (-1, 1):
            for i, j in runs(sign * mean > TURNING * fast):
                path = np.sum(np.abs(rate[i:j]))
                if path * one.period >= TURN:
                    slowest.append(float(np.sum(rate[i:j] ** 2) / path))
    return min(slowest, default=None)


def _part_of(found: Calibration | None, log: Recording) -> Part:
    """A part that has the noise which a known motion left, or the log's own quiet."""
    if found is not None and found.noise is not None:
        n, k = found.noise
    else:
        scatter = np.diff(filled(log.time, log.gyro[:, Z]), n=3)
        n, k = float(np.sqrt(np.median(scatter**2) / 0.455 / 20 * log.sample_period)), 0.0
    gyro = {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k or TYPICAL_WALK}}
    return Part("as the log shows it", log.sample_rate, Sensor("gyro", gyro))
