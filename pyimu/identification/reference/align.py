"""Whose delay it is.

What the logs' clocks say together, and the logs with their references on the sensor's clock.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from pyimu.errors import Finding
from pyimu.identification.fit.clock import LONGEST_OWN, Clock
from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.keys import LogClock, coefficients_of
from pyimu.identification.fit.maximum_likelihood import advantage, advantage_by_one_noise, fit
from pyimu.identification.fit.structure import prior_of, with_structure
from pyimu.identification.fit.trial import Trial, leaves_a_lag, marked
from pyimu.identification.reference.clock import explained_by, measure, rebanded, shifted
from pyimu.identification.reference.place import placed
from pyimu.identification.reference.slips import placed_slips
from pyimu.identification.reference.track import WANDERS
from pyimu.model.sensor import Sensor
from pyimu.recording.clock import runs

SIGNIFICANT = 5.0
"""Standard errors from which on a lag is no chance."""

DOUBTFUL = 3.0
"""Standard errors within which a log that shows no lag by itself must have that of the others, and
beyond which one that seems to change is none by chance."""

LIKELIER = 3.5
"""Standard errors of a drift from which on a line is likelier than one lag by the 6 nat that an
effect must explain."""

BENDS = ("scale_factor_asymmetry", "scale_factor_nonlinearity", "scale_factor_cubic")
"""What bends the response of a sensor to its own signal."""

ALIKE = 0.1
"""Logs whose lags differ by less than this share of their mean have one in common."""


def aligned(
    trials: Sequence[Trial],
    held: Sequence[Trial],
    sensor: Sensor,
    lines: bool = True,
    known: Mapping[str, Clock] = MappingProxyType({}),
    may_be_late: bool = True,
) -> list[Trial]:
    """All trials, fitted and ``held``, with the reference's clock taken out; ``known`` is that of
    logs, by name, that another sensor showed: it counts where this one shows none.

    As far as it is the reference's; their ``clock`` and ``findings`` say what was taken out.

    A lag may be the sensor's own where all fitted logs have it in common and the sensor is late. It
    is left in then, for the effects that make one; beside references in files of their own, on
    another clock, where a second log, fitted or held, has it too. The clock's is what differs from
    log to log, wanders, makes the sensor early, is longer than any sensor's, or lies beside a clock
    that somebody set, a lag that was undone, or samples that waited to be read in bursts, and all
    where the sensor is not one that ``may_be_late``. A clock that seems to drift or to wander by
    less than a sample is ``doubtful``, and has one lag where ``lines`` are not wanted.
    """
    clocks = [_clock(t, sensor, lines) for t in trials]
    clocks += [_clock(t, sensor, lines, apart=True) for t in held]
    both = zip((*trials, *held), clocks, strict=True)
    clocks = [_or_known(t, c, known.get(t.name)) for t, c in both]
    seen, others = _seen(clocks[: len(trials)]), _seen(clocks[len(trials) :])
    theirs = not may_be_late or any(leaves_a_lag(f) for t in trials for f in t.findings)
    own, std = 0.0 if theirs else in_common(seen), _std_of_mean(seen)
    if own and len(seen) == 1 and any(t.reference_apart for t in trials):
        clocks = [c and replace(c, or_sensor=not others) for c in clocks]
        own = own if others and in_common([*seen, *others]) else 0.0
    return [_aligned(t, c, own, std) for t, c in zip((*trials, *held), clocks, strict=True)]


def _seen(clocks: Sequence[Clock | None]) -> list[Clock]:
    return [c for c in clocks if c is not None and c.is_seen]


def _or_known(trial: Trial, clock: Clock | None, known: Clock | None) -> Clock | None:
    """The clock of a trial, or, where that is known no better than any sensor may lag, or further
    off than any does, the one that is ``known`` of its log, if that leaves less, or nothing else
    tells: vibration hides the motion from a sensor until its reference is on time.
    """
    if known is None or trial.reference == "static" or trial.reduction is not None:
        return clock
    if clock is not None and max(clock.std, abs(clock.mean - known.mean)) < LONGEST_OWN:
        return clock
    explained = explained_by(rebanded(placed(shifted(trial, known))))
    least = -np.inf if clock is None else clock.explained
    return replace(known, explained=explained) if explained > least else clock


def _clock(trial: Trial, sensor: Sensor, lines: bool, apart: bool = False) -> Clock | None:
    clock = placed_slips(trial, _level(measure(trial, sensor)), sensor)
    return _borne_out(trial, clock, sensor, lines, apart)


def _level(clock: Clock | None) -> Clock | None:
    """One lag where it may be the sensor's and changes by little of itself: a lag of the sensor is
    another at each frequency, and so wherever the motion is another.
    """
    if clock is None or clock.keeps_step or not clock.is_seen:
        return clock
    apart = float(np.ptp(clock.late))
    if apart >= ALIKE * abs(clock.mean) or abs(clock.mean) > LONGEST_OWN:
        return clock
    return clock.kept_in_step()


def _borne_out(
    trial: Trial, clock: Clock | None, sensor: Sensor, lines: bool, apart: bool
) -> Clock | None:
    """One lag where a lag that changes does not explain the samples better than one does beside
    what bends the sensor's own response, or a line through it, as where windows show none.

    Of steps from rate to rate a bent scale factor looks late, by as much more as they are larger.
    By less than a sample a lag must change better than one beside a straight response, too.
    Windows weigh a bias that wanders by its size alone; all rows together know its spectrum, and
    the mean of the lags that it bends. A line about a lag that is plain is found by the fit of its
    log, if that is not held ``apart``.
    """
    if clock is None or not clock.is_seen:
        return clock
    if clock.keeps_step:
        if abs(clock.mean) >= SIGNIFICANT * clock.std and not apart:
            return clock
        keeps = rebanded(shifted(trial, clock))
        fitted = fitted_structure(replace(keeps, clock=replace(clock, taken_out=True)), sensor)
        return _likelier(trial, clock, fitted, lines)
    steady = clock.kept_in_step()
    changes = rebanded(shifted(trial, clock))
    keeps = replace(
        in_band_of(changes, shifted(trial, steady)), clock=replace(steady, taken_out=True)
    )
    both = marked(changes.segments, len(trial.time)) & marked(keeps.segments, len(trial.time))
    changes, keeps = (replace(t, segments=runs(both)) for t in (changes, keeps))
    wanders, bent = fitted_structure(changes, sensor), fitted_structure(keeps, sensor, BENDS)
    straight = bent
    if advantage_by_one_noise(wanders, bent) > WANDERS:
        if np.ptp(clock.late) >= trial.h:
            return clock
        straight = fitted_structure(keeps, sensor)
        if advantage(wanders, straight) > WANDERS:
            return replace(clock if lines else steady, doubtful=True)
    if abs(steady.mean) >= SIGNIFICANT * steady.std and not apart:
        return steady
    return _likelier(trial, steady, straight, lines)


def _likelier(trial: Trial, steady: Clock, fitted: Fit, lines: bool) -> Clock:
    """The line that a fit finds about one lag, where that line is no chance, else the lag: where
    that is not seen, a clock that drifts is right at no instant that is known beforehand.
    """
    change, std = fitted.states[trial.name].clock, fitted.std.get(LogClock(trial.name, 1), np.inf)
    if change is None:
        return steady
    ends = float(trial.time[0]), float(trial.time[-1])
    line = steady.corrected(change, std, *ends, least=LIKELIER)
    return steady if line.keeps_step else replace(line if lines else steady, doubtful=True)


def in_band_of(one: Trial, other: Trial) -> Trial:
    """The ``other`` trial of a log in the band of ``one``, where they differ by their clocks: what
    is left in two bands is no measure of which is right.
    """
    return replace(other, band_hz=one.band_hz)


def fitted_structure(trial: Trial, sensor: Sensor, beside: Iterable[str] = ()) -> Fit:
    """The structure of a sensor, its bias and its noise, fitted to a trial, with the effects
    ``beside`` that this kind of sensor may have.
    """
    sensor, structure = with_structure(sensor)
    for name in beside:
        sensor = sensor if name in sensor.values else sensor.with_values(name)
        structure |= coefficients_of(sensor, name)
    return fit(begin(sensor, structure, [trial], prior_of(sensor, structure)))


def _less_unsure(trial: Trial, clock: Clock) -> Trial:
    """The trial without the rows of which nobody knows whether the clock has slipped yet."""
    if not clock.unsure:
        return trial
    known = marked(trial.segments, len(trial.time))
    for first, last in clock.unsure:
        known &= (trial.time < first) | (trial.time > last)
    return replace(trial, segments=runs(known))


def in_common(clocks: Sequence[Clock]) -> float:
    """The lag in s that may be the sensor's own; 0 where there is none."""
    if not clocks or not all(c.keeps_step for c in clocks):
        return 0.0
    late = np.array([c.mean for c in clocks])
    weight = np.array([c.std for c in clocks]) ** -2.0
    mean = float(weight @ late / weight.sum())
    std = weight**-0.5
    certain = mean * np.sqrt(weight.sum()) > SIGNIFICANT and mean < LONGEST_OWN
    # A log that shows no lag by itself may have any near it.
    chance = np.where(late > SIGNIFICANT * std, SIGNIFICANT, DOUBTFUL) * std
    alike = np.all(np.abs(late - mean) < np.maximum(ALIKE * mean, chance))
    return mean if certain and alike else 0.0


