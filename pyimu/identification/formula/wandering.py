"""Whether a residual follows a signal by a share that wanders: the sine of an angle whose phase
drifts, a gain that is another from minute to minute.

No coefficient describes it, and over a whole log it is next to nothing; it looks like slow noise.
Within some seconds the residual follows the signal all the same. Blocks of rows, white, are held
against those of the signal, each by itself: the squares of what they share have the chi-squared
distribution where there is nothing but noise (the test of a random coefficient; Nyblom 1989).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtrc

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.errors_in_variables import has_noise
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Key, Shape
from pyimu.identification.formula.columns import columns_of
from pyimu.identification.formula.screen import UNEXPLAINED
from pyimu.identification.formula.terms import Term, simple
from pyimu.identification.search.leftover import Unexplained
from pyimu.model.arguments import AXES

BLOCK = 8.0
"""s; over which a share is taken as constant at least."""

LONGER = (1, 3, 6)
"""Times that. Chosen with two logs beside an angle whose phase drifts by a turn in 40 to 150 s."""

FEWEST = 8
"""Shares of all blocks, and rows of one, at least."""

NOTHING = 1e-6
"""Share of its power by which a signal must differ from what others of its term, or other blocks,
have of it."""


@dataclass(frozen=True)
class _Followed:
    """How a term is followed on an axis: twice the log-likelihood that shares of it explain, one in
    each of blocks so many times ``longer``, and their number.
    """

    axis: int
    term: Term
    longer: int
    power: float
    shares: float

    @property
    def each(self) -> float:
        return self.power / self.shares

    @property
    def chance(self) -> float:
        return float(chdtrc(self.shares, self.power))


def wandering(fit: Fit) -> tuple[Unexplained, ...]:
    """The signal that the residual of a fit follows most clearly by a share that wanders, axis by
    axis; nothing where it is none, or the signals' own noise, which is in the residual, would say
    so.
    """
    if fit.is_reduced or has_noise(fit):
        return ()
    terms = {t.text: t for t in simple(fit.sensor.kind, fit.trials)}
    if not terms:
        return ()
    out = []
    found = {i: _less_coloured(_followed(fit, i, terms)) for i in sorted(fit.noise)}
    count = sum(map(len, found.values()))
    for axis, each in found.items():
        best = min(each, key=lambda f: (f.chance, f.term.size), default=None)
        if best is not None and best.chance * count < UNEXPLAINED:
            said = f"a multiple of {best.term.in_text(0)} that wanders"
            out.append(Unexplained(fit.sensor.kind, AXES[axis], (), best.chance * count, said))
    return tuple(out)


def _less_coloured(found: Iterable[_Followed]) -> list[_Followed]:
    """What was found, by the power that a share has of most terms, where that is more than that of
    noise: a residual that is not quite white shares more with all of them.
    """
    found = list(found)
    usual = {n: np.median([f.each for f in found if f.longer == n] or [1.0]) for n in LONGER}
    return [replace(f, power=f.power / max(1.0, float(usual[f.longer]))) for f in found]


def _followed(fit: Fit, axis: int, terms: Mapping[str, Term]) -> Iterator[_Followed]:
    """Each term, held against the residual of one axis."""
    columns = [columns_of(fit.sensor.kind, list(terms.values()))]
    beside = fit.beside(fit.residuals(), columns)
    sums: dict[tuple[str, int], np.ndarray] = {}
    for one, tried in zip(fit.linearise(), beside, strict=True):
        if axis not in one.keys:
            continue
        own, others = _white(fit, one, axis), _white(fit, tried, axis)[:, 1:]
        left, signals = _less(own[:, 1:], own[:, 0]), _less(own[:, 1:], others)
        rows = max(int(BLOCK / max(float(np.median(np.diff(one.time))), 1e-9)), FEWEST)
        for text in terms:
            of = [k for k, key in enumerate(tried.keys[axis]) if _is_of(key, text)]
            if of:
                blocks = _Blocks.of(left, signals[:, of], rows)
                for longer in LONGER:
                    at = text, longer
                    sums[at] = sums.get(at, np.zeros(2)) + blocks.joined(longer).explained()
    for (text, longer), (power, shares) in sums.items():
        if shares >= FEWEST:
            yield _Followed(axis, terms[text], longer, float(power), float(shares))


def _is_of(key: Key, text: str) -> bool:
    return isinstance(key, Shape) and key.term == text


def _white(fit: Fit, one: Linear, axis: int) -> np.ndarray:
    """The residual of an axis and its columns (m, 1 + c), white."""
    stacked = np.column_stack([one.residual[:, axis], *one.columns[axis].arrays])
    return fit.noise[axis].whiten(stacked, one.time, one.segments)


def _less(known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Columns less what ``known`` ones explain of them."""
    plane = np.linalg.qr(known / np.maximum(np.linalg.norm(known, axis=0), 1e-300))[0]
    return values - plane @ (plane.T @ values)


@dataclass(frozen=True)
class _Blocks:
    """Of blocks of rows the products (b, k, k) of signals, the same weighed by the residual's
    squares, and the products (b, k) of signals and residual.
    """

    gram: np.ndarray
    weighed: np.ndarray
    score: np.ndarray

    @classmethod
    def of(cls, left: np.ndarray, signals: np.ndarray, rows: int) -> _Blocks:
        count = len(left) // rows
        e = left[: count * rows].reshape(count, rows, 1)
        s = signals[: count * rows].reshape(count, rows, -1)
        both = e * s
        gram, weighed = (np.swapaxes(v, 1, 2) @ v for v in (s, both))
        return cls(gram, weighed, both.sum(axis=1))

    def joined(self, longer: int) -> _Blocks:
        """Blocks so many times longer."""
        count = len(self.score) // longer

        def summed(v: np.ndarray) -> np.ndarray:
            return v[: count * longer].reshape(count, longer, *v.shape[1:]).sum(axis=1)

        return _Blocks(summed(self.gram), summed(self.weighed), summed(self.score))

    def explained(self) -> np.ndarray:
        """Twice the log-likelihood that a share in each block explains, and how many they are: by
        the variance of its own rows where that is more than the noise's, which may follow the
        motion.
        """
        size = np.trace(self.gram, axis1=1, axis2=2)
        there = size > NOTHING * size.max(initial=0.0)
        gram, weighed, score = self.gram[there], self.weighed[there], self.score[there]
        back = np.linalg.inv(gram + NOTHING * size[there, None, None] * np.eye(gram.shape[1]))
        shares = np.einsum("bij,bji->b", gram, back)
        noise = np.einsum("bij,bji->b", weighed, back) / shares
        power = np.einsum("bi,bij,bj->b", score, back, score) / np.maximum(1.0, noise)
        return np.array([power.sum(), shares.sum()])
