"""What remains once no effect of the catalogue helps: dependence on inputs, more noise than
declared, rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from itertools import combinations_with_replacement
from typing import Any

import numpy as np
from scipy.stats import chi2

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.keys import Product
from pyimu.identification.fit.reference_noise import equations
from pyimu.identification.fit.trial import Trial, white_noise
from pyimu.identification.fit.whiten import RandomWalk, power_less_bias
from pyimu.identification.search.screen import Projected, dispersion
from pyimu.model.signals import COLUMNS, N_INPUT, SIGNALS, SURROUNDINGS
from pyimu.recording.quality.resolution import quantization_step

TRIED = ("rate", "specific_force", *SURROUNDINGS)
"""The signals that a residual which nothing explains is tried against."""

SIGNAL_OF = tuple(name for name in TRIED for _ in range(SIGNALS[name].size))
PLACES = np.concatenate([np.arange(N_INPUT)[COLUMNS[name]] for name in TRIED])
INPUT_NAMES = tuple(
    name + suffix
    for name in TRIED
    for suffix in (("",) if SIGNALS[name].size == 1 else ("_x", "_y", "_z"))
)
"""Of each number of those signals: its signal, its place in the input vector, and its name."""

UNEXPLAINED = 1e-3
"""Family-wise p-value below which a dependence on inputs is reported."""

DRIFT_GATE = 5.0
"""Log-likelihood [nat] by which a larger random walk must beat the declared one on some axis: 1 %
in three one-sided tests."""

NOISE = 2.0**0.5
"""Times its own noise that an input must spread: at least half of its power is then a signal."""

SHARE = 0.03
"""Share of the white variance that rounding must explain before it is named (a step of 0.6 sigma).
"""


@dataclass(frozen=True)
class Unexplained:
    """A product of inputs on which a residual depends although no effect of the model says so, or
    the ``shape`` of what is random in it and no effect either.
    """

    sensor: str
    axis: str
    depends_on: tuple[str, ...]
    p_value: float
    shape: str = ""

    def as_dict(self) -> dict[str, Any]:
        return asdict(self) | {"depends_on": list(self.depends_on)}


def lack_of_fit(fit: Fit) -> Unexplained | None:
    """The product of two inputs, or the cube of one, on which the residual still depends most
    clearly, if any does.

    Each product is tried on each axis; its chi-square is corrected for the scatter of the scores
    and its p-value for the number of trials (Bonferroni).
    """
    if all(t.reference == "static" and "temperature" not in t.known for t in fit.trials):
        return None
    normal = equations(fit, lambda f: f.linearise((), [_products(fit.trials)]))
    wanted = [i for i, k in enumerate(normal.keys) if isinstance(k, Product)]
    if not wanted:
        return None
    projected = Projected.of(
        normal, [i for i in range(len(normal.keys)) if i not in set(wanted)], wanted
    )
    found = []
    for place, column in enumerate(wanted):
        if projected.gram[place, place] > 0:
            statistic = (
                projected.score[place] ** 2
                / projected.gram[place, place]
                / dispersion(projected, (place,))
            )
            found.append((float(chi2.sf(statistic, 1)) * len(wanted), normal.keys[column]))
    p_value, key = min(found, key=lambda f: f[0], default=(1.0, None))
    if p_value >= UNEXPLAINED:
        return None
    return Unexplained(
        fit.sensor.kind,
        "xyz"[key.axis],
        tuple(dict.fromkeys(INPUT_NAMES[j] for j in key.inputs)),
        p_value,
    )


def _products(trials: tuple[Trial, ...]) -> Callable:
    """Column maker: products of two inputs and cubes of one, each input freed of its mean and
    scaled over all logs.
    """
    known = frozenset.intersection(*(t.known for t in trials))
    together = np.concatenate([t.u[:, PLACES] for t in trials])
    mean, scale = together.mean(axis=0), together.std(axis=0)
    least = np.maximum(NOISE * _own_noise(trials), 1e-9 * (1 + np.abs(mean)))
    usable = [j for j in range(len(SIGNAL_OF)) if SIGNAL_OF[j] in known and scale[j] > least[j]]
    terms = [*combinations_with_replacement(usable, 2), *((j, j, j) for j in usable)]

    def add_all(trial: Trial, u: np.ndarray, y: np.ndarray, add: Callable) -> None:
        z = (trial.u[:, PLACES] - mean) / np.where(scale > 0, scale, 1.0)
        for term in terms:
            values = np.prod(z[:, list(term)], axis=1)
            for i in range(3):
                add(Product(term, i), i, values)

    return add_all


def _own_noise(trials: tuple[Trial, ...]) -> np.ndarray:
    """Standard deviation of the white noise of each input."""
    each = [[white_noise(t, t.u[:, [place]])[0] for place in PLACES] for t in trials]
    return np.sqrt(np.mean(np.square(np.nan_to_num(each)), axis=0))


@dataclass(frozen=True)
class NoiseFigure:
    """N and K of one axis with their standard errors (SI)."""

    N: float
    N_std: float
    K: float
    K_std: float


def noise_figures(fit: Fit) -> dict[int, NoiseFigure] | None:
    """White noise and random walk of each axis as the residual shows them; None where the reference
    was differentiated.
    """
    if any(not isinstance(n, RandomWalk) for n in fit.seen.values()):
        return None
    h, rows, residuals = fit.trials[0].h, sum(t.count for t in fit.trials), fit.residuals()
    return {
        i: NoiseFigure(
            np.sqrt(n.r * h), np.sqrt(n.r * h / (2 * rows)), np.sqrt(n.k2), _k_std(residuals, i, n)
        )
        for i, n in fit.seen.items()
    }


def _k_std(residuals: list[Linear], axis: int, noise: RandomWalk) -> float:
    """Standard error of K from the curvature of the likelihood in log K; infinite where it is
    flat.
    """
    if noise.k2 == 0.0:
        return np.inf
    step = 0.2
    low, mid, high = (
        axis_likelihood(residuals, axis, RandomWalk(noise.r, noise.k2 * np.exp(2 * d)))
        for d in (-step, 0.0, step)
    )
    curvature = (2 * mid - low - high) / step**2
    return float(np.sqrt(noise.k2 / curvature)) if curvature > 0 else np.inf


def axis_likelihood(residuals: list[Linear], axis: int, noise: RandomWalk) -> float:
    """Log-likelihood [nat] of one axis of the residuals under a noise, with the bias of each log
    that suits it best.
    """
    total = 0.0
    for one in residuals:
        white = noise.whiten(
            np.column_stack([one.residual[:, axis], np.ones(len(one.time))]), one.time, one.segments
        )
        total -= 0.5 * (power_less_bias(white) + noise.log_det(one.time, one.segments))
    return total


def walk_gain(fit: Fit, declared: np.ndarray) -> np.ndarray:
    """Log-likelihood [nat] by which the fitted random walk beats the declared one on each axis,
    (3,).
    """
    residuals, out = fit.residuals(), np.full(3, np.nan)
    for i, n in fit.seen.items():
        out[i] = axis_likelihood(residuals, i, n) - axis_likelihood(
            residuals, i, RandomWalk(n.r, float(declared[i] ** 2))
        )
    return out


def drift(fit: Fit, declared_k: np.ndarray) -> dict[int, float]:
    """Axes on which the random walk is larger than declared beyond chance, and the gain [nat] of
    letting it be.
    """
    gain = walk_gain(fit, declared_k)
    return {
        i: float(gain[i])
        for i, n in fit.seen.items()
        if n.k2 > declared_k[i] ** 2 and gain[i] > DRIFT_GATE
    }


def rounding(trials: tuple[Trial, ...], white: np.ndarray) -> dict[int, float]:
    """Steps q by axis on which every raw sample lies and which matter against white noise of
    standard deviation (3,).
    """
    found = {}
    for i in range(3):
        steps = [
            quantization_step(np.concatenate([t.y[a:b, i] for a, b in t.row_segments]))
            for t in trials
            if t.count
        ]
        if steps and all(s is not None for s in steps) and np.isfinite(white[i]):
            q = float(np.median(steps))
            if q**2 / 12 > SHARE * white[i] ** 2:
                found[i] = q
    return found


def comb_gain(trials: tuple[Trial, ...], steps: dict[int, float]) -> float:
    """Log-likelihood [nat] by which samples that lie on a comb of step q speak for it, against
    samples that lie anywhere.

    A sample within m of the nearest multiple has density 1/(2 m) there instead of 1/q: ln(q / 2 m)
    each.
    """
    total = 0.0
    for i, q in steps.items():
        values = np.concatenate([t.y[a:b, i] for t in trials for a, b in t.row_segments])
        offsets = (values - values[0]) / q
        miss = max(float(np.abs(offsets - np.round(offsets)).max()) * q, 1e-6 * q)
        total += len(values) * np.log(q / (2 * miss))
    return total
