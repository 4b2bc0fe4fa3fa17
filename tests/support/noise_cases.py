"""What every noise of the catalogue should look like: densities and whitening filters.

Those of ``WRITTEN`` are written by hand, apart from the package. A noise that is not among them is
tested against the law of its own definition, so a new one needs no line here; ``hindrance`` says
which does.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numba import njit

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect, Parameter
from pyimu.model.effects.noise import POLES, end_weight
from pyimu.model.kinds import KINDS

Values = Mapping[str, float]


@dataclass(frozen=True)
class Law:
    """A sampled noise: its two-sided density ``psd(f, h)`` and its whitening filter.

    ``whiten(x, h)`` makes x (n,) unit white noise if it is right. The whitened series is what
    periodograms are taken of. A periodogram of the noise itself is, where the density is steep,
    leakage from its high side through the ends of the record; one of white noise has no leakage,
    and its octaves measure the noise's density over the theory's.
    """

    psd: Callable[[np.ndarray, float], np.ndarray]
    whiten: Callable[[np.ndarray, float], np.ndarray]


def white(density: Callable[[float], float]) -> Law:
    """Independent samples; ``density(h)`` is two-sided."""
    return Law(lambda f, h: np.full_like(f, density(h)), lambda x, h: x / np.sqrt(density(h) / h))


def walk(K: float) -> Law:
    """Sums of independent steps of variance K^2 h, whitened by its steps.

    The density is K^2 / (2 pi f)^2 and, by sampling, its aliases.
    """
    return Law(
        lambda f, h: (K * h / (2 * np.sin(np.pi * f * h))) ** 2,
        lambda x, h: np.diff(x) / (K * np.sqrt(h)),
    )


def rounded_angle(q: float) -> Law:
    """First differences over h of errors that are even within a step q.

    Whitened by their sums, but for the first error.
    """
    variance = q**2 / 12
    return Law(
        lambda f, h: (2 * np.sin(np.pi * f * h)) ** 2 * variance / h,
        lambda x, h: np.cumsum(np.insert(x, 0, 0.0)) * h / np.sqrt(variance),
    )


def markov(variance: np.ndarray, tau: np.ndarray) -> Law:
    """Sum of stationary Gauss-Markov processes, variances (p,), time constants (p,) s.

    Whitened by a Kalman filter from the first sample on.
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
    """Innovations (n,) of x = sum of b_k over their standard deviations.

    Each b_k+ = a_k b_k + noise is stationary from the start.
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
    """Gauss-Markov processes with corners evenly in logarithm.

    A variance of B^2 / pi a unit of log frequency makes B^2 / (2 pi f).
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

    @property
    def kinds(self) -> tuple[str, ...]:
        """Sensors that can have the effect."""
        return tuple(kind for kind in KINDS if kind in CATALOGUE[self.effect].sensors)


WRITTEN = (
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

SIZE, START, SLOPE = 1e-3, 3.0, 1.5
"""Of a case that follows from a definition: the coefficients, and the true signal and its rate
where the noise depends on them, all in SI."""


def noises() -> list[Effect]:
    """Effects of the catalogue that make noise: those that draw it, and those that round."""
    return [e for e in CATALOGUE.values() if e.stochastic or (e.law and e.law.ramp is None)]


def hindrance(e: Effect) -> str:
    """Why no case follows from the definition of a noise, in one line; empty where one does."""
    write = "add a Case to WRITTEN in tests/support/noise_cases.py"
    if e.law is None:
        return f"{e.name} draws noise and has no law: give its definition one"
    if not e.stochastic:
        return f"{e.name} makes its noise of other noise, which its law does not say: {write}"
    if len(e.law.parts) != 1 or e.law.parts[0] not in _BY_PART:
        made_of = " and ".join(e.law.parts) or "nothing"
        return f"{e.name} has a law of {made_of}, not of one of {', '.join(_BY_PART)}: {write}"
    odd = [n for n, q in e.parameters.items() if q.shape not in ((), (3,))]
    if odd:
        return f"{e.name} has coefficients that are not one an axis, {', '.join(odd)}: {write}"
    return ""


def derived(e: Effect) -> Case:
    """The case that follows from the definition of a noise without ``hindrance``."""
    values = {n: _value(q) for n, q in e.parameters.items()}
    values |= e.law.shown
    start = START if e.law.needs("x") else 0.0
    # A noise that depends on the signal as well is stationary where the signal does not grow.
    slope = SLOPE if e.law.needs("slope") and not start else 0.0
    return Case(e.name, values, law_of(e, values, start, slope), start=start, slope=slope)


def _value(q: Parameter) -> float:
    """``SIZE``, or the coefficient's bound nearest to it; its start where it only shapes others."""
    if q.form or q.reference:
        return q.start
    low = -np.inf if q.minimum is None else q.minimum
    high = np.inf if q.maximum is None else q.maximum
    return float(np.clip(SIZE, low, high))


def law_of(e: Effect, values: Values, start: float, slope: float) -> Law:
    """What the law of a definition says, for these coefficients and this signal."""
    (part,) = e.law.parts
    return _BY_PART[part](lambda **h: e.law.value(part, values, x=start, slope=slope, **h))


_BY_PART: Mapping[str, Callable[[Callable], Law]] = {
    "white": lambda density: white(lambda h: density(h=h)),
    "walk": lambda density: walk(np.sqrt(density())),
    "markov": lambda processes: markov(*np.transpose(processes())),
}
"""By the one part that a law has, of that part as a function."""


def cases() -> tuple[Case, ...]:
    """Those written by hand, then one for each other noise of the catalogue that makes one."""
    by_hand = {case.effect for case in WRITTEN}
    others = [e for e in noises() if e.name not in by_hand and not hindrance(e)]
    return (*WRITTEN, *map(derived, others))


CASES = cases()


def triads() -> list[list[Case]]:
    """The cases in threes, for the axes of a triad of one sensor that can have all of them.

    None has an effect twice, because some coefficients belong to the triad.
    """
    out: list[list[Case]] = []
    for case in CASES:
        fits = [
            t
            for t in out
            if len(t) < 3 and case.effect not in [c.effect for c in t] and case.kinds == t[0].kinds
        ]
        fits[0].append(case) if fits else out.append([case])
    return out


# Closed forms of the continuous noises, Hidalgo 2012, table 3, and IEEE Std 952-2020, annex C, for
# the process with one corner.


@dataclass(frozen=True)
class Form:
    """Two-sided density at f [Hz] and Allan variance at tau [s], and where they hold.

    ``frequencies`` and ``times`` are from and to.
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
    """To a quarter of a decibel: the density between the corners, and the floor.

    The floor holds where the window about 1 / tau lies between the corners.
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
