"""Whether a reference belongs to the sensor that it is compared with, by what they show alone."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.trial import TURNS, Trial
from pyimu.identification.reference.clock import are_still
from pyimu.identification.reference.moving import (
    LEAST_ROWS,
    in_own_band,
    moving_pair,
    turned_onto,
)
from pyimu.identification.search.belief import most
from pyimu.model.kinds import KINDS, OWN
from pyimu.recording.quality.clipping import clipped
from pyimu.recording.reference.band import COHERENCE, LEAST_BAND
from pyimu.recording.reference.rate import VERTICAL
from pyimu.recording.rest import ONE_SHOCK, RARE, seconds_of
from pyimu.report.numbers import number, quantity
from pyimu.units import STANDARD_GRAVITY

UNITS = {
    "gyro": (float(np.degrees(1.0)), ("rad", "deg")),
    "accel": (STANDARD_GRAVITY, ("g", "m/s^2")),
}
"""By sensor: the factor between two units that are taken for each other, of which the first has the
smaller numbers."""

ALIKE = 0.1
"""How near a factor must be to one that is a mistake of units."""

CUT = 0.05
"""Share of rows at the limit of a sensor's range that are a reason for what no reference shows."""

UNFIT = 0.5
"""Share of the sensor's moving power below which a reference does not belong to the sensor."""

FOLLOWS, SURELY = 0.5, 5.0
"""Share of a reference's motion that a sensor must show to follow it, and how many standard errors
of the share that must be: vibration hides a motion that is smaller, and its band shows it."""


def misfit(trials: Iterable[Trial]) -> str:
    """Why the reference of one of the trials does not belong to its sensor; nothing where all
    do.
    """
    trials = list(trials)
    alone = next(filter(None, map(moves_alone, trials)), "")
    if alone:
        return alone
    for t in trials:
        mistake = mistaken(t) if t.clock is not None or _shows_turns(t) else ""
        if mistake:
            return f"the reference of {t.name} {mistake}"
    clocked = (t for t in trials if t.clock is not None)
    return next(filter(None, (too_little(t, t.clock.explained) for t in clocked)), "")


def _shows_turns(trial: Trial) -> bool:
    """Whether a reference shows all of a gyro's motion, the clock of either known or not: beside
    numbers of another size none is found.
    """
    return trial.kind == "gyro" and trial.reference in TURNS and trial.reduction is None


def moves_alone(trial: Trial) -> str:
    """Which of sensor and reference moves while the other stands still; nothing where neither does
    so, or the sensor follows the reference below its own noise. A sensor moves that goes further
    from its median than temperature takes any.
    """
    if trial.reference == "static" or trial.reduction is not None or trial.clock is not None:
        return ""
    axes = list(trial.axes)
    shown = {"reference": trial.u[:, OWN[trial.kind]][:, axes], f"{trial.kind}": trial.y[:, axes]}
    band = in_own_band(trial)
    still = dict(zip(shown, are_still(band, *shown.values()), strict=True))
    far = {who: _farthest(trial, v) for who, v in shown.items()}
    for mover, other in (tuple(shown), tuple(shown)[::-1]):
        if still[other] and far[mover] and not _follows(band, *shown.values()):
            most = quantity(far[mover], KINDS[trial.kind].unit, 2)
            its = f"the {other} of {trial.name}"
            return f"{its} stands still while the {mover} goes {most} from its median"
    return ""


def _follows(trial: Trial, reference: np.ndarray, sensor: np.ndarray) -> bool:
    """Whether a sensor (n, axes) shows the motion of a reference (n, axes) in a trial's band."""
    x, y = (in_band(trial, v - v.mean(axis=0)) for v in (reference, sensor))
    if trial.free_rotation and len(trial.axes) == 3:
        x = x @ turned_onto(x, y)
    power = float(np.sum(x**2))
    if power == 0.0:
        return False
    share = float(np.sum(x * y)) / power
    error = float(np.sqrt(np.sum((y - share * x) ** 2) / (x.size * power)))
    return share > max(FOLLOWS, SURELY * error)


