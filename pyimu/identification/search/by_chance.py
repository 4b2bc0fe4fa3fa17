"""What the best of many values of a form explains where there is nothing to find.

Where the part says how much the sensor wanders, that is the best of many correlated numbers. Where
nobody does, the walk is estimated anew beside each value, and a few events may stand for all of a
walk: what they explain by chance is found by drawing walks as the residual allows them (parametric
bootstrap), placing the events one after another where they explain most, and estimating the walk
again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import logsumexp

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.noise_fit import declared_variances
from pyimu.identification.fit.whiten import Autoregressive, RandomWalk
from pyimu.identification.search.blocks import Blocks, basis, beside
from pyimu.model.effect import Effect

CHANCE = 0.01
"""Share of logs with nothing to find in which the best value may gain more than the toll says."""

DRAWS, SINGLE_DRAWS = 1000, 100_000
"""Draws of the best of all values, and of one that was named beforehand."""

BLOCKS, VALUES = 200, 120
"""Blocks of the longest log on which chance is drawn, and values of a form; between them the others
lie."""

FACTOR = 4.0
"""From one walk's K^2 that is tried to the next."""

BEYOND = 2
"""Larger walks that are tried than the residual allows."""

UNLIKELY = 1e-4
"""Weight of a walk that the residual does not allow."""


@dataclass(frozen=True)
class _Walk:
    """An axis beside one noise: an orthonormal ``base`` (n, b) of what the model explains, draws
    (n, d) of the residual, white and without that, and their log-likelihood (d,) [nat].
    """

    noise: RandomWalk | Autoregressive
    base: np.ndarray
    draws: np.ndarray
    likelihood: np.ndarray


class _Events:
    """What values explain of the draws of an axis beside one walk, those before being in.

    ``score`` and ``power`` (T, d) are those of each value's column without the columns before,
    ``likelihood`` (d,) that of what is in.
    """

    def __init__(self, walk: _Walk, columns: np.ndarray) -> None:
        self.gram, self.score = columns.T @ columns, columns.T @ walk.draws
        self.power = np.repeat(np.diag(self.gram)[:, None], walk.draws.shape[1], axis=1)
        self.likelihood, self.before = walk.likelihood.copy(), []

    def gain(self) -> np.ndarray:
        """Log-likelihood (T, d) [nat] beside each value."""
        shown = self.power > 1e-6
        found = 0.5 * self.score**2 / np.where(shown, self.power, 1.0)
        return self.likelihood + np.where(shown, found, 0.0)

    def take(self, best: np.ndarray, wanted: np.ndarray) -> None:
        """Put the values ``best`` (d,) in, in the draws that are ``wanted`` (d,)."""
        every = np.arange(len(best))
        column = self.gram[:, best]
        for other in self.before:
            column = column - other * other[best, every]
        power = self.power[best, every]
        use = wanted & (power > 1e-6)
        column = np.where(use, column / np.sqrt(np.where(use, power, 1.0)), 0.0)
        along = np.where(use, self.score[best, every] / np.sqrt(np.where(use, power, 1.0)), 0.0)
        self.likelihood += 0.5 * along**2
        self.score -= column * along
        self.power -= column**2
        self.before.append(column)


