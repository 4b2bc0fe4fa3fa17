"""Which kinds of noise a residual has beyond what is known of it: forward selection by likelihood,
behind a gate that noise as it is known passes at a stated rate.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.optimize import minimize_scalar

from pyimu.identification.noise.cells import Cells
from pyimu.identification.noise.laws import Form, Kind
from pyimu.identification.noise.spectrum import Bands
from pyimu.identification.search.choice import SET_WIDTH
from pyimu.identification.search.screen import FALSE_ALARM, PENALTY

SHARE = 0.5
"""Of the rate of false alarms: the other half is that of the effects that are not random."""

DRAWS = 300
"""Residuals of known noise that the gate is found from."""

TAIL = 0.1
"""Share of the draws, the largest, that say how the statistic falls off: as exp(-gain), nearly, as
log-likelihood ratios do."""

MOST = 4
"""Kinds of noise that are added at most."""


@dataclass(frozen=True)
class Axis:
    """One axis: its ``bands`` and their cells under what is known, the cells of its motion with the
    columns of the kinds that follow it, if it moves, and the size declared of each kind.
    """

    bands: Bands
    spectrum: Cells
    motion: Cells | None
    following: np.ndarray
    had: Mapping[str, float]


@dataclass(frozen=True)
class Term:
    """A kind of noise on one axis: its form, and where its size stands among what is free."""

    kind: Kind
    form: Form
    place: int


@dataclass(frozen=True)
class State:
    """Axes with the kinds of noise that were found, by number of axis."""

    axes: dict[int, Axis]
    found: dict[int, tuple[Term, ...]] = field(default_factory=dict)

    def has(self, kind: Kind, axis: int) -> bool:
        return any(t.kind.name == kind.name for t in self.found.get(axis, ()))


@dataclass(frozen=True)
class Chosen:
    """One kind of noise that was added, on ``axes``: penalised gain and gate [nat], and the kinds
    that gain as much.
    """

    kind: Kind
    axes: tuple[int, ...]
    gain: float
    gate: float
    alternatives: tuple[str, ...]


@dataclass(frozen=True)
class Offer:
    """What a kind would gain: in all, penalised, and by axis with the form that it takes."""

    kind: Kind
    gain: float
    axes: dict[int, Form]


def choose(
    state: State, kinds: Sequence[Kind], sensors: int = 1, seed: int = 1
) -> tuple[State, list[Chosen]]:
    """The state with the kinds of noise that the axes have, and how each came in.

    The gate is one for all kinds and axes of a sensor: the share of false alarms that falls to
    noise is divided among ``sensors``.
    """
    gate = _gate(state, kinds, SHARE * FALSE_ALARM / sensors, np.random.default_rng(seed))
    chosen: list[Chosen] = []
    for follows in (True, False):
        while len(chosen) < MOST:
            offers = [o for k in kinds if k.follows is follows for o in _offers(state, k)]
            best = max(offers, key=lambda o: o.gain, default=None)
            if best is None or best.gain <= gate:
                break
            close = [o.kind.name for o in offers if best.gain - o.gain < SET_WIDTH]
            others = tuple(n for n in dict.fromkeys(close) if n != best.kind.name)
            state = _with(state, best)
            chosen.append(Chosen(best.kind, tuple(best.axes), best.gain, gate, others))
    return _backward(state, chosen, gate)


def _gate(state: State, kinds: Sequence[Kind], alarm: float, rng: np.random.Generator) -> float:
    """The largest gain of any kind that known noise reaches at the rate ``alarm``.

    The largest tenth of the draws gives the tail's scale (Hill 1975, of exponential excesses).
    """
    drawn: dict[int, dict[bool, np.ndarray]] = {}
    for i, axis in state.axes.items():
        drawn[i] = {
            which: cells.drawn(cells.fit()[0], DRAWS, rng)
            for which, cells in ((True, axis.motion), (False, axis.spectrum))
            if cells is not None
        }
    best = np.zeros(DRAWS)
    for kind in kinds:
        gains = {
            i: g
            for i in state.axes
            if (g := _gains(state, kind, i, drawn[i].get(kind.follows))) is not None
        }
        if gains:
            best = np.maximum(best, _total(kind, gains)[0])
    top = np.sort(best)[-int(TAIL * DRAWS) :]
    scale = max(float(np.mean(top - top[0])), 1.0)
    return float(top[0] + scale * np.log(TAIL / alarm))


def _offers(state: State, kind: Kind) -> list[Offer]:
    """What a kind would gain on the axes that lack it; nothing where no axis does."""
    gains = {}
    for i, axis in state.axes.items():
        cells = axis.motion if kind.follows else axis.spectrum
        found = None if cells is None else _gains(state, kind, i, cells.squares[None])
        if found is not None and not state.has(kind, i):
            gains[i] = found
    if not gains:
        return []
    total, forms = _total(kind, gains)
    worth = {
        i: kind.forms[int(forms[i][0])]
        for i, g in gains.items()
        if g[0, int(forms[i][0])] > _cost(kind)
    }
    return [Offer(kind, float(total[0]), worth)] if worth else []


def _gains(state: State, kind: Kind, i: int, squares: np.ndarray | None) -> np.ndarray | None:
    """Gains (b, forms) of a kind on an axis for squares (b, c); None where it cannot be there."""
    axis = state.axes[i]
    if squares is None or (kind.effect.law.is_plain("white") and _follows(state, i)):
        return None
    if kind.follows:
        return axis.motion.gains(_following(axis, kind), np.zeros(1), squares)
    columns = np.array([kind.in_bands(axis.bands, f) for f in kind.forms])
    least = np.full(len(columns), _least(axis, kind))
    return axis.spectrum.gains(columns, least, squares)


def _follows(state: State, i: int) -> bool:
    return any(t.kind.follows for t in state.found.get(i, ()))


def _following(axis: Axis, kind: Kind) -> np.ndarray:
    names = list(axis.had)
    return axis.following[[names.index(kind.name)]]


def _least(axis: Axis, kind: Kind) -> float:
    """The least square that may be added to a kind's: what is declared of it may be too much."""
    return -(1 - 1e-6) * axis.had.get(kind.name, 0.0) ** 2 if not kind.scans else 0.0


