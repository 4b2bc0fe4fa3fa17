"""Noise as a filter on white noise: shaping filters, power spectral densities and Allan deviations.

A stochastic effect is a linear system driven by standard normals.  Its matrices are the Jacobians of the effect's own
step, so the spectrum that is drawn here is the spectrum of what is simulated, its sampling included.  The field's
continuous forms, N^2 and K^2 / (2 pi f)^2, are its limits far below the Nyquist frequency.

Densities here are two-sided: white noise N has the density N^2 at every frequency of either sign.
"""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import control
import numpy as np
from scipy.integrate import quad

from pyimu.effect import Sensor
from pyimu.errors import UserError

CONVERGED = 1e-10
"""Relative change of an Allan variance at which the grid in frequency is fine enough."""


def shaping_filter(sensor: Sensor, effect: str, axis: int, sample_period: float) -> control.StateSpace:
    """The discrete system from the standard normal of one axis (0 to 2) to that axis's output, for one effect of a sensor.

    Its output is in the sensor's unit (rad/s or m/s^2), its step ``sample_period`` in seconds.  States that the noise
    does not reach are left out.  The effect is linearised where the sensor is at rest with the input zero, which is
    exact for additive noise.  Raises UserError where the sensor lacks the effect or the effect draws no noise.
    """
    alone = _alone(sensor, effect)
    chain, h = alone.chain, ca.DM(sample_period)
    s, w = chain.step.sx_in(0), chain.step.sx_in(3)
    s_next, y = chain.step(s, ca.DM.zeros(chain.step.size_in(1)), alone.p, w, h)
    jacobians = [ca.jacobian(of, by) for of in (s_next, y) for by in (s, w)]
    matrices = ca.Function("linear", [s, w], jacobians)
    a, b, c, d = (np.array(ca.densify(m)) for m in matrices(ca.DM(chain.start), 0))
    b, c, d = b[:, [axis]], c[[axis], :], d[[axis]][:, [axis]]
    keep = _reached(a, b[:, 0]) & _reached(a.T, c[0])
    return control.ss(a[np.ix_(keep, keep)], b[keep], c[:, keep], d, sample_period)


def _alone(sensor: Sensor, effect: str) -> Sensor:
    if effect not in sensor.values:
        raise UserError(f"the {sensor.kind} has no effect {effect}, only {', '.join(sensor.values) or 'none'}")
    alone = Sensor(sensor.kind, {effect: sensor.values[effect]})
    if not alone.noise:
        raise UserError(f"{sensor.kind}.{effect} draws no noise and has no shaping filter")
    return alone


def _reached(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Which states a signal entering at ``b`` comes to, shape (n,); for the transposed system, which ones are seen."""
    reached = b != 0
    for _ in range(len(a)):
        reached = reached | ((a != 0) @ reached)
    return reached


def psd_two_sided(system: control.StateSpace, f: np.ndarray) -> np.ndarray:
    """Two-sided density of a discrete system driven by standard normals, |H(exp(j 2 pi f h))|^2 h, at ``f`` (n,) in Hz.

    In the square of the output's unit per Hz; infinite at a pole on the unit circle.
    """
    z = np.exp(2j * np.pi * np.asarray(f, dtype=float) * system.dt)
    return np.abs(system(z, squeeze=True, warn_infinite=False)) ** 2 * system.dt


def allan_deviation(psd: Callable[[np.ndarray], np.ndarray], tau: np.ndarray, sample_period: float | None = None) -> np.ndarray:
    """Allan deviation at cluster times ``tau`` (n,) in s of a noise with two-sided density ``psd(f)``.

    Without ``sample_period`` the noise is continuous: sigma^2 = 4 int_0^inf S sin^4(pi f tau) / (pi f tau)^2 df
    (Hidalgo 2012, section 2.1; IEEE Std 952-2020, annex C).  With it, clusters are means of n = tau / h samples, and
    (pi f tau)^2 becomes (n sin(pi f h))^2 with the integral up to Nyquist: exact for sampled noise.  Raises ValueError
    where tau is not positive, or not a multiple of the sample period.
    """
    tau = np.atleast_1d(np.asarray(tau, dtype=float))
    if np.any(tau <= 0):
        raise ValueError("cluster times must be positive")
    if sample_period is None:
        return np.sqrt([_continuous_variance(psd, t) for t in tau])
    n = np.rint(tau / sample_period).astype(int)
    if np.any(n < 1) or np.any(np.abs(n * sample_period - tau) > 1e-6 * sample_period * n):
        raise ValueError(f"cluster times must be multiples of the sample period {sample_period:g} s")
    return np.sqrt([_sampled_variance(psd, k, sample_period) for k in n])


def _sampled_variance(psd: Callable, n: int, h: float) -> float:
    """The integral up to Nyquist by the midpoint rule, which is exact for trigonometric polynomials of lower degree.

    Random walks give such a polynomial of degree 2 n; poles inside the circle make the rule converge geometrically.
    """
    points, before = 4 * n + 4, np.inf
    for _ in range(12):
        # A grid over half the circle, half a step away from the pole that a random walk has at zero.
        f = (np.arange(points // 2) + 0.5) / (points * h)
        kernel = np.sin(np.pi * f * n * h) ** 4 / (n * np.sin(np.pi * f * h)) ** 2
        value = 4 * np.sum(psd(f) * kernel) / (points * h)
        if abs(value - before) <= CONVERGED * abs(value):
            break
        points, before = 2 * points, value
    return value


def _continuous_variance(psd: Callable, tau: float, periods: int = 2000) -> float:
    """Gauss-Legendre over the first periods of the sine; beyond them sin^4 counts with its mean, 3/8.

    The tail starts at a zero of the sine, where what this leaves out falls with the cube of the number of periods.
    """
    nodes, weights = np.polynomial.legendre.leggauss(16)
    x = np.pi * (np.arange(periods)[:, None] + (nodes + 1) / 2)
    head = np.sum(psd(x / (np.pi * tau)) * np.sin(x) ** 4 / x ** 2 * (np.pi / 2) * weights)
    tail = quad(lambda v: 0.375 * float(psd(np.array(1 / (v * np.pi * tau)))), 0, 1 / (np.pi * periods))[0]
    return 4 / (np.pi * tau) * (head + tail)