def _farthest(trial: Trial, values: np.ndarray) -> float:
    """How far a second's mean of a column goes from the median; zero where that is no motion."""
    far = 0.0
    for column in values.T:
        seconds = seconds_of(column, trial.segments, trial.h)
        if np.count_nonzero(seconds.far(trial.kind)) > max(RARE * len(seconds.mean), ONE_SHOCK):
            far = max(far, float(np.abs(seconds.mean - np.median(seconds.mean)).max()))
    return far


def too_little(trial: Trial, share: float) -> str:
    """Why a reference does not belong to its sensor that accounts for a ``share`` of its power;
    nothing where it may.
    """
    if share >= (COHERENCE if _coheres_nowhere(trial) else UNFIT):
        return ""
    course = ", or it moves otherwise than ahead: its course is then no heading"
    cut = float(np.mean(np.any([clipped(trial.y[:, axis]) for axis in trial.axes], axis=0)))
    if cut > CUT:
        return (
            f"the reference of {trial.name} accounts for {max(share, 0.0):.0%} of what the "
            f"{trial.kind} shows, and {cut:.0%} of the rows lie at the limit of its range, beyond "
            "which it shows nothing: move it less, or set a larger range"
        )
    return (
        f"the reference of {trial.name} accounts for {max(share, 0.0):.0%} of what the "
        f"{trial.kind} shows: another body, another time, or other axes"
        f"{course if trial.reference == 'course' else ''}"
    )


def _coheres_nowhere(trial: Trial) -> bool:
    """Whether sensor and reference agree in no band, so that they are compared in the least."""
    least = trial.band_hz is not None and trial.band_hz < LEAST_BAND
    return least and trial.band_limit is not None and trial.band_limit > LEAST_BAND


def mistaken(trial: Trial) -> str:
    """What is wrong with the reference of a trial that would fit once that is put right.

    Mirrored axes, an axis that counts the other way, or numbers of another size than any scale
    factor makes; nothing where none is.
    """
    axes = list(trial.axes)
    x, y = moving_pair(trial)
    if len(y) < LEAST_ROWS:
        return ""
    x, y = x - x.mean(axis=0), y - y.mean(axis=0)
    triad = len(axes) == 3
    turned, flipped = (
        _scaled(a * x @ (turned_onto(a * x, y) if triad else np.eye(len(axes))), y)
        for a in (1.0, -1.0)
    )
    if triad and turned[1] < COHERENCE <= flipped[1] and abs(flipped[0] - 1) < ALIKE:
        return "has mirrored axes: its frame is turned into the sensor's by a determinant of -1"
    if not triad and flipped[1] >= COHERENCE and abs(flipped[0] - 1) < ALIKE:
        if trial.reference == "course":
            return "is mirrored: its east and north are swapped, or one has the other sign"
        return (
            "counts the other way: a heading grows counterclockwise seen from above, and the "
            "sensor's z points up"
        )
    if triad or turned[0] > 0:
        return _sized(trial, *turned)
    return ""


def _sized(trial: Trial, factor: float, share: float) -> str:
    """Why numbers are of another size where the reference, ``factor`` times as large, explains the
    ``share`` of the sensor's power; nothing where a sensor may have that scale.
    """
    times = max(factor, 1 / max(factor, 1e-300))
    if share < COHERENCE or times < 1 + most("scale_factor", trial.kind, "s"):
        return ""
    off, kind = "small" if factor > 1 else "large", trial.kind
    unit, (small, large) = UNITS[kind]
    if abs(times / unit - 1) < ALIKE:
        units, others = (small, large) if factor > 1 else (large, small)
        why = f"its numbers are in {units}, or the {kind}'s in {others}"
    else:
        leans = ", or its z is not vertical" if trial.reference in VERTICAL else ""
        why = f"it, or the {kind}, has another unit or range than its header says{leans}"
    return f"is too {off} by {number(times, 3)}: {why}"


def _scaled(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """The factor of x (m, 3) nearest to y, and the share of the power of y that it explains."""
    factor = float(np.sum(x * y) / max(np.sum(x * x), 1e-300))
    return factor, 1 - float(np.sum((y - factor * x) ** 2) / max(np.sum(y * y), 1e-300))
