"""Effects that are random, and those of the output, in the order in which they act.

The size of what is random is what its law is expected to gain (``whitening``).
"""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from effect_logs.scene import HZ
from effect_logs.term import Case, Term
from effect_logs.whitening import frequencies, gain_of_spectrum, gain_of_variance

DEG, G, HOUR = np.deg2rad(1.0), 9.80665, 3600.0


# White noise that follows the motion


def sampling_jitter(x, case: Case):
    late = case.c * case.rng.standard_normal((len(x), 1))
    return x + late * case.scene.slope(case.kind)


def _jitter_gain(case: Case, triad, free: bool):
    rows = case.scene.slope(case.kind)[: case.scene.fitted]
    return gain_of_variance((case.c * rows) ** 2, triad, case.scene.h)


def rate_dependent_noise(x, case: Case):
    return x + case.c * x / np.sqrt(case.scene.h) * case.rng.standard_normal(x.shape)


def _rate_dependent_gain(case: Case, triad, free: bool):
    rows = case.scene.own(case.kind)[: case.scene.fitted]
    return gain_of_variance((case.c * rows) ** 2 / case.scene.h, triad, case.scene.h)


# Noise with a spectrum


def angle_random_walk(x, case: Case):
    """White noise beside the declared, of root density c."""
    return x + case.c / np.sqrt(case.scene.h) * case.rng.standard_normal(x.shape)


def rate_random_walk(x, case: Case):
    steps = case.c * np.sqrt(case.scene.h) * case.rng.standard_normal(x.shape)
    return x + np.cumsum(steps, axis=0)


def _markov(draws, variance, angle: float):
    """A stationary first-order Gauss-Markov process (n, 3), ``angle`` samples over its time."""
    kept = np.exp(-angle)
    fresh = np.sqrt(-np.expm1(-2 * angle)) * draws
    fresh[0] = draws[0]
    return np.sqrt(variance) * lfilter([1.0], [1.0, -kept], fresh, axis=0)


def _markov_density(omega, variance, angle: float):
    """Per sample, (m, 3)."""
    kept = np.exp(-angle)
    shape = -np.expm1(-2 * angle) / (1 - 2 * kept * np.cos(omega) + kept**2)
    return shape[:, None] * variance


def gauss_markov(x, case: Case):
    tau, draws = case.form["tau"], case.rng.standard_normal(x.shape)
    return x + _markov(draws, case.c**2 * tau / 2, case.scene.h / tau)


def second_gauss_markov(x, case: Case):
    return gauss_markov(x, case)


PER_DECADE = 3


def _poles():
    """Rates of processes that make 1/f noise from a thousandth of a hertz up to the band's end, and
    their spacing in the natural logarithm.

    Processes of one variance v at every rate have the density 2 v a / (a^2 + w^2) each, whose
    integral over ln a is pi v / w: spaced by d they make B^2 / w for v = d B^2 / pi.
    """
    rates = 2 * np.pi * np.logspace(-4, np.log10(HZ), 6 * PER_DECADE + 1)
    return rates, float(np.log(rates[1] / rates[0]))


def bias_instability(x, case: Case):
    rates, spacing = _poles()
    draws = case.rng.standard_normal((len(rates), *x.shape))
    variance = spacing * case.c**2 / np.pi
    return x + sum(
        _markov(w, variance, a * case.scene.h) for a, w in zip(rates, draws, strict=True)
    )


def _spectral_gain(density):
    def gain(case: Case, triad, free: bool):
        n = case.scene.fitted
        extra = density(case, frequencies(n)[0])
        return gain_of_spectrum(extra, n, triad, case.scene.h, free)

    return gain


def _white_density(case: Case, omega):
    return np.tile(case.c**2 / case.scene.h, (len(omega), 1))


def _walk_density(case: Case, omega):
    return case.c**2 * case.scene.h / (4 * np.sin(omega[:, None] / 2) ** 2)


def _gm_density(case: Case, omega):
    tau = case.form["tau"]
    return _markov_density(omega, case.c**2 * tau / 2, case.scene.h / tau)


