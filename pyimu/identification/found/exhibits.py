"""What the page shows of a sensor, as finished arrays.

Residuals over time and against what drives an effect, their spectrum, and the gains of the
candidates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.signal import welch

from pyimu.display.brief import Brief
from pyimu.identification.fit.columns import band_segments, band_time, in_band, residual
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.inputs import LogState, reference_input
from pyimu.identification.fit.left_out import left_out
from pyimu.identification.fit.noise_floor import floor_noise
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.formula.columns import values_of
from pyimu.identification.formula.formula import Formula
from pyimu.identification.found.entries import Added
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.screen import Screening
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, SIGNALS

MOST_AXES = 3
"""Axes of which an effect is shown."""

LEAST_SHARE = 0.1
"""Share of what an effect does to its strongest axis below which an axis is not shown."""

LONGEST_SPECTRUM = 1024
"""Rows of the segments of a spectral estimate, at most."""


@dataclass(frozen=True, repr=False)
class Trace(Brief):
    """One log's residual (m, 3) before and after, in its band.

    At ``time`` (m,) s, of which ``segments`` of rows are without gap; ``axes`` are those that its
    reference covers.
    """

    name: str
    time: np.ndarray
    segments: list[tuple[int, int]]
    before: np.ndarray
    after: np.ndarray
    axes: tuple[int, ...]
    period: float


@dataclass(frozen=True)
class Driver:
    """What drives an effect.

    A signal by name ("time" and "contribution", what the effect adds, among them), one component of
    it or None, and whether it is its change that counts; ``unit`` is SI. What a formula is drawn
    against has a ``label`` instead.
    """

    signal: str
    component: int | None
    unit: str
    change: bool = False
    label: str = ""


@dataclass(frozen=True)
class Cloud:
    """Residual of one axis without and with an effect, (m,) each, against what drives it (m,).

    ``weight`` is what the effect does to the axis; ``outermost`` says that it acts on the largest
    values. ``formula`` (m,) is what a formula adds.
    """

    axis: int
    driver: Driver
    values: np.ndarray
    without: np.ndarray
    with_effect: np.ndarray
    weight: float
    outermost: bool
    formula: np.ndarray | None = None


@dataclass(frozen=True)
class Comb:
    """Where raw samples of one axis lie between two multiples of a step, -0.5 to 0.5 (m,)."""

    axis: int
    offsets: np.ndarray
    weight: float


@dataclass(frozen=True, repr=False)
class Spectrum(Brief):
    """One-sided densities (f,) of the residual, the mean of the axes, and of the noise alone."""

    frequency: np.ndarray
    before: np.ndarray
    after: np.ndarray
    noise: np.ndarray
    band_hz: float | None


@dataclass(frozen=True, repr=False)
class Exhibits(Brief):
    """All of one sensor; ``held_out`` says whether the traces are of rows that were not fitted.

    The magnetometer has no candidates that were screened.
    """

    held_out: bool
    traces: tuple[Trace, ...]
    spectrum: Spectrum | None
    first: Screening | None = None
    last: Screening | None = None
    of_effect: dict[str, tuple[Cloud | Comb, ...]] = field(default_factory=dict)


def exhibits_of(
    inv: Investigation, added: Sequence[Added], formulas: Sequence[Formula] = ()
) -> Exhibits:
    """What is worth showing of an investigation that added these effects, and ``formulas``."""
    own = {f.name: f for f in formulas if f.sensor == inv.after.sensor.kind}
    seen = [_seen(inv.before, inv.after, t) for t in inv.held or inv.after.trials]
    traces = tuple(trace for trace, _, _ in seen)
    return Exhibits(
        held_out=bool(inv.held),
        traces=traces,
        spectrum=_spectrum(inv, traces, seen[0][1]),
        first=inv.first,
        last=inv.last,
        of_effect={a.effect: _of_effect(a, inv, own.get(a.effect)) for a in added},
    )


def _seen(before: Fit, after: Fit, trial: Trial) -> tuple[Trace, Trial, LogState]:
    """Residual of one log under two models, each with the log's own state found under it.

    Gives the rows looked at, too, and the log's state under the second.
    """
    if trial.reduction is not None:
        return _judged(before, after, trial)
    (state_before, rest), (state, _) = _state(before, trial), _state(after, trial)
    first, second = (
        in_band(rest, residual(f.sensor, rest, s))
        for f, s in ((before, state_before), (after, state))
    )
    trace = Trace(
        name=rest.name,
        time=band_time(rest),
        segments=band_segments(rest),
        before=first,
        after=second,
        axes=rest.axes,
        period=rest.h * rest.band.stride,
    )
    return trace, rest, state


def _judged(before: Fit, after: Fit, trial: Trial) -> tuple[Trace, Trial, LogState]:
    """The same of rows that are each judged by a fit to the others.

    One of which these say nothing is met exactly.
    """
    first, second = (left_out(fit, trial) for fit in (before, after))
    errors = (np.nan_to_num(one.error)[:, None] * one.along for one in (first, second))
    time = trial.reduction.time
    trace = Trace(trial.name, time, [(0, len(time))], *errors, trial.axes, trial.h)
    return trace, trial, held_state(after, trial)[0]


def _state(fit: Fit, trial: Trial) -> tuple[LogState, Trial]:
    """State of a log under a model, and the rows to look at.

    A fitted log's bias is found anew: the model may be another.
    """
    if trial.parent is not None or trial.name not in fit.states:
        return held_state(fit, trial)
    whole = replace(trial, left_out=None, limited=None)
    state = replace(fit.states[trial.name], bias=np.zeros(3))
    bias = in_band(whole, residual(fit.sensor, whole, state)).mean(axis=0)
    return replace(state, bias=bias), whole


# Residual against what drives an effect


def _of_effect(a: Added, inv: Investigation, formula: Formula | None) -> tuple[Cloud | Comb, ...]:
    """The axes on which an effect acts, the strongest first.

    All rows are shown: what drives an effect may not move enough in the last part of a log.
    """
    step = inv.before.sensor.with_values(a.effect).reading("step")
    if step is not None and step[0] == a.effect:
        return _combs(a, [*inv.after.trials, *inv.held])
    if a.effect not in inv.after.sensor.values:
        return ()
    e = inv.after.sensor.effect(a.effect)
    bare = replace(inv.after, sensor=inv.after.sensor.without(a.effect))
    others = (t for t in inv.held if t.reduction is None or t.parent is None)
    seen = [_seen(bare, inv.after, t) for t in (*inv.after.trials, *others)]
    without, with_effect = (
        np.concatenate([getattr(trace, name) for trace, _, _ in seen])
        for name in ("before", "after")
    )
    weight = np.sqrt(np.sum((without - with_effect) ** 2, axis=0))
    axes = [int(i) for i in np.argsort(-weight) if weight[i] > LEAST_SHARE * weight.max() > 0.0]
    clouds = []
    for i in axes[:MOST_AXES]:
        if formula is None:
            driver = _driver(a, e, i, [trial for _, trial, _ in seen])
            values = [_values(driver, i, inv.after.sensor, *one) for one in seen]
        else:
            driver, values = _along(formula, i, [(trial, state) for _, trial, state in seen])
        clouds.append(
            Cloud(
                axis=i,
                driver=driver,
                values=np.concatenate(values),
                without=without[:, i],
                with_effect=with_effect[:, i],
                weight=float(weight[i]),
                outermost=e.stage == "output",
                formula=None if formula is None else (without - with_effect)[:, i],
            )
        )
    return tuple(clouds)


def _along(
    formula: Formula, axis: int, seen: Sequence[tuple[Trial, LogState]]
) -> tuple[Driver, list[np.ndarray]]:
    """What the first term of a formula on an axis is drawn against, log by log."""
    pairs = zip(formula.terms, formula.axes, strict=True)
    term = next((t for t, axes in pairs if axis in axes), formula.terms[0])
    label, code, unit = term.along(KINDS[formula.sensor].unit)
    values = []
    for trial, state in seen:
        u = reference_input(trial, state)
        x = in_band(trial, values_of(formula.sensor, code, u)[:, [axis]])[:, 0]
        values.append(x % (2 * np.pi) if term.angle else x)
    return Driver("formula", axis, unit, label=label), values


def _driver(a: Added, e: Effect, i: int, trials: Sequence[Trial]) -> Driver:
    """What drives an effect on axis ``i``."""
    kind = KINDS[trials[0].kind]
    needed, whole = sorted(e.signals(kind.name)), any(t.reduction is not None for t in trials)
    if e.stage == "dynamics" and not whole:
        return Driver(kind.own, i, SIGNALS[kind.own].unit, change=True)
    if whole or (needed and (e.stage in ("motion", "gain") or len(needed) > 1)):
        return Driver("contribution", None, kind.unit)
    signal = needed[0] if needed else kind.own
    matrix = next((v for v, _, _ in a.parameters.values() if np.ndim(v) == 2), None)
    if matrix is not None and matrix.shape[1] == SIGNALS[signal].size:
        u = np.concatenate([t.u[:, COLUMNS[signal]] for t in trials])
        strongest = int(np.argmax(np.abs(matrix[i]) * np.std(u, axis=0)))
        return Driver(signal, strongest, SIGNALS[signal].unit)
    if not needed and e.stage == "bias":
        return Driver("time", None, "s")
    component = i if SIGNALS[signal].size == 3 else None
    return Driver(signal, component, SIGNALS[signal].unit)


def _values(
    driver: Driver, axis: int, sensor: Sensor, trace: Trace, trial: Trial, state: LogState
) -> np.ndarray:
    """The values (m,) of what drives an effect, in a log's band."""
    if driver.signal == "contribution":
        return (trace.before - trace.after)[:, axis]
    u = reference_input(trial, state)[:, COLUMNS[driver.signal]]
    values = u[:, [driver.component or 0]]
    values = np.gradient(values, trial.h, axis=0) if driver.change else values
    return in_band(trial, values)[:, 0]


