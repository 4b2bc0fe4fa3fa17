r"""Bias against temperature: a polynomial by generalised least squares, and a loop of hysteresis.

    y = b0 + k_T (T - T0) + k_2 (T - T0)^2 + k_3 (T - T0)^3 + noise

is fitted to averages over intervals (``averages``). The noise is white and a random walk, which are
found together with the polynomial (``regression``). A bias that walks and a temperature that drifts
go together by chance: ordinary regression takes that for a thermal effect. In 400 simulated records
of a warm-up, of a chamber's cycles and of weather its 95 % interval held the true k_T in 9, 40 and
13 of a hundred, this one in 94, 93 and 96 (test_thermal.py).

How many terms the data warrant is decided in ``order``, whether there is a loop in ``hysteresis``.
Noise and steps of the thermometer, which would make the coefficients too small, are smoothed out
(``thermometer``).

b0 is the bias at T0 at the start of the log: where a bias walks it has no other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from pyimu.characterization.estimate import Estimate
from pyimu.characterization.temperature.averages import Averages
from pyimu.characterization.temperature.hysteresis import Hysteresis, branches, play
from pyimu.characterization.temperature.order import ThermalModel, choose_model
from pyimu.characterization.temperature.regression import regress
from pyimu.characterization.temperature.thermometer import smoothed
from pyimu.errors import UserError

NAMES = ("b0", "kT", "k2", "k3")
"""Names of the coefficients by order."""

EFFECTS = {
    "kT": ("thermal_bias", "kT"),
    "k2": ("thermal_bias_quadratic", "k2"),
    "k3": ("thermal_bias_cubic", "k3"),
}
"""The effect and its parameter that a coefficient is in the catalogue."""

FEWEST = 20
"""Averages that are needed for a fit."""

STEADY = 0.5
"""A temperature, smoothed, whose standard deviation is no more than that share of its own noise in
an average says nothing."""

POINTS = 100
"""Temperatures at which the curve is given for drawing."""


@dataclass(frozen=True)
class ThermalFit:
    """The polynomial of one channel, and the loop of hysteresis beside it.

    ``coefficients`` are by name, in the unit of the samples per K^n, their ``covariance`` in that
    order; T0 is in degC. ``p_value`` is that of no effect of temperature at all; with ``order`` 0
    ``bound`` is the largest abs(k_T) that the data allow, else it is nan. ``N`` [unit sqrt(s)] and
    ``K`` [unit/sqrt(s)] are the noise of the averages. ``hysteresis`` is None where
    ``no_hysteresis`` says why none could be looked for.

    The averages (m,): ``time`` in s, ``temperature`` in degC without the thermometer's noise, the
    ``bias``, the polynomial ``fitted`` on the level of the whole log, ``branch`` 1 where the
    temperature rises, -1 where it falls, 0 on a turn, ``loop`` what the hysteresis adds to the
    polynomial, zero where it is not warranted. ``curve`` (2, 100) are temperatures and the
    polynomial there, for drawing.
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
    fitted: np.ndarray
    branch: np.ndarray
    loop: np.ndarray
    curve: np.ndarray

    @property
    def warranted(self) -> bool:
        """Whether temperature has an effect at all."""
        return self.order > 0 or (self.hysteresis is not None and self.hysteresis.warranted)

    @property
    def residual(self) -> np.ndarray:
        """The bias (m,) less the polynomial."""
        return self.bias - self.fitted

    def at(self, temperature: np.ndarray) -> np.ndarray:
        """The polynomial (n,) at temperatures (n,) in degC."""
        return _polynomial(self.coefficients, self.T0, temperature)

    def effect(self, time: np.ndarray) -> np.ndarray:
        """What temperature makes of the bias (n,) at times (n,) s of the log.

        It is the polynomial, and the loop where that is warranted.
        """
        return self.at(np.interp(time, self.time, self.temperature)) + np.interp(
            time, self.time, self.loop
        )

    def parameters(self) -> dict[tuple[str, str], float]:
        """Values of the catalogue's effects that are warranted, by (effect, parameter)."""
        out = {EFFECTS[n]: c.value for n, c in self.coefficients.items() if n in EFFECTS}
        out |= {(effect, "T0"): self.T0 for effect, _ in out}
        h = self.hysteresis
        return out | (
            {("thermal_hysteresis", "kh"): h.kh, ("thermal_hysteresis", "width"): h.width}
            if h is not None and h.warranted
            else {}
        )


