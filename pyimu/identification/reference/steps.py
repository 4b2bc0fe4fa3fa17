"""A level that drifts steadily, or falls back by steps of one size beside.

So do two clocks that slip by a sample whenever they have drifted apart by one.

The number of steps before each measurement is a hidden integer, found by the path of greatest
likelihood (Viterbi 1967) in turn with offset, slope and size by least squares. A measurement during
which the level steps may show any value between the two.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit

from pyimu.identification.fit.clock import Slip

MOST = 40
"""Steps either way beyond which none is followed."""

LARGEST = 3
"""Largest jumps between neighbours that are tried for the size of a step."""

ROUNDS = 20

ROUNDING = 1e-12
"""Share of a step's squares below which what a line leaves of it is rounding."""


@dataclass(frozen=True)
class Line:
    """offset + slope time + size number, with ``cov`` (3, 3) of these coefficients.

    ``number`` (k,) are the steps before the end of each measurement, ``inside`` (k,) those during
    which it steps, ``scale`` the factor on the variances; ``likelihood`` [nat] without constants.
    """

    coefficients: np.ndarray
    cov: np.ndarray
    number: np.ndarray
    inside: np.ndarray
    scale: float
    likelihood: float

    @property
    def count(self) -> int:
        return int(np.abs(np.diff(self.number)).sum())

    def at(self, time: np.ndarray, number: np.ndarray) -> np.ndarray:
        return np.column_stack([np.ones(len(time)), time, number]) @ self.coefficients

    @property
    def slope(self) -> tuple[float, float]:
        """Slope in a second and its standard error."""
        return float(self.coefficients[1]), float(np.sqrt(self.cov[1, 1]))

    def std(self, time: np.ndarray) -> float:
        """Standard error of the line, over measurements at ``time`` (k,)."""
        columns = np.column_stack([np.ones(len(time)), time, self.number])
        return float(np.sqrt(np.mean(np.sum((columns @ self.cov) * columns, axis=1))))

    def steps(self, time: np.ndarray, values: np.ndarray) -> tuple[Slip, ...]:
        """When it steps, behind measurements (k,).

        Between two of them, or during one, by the share of it that shows the level before.
        """
        out = []
        for k in np.flatnonzero(np.diff(self.number)) + 1:
            size = float(self.coefficients[2] * (self.number[k] - self.number[k - 1]))
            start, stop = float(time[k - 1]), float(time[k])
            if self.inside[k]:
                after = time[min(k + 1, len(time) - 1)]
                start, stop = (start + stop) / 2, float(stop + after) / 2
                share = (self.at(time[[k]], self.number[[k]])[0] - values[k]) / size
                middle = start + float(np.clip(share, 0.0, 1.0)) * (stop - start)
            else:
                middle = (start + stop) / 2
            out.append(Slip(middle, (stop - start) / float(np.sqrt(12.0)), size))
        return tuple(out)


def constant_likelihood(values: np.ndarray, std: np.ndarray) -> float:
    """Log-likelihood [nat] of one level behind values (k,), on the footing of ``Line``'s."""
    weight = std**-2.0
    left = values - weight @ values / weight.sum()
    return _likelihood(left, std)[0]


def ramp(time: np.ndarray, values: np.ndarray, std: np.ndarray) -> Line:
    """A steady drift behind measurements (k,), at least 4."""
    still = np.zeros(len(time), dtype=np.int64)
    return _fitted(time, values, std, still, np.zeros(len(time), dtype=bool))


def stepped(time: np.ndarray, values: np.ndarray, std: np.ndarray) -> Line | None:
    """A steady drift with steps of one size behind measurements (k,); None where none is seen.

    Each step costs the logarithm of their number, the chances of its place (Schwarz 1978). Steps
    that all come and go again are faults of single measurements.
    """
    starts = [_one_step(time, values, std), *_by_jumps(time, values, std)]
    lines = [one for s in starts if (one := _settled(time, values, std, s)) is not None]
    return max(lines, key=lambda one: one.likelihood - cost(one), default=None)


def cost(line: Line) -> float:
    """Nats that a line with steps must gain beyond one without, to be worth its coefficients."""
    return (0.5 * (line.count > 0) + line.count) * float(np.log(len(line.number)))


def _settled(time, values, std, line: Line | None) -> Line | None:
    """The line with steps that a first one leads to."""
    for _ in range(ROUNDS):
        if line is None or not line.count or not line.scale > 0.0:
            return None
        offset, slope, size = line.coefficients
        left, sigma = values - offset - slope * time, np.sqrt(line.scale) * std
        number, inside = _path(left, sigma, abs(size), float(np.log(len(time))))
        number = number if size > 0 else -number
        same = np.array_equal(number, line.number) and np.array_equal(inside, line.inside)
        line = _fitted(time, values, std, number, inside)
        if same:
            break
    return line if line is not None and line.number[-1] != line.number[0] else None


