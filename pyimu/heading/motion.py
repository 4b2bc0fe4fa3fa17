"""A known motion: one gyro beside a reference of what it should have measured.

The reference is a heading or a rate. What cannot be a reference of this gyro is refused here, with
what would be right, before anything is fitted to it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import UserError
from pyimu.recording.clock import runs
from pyimu.recording.quality.clipping import PLATEAU, clipped
from pyimu.recording.recording import Recording
from pyimu.recording.reference.rate import check_radians

Reference = Literal["heading", "rate"]

Z = 2
"""The axis about the vertical of a body that stands level."""

QUARTER = np.pi / 2
"""rad; a heading that changes by more between two samples is as near to the one way round as to the
other."""

DEGREES = np.degrees(1.0)
"""By which factor degrees that are called radians are too large."""

APART = 1.5
"""Factor by which a slope may be off and still be known for one, for -1, or for ``DEGREES``: two
gyros of one kind differ by less, and these differ by more."""

ALIKE = 0.9
"""Correlation of gyro and reference below which their slope is, to a fifth and more, that of noise:
it is too small by one less its square."""

WRAPPED = 10.0
"""Times the median step of the fastest rows that no turn, and every wrap, is."""

DISAGREE = 0.05
"""Share of the path turned by which two references of one motion may differ: more than that is the
error of the scale factor that they are to find (MPU-6050: 3 %)."""

REST_TURN = np.radians(1.0)
"""rad; a declared rest in which the reference turns by more is none: optical references and wheels
wander by some tenths of a degree (Hidalgo 2012: 0.1 to 0.2 deg)."""

LEAST_ROWS = 10
"""Rows of a piece of a log that are worth a heading of its own."""


@dataclass(frozen=True)
class KnownMotion:
    """One axis of a log and its reference, rows (n,) without missing values.

    ``time`` s, ``measured`` rad/s, and of ``heading`` rad (unwrapped within a segment) and ``rate``
    rad/s the one that the log has, or both. A row of ``measured`` is the mean rate of the period
    that ends with it. ``segments`` are ranges of rows without gap or missing value.
    """

    name: str
    time: np.ndarray
    measured: np.ndarray
    heading: np.ndarray | None
    rate: np.ndarray | None
    segments: list[tuple[int, int]]
    period: float

    @property
    def references(self) -> tuple[Reference, ...]:
        return tuple(n for n in ("heading", "rate") if getattr(self, n) is not None)


def known_motion(recording: Recording, reference: Reference | None = None) -> KnownMotion:
    """The rows of a recording about the vertical beside their ``reference``, or each that it has.

    The heading is ``ref_heading``, or the yaw of ``ref_q``; the rate the z axis of ``ref_rate``.

    Raises UserError where there is none, and for one that contradicts the gyro: a heading that may
    have turned either way between two samples, one that was given in degrees, one that turns the
    other way round, a gyro at its limit, two references that differ, a declared rest that turns.
    """
    if recording.gyro is None:
        raise UserError(f"{recording.name}: no gyro, a heading needs gyro_z")
    found = {"heading": _heading(recording), "rate": _rate(recording)}
    if reference is not None:
        found = {name: v if name == reference else None for name, v in found.items()}
    given = {name: v for name, v in found.items() if v is not None}
    if not given:
        raise UserError(_without_reference(recording, reference))
    measured = recording.gyro[:, Z]
    known = np.isfinite(np.column_stack([measured, *given.values()])).all(axis=1)
    pieces = [(a + i, a + j) for a, b in recording.segments for i, j in runs(known[a:b])]
    pieces = [(a, b) for a, b in pieces if b - a >= LEAST_ROWS]
    if not pieces:
        raise UserError(
            f"{recording.name}: nowhere {LEAST_ROWS} rows on end with gyro_z and "
            f"{' and '.join(given)} reference; a calibration needs some seconds of them"
        )
    rows = np.concatenate([np.arange(a, b) for a, b in pieces])
    ends = np.cumsum([b - a for a, b in pieces]).tolist()
    segments = list(zip([0, *ends[:-1]], ends, strict=True))
    one = KnownMotion(
        recording.name,
        recording.time[rows],
        measured[rows],
        *(None if v is None else v[rows] for v in found.values()),
        segments,
        recording.sample_period,
    )
    return _checked(one, None if recording.stationary is None else recording.stationary[rows])


def _heading(recording: Recording) -> np.ndarray | None:
    if recording.ref_heading is not None:
        check_radians(recording)
        return np.array(recording.ref_heading)
    if recording.ref_q is None:
        return None
    yaw = np.full(len(recording), np.nan)
    known = np.isfinite(recording.ref_q).all(axis=1)
    q = Rotation.from_quat(recording.ref_q[known], scalar_first=True)
    yaw[known] = q.as_euler("ZYX")[:, 0]
    return yaw


def _rate(recording: Recording) -> np.ndarray | None:
    return None if recording.ref_rate is None else np.array(recording.ref_rate[:, Z])


def _without_reference(recording: Recording, reference: Reference | None) -> str:
    column = {"heading": "ref_heading [rad] or ref_q", "rate": "ref_rate_z [rad/s]"}
    wanted = [column[reference]] if reference else [*column.values()]
    return (
        f"{recording.name}: no reference of the known motion, which needs a column "
        f"{' or '.join(wanted)}; without one there is nothing to calibrate by, only "
        "--method integrate, threshold and filter"
    )


# What cannot be


def _checked(one: KnownMotion, marked: np.ndarray | None) -> KnownMotion:
    """The motion with its heading unwrapped. Raises UserError as ``known_motion`` says."""
    for name in one.references:
        _check_slope(one, name)
    if one.heading is not None:
        one = _unwrapped(one)
    _check_limit(one)
    _check_references(one)
    if marked is not None:
        _check_rests(one, marked > 0.5)
    return one


def _steps(one: KnownMotion, name: Reference) -> np.ndarray:
    """Turn (n,) rad in the period that ends with each row; NaN for the first of a segment."""
    if name == "rate":
        return one.rate * one.period
    steps = np.diff(one.heading, prepend=np.nan)
    steps[[a for a, _ in one.segments]] = np.nan
    return steps


def _check_slope(one: KnownMotion, name: Reference) -> None:
    """Refuse a reference in degrees or of opposite sign, by the rows that turn fastest.

    The median slope of a quarter of the rows is not moved by the few in which a heading wraps.
    Where the two are hardly alike it says nothing.
    """
    steps, turned = _steps(one, name), (one.measured - np.median(one.measured)) * one.period
    rows = np.flatnonzero(np.isfinite(steps))
    rows = rows[np.argsort(-np.abs(turned[rows]))[: max(len(rows) // 4, 1)]]
    if not np.any(turned[rows]):
        return
    against = steps[rows] - np.median(steps[np.isfinite(steps)])
    # A heading wraps in few of these rows.
    usual = np.abs(against) <= WRAPPED * np.median(np.abs(against))
    rows, against = rows[usual], against[usual]
    spread = float(np.std(against) * np.std(turned[rows]))
    along = float(np.mean((against - against.mean()) * (turned[rows] - turned[rows].mean())))
    if abs(along) < ALIKE * spread or spread == 0.0:
        return
    slope = float(np.median(against / np.where(turned[rows] == 0, np.inf, turned[rows])))
    column = "ref_heading" if name == "heading" else "ref_rate_z"
    for factor, text in (
        (DEGREES, f"{column} looks like degrees that are called radians (a factor of 57)"),
        (1 / DEGREES, f"gyro_z looks like deg/s that are called rad/s, against {column}"),
    ):
        if 1 / APART < abs(slope) / factor < APART:
            raise UserError(f"{one.name}: {text}: correct the unit in the column's header")
    if -APART < slope < -1 / APART:
        raise UserError(
            f"{one.name}: gyro_z and {column} turn opposite ways (s near -2): one of them counts "
            "clockwise; a heading is counter-clockwise from east, and z is up"
        )


def _unwrapped(one: KnownMotion) -> KnownMotion:
    heading = np.array(one.heading)
    for a, b in one.segments:
        raw = heading[a:b]
        steps = (np.diff(raw) + np.pi) % (2 * np.pi) - np.pi
        wide = np.flatnonzero(np.abs(steps) > QUARTER)
        if len(wide):
            at = one.time[a + wide[0] + 1]
            raise UserError(
                f"{one.name}: ref_heading steps by {np.degrees(steps[wide[0]]):.0f} deg at "
                f"{at:.6g} s, which could be either way round: a heading must be sampled so often "
                "that it turns by less than 90 deg from row to row"
            )
        heading[a:b] = raw[0] + np.concatenate([[0.0], np.cumsum(steps)])
    return replace(one, heading=heading)


def _check_limit(one: KnownMotion) -> None:
    """Refuse a gyro that stays at a level while its reference goes on."""
    stuck = clipped(one.measured)
    rate = one.rate if one.rate is not None else _steps(one, "heading") / one.period
    for sign in (-1, 1):
        rows = np.flatnonzero(stuck & (sign * one.measured > 0) & np.isfinite(rate))
        if len(rows) and np.ptp(rate[rows]) > 3 * PLATEAU * np.max(np.abs(one.measured[rows])):
            level = np.degrees(np.median(one.measured[rows]))
            raise UserError(
                f"{one.name}: gyro_z is at its limit of {level:.4g} deg/s in {len(rows)} rows, "
                f"from {one.time[rows[0]]:.6g} s on, while the reference goes on: a known motion "
                "must stay within the gyro's range"
            )


def _check_references(one: KnownMotion) -> None:
    """Refuse two references of which one turns other than the other."""
    if len(one.references) < 2:
        return
    by_rate = one.rate * one.period
    for a, b in one.segments:
        off = one.heading[a + 1 : b] - one.heading[a] - np.cumsum(by_rate[a + 1 : b])
        path = np.sum(np.abs(by_rate[a + 1 : b]))
        # Either may be late by a period or two, which is no contradiction.
        late = 2 * one.period * np.max(np.abs(one.rate[a:b]))
        most = float(np.max(np.abs(off)))
        if most > DISAGREE * path + late + REST_TURN:
            raise UserError(
                f"{one.name}: ref_heading and ref_rate_z disagree by {np.degrees(most):.3g} deg "
                f"on a path of {np.degrees(path):.4g} deg: say by reference= (--reference) which "
                "of the two is true"
            )


def _check_rests(one: KnownMotion, marked: np.ndarray) -> None:
    """Refuse a rest that is declared while the reference turns."""
    turns = np.nan_to_num(_steps(one, one.references[0]))
    for a, b in one.segments:
        for i, j in runs(marked[a:b]):
            turned = float(np.sum(turns[a + i + 1 : a + j]))
            if abs(turned) > REST_TURN:
                raise UserError(
                    f"{one.name}: stationary from {one.time[a + i]:.6g} to "
                    f"{one.time[a + j - 1]:.6g} s, in which the reference turns by "
                    f"{np.degrees(turned):.3g} deg: correct the column stationary, or the "
                    "reference's clock, or leave the column out"
                )
