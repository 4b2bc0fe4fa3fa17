"""A lag of the sensor's own beside the references' clocks.

A clock takes the delay of a low-pass filter with it. What it leaves is a gain that falls with the
square of the frequency, by b^2 / 2 of a filter of first order with the time constant b: a lag is
seen by that alone. Its delay and the clock are fitted together, and not from none on, where that
has no slope.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pyimu.identification.fit.clock import LONGEST_OWN
from pyimu.identification.fit.damping import damping
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import LogState, copied, own_rate
from pyimu.identification.fit.interpolated import TAPS, delayed
from pyimu.identification.fit.keys import Coefficient, coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.trial import Trial
from pyimu.identification.search.candidates import Choice, Group, absent
from pyimu.identification.search.choice import (
    SET_WIDTH,
    Refined,
    ahead,
    plainest_form,
    promise,
    refine,
    share_left,
)
from pyimu.identification.search.screen import Screened
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.kinds import OWN
from pyimu.recording.reference.rate import VERTICAL
from pyimu.recording.reference.unsmoothed import SMOOTHED

MERE = "time_delay"
"""What a clock stands for in full."""

SURE = 5.0
"""Standard errors that a lag is long at least."""

LEAST = 0.1
"""Share of the power that a model leaves which a lag must explain: what is less may be what the
motion, the clock or the noise of the reference does to a gain at high frequencies."""

MOST_OF = 0.5
"""Share of what a lag must explain that the plainest form must, for others to be looked at."""

RINGS = 4.0
"""Standard errors by which the damping of a filter may be below that of one that is flat."""

STARTS = 0.006, 0.025
"""s; delays to begin with, within a factor of two of nearly all."""


@dataclass(frozen=True)
class Beside:
    """A ``lag`` that explains most beside clocks that may be off by it, in a model without it
    (``wide``); ``alternatives`` are other forms that explain as much.
    """

    wide: Fit
    lag: Refined
    alternatives: tuple[str, ...]


def lag_beside_clocks(current: Fit, gate: float) -> Beside | None:
    """The form of a lag that explains more than ``gate`` [nat] beside clocks that may be off by it;
    None where none does.
    """
    forms = _forms(current)
    hides = all(map(may_hide_a_lag, current.trials))
    if not forms or not hides or not _damps_more(damping(current), gate):
        return None
    wide = beside_clocks(current)
    # By the reference, whose noise damps, too, the sensor damps more than it does.
    shown = damping(wide, by_sensor=True)
    if not _damps_more(shown, gate):
        return None
    # Whatever the filter, a first-order one explains much of what it does, and is found at once.
    plainest, *others = sorted(forms, key=lambda e: len(coefficients_of(wide.sensor, e.name)))
    first = _found(wide, plainest)
    if first.gain <= 0.0 or share_left(first.fit, wide) > 1.0 - MOST_OF * LEAST:
        return None
    found = [first, *(_found(wide, e) for e in others)]
    above = gate + np.log(len(forms) * len(STARTS))
    found = [r for r in found if r.gain > above and _damps(r) and _is_seen(r, wide, shown[0])]
    if not found:
        return None
    best = plainest_form(found)
    close = [r.screened.effect for r in found if r is not best and ahead(best, r) <= SET_WIDTH]
    return Beside(wide, best, tuple(close))


def _damps_more(seen: tuple[float, float], gate: float) -> bool:
    gain, falls = seen
    return falls > 0.0 and gain > gate


def leaves_less(one: Fit, other: Fit) -> bool:
    """Whether a model leaves less than another by ``LEAST``."""
    return share_left(one, other) < 1.0 - LEAST


def _is_seen(found: Refined, wide: Fit, shown: float) -> bool:
    """Whether a lag is one that a sensor may have, is known to a ``SURE`` part of itself, and
    leaves less, by the motion that the sensor shows, too: there the ``shown`` gain [nat] of what
    is damped must have fallen.
    """
    name, fitted = found.screened.effect, found.fit
    (sought,) = (n for n, p in CATALOGUE[name].parameters.items() if p.sought)
    std = fitted.std.get(Coefficient(name, sought, ()), np.inf)
    known = SURE * std < float(fitted.sensor.values[name][sought])
    known &= damping(fitted, by_sensor=True)[0] < shown
    return fitted.sensor.delay(name) < LONGEST_OWN and known and leaves_less(fitted, wide)


def beside_clocks(current: Fit) -> Fit:
    """A model beside clocks that may be off by as much as a lag of the sensor."""
    return fit(replace(current, trials=tuple(map(apart, current.trials))).with_noise())


def has_lag(before: Fit) -> bool:
    """Whether the model that an investigation began with is ``beside_clocks``: a lag was found
    then.
    """
    return any(t.clock is not None and t.clock.apart for t in before.trials)


def _forms(current: Fit) -> list[Effect]:
    """Effects that delay, and damp what is quick."""
    if current.sensor.kind != "gyro" or current.is_reduced:
        return []
    return [e for e in absent(current) if e.delay is not None and e.name != MERE]


def may_hide_a_lag(trial: Trial) -> bool:
    """Whether a trial's clock may hide the delay of a lag. That of a point that is tracked turns
    otherwise than the vehicle, and what was smoothed is damped itself.
    """
    clock = trial.clock
    return (
        trial.place is None
        and trial.reference not in VERTICAL
        and clock is not None
        and clock.is_seen
        and clock.is_steady
        and not any(f.kind == SMOOTHED for f in trial.findings)
    )


def apart(trial: Trial) -> Trial:
    """The trial with a clock that may be off by a lag, all of its own lag taken out of the
    reference, less the rows at the ends of its segments that are interpolated from what is not
    there; one whose clock was not seen, or is so already, as it is.
    """
    clock = trial.clock
    if not may_hide_a_lag(trial) or clock.apart:
        return trial
    less = int(np.ceil(LONGEST_OWN / trial.h)) + TAPS
    kept = [(a + less, b - less) for a, b in trial.segments if b - a > 3 * less]
    u = copied(trial.u)
    for at in (OWN[trial.kind], own_rate(trial.kind)) if clock.own else ():
        u[:, at] = delayed(trial.u[:, at], clock.own / trial.h)
    whole = replace(clock, late=clock.late + clock.own, own=0.0, taken_out=True, apart=LONGEST_OWN)
    return replace(trial, u=u, clock=whole, segments=kept or trial.segments)


def _found(wide: Fit, e: Effect) -> Refined:
    """An effect beside the clocks, fitted from where it promises most."""
    starts = [_from(wide, e, delay) for delay in STARTS]
    start, c = max(starts, key=lambda one: promise(one[1], one[0], wide))
    return refine(start, c)


def _from(current: Fit, e: Effect, delay: float) -> tuple[Fit, Screened]:
    """An effect that begins with a ``delay`` in s, beside the clocks that are less by it."""
    name, parameter = next((n, p) for n, p in e.parameters.items() if p.sought)
    identity = {n: float(np.mean(v)) for n, v in e.start().items()}
    # A time constant is in proportion to the delay, a frequency to one over it.
    one = float(e.delay(**{**identity, name: 1.0}))
    value = delay / one if parameter.scan.measure == "period" else one / delay
    keys = tuple(sorted(coefficients_of(current.sensor, e.name)))
    group = Group(e.name, keys, (Choice((), value),))
    start = Screened(e.name, 0.0, (group,), {(): value}, np.nan)
    states = {name: _later(s, -delay) for name, s in current.states.items()}
    return replace(current, states=states), start


def _later(state: LogState, seconds: float) -> LogState:
    return replace(state, clock=state.clock and state.clock.moved(0, seconds))


def _damps(found: Refined) -> bool:
    """Whether a filter may pass no frequency better than rest: one that clearly rings stands for
    what makes the reference damp.
    """
    name, fitted = found.screened.effect, found.fit
    if "zeta" not in fitted.sensor.values[name]:
        return True
    std = fitted.std.get(Coefficient(name, "zeta", ()), 0.0)
    return float(fitted.sensor.values[name]["zeta"]) + RINGS * std >= np.sqrt(0.5)