def _flicker_density(case: Case, omega):
    rates, spacing = _poles()
    variance = spacing * case.c**2 / np.pi
    return sum(_markov_density(omega, variance, a * case.scene.h) for a in rates)


# The output


def dead_zone(x, case: Case):
    return x - np.clip(x, -case.c, case.c)


def hard_dead_zone(x, case: Case):
    return np.where(np.abs(x) > case.c, x, 0.0)


CLIPPED = {"gyro": 0.3, "accel": 0.2}
"""Share of the largest input that a typical limit cuts off."""


def _tops(rng, scene):
    """The largest input of each axis in the first log: a sensor has one limit in all its logs."""
    return {"tops": {kind: np.abs(scene.own(kind)).max(axis=0) for kind in CLIPPED}}


def saturation(x, case: Case):
    """Clipped at s (1 - s) / c of the largest input, which is 1 - s at the typical c = s.

    The limit goes to infinity as c goes to 0, so that the effect goes to nothing: one at the
    largest input itself cuts half of the noise off a motion with a flat top.
    """
    share = CLIPPED[case.kind]
    c = np.where(case.c > 0, case.c, 1.0)
    limit = np.where(case.c > 0, share * (1 - share) / c * case.form["tops"][case.kind], np.inf)
    return np.clip(x, -limit, limit)


def quantization(x, case: Case):
    q = np.where(case.c > 0, case.c, 1.0)
    return np.where(case.c > 0, q * np.floor(x / q + 0.5), x)


def angle_quantization(x, case: Case):
    q, h = np.where(case.c > 0, case.c, 1.0), case.scene.h
    counts = np.floor(np.cumsum(x * h, axis=0) / q + 0.5)
    given = q * np.diff(counts, axis=0, prepend=np.zeros((1, 3))) / h
    return np.where(case.c > 0, given, x)


def _tau(rng, scene):
    """2 to 20 s: far shorter than a log, far longer than a sample."""
    return {"tau": float(np.exp(rng.uniform(np.log(2.0), np.log(20.0))))}


def _short_tau(rng, scene):
    """0.3 to 3 s: the faster of two processes, with next to nothing of the other's range."""
    return {"tau": float(np.exp(rng.uniform(np.log(0.3), np.log(3.0))))}


def _term(function, parameter, gyro, accel, **more) -> Term:
    sizes = {"gyro": gyro, "accel": accel}
    return Term(function.__name__, function, sizes, signed=False, parameter=parameter, **more)


DECLARED = {"forms": ("declared",)}

TERMS = (
    _term(sampling_jitter, "sj", 2.9e-4, 2.9e-4, shape=(), gain=_jitter_gain),
    _term(
        angle_random_walk,
        "",
        0.212 * DEG / 60,
        283e-6 * G,
        gain=_spectral_gain(_white_density),
        **DECLARED,
    ),
    _term(
        rate_random_walk,
        "",
        12.3 * DEG / HOUR / 60,
        1e-3,
        gain=_spectral_gain(_walk_density),
        **DECLARED,
    ),
    _term(
        gauss_markov,
        "q",
        3.88e-5,
        6e-3,
        form=_tau,
        gain=_spectral_gain(_gm_density),
    ),
    _term(
        second_gauss_markov,
        "q",
        3.88e-4,
        0.06,
        form=_short_tau,
        gain=_spectral_gain(_gm_density),
    ),
    _term(
        bias_instability,
        "B",
        6.93 * DEG / HOUR,
        54.2e-6 * G,
        gain=_spectral_gain(_flicker_density),
    ),
    _term(rate_dependent_noise, "k", 1e-4, 1.4e-4, gain=_rate_dependent_gain),
)

OUTPUT = (
    _term(dead_zone, "d", 0.0076 * DEG, 0.06e-3 * G),
    _term(hard_dead_zone, "d", 0.0076 * DEG, 0.061e-3 * G),
    _term(angle_quantization, "q", 0.01 * 0.0076 * DEG, 6e-6, by_size=False),
    _term(saturation, "", *CLIPPED.values(), form=_tops),
    _term(quantization, "q", 0.00763 * DEG, 6.1e-5 * G, by_size=False),
)
"""Rounding is seen in the raw values, whatever its size in sigmas; those have size 1 alone."""
