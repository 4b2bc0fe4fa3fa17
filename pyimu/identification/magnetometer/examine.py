"""What the logs show of a magnetometer: what it is worth on rows that were not fitted, and whether
it is a calibration at all.

In a room the field is not the same everywhere, and what it is off follows the attitude in part: a
fit takes that for hard and soft iron. So a calibration goes into the model only where what it
leaves is near noise (``verdict.FAR``); else it is said, with what speaks against it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from pyimu.attitude.calibration import MagnetometerCalibration, of_sensor
from pyimu.attitude.magnetometer import magnetometer_of
from pyimu.characterization.magnetometer.estimate import LEAST, WEAKEST
from pyimu.display.silent import silent
from pyimu.identification.errors.held_out import clock_of, log_state
from pyimu.identification.fit.score import ErrorSums
from pyimu.identification.fit.trial import HEAD, HELD_OUT
from pyimu.identification.found.entries import Errors
from pyimu.identification.found.exhibits import Exhibits, Trace
from pyimu.identification.magnetometer.fit import (
    BIAS,
    DEGREES,
    MATRIX,
    SHARED,
    FieldFit,
    LogField,
    fit,
    predicted,
    shown,
    weakest,
)
from pyimu.identification.magnetometer.rows import FieldRows, field_rows
from pyimu.identification.model.model_of import Found
from pyimu.identification.verdict.verdict import FAR
from pyimu.model.part import Part
from pyimu.numerics.laws import f as fisher
from pyimu.recording.recording import Recording

GATE = 0.01
"""Probability with which a magnetometer that lacks nothing passes for one that does."""

NOTHING, UNCONFIRMED, UNEVEN, FOUND = "nothing missing", "not confirmed", "uneven field", "found"
"""What may become of a calibration."""


@dataclass(frozen=True)
class Held:
    """A log's rows to judge by, with its field before and after, found in other rows."""

    rows: FieldRows
    before: LogField
    after: LogField


@dataclass(frozen=True)
class Examined:
    """What became of a magnetometer: one of the words above.

    ``before`` is the calibration of the part, ``after`` the fit; ``gain`` and ``gate`` are the
    statistic of what it changes and its limit. ``white`` (3,) T is the standard deviation of a
    sample's white noise, ``N`` (3,) T sqrt(s) the root of its two-sided density.
    """

    outcome: str
    before: MagnetometerCalibration
    after: FieldFit
    gain: float
    gate: float
    white: np.ndarray
    N: np.ndarray
    errors: Errors
    by_log: Mapping[str, Errors]
    held: tuple[Held, ...] = field(repr=False, default=())

    @property
    def adopted(self) -> bool:
        """Whether the fit goes into the model."""
        return self.outcome == FOUND

    @property
    def times_noise(self) -> float:
        """What the fit leaves on held-out rows, in units of the noise."""
        return self.errors.after.total / self.errors.noise

    @property
    def exhibits(self) -> Exhibits:
        """The residuals as arrays, for pictures; there are no candidates."""
        traces = tuple(self._trace(h) for h in self.held)
        return Exhibits(held_out=True, traces=traces, spectrum=None)

    def _trace(self, h: Held) -> Trace:
        before = h.rows.mag - predicted(self.before, h.rows, h.before)
        after = h.rows.mag - predicted(self.after.calibration, h.rows, h.after)
        rows = h.rows
        return Trace(rows.name, rows.time, rows.segments, before, after, (0, 1, 2), rows.period)


def examined(
    start: Part,
    logs: list[Recording],
    others: list[Recording],
    found: Found,
    unfit: str,
    say: Callable[[str], None] = silent,
) -> Examined | str:
    """What the magnetometer of the logs shows, or why it was not examined; empty without one.

    ``found`` are the investigations of the other sensors: the reference's mounting and clock, which
    are those of the gyro, and which rows are held out. ``unfit`` says why a reference does not
    belong to the sensor.
    """
    seen = [r for r in (*logs, *others) if r.mag is not None]
    if not seen:
        return ""
    say("magnetometer against a constant field")
    reason = unfit or _unusable(seen)
    if reason:
        return f"the magnetometer was not examined: {reason}"
    made = {r.name: _rows(r, found) for r in seen if r.ref_q is not None}
    fitted, heads, held = _split(logs, others, made, found)
    few = _too_little(fitted, held)
    if few:
        return f"the magnetometer was not examined: {few}"
    return _judged(start, fitted, heads, held)


def _unusable(seen: list[Recording]) -> str:
    """Why no log's magnetometer can be compared with anything."""
    if not any(r.ref_q is not None for r in seen):
        return (
            "no reference attitude (ref_q) to turn a constant field by; pyimu characterize finds "
            "hard and soft iron by gravity, in a log that turns every way"
        )
    for r in seen:
        for finding in magnetometer_of(r, True).findings:
            what = {
                "mag_missing": "it has no sample",
                "mag_zeros": "it shows zeros alone",
                "mag_axis_missing": f"its axis {finding.detail.get('axes')} shows zeros alone",
            }.get(finding.kind)
            size = 1e6 * float(finding.detail.get("strength", np.nan))
            return f"{r.name}: {what or f'it shows {size:.4g} uT, the Earth has 22 to 67 uT'}"
    return ""