class Chance:
    """Draws of what a fit leaves where nothing is missing."""

    def __init__(self, fit: Fit, linears: Sequence[Linear], penalty: float, seed: int = 1) -> None:
        self.fit, self.penalty, self.seed = fit, penalty, seed
        self.blocks = Blocks(fit, linears, BLOCKS)

    @cached_property
    def axes(self) -> dict[int, list[_Walk]]:
        rng = np.random.default_rng(self.seed)
        return {i: self._walks(i, rng) for i in self.fit.noise}

    def _walks(self, axis: int, rng: np.random.Generator) -> list[_Walk]:
        """The noises that an axis may have, and draws of it."""
        noise, left = self.fit.noise[axis], self.blocks.left[axis]
        declared = declared_variances(self.fit.sensor, self.fit.trials[0].h)[1][axis]
        if not isinstance(noise, RandomWalk) or 0.0 < noise.k2 <= declared:
            white, _ = self.blocks.white(left, noise)
            base = basis(white[:, 1:])
            draws = rng.standard_normal((len(white), DRAWS))
            draws -= base @ (base.T @ draws)
            return [_Walk(noise, base, draws, np.zeros(DRAWS))]
        tried, likely = self._allowed(noise, left)
        k2 = rng.choice([n.k2 for n in tried], DRAWS, p=np.exp(likely - logsumexp(likely)))
        drawn = self.blocks.drawn(noise.r, k2, rng)
        return [self._beside(n, left, drawn) for n in tried]

    def _allowed(
        self, noise: RandomWalk, left: Sequence[np.ndarray]
    ) -> tuple[list[RandomWalk], np.ndarray]:
        """The walks that a residual allows or that are less, and the logarithms of their weights:
        the restricted likelihood, all sizes K alike beforehand (``fit/walk.py``).
        """
        rows = sum(len(one.time) for _, one, *_ in self.blocks.trials)
        least = noise.r / rows / self.blocks.length
        count = max(c for *_, c in self.blocks.trials)
        most = FACTOR**BEYOND * max(noise.r / count / self.blocks.block, FACTOR * noise.k2)
        number = 1 + int(np.ceil(np.log(most / least) / np.log(FACTOR)))
        tried, weights = [], []
        for k2 in least * FACTOR ** np.arange(max(number, 2)):
            one = replace(noise, k2=float(k2))
            white, log_det = self.blocks.white(left, one)
            base = basis(white[:, 1:])
            rest = white[:, 0] - base @ (base.T @ white[:, 0])
            tried.append(one)
            weights.append(
                -0.5 * (float(rest @ rest) + log_det) - _log_volume(white[:, 1:]) + 0.5 * np.log(k2)
            )
        likely = np.array(weights) - logsumexp(weights)
        # Of a draw a larger walk may be the likeliest than the one that it was drawn with.
        last = int(np.flatnonzero(likely > np.log(UNLIKELY))[-1]) + BEYOND
        return tried[: last + 1], likely[: last + 1]

    def _beside(
        self, noise: RandomWalk, left: Sequence[np.ndarray], drawn: Sequence[np.ndarray]
    ) -> _Walk:
        both = [np.hstack([d, c[:, 1:]]) for d, c in zip(drawn, left, strict=True)]
        white, log_det = self.blocks.white(both, noise)
        base, draws = basis(white[:, DRAWS:]), white[:, :DRAWS]
        draws = draws - base @ (base.T @ draws)
        return _Walk(noise, base, draws, -0.5 * (np.sum(draws**2, axis=0) + log_det))

    def tolls(self, e: Effect, name: str, values: np.ndarray, most: int) -> np.ndarray:
        """How much more (most,) the best of all ``values`` of a coefficient gains by chance than
        one that was named beforehand, and so many of them, each beside those before.
        """
        apart = -(-len(values) // VALUES)
        made = self.blocks.columns(e, name, values[::apart])
        events, near = {}, []
        for i, walks in self.axes.items():
            columns = [beside(self._white(made, i, w), w.base) for w in walks]
            events[i] = [_Events(w, c) for w, c in zip(walks, columns, strict=True)]
            near.append(_neighbours(columns[0]))
        largest = self._largest(events, most)
        between = (1.0 - float(np.median(near)) ** 2) * np.log(apart)
        return largest - self._single + between * np.arange(1, most + 1)

    def _white(self, made: Sequence[np.ndarray], axis: int, walk: _Walk) -> np.ndarray:
        return self.blocks.white([one[:, :, axis] for one in made], walk.noise)[0]

    def _largest(self, events: dict[int, list[_Events]], most: int) -> np.ndarray:
        """What the best values gain [nat] in all but ``CHANCE`` of the draws, one, two, ..."""
        total, out, every = np.zeros(DRAWS), [], np.arange(DRAWS)
        for _ in range(most):
            gains = {i: self._gain(of_axis) for i, of_axis in events.items()}
            each = np.sum([np.maximum(g, 0.0) for g in gains.values()], axis=0)
            best = np.argmax(each, axis=0)
            total = total + each[best, every]
            out.append(float(np.quantile(total, 1.0 - CHANCE)))
            for i, of_axis in events.items():
                for one in of_axis:
                    one.take(best, gains[i][best, every] > 0.0)
        return np.array(out)

    def _gain(self, of_axis: list[_Events]) -> np.ndarray:
        """Gain (T, d) [nat], penalised, of each value on an axis, beside the walk that suits it
        best, over the likeliest walk without it.
        """
        with_it = np.max([one.gain() for one in of_axis], axis=0)
        return with_it - np.max([one.likelihood for one in of_axis], axis=0) - self.penalty

    @cached_property
    def _single(self) -> float:
        """The same of one value that was named beforehand, beside a noise that is known."""
        z = np.random.default_rng(self.seed).standard_normal((SINGLE_DRAWS, len(self.axes)))
        gains = np.maximum(0.5 * z**2 - self.penalty, 0.0)
        return float(np.quantile(gains.sum(axis=1), 1.0 - CHANCE))


def _neighbours(columns: np.ndarray) -> float:
    """Typical correlation of a column with the next."""
    if columns.shape[1] < 2:
        return 1.0
    return float(np.median(np.abs(np.sum(columns[:, 1:] * columns[:, :-1], axis=0))))


def _log_volume(columns: np.ndarray) -> float:
    """Half the logarithm of the determinant of what columns say of their coefficients."""
    sizes = np.linalg.svd(columns, compute_uv=False)
    return float(np.log(sizes[sizes > 1e-9 * sizes.max(initial=0.0)]).sum())
