"""How much each term of the library would explain of what a model leaves, and how much chance.

Columns are whitened with the noise of the fit and have all that the model explains projected out,
as those of any effect.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import chdtrc

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.errors_in_variables import beside_moved, equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.glance import Glance
from pyimu.identification.fit.keys import Shape
from pyimu.identification.fit.normal import solve
from pyimu.identification.formula.columns import columns_of
from pyimu.identification.formula.terms import Term
from pyimu.identification.search.projected import Projected, dispersion
from pyimu.identification.search.screen import DRAWS, FALSE_ALARM, PENALTY

CHUNK = 48
"""Terms whose columns are held at once."""

KEPT_ROWS = 2000
"""Whitened rows, evenly picked, from which the correlation of the terms is told: to 1 in 45."""

UNEXPLAINED = 1e-3
"""Family-wise p-value below which a dependence on a term is reported."""


@dataclass(frozen=True)
class Scored:
    """A term, its gain [nat] less penalties, the axes on which it explains anything, the smallest
    p-value of an axis, of this one trial, and the ``excess`` [nat] of what it explains on all axes
    over what chance does.
    """

    term: Term
    gain: float
    axes: tuple[int, ...]
    p_value: float
    axis: int
    excess: float = 0.0


@dataclass(frozen=True)
class Scores:
    """All terms, best first, with what each would explain beside the model of ``fit``."""

    terms: tuple[Scored, ...]
    fit: Fit

    @cached_property
    def whitened(self) -> list[tuple[np.ndarray, ...]]:
        """By term and axis the directions (rows, columns), orthonormal, in which it acts on some of
        the whitened rows once the model is projected out.
        """
        out, base = [], self.fit.linearise()
        for few in _chunks([s.term for s in self.terms]):
            linears = self.fit.beside(base, [columns_of(self.fit.sensor.kind, few)])
            out += _whitened(self.fit, linears, few)
        return out

    @property
    def trials(self) -> int:
        """How many terms were tried on how many axes."""
        return 3 * len(self.terms)

    @property
    def p_value(self) -> float:
        """Family-wise (Bonferroni), of the clearest dependence."""
        return min((s.p_value for s in self.terms), default=1.0) * self.trials


def scored(fit: Fit, terms: Sequence[Term], columns: Callable = columns_of) -> Scores:
    """The terms with what each would explain beside a model; ``columns`` makes theirs."""
    plain = _at_a_glance(fit, terms, columns)
    found = plain | _in_full(fit, [t for t in terms if t.text not in plain], columns)
    out = [found[t.text] for t in terms if t.text in found]
    return Scores(tuple(sorted(out, key=lambda s: -s.gain)), fit)


def _at_a_glance(fit: Fit, terms: Sequence[Term], columns: Callable) -> dict[str, Scored]:
    """By text the terms of one column each that explain no more on any axis than its penalty."""
    glance, out = Glance.of(fit), {}
    single = [t for t in terms if len(t.code) == 1]
    for few in _chunks(single if glance is not None else ()):
        explained = glance.explained([columns(fit.sensor.kind, few)])
        for term in few:
            keys = {i: Shape(term.text, 0, i) for i in range(3)}
            power = {i: explained[k] for i, k in keys.items() if k in explained}
            if max(power.values(), default=0.0) <= 2.0 * PENALTY:
                chances = [(float(chdtrc(1, p)), i) for i, p in power.items()]
                out[term.text] = Scored(term, 0.0, (), *min([(1.0, 0), *chances]))
    return out


def _in_full(fit: Fit, terms: Sequence[Term], columns: Callable) -> dict[str, Scored]:
    """By text what each of the terms explains."""
    out: dict[str, Scored] = {}
    pair = beside_moved(fit)
    for few in _chunks(terms):

        def linearised(f: Fit, few=few) -> list[Linear]:
            return f.beside(f.linearise(), [columns(f.sensor.kind, few)])

        normal = with_prior(equations(fit, linearised, pair), fit)
        place = {k: i for i, k in enumerate(normal.keys) if isinstance(k, Shape)}
        model = [i for i, k in enumerate(normal.keys) if not isinstance(k, Shape)]
        if not place:
            continue
        projected = Projected.of(normal, model, list(place.values()))
        at = {k: n for n, k in enumerate(place)}
        out |= {t.text: _scored(t, projected, at) for t in few}
    return out


def _chunks(terms: Sequence[Term]) -> Iterator[list[Term]]:
    return (list(terms[first : first + CHUNK]) for first in range(0, len(terms), CHUNK))


def _scored(term: Term, projected: Projected, at: dict[Shape, int]) -> Scored:
    total, excess, axes, best = 0.0, 0.0, [], (1.0, 0)
    for i in range(3):
        columns = [at[k] for n in range(len(term.code)) if (k := Shape(term.text, n, i)) in at]
        columns = [c for c in columns if projected.gram[c, c] > 0]
        if not columns:
            continue
        s = projected.score[columns]
        power = float(s @ solve(projected.variance[np.ix_(columns, columns)], s))
        if 0.5 * power > PENALTY:
            power /= _dispersion(projected, columns)
        best = min(best, (float(chdtrc(len(columns), power)), i))
        excess += 0.5 * (power - len(columns))
        if 0.5 * power > PENALTY * len(columns):
            total += 0.5 * power - PENALTY * len(columns)
            axes.append(i)
    return Scored(term, total, tuple(axes), *best, excess)


def _dispersion(projected: Projected, columns: list[int]) -> float:
    """That of a few of many columns, without the Gram matrices by batch of all of them."""
    gram = projected.variance[np.ix_(columns, columns)]
    turn = projected.turn[:, columns]
    few = replace(projected, gram=gram, score=projected.score[columns], turn=turn)
    return dispersion(few, range(len(columns)))


# The gate


def _whitened(fit: Fit, linears: list[Linear], terms: list[Term]) -> list[tuple[np.ndarray, ...]]:
    """``Scores.whitened`` of a few terms, from their columns beside the model's."""
    out: dict[str, list[np.ndarray]] = {t.text: [] for t in terms}
    for i in sorted(fit.noise):
        rows, keys = _thinned(fit, linears, i)
        base = rows[:, [n for n, k in enumerate(keys) if not isinstance(k, Shape)]]
        base = base / np.maximum(np.linalg.norm(base, axis=0), 1e-300)
        plane = np.linalg.qr(base)[0] if base.shape[1] else base
        left = rows - plane @ (plane.T @ rows)
        lost = np.linalg.norm(left, axis=0) < 1e-4 * np.linalg.norm(rows, axis=0)
        left[:, lost] = 0.0
        for t in terms:
            own = [n for n, k in enumerate(keys) if isinstance(k, Shape) and k.term == t.text]
            own = [n for n in own if np.any(left[:, n])]
            if own:
                out[t.text].append(np.linalg.qr(left[:, own])[0])
            else:
                out[t.text].append(np.zeros((len(left), 0)))
    return [tuple(out[t.text]) for t in terms]