def _combs(a: Added, trials: Sequence[Trial]) -> tuple[Comb, ...]:
    """The raw samples against the multiples of the step found: on them, if they are rounded."""
    q = next(iter(a.parameters.values()))[0]
    combs = []
    for i in map(int, np.flatnonzero(q)):
        y = np.concatenate([t.y[s:e, i] for t in trials for s, e in t.segments])
        offsets = ((y - y[0]) / q[i] + 0.5) % 1.0 - 0.5
        combs.append(Comb(axis=i, offsets=offsets, weight=float(q[i])))
    return tuple(combs)


# Spectrum


def _spectrum(inv: Investigation, traces: Sequence[Trace], trial: Trial) -> Spectrum | None:
    """None where no segment is long enough."""
    if trial.reduction is not None:
        return None
    before, after = (density(traces, name) for name in ("before", "after"))
    if before is None or after is None:
        return None
    f = before[0]
    noise = noise_density(floor_noise(inv.after), trial, f)
    return Spectrum(f, before[1], after[1], noise, trial.band_hz)


def density(traces: Sequence[Trace], name: str) -> tuple[np.ndarray, np.ndarray] | None:
    """Frequencies [Hz] and one-sided PSD, the mean of the axes.

    It is averaged over all segments that are long enough; None where none is.
    """
    pieces = [(t, getattr(t, name)[a:b][:, list(t.axes)]) for t in traces for a, b in t.segments]
    longest = max((len(p) for _, p in pieces), default=0)
    length = min(LONGEST_SPECTRUM, 2 ** int(np.log2(max(longest, 1) / 3 + 1)))
    if length < 16:
        return None
    total, weight = 0.0, 0
    for t, piece in pieces:
        if len(piece) >= length:
            rate = 1.0 / t.period
            f, p = welch(piece, rate, nperseg=length, axis=0, detrend="constant")
            total, weight = total + len(piece) * p.mean(axis=1), weight + len(piece)
    return f[1:-1], (total / weight)[1:-1]


def noise_density(noise: dict[int, RandomWalk], trial: Trial, f: np.ndarray) -> np.ndarray:
    """One-sided PSD of white noise plus random walk through the band, the mean of the axes."""
    weights = np.array(trial.band.weights)
    delays = np.outer(f * trial.h, np.arange(len(weights)))
    gain = np.abs(np.exp(-2j * np.pi * delays) @ weights) ** 2
    walk = (2 * np.sin(np.pi * np.minimum(f * trial.h, 0.5)) / trial.h) ** 2
    each = [2 * n.r * trial.h + 2 * n.k2 / walk for i, n in noise.items() if i in trial.axes]
    return gain * np.mean(each, axis=0)