def _rows(r: Recording, found: Found) -> FieldRows | None:
    """A log's rows, with the reference's mounting and clock as the gyro shows them."""
    inv = found.get("gyro")
    state = None if inv is None else log_state(inv, r.name)
    if inv is None or state is None:
        return field_rows(r, np.eye(3), None)
    return field_rows(r, np.array(state["rotation"]), clock_of(inv, r.name))


def _split(
    logs: list[Recording],
    others: list[Recording],
    made: Mapping[str, FieldRows | None],
    found: Found,
) -> tuple[list[FieldRows], dict[str, FieldRows], list[FieldRows]]:
    """The rows to fit, those that tell a held-out log's own field, and those to judge by."""
    fitted, heads, held = [], {}, []
    for r in logs:
        rows = made.get(r.name)
        if rows is None:
            continue
        if others:
            fitted.append(rows)
            continue
        at = _held_from(r.name, found, rows)
        fitted.append(rows.between(-np.inf, at))
        held.append(rows.between(at))
    for rows in filter(None, (made.get(r.name) for r in others)):
        at = rows.time[0] + min(HEAD, 0.5 * float(np.ptp(rows.time)))
        heads[rows.name] = rows.between(-np.inf, at)
        held.append(rows.between(at))
    return [r for r in fitted if len(r)], heads, [r for r in held if len(r)]


def _held_from(name: str, found: Found, rows: FieldRows) -> float:
    """s; where the rows begin that are held out of a log."""
    trials = [t for inv in found.values() for t in inv.held if t.name == name]
    samples = [float(t.time[0]) for t in trials if t.reduction is None]
    if samples:
        return samples[0]
    return float(rows.time[min(int(len(rows) * (1 - HELD_OUT)), len(rows) - 1)])


def _too_little(fitted: list[FieldRows], held: list[FieldRows]) -> str:
    if not fitted or not held:
        return "no rows with both a sample and a reference attitude"
    count = sum(len(r.attitudes()) for r in fitted)
    turn = "turn it all round about all three of its axes"
    if count < LEAST * SHARED:
        return f"it was seen in {count} attitudes, at least {LEAST * SHARED} are needed: {turn}"
    if weakest(fitted) < WEAKEST:
        return (
            f"the attitudes that it was seen in do not tell hard iron, soft iron and field: {turn}"
        )
    return ""


def _judged(
    start: Part, fitted: list[FieldRows], heads: Mapping[str, FieldRows], held: list[FieldRows]
) -> Examined:
    declared = of_sensor(start.mag)
    before = declared or MagnetometerCalibration()
    found, plain = fit(fitted, before), fit(fitted, before, shared=False)
    pairs = []
    for rows in held:
        fields = []
        for c, of_fit in ((before, plain), (found.calibration, found)):
            if rows.name in heads:
                of_fit = fit([heads[rows.name]], c, shared=False)
            fields.append(of_fit.fields[rows.name])
        pairs.append(Held(rows, *fields))
    white = np.sqrt(np.nanmean([r.white**2 for r in fitted], axis=0))
    by_log = {h.rows.name: _errors(before, found.calibration, h) for h in pairs}
    each = list(by_log.values())
    gain, gate = _gain(before, found)
    seen = Examined(
        NOTHING,
        before,
        found,
        gain,
        gate,
        white,
        white * np.sqrt(np.median([r.period for r in fitted])),
        sum(each[1:], start=each[0]),
        by_log,
        tuple(pairs),
    )
    return replace(seen, outcome=_outcome(seen))


def _outcome(seen: Examined) -> str:
    if not seen.gain > seen.gate:
        return NOTHING
    if not seen.errors.after.total < seen.errors.before.total:
        return UNCONFIRMED
    return FOUND if seen.times_noise <= FAR else UNEVEN


def _gain(before: MagnetometerCalibration, found: FieldFit) -> tuple[float, float]:
    """The mean square of bias and shape against those before, in standard errors, and its limit.

    A ratio of variances: the factor of the covariance is known by so many blocks.
    """
    size = np.cbrt(np.linalg.det(before.matrix))
    off = np.zeros(SHARED)
    off[BIAS] = found.calibration.bias - before.bias
    off[MATRIX] = (found.calibration.matrix - before.matrix / size).ravel()
    gain = float(np.mean((shown(found.covariance) @ off) ** 2))
    freedom = DEGREES * (found.blocks - 1)
    return gain, float(fisher.ppf(1 - GATE, DEGREES, freedom))


def _errors(before: MagnetometerCalibration, after: MagnetometerCalibration, h: Held) -> Errors:
    sums = []
    for c, of_log in ((before, h.before), (after, h.after)):
        left = h.rows.mag - predicted(c, h.rows, of_log)
        sums.append(ErrorSums(np.sum(left**2, axis=0), np.full(3, float(len(left)))))
    rows = np.full(3, float(len(h.rows)))
    noise = np.nan_to_num(h.rows.white) ** 2 + np.nan_to_num(h.rows.turned) ** 2
    floor = ErrorSums(rows * noise, rows)
    return Errors("T", *sums, floor, ErrorSums())