def _fitted(time, values, std, number, inside) -> Line | None:
    """The line by least squares for given steps; None where too little is left to tell one."""
    use = ~inside
    columns = np.column_stack([np.ones(len(time)), time, number])
    free = [0, 1, 2] if np.ptp(number[use]) else [0, 1]
    if use.sum() <= len(free) + 1 or (number.any() and len(free) < 3):
        return None
    a = columns[use][:, free] / std[use, None]
    gram = np.linalg.pinv(a.T @ a)
    found = np.zeros(3)
    found[free] = gram @ (a.T @ (values[use] / std[use]))
    likelihood, scale = _likelihood((values - columns @ found)[use], std[use])
    cov = np.zeros((3, 3))
    cov[np.ix_(free, free)] = gram * scale * use.sum() / (use.sum() - len(free))
    likelihood -= inside.sum() * np.log(max(abs(found[2]), 1e-300))
    return Line(found, cov, number, inside, scale, float(likelihood))


def _likelihood(left: np.ndarray, std: np.ndarray) -> tuple[float, float]:
    """Gaussian log-likelihood [nat] at the best factor on the variances, and that factor."""
    scale = max(float(np.mean((left / std) ** 2)), 1e-300)
    return -0.5 * float(np.sum(np.log(2 * np.pi * scale * std**2)) + len(left)), scale


# Where to begin


def _one_step(time, values, std) -> Line | None:
    """The best line with a single step, wherever it is: that which takes most off the squares that
    a line leaves.

    What a line leaves of a step is the step less its projection, so that sums from the step on are
    enough (Frisch and Waugh 1933).
    """
    if len(time) < 2:
        return None
    line, _ = np.linalg.qr(np.column_stack([np.ones(len(time)), time]) / std[:, None])
    left = values / std - line @ (line.T @ (values / std))
    seen, power, across = (
        np.cumsum(v[::-1], axis=0)[::-1] for v in (left / std, std**-2.0, line / std[:, None])
    )
    own = power - np.sum(across**2, axis=1)
    taken = np.where(own > ROUNDING * power, seen**2 / np.maximum(own, 1e-300), 0.0)
    number = (np.arange(len(time)) > np.argmax(taken[1:])).astype(np.int64)
    return _fitted(time, values, std, number, np.zeros(len(time), dtype=bool))


def _by_jumps(time, values, std) -> list[Line]:
    """Lines whose step is one of the largest jumps, with the slope of most neighbours."""
    rates = np.diff(values) / np.diff(time)
    slope, out = float(np.median(rates)), []
    for apart in (1, 2):
        jumps = values[apart:] - values[:-apart] - slope * (time[apart:] - time[:-apart])
        spread = np.sqrt(std[apart:] ** 2 + std[:-apart] ** 2)
        scale = float(np.median(np.abs(jumps / spread)) / 0.6745) ** 2
        for k in np.argsort(-np.abs(jumps))[:LARGEST]:
            coefficients = np.array([values[0] - slope * time[0], slope, jumps[k]])
            number = (np.arange(len(time)) >= k + apart).astype(np.int64)
            none = np.zeros(len(time), dtype=bool)
            cov = np.zeros((3, 3))
            out.append(Line(coefficients, cov, number, none, max(scale, 1e-12), -np.inf))
    return out


@njit(cache=True)
def _path(left, sigma, size, price):
    """Steps (k,) before the end of each measurement, and where it steps inside.

    On the path of greatest likelihood, steps being of a ``size`` > 0, less the ``price`` of each.
    """
    n, states = len(left), 2 * MOST + 1
    score = np.full(states, -np.inf)
    score[MOST] = -0.5 * (left[0] / sigma[0]) ** 2
    came = np.zeros((n, states), dtype=np.int64)
    within = np.zeros((n, states), dtype=np.bool_)
    for k in range(1, n):
        fresh = np.full(states, -np.inf)
        for j in range(states):
            gauss = -0.5 * ((left[k] - (j - MOST) * size) / sigma[k]) ** 2
            gauss -= np.log(2.5066282746310002 * sigma[k])
            for d in (-1, 0, 1):
                i = j - d
                if i < 0 or i >= states or score[i] == -np.inf:
                    continue
                worth, mixed = score[i] + gauss, False
                if d != 0:
                    below, above = min(i, j) - MOST, max(i, j) - MOST
                    if below * size < left[k] < above * size and -np.log(size) > gauss:
                        worth, mixed = score[i] - np.log(size), True
                    worth -= price
                if worth > fresh[j]:
                    fresh[j], came[k, j], within[k, j] = worth, d, mixed
        score = fresh
    number, inside = np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.bool_)
    j = int(np.argmax(score))
    for k in range(n - 1, -1, -1):
        number[k], inside[k] = j - MOST, within[k, j]
        j -= came[k, j]
    return number, inside
