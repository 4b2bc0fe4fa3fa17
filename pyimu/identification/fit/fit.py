"""A model fitted to trials, and the steps of least squares towards it."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import UserError
from pyimu.identification.fit.clock import ClockChange
from pyimu.identification.fit.columns import (
    Linear,
    Stack,
    band_segments,
    band_time,
    in_band,
    linearise,
    reduced,
    residual,
    with_columns,
)
from pyimu.identification.fit.inputs import LogState
from pyimu.identification.fit.keys import (
    Coefficient,
    Key,
    LogClock,
    LogKey,
    LogLag,
    LogPlace,
    coefficients_of,
)
from pyimu.identification.fit.noise_fit import declared_variances, fit_noise, less_levels
from pyimu.identification.fit.normal import Noise, Normal, normal_equations, solve
from pyimu.identification.fit.trial import Trial, marked
from pyimu.identification.fit.whiten import WALKS, Autoregressive, RandomWalk
from pyimu.model.arguments import Parameter
from pyimu.model.kinds import KINDS, OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS
from pyimu.recording.reference.rate import VERTICAL

THERMOMETER = 30.0
"""s; standard deviation of a thermometer's lag behind the sensor: some seconds on the same die, a
minute on the same board."""


WANDERS_LESS = 0.1
"""Share of a fitted random walk's K beside which slow effects are looked for: one of 8 sigmas that
nothing else stands for makes K 7 to 22 times as large."""


NEAR = 1.0
"""nat; a step that promises less moves the coefficients by hardly more than a standard error, and
what the noise of the reference changes, itself a small part of the columns, by a share of that."""


SHORTEST_STEP = 1 / 128
"""Share of a step of least squares below which a shorter one is not tried."""


class Last:
    """What a model was last linearised to, for those that differ from it in their noise alone, and
    what the noise of the reference changes of it, once that was asked for.

    While a search for the coefficients is ``near`` their place the changes are those of where it
    was; ``settle`` lets them be asked for anew.
    """

    def __init__(self) -> None:
        self.near = self.moved = False
        self.forget()

    def forget(self) -> None:
        self.of: tuple = ()
        self.linears: list[Linear] = []
        self.moved = self.near
        if not self.near:
            self.changes: list[Linear] = []

    def settle(self) -> None:
        if self.moved:
            self.changes, self.moved = [], False


@dataclass(frozen=True)
class Fit:
    """A model fitted to trials: values in ``sensor``, per-log states, noise by axis, log-likelihood
    [nat].

    ``noise`` is what rows are weighed by: ``seen``, which the residual shows, and at least what the
    part declares. ``free`` are the keys of the coefficients that are estimated; ``std`` the
    standard errors by column key; ``prior`` the standard deviations, about the identity, of
    coefficients that nobody declared; ``echo`` by axis what the reference's noise added to the
    variance of the innovations of the first model; ``coloured`` says that this noise is not white.
    """

    sensor: Sensor
    free: frozenset[Key]
    trials: tuple[Trial, ...]
    states: dict[str, LogState]
    noise: Noise
    log_likelihood: float = -np.inf
    std: Mapping[Key, float] = field(default_factory=dict)
    prior: Mapping[Coefficient, float] = field(default_factory=dict)
    echo: Mapping[int, float] = field(default_factory=dict)
    coloured: bool = False
    seen: Noise = field(default_factory=dict)
    last: Last = field(default_factory=Last, repr=False, compare=False)

    def linearise(self, candidates: Iterable[str] = (), extra: Iterable = ()) -> list[Linear]:
        """All trials with columns for the free coefficients, the logs' own, and effects
        ``candidates`` put in at their identity.
        """
        if not candidates and not extra:
            return self._linearised()
        sensor, wanted = self.sensor, self.free
        for name in candidates:
            sensor = sensor if name in sensor.values else sensor.with_values(name)
            wanted |= coefficients_of(sensor, name)
        return [linearise(sensor, t, self.states[t.name], wanted, extra) for t in self.trials]

    def _linearised(self) -> list[Linear]:
        """All trials with columns for what the model has."""
        if not self.is_last:
            self.last.forget()
            self.last.linears = [
                linearise(self.sensor, t, self.states[t.name], self.free) for t in self.trials
            ]
            self.last.of = self._linearised_by
        return list(self.last.linears)

    @property
    def is_reduced(self) -> bool:
        """Whether its rows are no samples, but what whole stretches of logs say."""
        return any(t.reduction is not None for t in self.trials)

    @property
    def _linearised_by(self) -> tuple:
        """What a linearisation depends on."""
        return self.sensor, self.free, *self.trials, *(self.states[t.name] for t in self.trials)

    @property
    def is_last(self) -> bool:
        """Whether the same objects were linearised last."""
        last, own = self.last.of, self._linearised_by
        return len(last) == len(own) and all(a is b for a, b in zip(last, own, strict=True))

    def beside(self, linears: Iterable[Linear], extra: Iterable) -> list[Linear]:
        """All trials as they were linearised, with the columns that functions ``extra`` add."""
        return [
            with_columns(one, self.sensor, t, self.states[t.name], extra)
            for one, t in zip(linears, self.trials, strict=True)
        ]

    def residuals(self) -> list[Linear]:
        """All trials' residuals in their band, without columns."""
        if self.is_last:
            return [_without_columns(one) for one in self.last.linears]
        return [self._residual(t) for t in self.trials]

    def _residual(self, trial: Trial) -> Linear:
        state = self.states[trial.name]
        if trial.reduction is not None:
            return reduced(trial, trial.rows(self.sensor, state.bias))
        return bare(trial, in_band(trial, residual(self.sensor, trial, state)))

    def with_noise(self, whole: Collection[int] = ()) -> Fit:
        """The same model with the noise that its present residual shows, and the part declares; on
        the axes ``whole`` by all of the residual, also where that is hardly anything but motion.
        """
        seen = fit_noise(self.trials, self.residuals(), self.coloured, whole)
        return replace(self, seen=seen, noise=self._at_least_declared(seen))

    def _at_least_declared(self, seen: Noise) -> Noise:
        first = self.trials[0]
        white, walk = declared_variances(self.sensor, first.h)
        white = white / first.band.stride
        return {i: _at_least(n, float(white[i]), float(walk[i])) for i, n in seen.items()}

    def as_declared(self) -> Fit:
        """The same model with no more random walk than the part declares, where it does.

        What the model lacks and what wanders look alike; the part's word is that it wanders no
        more.
        """
        _, walk = declared_variances(self.sensor, self.trials[0].h)
        held = {
            i: replace(n, k2=walk[i]) if isinstance(n, WALKS) and walk[i] > 0.0 else n
            for i, n in self.noise.items()
        }
        return self if held == self.noise else replace(self, noise=held)

    def wandering_less(self) -> Fit:
        """The same model where the random walk that nobody declared is a tenth of what was fitted,
        and an autoregression predicts nothing slow.

        A slow effect that is missing is taken for a walk, of any size, or for what the past
        predicts; to be seen at all it must not be.
        """
        _, walk = declared_variances(self.sensor, self.trials[0].h)
        less = {
            i: replace(n, k2=WANDERS_LESS**2 * n.k2)
            if isinstance(n, WALKS) and walk[i] == 0.0
            else n
            for i, n in less_levels(self.residuals(), self.noise).items()
        }
        return self if less == self.noise else replace(self, noise=less)