def _std_of_mean(clocks: Sequence[Clock]) -> float:
    return float(sum(c.std**-2.0 for c in clocks) ** -0.5) if clocks else 0.0


def _aligned(trial: Trial, clock: Clock | None, own: float, own_std: float) -> Trial:
    if clock is None:
        return trial
    if not np.isfinite(clock.std):
        return replace(trial, clock=clock)
    if clock.doubtful:
        # Its line moves the reference by less than a row at either end: with it and without the
        # same rows are fitted.
        trial = replace(trial, segments=[(a + 1, b - 1) for a, b in trial.segments if b - a > 2])
    trial = _less_unsure(trial, clock)
    rest = clock.less(own)
    # What a log lacks of the lag in common is known no better than that.
    std = float(np.hypot(clock.std, own_std)) if own else clock.std
    chance = max(SIGNIFICANT * std, ALIKE * own)
    # A lag that seems to change, and is nobody's own, is the clock's.
    is_clock = clock.changed and not own and abs(clock.mean) >= DOUBTFUL * clock.std
    by_chance = rest.keeps_step and abs(rest.mean) < chance and not is_clock
    if by_chance and not any(map(leaves_a_lag, trial.findings)):
        return replace(trial, clock=rest)
    found = Finding(
        "reference_clock",
        trial.kind,
        len(rest.late),
        {
            "least_late": float(rest.late.min()),
            "most_late": float(rest.late.max()),
            "late_std": clock.std,
        },
    )
    moved = rebanded(shifted(trial, rest))
    said = trial.findings if by_chance else (*trial.findings, found)
    return replace(moved, clock=replace(rest, taken_out=True), findings=said)