def _thinned(fit: Fit, linears: list[Linear], axis: int) -> tuple[np.ndarray, list]:
    """Some whitened rows of all logs on one axis, and the keys of their columns."""
    with_axis = [one for one in linears if axis in one.keys]
    keys = list(dict.fromkeys(k for one in with_axis for k in one.keys[axis]))
    stride = max(1, sum(len(one.time) for one in with_axis) // KEPT_ROWS)
    pieces = []
    for one in with_axis:
        white = fit.noise[axis].whiten(np.asarray(one.columns[axis]), one.time, one.segments)[
            ::stride
        ]
        full = np.zeros((len(white), len(keys)))
        full[:, [keys.index(k) for k in one.keys[axis]]] = white
        pieces.append(full)
    return np.concatenate(pieces), keys


def gate(scores: Scores, seed: int = 1) -> float:
    """The 1 - ``FALSE_ALARM`` point of the largest gain of all terms where there is nothing to
    find, from draws with the covariance that the terms' columns have (max-T).
    """
    rng = np.random.default_rng(seed)
    axes = len(scores.whitened[0])
    total = [0.0] * len(scores.whitened)
    for i in range(axes):
        directions = [w[i] for w in scores.whitened]
        widths = [d.shape[1] for d in directions]
        together = np.concatenate(directions, axis=1)
        values, vectors = np.linalg.eigh(together.T @ together)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        draws = rng.standard_normal((DRAWS, len(values))) @ root.T
        edges = np.cumsum([0, *widths])
        for n, (a, b) in enumerate(zip(edges[:-1], edges[1:], strict=True)):
            gain = 0.5 * np.sum(draws[:, a:b] ** 2, axis=1) - PENALTY * (b - a)
            total[n] = total[n] + np.maximum(gain, 0.0)
    return float(np.quantile(np.max(total, axis=0), 1.0 - FALSE_ALARM))