def _at_least(noise, white: float, walk: float):
    """A noise with at least the declared variances, of means over a row and of the walk in a
    second.
    """
    if isinstance(noise, RandomWalk):
        return RandomWalk(max(noise.r, white), max(noise.k2, walk))
    if not isinstance(noise, Autoregressive):
        return noise
    return replace(noise.no_quieter_than(white), k2=max(noise.k2, walk))


def _without_columns(one: Linear) -> Linear:
    none = {i: Stack(len(one.time)) for i in one.keys}
    return replace(one, keys={i: [] for i in one.keys}, columns=none)


def bare(trial: Trial, r: np.ndarray) -> Linear:
    """A residual (m, 3) of a trial, in its band, with no columns beside it."""
    return Linear(
        band_time(trial),
        band_segments(trial),
        r,
        {i: [] for i in trial.axes},
        {i: Stack(len(r)) for i in trial.axes},
    )


def initial_state(sensor: Sensor, trial: Trial) -> LogState:
    """Mounting by the rotation that turns the reference into the measurement, bias as the mean of
    what is left.
    """
    rotation = np.eye(3)
    if trial.reduction is not None:
        return LogState(np.array(trial.reduction.bias))
    if trial.free_rotation:
        x, y = (in_band(trial, v) for v in (trial.u[:, OWN[trial.kind]], trial.y))
        # Turns whose size the two sides tell apart (a clipped sensor, a bad reference) would bend
        # the estimate.
        fast = (np.linalg.norm(x, axis=1) > 0.05) & (
            np.abs(np.linalg.norm(x, axis=1) - np.linalg.norm(y, axis=1))
            < 0.2 * np.linalg.norm(x, axis=1)
        )
        if fast.sum() > 10:
            with warnings.catch_warnings():
                # Turns about one axis alone leave that about it to the fit.
                warnings.filterwarnings("ignore", "Optimal rotation", UserWarning)
                rotation = Rotation.align_vectors(y[fast], x[fast])[0].as_matrix()
    rest = in_band(trial, residual(sensor, trial, LogState(np.zeros(3), rotation)))
    bias = np.median(rest, axis=0) if len(rest) else np.zeros(3)
    return LogState(bias, rotation, clock=_clock_to_find(trial))


