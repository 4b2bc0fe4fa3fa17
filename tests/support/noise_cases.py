"""What every noise of the catalogue should look like: densities and whitening filters, written
apart from the package.

A new stochastic effect needs one line in ``CASES``. Its law is one of those below, or another
function that gives one.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numba import njit

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects.noise import POLES, end_weight
from pyimu.shaping import NOISE_LIKE

Values = Mapping[str, float]


@dataclass(frozen=True)
class Law:
    """A sampled noise: its two-sided density ``psd(f, h)`` and ``whiten(x, h)``, which makes x (n,)
    unit white noise if it is right.

    The whitened series is what periodograms are taken of. A periodogram of the noise itself is,
    where the density is steep, leakage from its high side through the ends of the record; one of
    white noise has no leakage, and its octaves measure the noise's density over the theory's.
    """

    psd: Callable[[np.ndarray, float], np.ndarray]
    whiten: Callable[[np.ndarray, float], np.ndarray]


def white(density: Callable[[float], float]) -> Law:
    """Independent samples; ``density(h)`` is two-sided."""
    return Law(lambda f, h: np.full_like(f, density(h)), lambda x, h: x / np.sqrt(density(h) / h))


def walk(K: float) -> Law:
    """Sums of independent steps of variance K^2 h: K^2 / (2 pi f)^2 and, by sampling, its aliases.
    Whitened by its steps.
    """
    return Law(
        lambda f, h: (K * h / (2 * np.sin(np.pi * f * h))) ** 2,
        lambda x, h: np.diff(x) / (K * np.sqrt(h)),
    )


def rounded_angle(q: float) -> Law:
    """First differences over h of errors that are even within a step q. Whitened by their sums,
    but for the first error.
    """
    variance = q**2 / 12
    return Law(
        lambda f, h: (2 * np.sin(np.pi * f * h)) ** 2 * variance / h,
        lambda x, h: np.cumsum(np.insert(x, 0, 0.0)) * h / np.sqrt(variance),
    )


def markov(variance: np.ndarray, tau: np.ndarray) -> Law:
    """Sum of stationary Gauss-Markov processes, variances (p,), time constants (p,) s. Whitened by
    a Kalman filter from the first sample on.
    """
    variance, tau = np.atleast_1d(variance).astype(float), np.atleast_1d(tau).astype(float)

    def psd(f, h):
        a = np.exp(-h / tau)[:, None]
        # 1 + a^2 - 2 a cos, without the cancellation near a = 1 and f = 0.
        distance = (1 - a) ** 2 + 4 * a * np.sin(np.pi * f * h) ** 2
        return np.sum(variance[:, None] * (1 - a**2) * h / distance, axis=0)

    return Law(psd, lambda x, h: _innovations(x, np.exp(-h / tau), variance))


@njit(cache=True)
def _innovations(x, a, variance):
    """Innovations (n,) over their standard deviations of x = sum of b_k, each b_k+ = a_k b_k +
    noise, stationary from the start.
    """
    p = len(a)
    b, cov, out = np.zeros(p), np.diag(variance), np.empty(len(x))
    for k in range(len(x)):
        seen = cov.sum(axis=1)
        total = seen.sum()
        error = x[k] - b.sum()
        out[k] = error / np.sqrt(total)
        for i in range(p):
            b[i] = a[i] * (b[i] + seen[i] * error / total)
        for i in range(p):
            for j in range(p):
                cov[i, j] = a[i] * a[j] * (cov[i, j] - seen[i] * seen[j] / total)
            cov[i, i] += (1 - a[i] ** 2) * variance[i]
    return out


def flicker(B: float, f_low: float, f_high: float) -> Law:
    """Gauss-Markov processes with corners evenly in logarithm; variance B^2 / pi a unit of log
    frequency makes B^2 / (2 pi f).
    """
    corners = np.geomspace(f_low, f_high, POLES)
    weights = np.ones(POLES)
    weights[[0, -1]] = end_weight(np.log(corners[1] / corners[0]))
    return markov(
        weights * B**2 / np.pi * np.log(f_high / f_low) / (POLES - 1), 1 / (2 * np.pi * corners)
    )


@dataclass(frozen=True, eq=False)
class Case:
    """One noise on one axis: values of the effect's coefficients, its law, and what excites it.

    ``beside`` are effects of the same axis, with values, that come before it; the noise is the
    output less that of a sensor with those alone. ``start`` and ``slope`` are the sensor's own
    signal at time zero and its rate.
    """

    effect: str
    values: Values
    law: Law
    beside: Mapping[str, Values] = field(default_factory=dict)
    start: float = 0.0
    slope: float = 0.0

    @property
    def name(self) -> str:
        return "-".join([self.effect, *(f"{k}={v:g}" for k, v in self.values.items())])


CASES = (
    Case("angle_random_walk", {"N": 6.0e-5}, white(lambda h: 6.0e-5**2)),
    Case("rate_random_walk", {"K": 2.7e-3}, walk(2.7e-3)),
    Case("gauss_markov", {"q": 1e-3, "tau": 0.5}, markov(1e-6 * 0.5 / 2, 0.5)),
    # A time constant of the record's length at 100 Hz, and beyond it at 976 Hz.
    Case("gauss_markov", {"q": 2e-3, "tau": 600.0}, markov(4e-6 * 600.0 / 2, 600.0)),
    Case("bias_instability", {"B": 1e-4, "f_low": 1e-5, "f_high": 1.0}, flicker(1e-4, 1e-5, 1.0)),
    Case("bias_instability", {"B": 3e-4, "f_low": 1e-4, "f_high": 10.0}, flicker(3e-4, 1e-4, 10.0)),
    Case("sampling_jitter", {"sj": 2e-4}, white(lambda h: (2e-4 * 1.5) ** 2 * h), slope=1.5),
    Case("rate_dependent_noise", {"k": 1e-3}, white(lambda h: (1e-3 * 3.0) ** 2), start=3.0),
    # Steps of a standard deviation of what is rounded: neighbouring errors correlate as exp(-2
    # pi^2) = 3e-9.
    Case(
        "quantization",
        {"q": 1e-3},
        white(lambda h: 1e-6 * h / 12),
        beside={"angle_random_walk": {"N": 1e-4}},
    ),
    Case(
        "angle_quantization",
        {"q": 1e-5},
        rounded_angle(1e-5),
        beside={"angle_random_walk": {"N": 3.2e-4}},
    ),
)

NOISES = [name for name, e in CATALOGUE.items() if e.stochastic] + [
    name for name in NOISE_LIKE if name != "rate_ramp"
]
"""Effects that make noise: those that draw it, and those that round."""


def triads() -> list[list[Case]]:
    """The cases in threes, for the axes of a triad; none has an effect twice, because some
    coefficients belong to the triad.
    """
    out: list[list[Case]] = []
    for case in CASES:
        fits = [t for t in out if len(t) < 3 and case.effect not in [c.effect for c in t]]
        fits[0].append(case) if fits else out.append([case])
    return out


# Closed forms of the continuous noises, Hidalgo 2012, table 3, and IEEE Std 952-2020, annex C, for
# the process with one corner.


@dataclass(frozen=True)
class Form:
    """Two-sided density at f [Hz] and Allan variance at tau [s], and the frequencies and times from
    and to which they hold.
    """

    psd: Callable[[np.ndarray], np.ndarray]
    allan: Callable[[np.ndarray], np.ndarray]
    frequencies: tuple[float, float] = (1e-6, np.inf)
    times: tuple[float, float] = (0.0, 1e4)
    ripple: float = 0.0


def _white_form(density: float) -> Form:
    return Form(lambda f: np.full_like(f, density), lambda t: density / t)


def _markov_form(h: float, q: float, tau: float) -> Form:
    def allan(t):
        return (
            (q * tau) ** 2
            / t
            * (1 - tau / (2 * t) * (3 - 4 * np.exp(-t / tau) + np.exp(-2 * t / tau)))
        )

    return Form(lambda f: (q * tau) ** 2 / (1 + (2 * np.pi * f * tau) ** 2), allan)


def _flicker_form(h: float, B: float, f_low: float, f_high: float) -> Form:
    """To a quarter of a decibel: the density between the corners, the floor where the window about
    1 / tau lies between them.
    """
    return Form(
        lambda f: B**2 / (2 * np.pi * f),
        lambda t: np.full_like(t, 2 * np.log(2) / np.pi * B**2),
        (f_low, f_high),
        (5 / f_high, 0.05 / f_low),
        10**0.025 - 1,
    )


FORMS: Mapping[str, Callable[..., Form]] = {
    "angle_random_walk": lambda h, N: _white_form(N**2),
    "rate_random_walk": lambda h, K: Form(
        lambda f: (K / (2 * np.pi * f)) ** 2, lambda t: K**2 * t / 3
    ),
    "gauss_markov": _markov_form,
    "bias_instability": _flicker_form,
    "quantization": lambda h, q: _white_form(q**2 * h / 12),
    "angle_quantization": lambda h, q: Form(
        lambda f: (2 * np.pi * f) ** 2 * q**2 / 12 * h, lambda t: 3 * q**2 / 12 / t**2
    ),
}
"""By effect, of the sample period and the values of a case; the angle's Q is q / sqrt(12), the
rate's rounding q^2 h / 12."""