def _cost(kind: Kind) -> float:
    """nat that a kind pays on an axis, for its size and for a form of the axis's own."""
    return PENALTY * (1 + (kind.scans and not kind.shares_form))


def _total(kind: Kind, gains: dict[int, np.ndarray]) -> tuple[np.ndarray, dict[int, np.ndarray]]:
    """Penalised gains (b,) over all axes, and by axis the number (b,) of the form that is best."""
    worth = {i: np.maximum(g - _cost(kind), 0.0) for i, g in gains.items()}
    if kind.shares_form:
        every = sum(worth.values())
        at = np.argmax(every, axis=1)
        return every[np.arange(len(at)), at], dict.fromkeys(gains, at)
    return (
        sum(w.max(axis=1) for w in worth.values()),
        {i: np.argmax(w, axis=1) for i, w in worth.items()},
    )


def _with(state: State, offer: Offer) -> State:
    """The state with a kind of noise on the axes of an offer, free beside all else."""
    axes, found = dict(state.axes), dict(state.found)
    for i, form in offer.axes.items():
        axis = axes[i]
        if offer.kind.follows:
            cells = axis.motion.with_free(_following(axis, offer.kind), np.zeros(1))
            # What follows the motion is white in the mean: how much, the motion says better.
            mean = axis.spectrum.with_free(axis.bands.turn[None], np.zeros(1))
            axes[i] = replace(axis, motion=cells, spectrum=mean)
        else:
            column = offer.kind.in_bands(axis.bands, form)[None]
            cells = axis.spectrum.with_free(column, np.array([_least(axis, offer.kind)]))
            axes[i] = replace(axis, spectrum=cells)
        term = Term(offer.kind, form, len(cells.free) - 1)
        found[i] = (*found.get(i, ()), term)
    return State(axes, found)


def _backward(state: State, chosen: list[Chosen], gate: float) -> tuple[State, list[Chosen]]:
    """Drop what others that came in later made superfluous."""
    for one in chosen[:-1]:
        fewer = state
        lost = 0.0
        for i in one.axes:
            cells = _cells(state, i, one.kind)
            fewer = without(fewer, one.kind, i)
            lost += cells.fit()[1] - _cells(fewer, i, one.kind).fit()[1] - _cost(one.kind)
        if lost <= gate:
            state, chosen = fewer, [c for c in chosen if c is not one]
    return state, chosen


def _cells(state: State, i: int, kind: Kind) -> Cells:
    return state.axes[i].motion if kind.follows else state.axes[i].spectrum


def without(state: State, kind: Kind, i: int) -> State:
    axis = state.axes[i]
    gone = next(t for t in state.found[i] if t.kind.name == kind.name)
    name = "motion" if kind.follows else "spectrum"
    axis = replace(axis, **{name: getattr(axis, name).without(gone.place)})
    kept = tuple(
        replace(t, place=t.place - 1)
        if t.kind.follows is kind.follows and t.place > gone.place
        else t
        for t in state.found[i]
        if t is not gone
    )
    return State({**state.axes, i: axis}, {**state.found, i: kept})


def refined(state: State, i: int, term: Term) -> tuple[Form, float]:
    """The form of a scanned kind on an axis between those that were tried, where it has one number
    of its own, and that number's standard error; infinite where the likelihood is flat.
    """
    if not term.kind.scans or term.kind.shares_form:
        return term.form, 0.0
    ((name, at),) = term.form.items()
    ratio = 2.0 ** (3.0 / 4)
    likely = _by_form(state, i, term, name)
    low, high = np.log(at / ratio), np.log(at * ratio)
    best = _golden(likely, low, high)
    step = 0.1
    bend = 2 * likely(best) - likely(best - step) - likely(best + step)
    std = np.exp(best) * step / np.sqrt(bend) if bend > 0 else np.inf
    return {name: float(np.exp(best))}, float(std)


def _by_form(state: State, i: int, term: Term, name: str) -> Callable[[float], float]:
    axis = state.axes[i]

    def likely(log_value: float) -> float:
        columns = np.array(axis.spectrum.free)
        columns[term.place] = term.kind.in_bands(axis.bands, {name: float(np.exp(log_value))})
        return replace(axis.spectrum, free=columns).fit()[1]

    return likely


def _golden(f: Callable[[float], float], low: float, high: float) -> float:
    found = minimize_scalar(
        lambda x: -f(x), bounds=(low, high), method="bounded", options={"xatol": 0.01}
    )
    return float(found.x)


def with_form(state: State, i: int, term: Term, form: Form) -> State:
    """The state with another form of a kind on an axis."""
    axis = state.axes[i]
    columns = np.array(axis.spectrum.free)
    columns[term.place] = term.kind.in_bands(axis.bands, form)
    axis = replace(axis, spectrum=replace(axis.spectrum, free=columns))
    found = tuple(replace(t, form=form) if t is term else t for t in state.found[i])
    return State({**state.axes, i: axis}, {**state.found, i: found})
