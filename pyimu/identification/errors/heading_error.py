"""What a model and a clock are worth to the heading of a vehicle.

The integrated gyro against the reference's heading or course.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.identification.fit.columns import residual
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.score import WINDOW, held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.reference.clock import shifted
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.taken_back import without
from pyimu.identification.verdict.fates import TURNED_BACK
from pyimu.recording.reference.rate import VERTICAL

FAR = 1.2
"""Times the error before that is no chance, however few turns there are."""


def heading_rms(inv: Investigation | None) -> tuple[float, float] | None:
    """RMS error [rad] of the gyro's integrated heading over the held-out rows.

    Of the model before with the clock as it was logged, and of the model after with the clock that
    was found; None where no reference saw a heading.
    """
    held = [t for t in (inv.held if inv is not None else ()) if t.reference in VERTICAL]
    before = _rms([heading_error(inv.before, as_logged(t)) for t in held])
    after = _rms([heading_error(inv.after, t) for t in held])
    return None if before is None or after is None else (before, after)


def with_better_heading(inv: Investigation) -> Investigation:
    """An investigation less the effects that make the heading of held-out rows clearly worse."""
    held = [t for t in inv.held if t.reference in VERTICAL]
    before = _rms([heading_error(inv.before, t) for t in held])
    while held and before:
        now = _rms([heading_error(inv.after, t) for t in held])
        if not inv.removable or now is None or now <= FAR * before:
            return inv
        others = {n: without(inv, n, "") for n in inv.removable}
        errors = {n: _rms([heading_error(o.after, t) for t in held]) for n, o in others.items()}
        best = min(errors, key=lambda n: errors[n])
        if errors[best] >= now:
            return inv
        degrees = [f"{np.degrees(v):.2f}" for v in (errors[best], now)]
        inv = without(inv, best, f"{TURNED_BACK}, {degrees[0]} to {degrees[1]} deg")
    return inv


def heading_error(fit: Fit, trial: Trial) -> np.ndarray:
    """The heading of a one-axis ``trial`` by the gyro less that of its reference, (m,) rad.

    In its band, over the stretches that are known for longer than ``WINDOW``.

    What no model knows is taken out: the heading at which a stretch begins, for a vehicle may turn
    on the spot or reverse between, and one constant rate, that of the bias at power-on.
    """
    state, rest = held_state(fit, trial)
    (axis,) = rest.axes
    rate = residual(fit.sensor, rest, state)[:, axis] / abs(rest.up[axis])
    parts = []
    for a, b in rest.segments:
        if rest.time[b - 1] - rest.time[a] > WINDOW:
            angle = np.column_stack([rest.h * np.cumsum(rate[a:b]), rest.time[a:b]])
            parts.append(rest.band.apply(angle, [(0, b - a)]))
    parts = [p - p.mean(axis=0) for p in parts if len(p)]
    if not parts:
        return np.zeros(0)
    angle, time = np.concatenate(parts).T
    return angle - time * (angle @ time) / max(time @ time, 1e-300)


def as_logged(trial: Trial) -> Trial:
    """The trial with its reference on its own clock again."""
    if trial.clock is None or not trial.clock.taken_out:
        return trial
    return replace(shifted(trial, trial.clock.back()), clock=None)


def _rms(errors: list[np.ndarray]) -> float | None:
    rows = sum(map(len, errors))
    return float(np.sqrt(sum(e @ e for e in errors) / rows)) if rows else None