def _clock_to_find(trial: Trial) -> ClockChange | None:
    """What a trial's clock still lacks before anything is known of it, about the middle of its
    motion; None where too little of the clock is to be seen, or it is no straight line.

    A course and a heading turn otherwise than the vehicle, at the point that is tracked.
    """
    clock = trial.clock
    steady = clock is not None and clock.is_seen and clock.is_steady
    if not steady or trial.reference in VERTICAL:
        return None
    power = np.sum(trial.u[:, COLUMNS[KINDS[trial.kind].own_rate]] ** 2, axis=1)
    power = power * marked(trial.row_segments, len(power))
    return ClockChange(float(power @ trial.time / power.sum())) if np.any(power) else None


def begin(
    sensor: Sensor,
    free: Iterable[Key],
    trials: Iterable[Trial],
    prior: Mapping[Coefficient, float] = MappingProxyType({}),
) -> Fit:
    """A model before its first fit."""
    trials = tuple(trials)
    states = {t.name: initial_state(sensor, t) for t in trials}
    return Fit(sensor, frozenset(free), trials, states, {}, prior=prior).with_noise()


def with_prior(normal: Normal, fit: Fit) -> Normal:
    """The normal equations with the prior's rows, which share out over the batches: their matrices
    are those of ``normal``, too large to hold twice.
    """
    gram, score = normal.batch_gram, normal.batch_score
    seen = None if normal.seen is None else np.array(normal.seen)
    for key, (departure, std) in departures(fit).items():
        if key in normal.position:
            i = normal.position[key]
            gram[:, i, i] += std**-2 / len(gram)
            score[:, i] -= departure / std**2 / len(gram)
            if seen is not None:
                seen[i, i] += std**-2
    power = normal.power + prior_power(fit)
    return replace(normal, batch_gram=gram, batch_score=score, power=power, seen=seen)


def prior_power(fit: Fit) -> float:
    """Sum of squares of what has a prior, by how far it departs from that in units of its own."""
    return sum((away / std) ** 2 for away, std in departures(fit).values())


def departures(fit: Fit) -> dict[Key, tuple[float, float]]:
    """By key what departs from its prior, and the prior's standard deviation."""
    away = {k: (departure(fit, k), s) for k, s in fit.prior.items() if k in fit.free}
    for t in fit.trials:
        change = fit.states[t.name].clock
        if change is not None:
            values = (change.offset, change.drift)
            room = t.clock.room(t.time[-1] - t.time[0])
            away |= {LogClock(t.name, k): (values[k], std) for k, std in room.items()}
        away[LogLag(t.name)] = fit.states[t.name].lag, THERMOMETER
        if t.place is not None:
            found, std = fit.states[t.name].place, t.place.std
            away |= {LogPlace(t.name, k): (found[k], std[k]) for k in t.place.unknown}
    return away


def departure(fit: Fit, key: Coefficient) -> float:
    """By how much a coefficient departs from its identity."""
    value = fit.sensor.values[key.effect][key.parameter][key.index]
    return float(value - fit.sensor.effect(key.effect).parameters[key.parameter].start)


def power(fit: Fit) -> float:
    """Sum of squares of the whitened residual: what ``normal_equations`` calls power, without its
    columns.
    """
    return whitened_power(fit, fit.residuals())


def whitened_power(fit: Fit, linears: Iterable[Linear]) -> float:
    """Sum of squares of what linearised trials leave, whitened by the noise of a fit."""
    return sum(whitened(fit.noise[i], one, i) for one in linears for i in one.keys)


def squares(linears: Iterable[Linear]) -> np.ndarray:
    """Sums of squares (3,) of the residuals of trials, by axis."""
    return np.sum([np.sum(one.residual**2, axis=0) for one in linears], axis=0)


def whitened(noise, one: Linear, axis: int) -> float:
    """Sum of squares of a residual on an axis, whitened."""
    white = noise.filter(one.time, one.segments)
    return white.power(np.ascontiguousarray(one.residual[:, axis]))


def plain_equations(fit: Fit) -> Normal:
    """Normal equations of a fit's columns as they are."""
    return normal_equations(fit.linearise(), fit.noise)