def _polynomial(
    coefficients: Mapping[str, Estimate], T0: float, temperature: np.ndarray
) -> np.ndarray:
    return np.polynomial.polynomial.polyval(
        np.asarray(temperature, dtype=float) - T0, [c.value for c in coefficients.values()]
    )


def fit_thermal(
    averages: Averages,
    column: int = 0,
    level: float = 0.95,
    T0: float | None = None,
    order: int | None = None,
) -> ThermalFit:
    """Polynomial and hysteresis of one column of the averages.

    b0 is the bias at ``T0`` [degC]: the mean temperature, to 0.1, unless given. ``order`` is that
    of the polynomial, instead of what the data warrant; ``level`` is the probability of the
    intervals.

    Raises UserError where there are too few averages, the channel or the temperature is constant,
    or the temperature is no more than the thermometer's own noise.
    """
    _check(averages)
    smooth = replace(averages, temperature=_without_noise(averages))
    values = averages.values[:, column]
    if np.ptp(values) == 0:
        raise UserError("no thermal fit is possible: the channel is constant")
    if T0 is None:
        T0 = round(float(np.average(smooth.temperature, weights=smooth.count)), 1)
    model = choose_model(smooth, values, float(T0), level, order)
    return _result(smooth, values, model, float(T0), level)


def _check(averages: Averages) -> None:
    """Raise UserError where there are too few averages, or the temperature is constant."""
    if len(averages.time) < FEWEST:
        raise UserError(
            f"no thermal fit is possible: {len(averages.time)} averages of samples, at least "
            f"{FEWEST} are needed; a longer log would do"
        )
    if np.ptp(averages.temperature) == 0:
        raise UserError(
            "no thermal fit is possible: the temperature is constant, "
            f"{averages.temperature[0]:.2f} degC; a log in which it changes would do"
        )


def _without_noise(averages: Averages) -> np.ndarray:
    """The temperature (m,) without the thermometer's noise.

    Raises UserError where it does not change by more than that.
    """
    temperature = smoothed(averages)
    noise = np.std(averages.temperature - temperature)
    if np.std(temperature) <= STEADY * noise or np.ptp(temperature) < 1e-9:
        raise UserError(
            "no thermal fit is possible: the temperature stays at "
            f"{np.mean(averages.temperature):.2f} degC within the thermometer's "
            f"noise, {noise:.2g} K; a log in which it changes would do"
        )
    return temperature


def _result(
    averages: Averages, values: np.ndarray, model: ThermalModel, T0: float, level: float
) -> ThermalFit:
    """The fit of the chosen model."""
    order, temperature = model.order, averages.temperature
    fit = regress(averages, values, model.up_to(order))
    scale = model.span ** -np.arange(order + 1.0)
    coefficients = dict(zip(NAMES, fit.estimates(scale, level), strict=False))
    # b0 is the level at the start of the log, from where the walk goes on.
    above = float(np.mean(values - _polynomial(coefficients, T0, temperature)))
    line = np.linspace(temperature.min(), temperature.max(), POINTS)
    return ThermalFit(
        order=order,
        T0=T0,
        coefficients=coefficients,
        covariance=fit.covariance[: order + 1, : order + 1] * np.outer(scale, scale),
        bound=np.nan if order else _bound(averages, values, model, level),
        p_value=model.p_value,
        N=fit.N,
        K=fit.K,
        hysteresis=model.loop,
        no_hysteresis=model.why,
        time=averages.time,
        temperature=temperature,
        bias=values,
        fitted=_polynomial(coefficients, T0, temperature) + above,
        branch=branches(temperature),
        loop=_loop_bias(model, temperature),
        curve=np.array([line, _polynomial(coefficients, T0, line) + above]),
    )


def _bound(averages: Averages, values: np.ndarray, model: ThermalModel, level: float) -> float:
    """The largest abs(k_T) that the data allow."""
    fit = regress(averages, values, model.up_to(1))
    slope = fit.estimates(np.array([1, 1 / model.span]), level)[1]
    return float(max(abs(slope.low), abs(slope.high)))


def _loop_bias(model: ThermalModel, temperature: np.ndarray) -> np.ndarray:
    """What a loop that is warranted adds to the bias (m,), else zeros."""
    if model.loop is None or not model.loop.warranted:
        return np.zeros(len(temperature))
    return model.loop.opening.value / 2 * play(temperature, model.loop.width)
