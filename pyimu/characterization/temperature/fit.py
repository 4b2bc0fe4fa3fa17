r"""Bias against temperature: a polynomial by generalised least squares, and whether rising and
falling temperature agree.

    y = b0 + k_T (T - T0) + k_2 (T - T0)^2 + k_3 (T - T0)^3 + noise

on block means (``blocks``), the noise being white and a random walk, found together with the
polynomial (``walk``). A bias that walks and a temperature that drifts go together by chance:
ordinary regression takes that for a thermal effect. In 400 simulated records of a warm-up, of a
chamber's cycles and of weather its 95 % interval held the true k_T in 9, 40 and 13 of a hundred,
this one in 94, 93 and 96 (tests/test_thermal.py).

The order is the lowest that no higher one improves on beyond chance (F tests at ``CHANCE``
together), with the noise that the highest leaves, since too low an order makes noise of what it
lacks. Zero is an order: no effect of temperature is warranted.

Hysteresis: the polynomial and a play of half width w, g = (T - play(T)) / w, which is 1 on a rising
branch and -1 on a falling one, and goes from one to the other within 2 w of a turn; the opening of
the loop is twice its coefficient. Some widths are tried, and the significance counts them. A
sensor whose temperature lags behind the thermometer opens a loop too, and cannot be told from one
that remembers. Noise and steps of the thermometer, which would make the coefficients too small,
are smoothed away (``thermometer``).

b0 is the bias at T0 at the start of the log: where a bias walks it has no other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numba import njit
from scipy.stats import f as f_law

from pyimu.characterization.noise.estimate import Estimate
from pyimu.characterization.temperature.averages import Blocks
from pyimu.characterization.temperature.regression import Regression, regress
from pyimu.characterization.temperature.thermometer import smoothed
from pyimu.errors import UserError

NAMES = ("b0", "kT", "k2", "k3")
"""Coefficients by order; in the catalogue ``turn_on_bias.b0`` and the three ``thermal_bias``
effects."""

CATALOGUE = {
    "kT": ("thermal_bias", "kT"),
    "k2": ("thermal_bias_quadratic", "k2"),
    "k3": ("thermal_bias_cubic", "k3"),
}

CHANCE = 1e-3
"""An effect is warranted where noise without it would look so with at most this probability."""

FEWEST = 20
"""Blocks."""

STEADY = 0.5
"""A temperature, smoothed, whose standard deviation is no more than that share of its own noise in
a block says nothing."""

PLAYS = (0.02, 0.05, 0.1, 0.2)
"""Half widths of the play that are tried, as shares of the range of the temperature."""

BOTH_WAYS = 0.25
"""Share of the range that both branches must cover for a loop to be looked for."""


@dataclass(frozen=True)
class Hysteresis:
    """``opening``: bias on the rising branch less that on the falling one, in the samples' unit.

    ``kh`` [unit/K] and ``width`` [K] are those of the catalogue's ``thermal_hysteresis``.
    """

    opening: Estimate
    p_value: float
    width: float

    @property
    def warranted(self) -> bool:
        return self.p_value < CHANCE

    @property
    def kh(self) -> float:
        return -self.opening.value / (2 * self.width)


@dataclass(frozen=True)
class ThermalFit:
    """The polynomial of one channel: ``coefficients`` by name, unit of the samples per K^n, their
    ``covariance`` in that order.

    ``p_value`` is that of no effect of temperature at all; with ``order`` 0 ``bound`` is the
    largest abs(k_T) that the data allow, else it is nan. ``N`` [unit sqrt(s)] and ``K``
    [unit/sqrt(s)] are the noise of the block means. ``hysteresis`` is None where ``no_hysteresis``
    says why none could be looked for. Arrays (m,) for the picture: ``residual`` is ``bias`` less
    ``fitted``, ``temperature`` is without the thermometer's noise, ``branch`` 1 where it rises, -1
    where it falls, 0 on a turn, ``loop`` what the hysteresis adds to the polynomial, zero where it
    is not warranted.
    """

    order: int
    T0: float
    coefficients: Mapping[str, Estimate]
    covariance: np.ndarray
    bound: float
    p_value: float
    N: float
    K: float
    hysteresis: Hysteresis | None
    no_hysteresis: str
    time: np.ndarray
    temperature: np.ndarray
    bias: np.ndarray
    branch: np.ndarray
    loop: np.ndarray

    @property
    def warranted(self) -> bool:
        """Whether temperature has an effect at all."""
        return self.order > 0 or (self.hysteresis is not None and self.hysteresis.warranted)

    def effect(self, time: np.ndarray) -> np.ndarray:
        """What temperature makes of the bias (n,) at times (n,) s of the log: the polynomial, and
        the loop where it is warranted.
        """
        return self.at(np.interp(time, self.time, self.temperature)) + np.interp(
            time, self.time, self.loop
        )

    def at(self, temperature: np.ndarray) -> np.ndarray:
        """The polynomial at temperatures in degC."""
        return np.polynomial.polynomial.polyval(
            np.asarray(temperature, dtype=float) - self.T0,
            [c.value for c in self.coefficients.values()],
        )

    @property
    def fitted(self) -> np.ndarray:
        """The polynomial (m,) on the level of the whole log."""
        return self.at(self.temperature) + self.level

    @property
    def level(self) -> float:
        """Of the whole log above b0, which is that of its start, from where the walk goes on."""
        return float(np.mean(self.bias - self.at(self.temperature)))

    @property
    def residual(self) -> np.ndarray:
        return self.bias - self.fitted

    def parameters(self) -> dict[tuple[str, str], float]:
        """Values of the catalogue's effects that are warranted, by (effect, parameter)."""
        out = {CATALOGUE[n]: c.value for n, c in self.coefficients.items() if n in CATALOGUE}
        out |= {(effect, "T0"): self.T0 for effect, _ in out}
        h = self.hysteresis
        return out | (
            {("thermal_hysteresis", "kh"): h.kh, ("thermal_hysteresis", "width"): h.width}
            if h is not None and h.warranted
            else {}
        )