def gauss_newton(
    start: Fit,
    steps: int,
    equations: Callable[[Fit], Normal] = plain_equations,
    left: Callable[[Fit], float] = power,
) -> Fit:
    """Least squares by normal ``equations``, each step shortened until it lowers what is ``left``:
    the power that the equations have.
    """
    start.last.settle()
    normal = with_prior(equations(start), start)
    for _ in range(steps):
        change = solve(normal.gram, normal.score)
        promised = float(change @ normal.score)
        if promised < 1e-3:
            break
        start.last.near = promised < NEAR
        changes = start.last.changes
        # Mostly the whole step is taken, and its equations are asked for next: they say what is
        # left, too.
        moved = _along(start, normal.keys, change, changes)
        after = with_prior(equations(moved), moved)
        if not after.power < normal.power:
            shorter = _shorter(start, normal, change, after.power, left)
            if shorter is None:
                start.last.changes = changes
                break
            moved, after = shorter, with_prior(equations(shorter), shorter)
        start, normal = moved, after
    start.last.near = False
    return start


def _shorter(
    start: Fit,
    normal: Normal,
    change: np.ndarray,
    power: float,
    left: Callable[[Fit], float],
) -> Fit | None:
    """The fit a share of a ``change`` further that lowers what is ``left``, the whole of which left
    a ``power``; None where that is none above ``SHORTEST_STEP``.

    The next share is where the parabola through what is left, its slope at the start and the last
    share is least, and between a tenth and a half of that (Nocedal and Wright 2006, "Numerical
    optimization", section 3.5).
    """
    share, promised, changes = 1.0, float(change @ normal.score), start.last.changes
    while True:
        risen = power - normal.power + 2.0 * promised * share
        # Of a step to where nothing is defined there is no parabola.
        share *= min(max(promised * share / risen, 0.1), 0.5) if risen > 0.0 else 0.5
        if share < SHORTEST_STEP:
            return None
        moved = _along(start, normal.keys, share * change, changes)
        power = left(moved) + prior_power(moved)
        if power < normal.power:
            return moved


def _along(start: Fit, keys: list[Key], change: np.ndarray, changes: list[Linear]) -> Fit:
    """The fit a ``change`` further. While the search is near its place, what the noise of the
    reference ``changes`` there is carried along.
    """
    if start.last.near:
        start.last.changes = [carried(one, keys, change) for one in changes]
    return stepped(start, keys, change)


def carried(one: Linear, keys: list[Key], change: np.ndarray) -> Linear:
    """A linearised trial a ``change`` of the coefficients further."""
    moved, residual = dict(zip(keys, change, strict=True)), np.array(one.residual)
    for i, stack in one.columns.items():
        for key, column in zip(one.keys[i], stack.arrays, strict=True):
            residual[:, i] -= moved.get(key, 0.0) * column
    return replace(one, residual=residual)


def stepped(start: Fit, keys: list[Key], change: np.ndarray) -> Fit:
    """Move every coefficient and log state by its share of ``change``."""
    values = {e: {n: np.array(v) for n, v in p.items()} for e, p in start.sensor.values.items()}
    states = dict(start.states)
    for key, d in zip(keys, change, strict=True):
        if isinstance(key, Coefficient):
            array = values[key.effect][key.parameter]
            definition = start.sensor.effect(key.effect).parameters[key.parameter]
            array[key.index] = _bounded(definition, array[key.index], d)
        elif isinstance(key, LogKey):
            states[key.log] = states[key.log].moved(key, d)
    return replace(start, sensor=_possible(Sensor(start.sensor.kind, values), start), states=states)


def _possible(sensor: Sensor, start: Fit) -> Sensor:
    """The sensor, with the coefficients of ``start`` where no part of the trials' sample periods
    can have new ones together.
    """
    for effect in (e for e in sensor.effects if e.limits):
        alone = Sensor(sensor.kind, {effect.name: sensor.values[effect.name]})
        try:
            for h in {t.h for t in start.trials}:
                alone.check(h, "step")
        except UserError:
            sensor = sensor.with_values(effect.name, **start.sensor.values[effect.name])
    return sensor


def _bounded(definition: Parameter, value: float, change: float) -> float:
    """A step across a bound goes half way to it: a bound often means "off", where there is no slope
    to come back by.
    """
    if definition.minimum is not None and value + change <= definition.minimum:
        return 0.5 * (value + definition.minimum)
    if definition.maximum is not None and value + change >= definition.maximum:
        return 0.5 * (value + definition.maximum)
    return value + change
