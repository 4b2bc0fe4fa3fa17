"""Forward selection for one sensor.

Screen, fit the best few in full, ask the held-out data, add, and look again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from pyimu.display.silent import silent
from pyimu.identification.fit.damping import Damped
from pyimu.identification.fit.errors_in_variables import has_noise
from pyimu.identification.fit.fit import Fit, Last, begin, gauss_newton
from pyimu.identification.fit.keys import Coefficient, Key, coefficients_of
from pyimu.identification.fit.limited import with_limited
from pyimu.identification.fit.maximum_likelihood import advantage, advantage_by_one_noise, fit
from pyimu.identification.fit.outweighed import without_outweighed
from pyimu.identification.fit.reduction import GAIN, STRUCTURE
from pyimu.identification.fit.reference_noise import (
    drawn_again,
    drawn_anew,
    undrawn,
    with_reference_noise,
)
from pyimu.identification.fit.scatter import wander_of, with_wander
from pyimu.identification.fit.trial import Doubt, Trial
from pyimu.identification.search.as_sampled import GATE, ceiling_of, threshold_of
from pyimu.identification.search.belief import unbelievable
from pyimu.identification.search.ceiling import has_ceiling, is_ceiling, unbent, without_lost
from pyimu.identification.search.choice import Refined, Tried, beside, chosen_of
from pyimu.identification.search.confirm import evidence
from pyimu.identification.search.damped import (
    damped,
    damped_trial,
    damps_by,
    means_over_a_period,
    sharp,
    sharp_trial,
)
from pyimu.identification.search.inexact import within_form
from pyimu.identification.search.investigation import Investigation, Refused, Step
from pyimu.identification.search.judge import OF_REFERENCE, judged
from pyimu.identification.search.left_out import LeftOut
from pyimu.identification.search.own_kinks import with_own_kinks
from pyimu.identification.search.own_lag import apart, beside_clocks, lag_beside_clocks, leaves_less
from pyimu.identification.search.reference_line import without_line
from pyimu.identification.search.screen import PENALTY, Screened, Screening, is_slow, keys_of
from pyimu.identification.search.taken_back import (
    backward,
    by_fewer,
    may_grow,
    scattering_at_last,
    with_intervals,
)
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects import EFFECTS
from pyimu.model.sensor import Sensor

MOST_LINES = 4
"""Lines that are taken out of a reference at most; an encoder's motion makes dozens, of which few
stand out."""

MOST_EFFECTS = 8

HALFWAY = 1 / 3
"""Share of the gate that one of two slow effects has to explain alone."""

STEPS = 6
"""Of least squares towards the places where forces act."""


def investigate(
    sensor: Sensor,
    free: frozenset,
    trials: list[Trial],
    held: list[Trial],
    say: Callable[[str], None] = silent,
    prior: Mapping[Coefficient, float] = MappingProxyType({}),
    unfit: str = "",
    believed: bool = False,
    lines: int = MOST_LINES,
    lags: bool = True,
) -> Investigation:
    """Find what ``sensor``, with coefficients ``free``, lacks to explain ``trials``, confirmed on
    ``held``; ``prior`` are standard deviations of coefficients that nobody declared, ``unfit`` why
    the reference does not belong to the sensor, so that nothing is looked for. What may be noise of
    the reference or what an effect left is ``believed`` to be the former, or told by the sensor's
    own signal; of lines that are the reference's so many are taken out of it at most. ``lags`` says
    whether a lag of the sensor's own that clocks may hide is looked for, which is long.
    """
    say(f"{sensor.kind}: fitting the model as declared")
    first = _first(begin(sensor, free, trials, prior), believed)
    before, apart = with_reference_noise(first, held, believed)
    before = fit(without_outweighed(before)) if before.echo else before
    if unfit:
        none = Screening((), np.inf)
        return Investigation(before, before, (), (), none, none, tuple(apart), unfit)
    if has_ceiling(sensor):
        before = without_lost(before)
        apart = [with_limited(sensor, t) for t in apart]
    search = _Search(before, sensor, apart, believed, lines, lags)
    while len(search.steps) < MOST_EFFECTS:
        known, count = len(search.steps), len(search.seen.candidates)
        say(f"{sensor.kind}: {known} added, trying {count} candidates")
        if not search.advance() or search.line is not None:
            break
    if search.line is not None:
        trials, held = without_line(search.line.fit, search.line.screened.effect, trials, held)
        return investigate(sensor, free, trials, held, say, prior, "", believed, lines - 1, lags)
    if not believed and _is_of_reference(search):
        return investigate(sensor, free, trials, held, say, prior, "", True, lines, lags)
    after, steps = backward(search.after, search.steps)
    after, steps, last = by_fewer(after, steps, search.last, sensor.values)
    after, steps = with_intervals(after, steps), scattering_at_last(after, steps, last)
    refused = tuple(search.refused.values())
    looks = search.first, last
    left = unbent(search.before, after), after, tuple(steps), refused, *looks, tuple(search.held)
    return Investigation(*left, believed=believed)


def _first(start: Fit, believed: bool) -> Fit:
    """The first fit of a model.

    The noise that its references show before anything is fitted is taken out of it: beside that a
    scale factor would go to where it leaves less of the noise, and not of the motion, and a random
    walk would stand for the motion then.
    """
    start = _in_place(start)
    known, _ = with_reference_noise(start, [], believed)
    if not has_noise(known):
        return fit(start)
    return undrawn(fit(without_outweighed(known, fitted=False)))


def _in_place(start: Fit) -> Fit:
    """A model with what belongs to its logs alone fitted, where a force acts at a place that is to
    be found: what an arm and a heading leave of the motion is no noise of a reference. Beside
    positions whose scale is not known free gains of the sensor are fitted with them: alone it would
    take a part of these that gravity contradicts.
    """
    if all(t.place is None for t in start.trials):
        return start
    scaled = any(t.place is not None and t.place.scale_std for t in start.trials)
    gains = {k for k in start.free if scaled and _is_gain(k)}
    placed = replace(start, free=frozenset(gains))
    for _ in range(2 if gains else 1):
        placed = gauss_newton(placed, STEPS)
        placed = replace(placed, last=Last()).with_noise()
    return replace(placed, free=start.free, last=Last())


def _is_gain(key: Key) -> bool:
    return isinstance(key, Coefficient) and key.effect == GAIN


def _is_of_reference(search: _Search) -> bool:
    """Whether what a search ran into, or left with nothing found, is the reference's noise."""
    if any(r.reason == OF_REFERENCE for r in search.refused.values()):
        return True
    doubts = [t.doubt for t in search.after.trials if t.doubt]
    return bool(doubts) and not search.steps and min(doubts) is Doubt.LIKELY