def fit_thermal(
    blocks: Blocks,
    column: int = 0,
    level: float = 0.95,
    T0: float | None = None,
    order: int | None = None,
) -> ThermalFit:
    """Polynomial and hysteresis of one column; ``T0`` [degC] is where b0 is the bias: the mean
    temperature, to 0.1, unless given.

    ``order``: of the polynomial, instead of what the data warrant.

    Raises UserError where there are too few blocks, the temperature is constant, or no more than
    its own noise.
    """
    _check(blocks)
    temperature, values = _steadied(blocks), blocks.values[:, column]
    if np.ptp(values) == 0:
        raise UserError("no thermal fit is possible: the channel is constant")
    blocks = replace(blocks, temperature=temperature)
    T0 = round(float(np.average(temperature, weights=blocks.count)), 1) if T0 is None else float(T0)
    span = float(np.ptp(temperature))
    powers = ((temperature - T0) / span)[:, None] ** np.arange(_highest(temperature) + 1)
    chosen, p_value = _order(blocks, values, powers, (), order)
    loop, why = _hysteresis(blocks, values, powers[:, : chosen + 1], level)
    extra: Sequence[np.ndarray] = ()
    if loop is not None and loop.warranted:
        extra = (_play(temperature, loop.width),)
        chosen, p_value = _order(blocks, values, powers, extra, order)
        loop = _opening(
            blocks, values, powers[:, : chosen + 1], loop.width, level, len(_halves(temperature))
        )
    fit = regress(blocks, values, np.column_stack([powers[:, : chosen + 1], *extra]))
    scale = span ** -np.arange(chosen + 1.0)
    estimates = _estimates(fit, scale, level)
    bound = np.nan
    if chosen == 0:
        slope = _estimates(
            regress(blocks, values, np.column_stack([powers[:, :2], *extra])),
            np.array([1, 1 / span]),
            level,
        )[1]
        bound = max(abs(slope.low), abs(slope.high))
    covariance = fit.covariance[: chosen + 1, : chosen + 1] * np.outer(scale, scale)
    branch = np.trunc(_play(temperature, PLAYS[1] * span)).astype(int)
    warranted = loop is not None and loop.warranted
    looped = (
        loop.opening.value / 2 * _play(temperature, loop.width)
        if warranted
        else np.zeros(len(temperature))
    )
    return ThermalFit(
        chosen,
        T0,
        dict(zip(NAMES, estimates, strict=False)),
        covariance,
        float(bound),
        p_value,
        fit.N,
        fit.K,
        loop,
        why,
        blocks.time,
        temperature,
        values,
        branch,
        looped,
    )


def _check(blocks: Blocks) -> None:
    if len(blocks.time) < FEWEST:
        raise UserError(
            f"no thermal fit is possible: {len(blocks.time)} blocks of samples, at least {FEWEST} "
            "are needed; a longer log would do"
        )
    if np.ptp(blocks.temperature) == 0:
        raise UserError(
            f"no thermal fit is possible: the temperature is constant, {blocks.temperature[0]:.2f} "
            "degC; "
            "a log in which it changes would do"
        )