class _Search:
    """The way from the model before to the one after: what was added and refused so far, and the
    candidates beside it as they were ``first`` and ``last`` seen; ``line`` is one that turned out
    to be the reference's.
    """

    def __init__(
        self,
        before: Fit,
        sensor: Sensor,
        held: list[Trial],
        believed: bool = False,
        lines: int = MOST_LINES,
        lags: bool = True,
    ) -> None:
        self.before, self.sensor, self.held = before, sensor, held
        self.believed, self.lines = believed, lines
        self.line: Refined | None = None
        self.lags = lags
        self.damping: Damped | None = None
        self.without_lag: Fit | None = None
        self.after, self.steps = _as_sampled(before, held)
        if self.steps and any(t.limited is not None for t in self.after.trials):
            # What was left at the limit is no noise of the reference.
            self.held = [with_limited(self.after.sensor, t) for t in held]
            self.after, self.held = drawn_anew(self.after, self.held, believed)
            self.after = fit(self.after)
        self.refused: dict[str, Refused] = {}
        self.kept_out: set[Coefficient] = set()
        self.left_out = self._left_out()
        self.tried = Tried(self.after, sensor.values)
        self.first = self.last = self.seen = self.tried.looked()[0]
        self._lags()

    def _lags(self) -> bool:
        """Take in a lag that clocks may hide, or refuse it, and heed what damps the motion then;
        False where nothing is changed.
        """
        if not self.lags or self.after is self.without_lag:
            return False
        plain = sharp(self.after)
        means = means_over_a_period(plain, self.seen.gate)
        found = None if means else lag_beside_clocks(plain, self.seen.gate)
        if found is None:
            changed = self._damp()
            self.without_lag = self.after
            return changed
        self.lags = False
        # Where all that the sensor is late may be its own, one coefficient may do for both.
        own = any(t.clock.own for t in self.after.trials)
        alone = chosen_of(self.tried, self.seen.above(), self.seen.gate)[0] if own else None
        if alone is not None and not leaves_less(found.lag.fit, alone.fit):
            return False
        held = [apart(sharp_trial(t)) for t in self.held]
        chosen, reason = judged(Tried(found.wide, self.sensor.values), found.lag, held, GATE)
        if reason:
            self._refuse(chosen, reason)
            return self._damp()
        self.before = beside_clocks(sharp(self.before))
        self.held, self.damping = held, None
        self._add(chosen, found.alternatives)
        return True

    def _damp(self) -> bool:
        """Heed what damps the motion where no lag does, or more of it beside what has come in
        since, which had bent it, too; False where nothing more does, or where the samples are no
        likelier by it: to its spectrum alone, a slow error may look so.
        """
        more, was = damps_by(self.after, self.seen.gate), self.damping
        if more is None:
            return False
        by = more if was is None else replace(more, falls=more.falls + was.falls)
        after = damped(self.after, by)
        if advantage_by_one_noise(after, self.after) <= 0.0:
            return False
        self.damping, self.before = by, damped(self.before, by)
        self.held = [damped_trial(t, by) for t in self.held]
        self._goes_on(after)
        self.first = self.seen if was is None else self.first
        return True

    def _refuse(self, chosen: Refined, reason: str) -> None:
        name = chosen.screened.effect
        beyond = bool(unbelievable(chosen.fit, keys_of(chosen.screened)))
        self.refused[name] = Refused(name, chosen.gain, reason, beyond)

    def advance(self) -> bool:
        """Take the next candidate in, refuse it, or look by the next view; False where there is
        none left.
        """
        options = [c for c in self.seen.above() if c.effect not in self.refused]
        options = _in_order(options, self.after)
        most = max((c.gain for c in options), default=0.0)
        if self._grows(max(self.seen.gate, self._likelier_than(most)), self.seen.gate):
            return True
        chosen, names = chosen_of(self.tried, options, self.seen.gate)
        if chosen is None:
            return self._looks_again() or self._lags() or self._two_at_once()
        instead = max(self._likelier_than(chosen.gain), 0.0)
        if self._grows(instead, instead):
            return True
        reason = within_form(chosen, self.steps, self.after)
        if not reason:
            chosen, reason = judged(self.tried, chosen, self.held, self.seen.gate)
        name = chosen.screened.effect
        if reason == OF_REFERENCE and CATALOGUE[name].is_line and self.lines:
            self.line = chosen
        if reason:
            self._refuse(chosen, reason)
        else:
            self._add(chosen, names)
        return True

    def _likelier_than(self, gain: float) -> float:
        """What an element of an effect that is in the model must explain [nat] to be likelier than
        a candidate that explains ``gain``: of those there are many, and each is as likely
        beforehand. What is left of an effect is no other one.
        """
        return gain - float(np.log(max(len(self.seen.candidates), 1)))

    def _grows(self, above: float, gate: float) -> bool:
        """Let in an element of an effect that is in the model where it explains more than ``above``
        [nat] at first look, and more than ``gate`` once fitted.
        """
        if self.left_out is None:
            return False
        keys, first, spread = self.left_out.largest(self.kept_out)
        if first <= above:
            return False
        fitted = fit(replace(self.after, free=self.after.free | keys).with_noise())
        gain = advantage(fitted, self.after) / spread - PENALTY * len(keys)
        seen = evidence(self.after, fitted, self.held)
        (name,) = {k.effect for k in keys}
        held = float(seen.gained.sum()) / spread
        denied = seen.raises or gain + held <= gate
        if denied or unbelievable(fitted, coefficients_of(fitted.sensor, name) & fitted.free):
            self.kept_out |= keys
            return True
        self.steps = [
            replace(s, keys=s.keys | keys, gain=s.gain + gain) if s.effect == name else s
            for s in self.steps
        ]
        self._goes_on(self._sharp_again(fitted))
        return True

    def _left_out(self) -> LeftOut | None:
        """The elements that effects in the model may grow by; a formula of the user's own, too."""
        added = [s.effect for s in self.steps if not s.declared]
        free = {k.effect for k in self.before.free if isinstance(k, Coefficient)}
        own = sorted(e for e in free if CATALOGUE[e] not in EFFECTS)
        few = [e for e in (*added, *own) if may_grow(e, self.after)]
        return LeftOut.of(self.after.as_declared(), few)

    def _looks_again(self) -> bool:
        if not self.tried.views:
            return False
        self.seen, slow = self.tried.looked()
        self.last = self.last if slow else self.seen
        return True

    def _add(self, chosen: Refined, alternatives: tuple[str, ...]) -> None:
        self.steps.append(self._step(chosen, alternatives))
        clipped = is_ceiling(chosen.fit.sensor, chosen.screened.effect)
        if clipped:
            self.held = [with_limited(chosen.fit.sensor, t) for t in self.held]
        self._goes_on(self._sharp_again(without_lost(chosen.fit) if clipped else chosen.fit))

    def _step(self, chosen: Refined, alternatives: tuple[str, ...]) -> Step:
        name = chosen.screened.effect
        return Step(
            name,
            keys_of(chosen.screened),
            chosen.gain,
            self.seen.gate,
            alternatives,
            chosen.dispersion,
            name in self.before.sensor.values,
            fitted=self.tried.gains,
        )

    def _two_at_once(self) -> bool:
        """Take two slow effects in that hide each other: beside a walk whose size nobody knows each
        is a part of what the other leaves, and neither explains enough alone. Beside the other each
        has to pass the gate and the held-out rows; False where no two do. Those are tried that come
        to ``HALFWAY`` alone: the search is as long as a step for each, and beside a derived
        reference it is not made, whose noise makes it long.
        """
        if any(t.band_hz is not None for t in self.after.trials):
            return False
        some = [r for name, r in self.tried.refined.items() if is_slow(CATALOGUE[name])]
        for one in sorted(some, key=lambda r: -r.gain):
            if one.gain < HALFWAY * self.seen.gate:
                return False
            other = self._slow_beside(one.fit)
            back = self._slow_beside(beside(self.after, other[0].screened)) if other else None
            if other and back:
                self.steps.append(self._step(*other))
                self._add(*back)
                return True
        return False

    def _slow_beside(self, after: Fit) -> tuple[Refined, tuple[str, ...]] | None:
        """The slow candidate that stands beside a model, by any view, and the names of those that
        explain as much; None where none does.
        """
        tried = Tried(after, self.sensor.values)
        tried.views = [(view, True) for view, _ in tried.views]
        while tried.views:
            seen, _ = tried.looked()
            gate = max(seen.gate, self.seen.gate)
            options = [c for c in seen.above() if c.effect not in self.refused]
            chosen, names = chosen_of(tried, options, gate)
            if chosen is not None:
                chosen, reason = judged(tried, chosen, self.held, gate)
                return None if reason else (chosen, names)
        return None

    def _sharp_again(self, after: Fit) -> Fit:
        """A model beside the motion as it was, where that is likelier now: what has come in since
        explains what had looked as if the sensor damped it.
        """
        if self.damping is None:
            return after
        plain = sharp(after)
        if advantage_by_one_noise(after, plain) > 0.0:
            return after
        self.damping = None
        self.before, self.held = sharp(self.before), list(map(sharp_trial, self.held))
        return plain

    def _goes_on(self, after: Fit) -> None:
        """Look for more beside a model."""
        if after.is_reduced:
            self.held = [with_wander(t, wander_of(after.trials[0])) for t in self.held]
        known, self.held = drawn_again(after, self.held, self.believed)
        self.after = after if known is after else fit(known)
        self.after, self.held = with_own_kinks(self.after, self.held)
        self.tried = Tried(self.after, self.sensor.values)
        self.left_out = self._left_out()
        self.last = self.seen = self.tried.looked()[0]


def _as_sampled(before: Fit, held: list[Trial]) -> tuple[Fit, list[Step]]:
    """A model with what the samples themselves say of the output."""
    after, steps = before, []
    for look in (threshold_of, ceiling_of):
        read = look(after, held)
        if read is not None:
            read, after = read.borne_out(after)
        if read is not None:
            after = without_lost(after) if is_ceiling(after.sensor, read.effect) else after
            found = (read.effect, read.keys, read.gain, GATE, read.alternatives, 1.0)
            steps.append(Step(*found, as_sampled=True))
    return after, steps


def _in_order(options: list[Screened], fit: Fit) -> list[Screened]:
    """The candidates that come first where rows are stretches of a log: gains before all else.

    So few rows hardly tell a bend from a slope, and slopes are the commoner (effect hierarchy, Wu
    and Hamada 2009, section 4.6).
    """
    if not fit.is_reduced:
        return options
    return [c for c in options if c.effect in STRUCTURE] or options