def _steadied(blocks: Blocks) -> np.ndarray:
    """The temperature without the thermometer's noise."""
    temperature = smoothed(blocks)
    noise = np.std(blocks.temperature - temperature)
    if np.std(temperature) <= STEADY * noise or np.ptp(temperature) < 1e-9:
        raise UserError(
            "no thermal fit is possible: the temperature stays at "
            f"{np.mean(blocks.temperature):.2f} degC within the thermometer's "
            f"noise, {noise:.2g} K; a log in which it changes would do"
        )
    return temperature


def _highest(temperature: np.ndarray) -> int:
    """The highest order that is looked at: fewer where the thermometer shows few temperatures."""
    return min(len(NAMES) - 1, len(np.unique(temperature)) - 1)


def _order(
    blocks: Blocks,
    values: np.ndarray,
    powers: np.ndarray,
    extra: Sequence[np.ndarray],
    given: int | None,
) -> tuple[int, float]:
    """The order, unless given, and the probability that noise alone improves as much on order
    zero.
    """
    highest = powers.shape[1] - 1
    weights = regress(blocks, values, np.column_stack([powers, *extra])).weights
    fits = [
        regress(blocks, values, np.column_stack([powers[:, : p + 1], *extra]), weights)
        for p in range(highest + 1)
    ]
    # Each against all higher ones.
    chances = [
        min(1.0, (highest - p) * min(_gain(fits[p], fits[q]) for q in range(p + 1, highest + 1)))
        for p in range(highest)
    ]
    warranted = next((p for p, chance in enumerate(chances) if chance >= CHANCE), highest)
    return warranted if given is None else min(given, highest), chances[0]


def _gain(low: Regression, high: Regression) -> float:
    """Probability that noise alone gains as much by the terms that the second has more."""
    terms = low.freedom - high.freedom
    return float(
        high.weights
        @ f_law.sf(
            (low.squares - high.squares) / terms / (high.squares / high.freedom),
            terms,
            high.freedom,
        )
    )


def _estimates(fit: Regression, scale: np.ndarray, level: float) -> list[Estimate]:
    """The first coefficients, as many as ``scale``, times that."""
    means, stds = fit.mean, np.sqrt(np.diag(fit.covariance))
    return [
        Estimate(
            float(means[j] * s),
            float(stds[j] * s),
            *(float(s * end) for end in fit.interval(j, level)),
        )
        for j, s in enumerate(scale)
    ]


@njit(cache=True)
def _play(temperature, half):
    """(T - play(T)) / half, from -1 to 1; zero at the start, where the past is unknown."""
    lag, out = 0.0, np.zeros(len(temperature))
    for i in range(1, len(temperature)):
        lag = min(half, max(-half, lag + temperature[i] - temperature[i - 1]))
        out[i] = lag / half
    return out


def _halves(temperature: np.ndarray) -> list[float]:
    """Half widths [K] of the play for which both branches cover enough of the same temperatures."""
    span, found = np.ptp(temperature), []
    for half in span * np.array(PLAYS):
        g = _play(temperature, half)
        up, down = temperature[g == 1], temperature[g == -1]
        if (
            len(up)
            and len(down)
            and min(up.max(), down.max()) - max(up.min(), down.min()) >= BOTH_WAYS * span
        ):
            found.append(float(half))
    return found


def _hysteresis(
    blocks: Blocks, values: np.ndarray, powers: np.ndarray, level: float
) -> tuple[Hysteresis | None, str]:
    """The loop of the most significant width, or why none can be looked for."""
    halves = _halves(blocks.temperature)
    if not halves:
        return (
            None,
            "the temperature does not come back over a quarter of its range, rising and falling",
        )
    loops = [_opening(blocks, values, powers, half, level, len(halves)) for half in halves]
    return min(
        loops, key=lambda loop: (loop.p_value, -abs(loop.opening.value) / loop.opening.std)
    ), ""


def _opening(
    blocks: Blocks, values: np.ndarray, powers: np.ndarray, half: float, level: float, tried: int
) -> Hysteresis:
    fit = regress(blocks, values, np.column_stack([_play(blocks.temperature, half), powers]))
    opening, above = _estimates(fit, np.array([2.0]), level)[0], fit.tail(0, 0.0)
    return Hysteresis(opening, min(1.0, max(0.0, tried * 2 * min(above, 1 - above))), half)
