"""Process noise of the attitude error and the gyro bias over one sample period.

The error state is x = (p, b): p (3,) the attitude error in body axes, ``scale`` times the small
rotation vector (``mrp.share``; 1 where p is in rad), b (3,) the gyro bias in rad/s, for the flicker
model one b for each of its processes. It obeys x' = F x + G w with w white, of unit two-sided
density; what is derived here is the covariance

    Q = integral from 0 to h of exp(F t) G G^T exp(F t)^T dt
"""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial

import casadi as ca

from pyimu.symbolic.series import phi, stumpff

TERMS = 20
"""Terms of the series of ``discretised``; at |F| h = 1/2 the rest is below 1e-18 of the sum."""


def error_system(rate, n, biases: Sequence[tuple], scale=1.0):
    """F and G, both (m, m), of the error state, with m = 3 and 3 more for each bias process.

    ``rate`` (3,) rad/s is the body's, ``n`` (3,) rad/sqrt(s) the angle random walk, ``biases``
    are pairs of the strength (3,) rad/s/sqrt(s) and the decay (3,) 1/s of each process; a random
    walk has no decay::

        p' = -rate x p - scale (sum of b + N w),    b' = -decay b + strength w

    Crassidis and Markley 2003, section III. The minus signs are there because the bias is
    subtracted from the measured rate.
    """
    m, kind = len(biases), type(rate)
    upper = ca.horzcat(-ca.skew(rate), *[-scale * kind.eye(3)] * m)
    decay = ca.vertcat(*[d for _, d in biases])
    f = ca.vertcat(upper, ca.horzcat(kind(3 * m, 3), ca.diag(-decay)))
    return f, ca.diag(ca.vertcat(-scale * n, *[k for k, _ in biases]))


def process_noise(n, k, h):
    """Covariance (6, 6) that a period of ``h`` s adds to attitude error and gyro bias.

    The attitude error is in rad in body axes, the gyro bias in rad/s.

    ``n`` (3,) rad/sqrt(s) is each axis's angle random walk, ``k`` (3,) rad/s/sqrt(s) its rate
    random walk::

        [ (N^2 h + K^2 h^3 / 3) I    -K^2 h^2 / 2 I ]
        [ -K^2 h^2 / 2 I              K^2 h I       ]

    Exact for a body that does not turn during ``h`` (Crassidis and Markley 2003, eq. 27; Hidalgo
    2012, equation of Q_k, where the print has lost the minus signs: the bias is subtracted from the
    rate, so that its growth turns the attitude back).
    """
    n2, k2 = n * n, k * k
    attitude, cross, bias = n2 * h + k2 * h**3 / 3, -k2 * h**2 / 2, k2 * h
    return ca.vertcat(
        ca.horzcat(ca.diag(attitude), ca.diag(cross)), ca.horzcat(ca.diag(cross), ca.diag(bias))
    )


def turning_transition(f, square, h):
    """exp(F h) = I + h F + psi_2 F^2 + psi_3 F^3, exact where F^4 = -``square`` F^2.

    The error state with a random walk for its bias is such a system (``error_system`` without
    decay), with ``square`` = |rate|^2.
    """
    f2 = f @ f
    return type(f).eye(f.shape[0]) + h * f + psi(2, square, h) * f2 + psi(3, square, h) * f2 @ f


def turning_process_noise(rate, n, k, h, scale=1.0):
    """The covariance (6, 6) of ``process_noise`` for a body that turns at a constant rate; exact.

    ``rate`` is (3,) rad/s.

    With exp(F t) = I + t F + psi_2(t) F^2 + psi_3(t) F^3 the integral is a sum over the products of
    two of the four functions; axes may have different coefficients. ``scale`` is that of the
    attitude error (``mrp.share``).
    """
    f, g = error_system(rate, n, [(k, type(k)(3, 1))], scale)
    square = ca.dot(rate, rate)
    powers = [type(f).eye(6), f, f @ f, f @ f @ f]
    products = turning_products(square, h)
    return sum(
        products[min(i, j), max(i, j)] * powers[i] @ g @ g.T @ powers[j].T
        for i in range(4)
        for j in range(4)
    )


def turning_products(square, h) -> dict:
    """Integrals from 0 to h of the products of two of the functions 1, t, psi_2(t), psi_3(t).

    They are given by the places (i, j), i <= j, of the two.

    Squares of sine and cosine are those of twice the angle, hence psi at four times the ``square``
    of the rate.
    """
    s = {k: psi(k, square, h) for k in range(3, 8)}
    twice = {k: psi(k, 4 * square, h) for k in (5, 7)}
    return {
        (0, 0): h,
        (0, 1): h**2 / 2,
        (0, 2): s[3],
        (0, 3): s[4],
        (1, 1): h**3 / 3,
        (1, 2): h * s[3] - s[4],
        (1, 3): h * s[4] - s[5],
        (2, 2): 8 * twice[5] - 2 * s[5],
        (2, 3): s[3] ** 2 / 2,
        (3, 3): 32 * twice[7] - 2 * (h * s[6] - s[7]),
    }


def psi(k: int, square, h):
    """psi_k = h^k c_k(square h^2): sin(x)/w, (1 - cos(x))/w^2, (x - sin(x))/w^3, ...

    Here x = w h and w^2 = ``square``.

    Each is the integral of the one before over h.
    """
    return h**k * stumpff(k, square * h * h)


def gauss_markov_process_noise(n, strength, tau, h, scale=1.0):
    """The covariance (6, 6) of ``process_noise`` for a Gauss-Markov bias, without rotation.

    The bias obeys b' = -b/tau + strength w.

    ``strength`` (3,) rad/s/sqrt(s) and ``tau`` (3,) s have a value for each axis. For tau to
    infinity the bias is a random walk.
    """
    return flicker_process_noise(n, [(strength, tau)], h, scale)


def flicker_process_noise(n, processes: Sequence[tuple], h, scale=1.0):
    """Covariance (3 + 3 m, 3 + 3 m) for a bias that is a sum of m Gauss-Markov processes.

    The processes are independent, and stand for flicker noise.

    ``processes`` are pairs of strength (3,) rad/s/sqrt(s) and correlation time (3,) s; each has
    three states of its own. The body does not turn; where it does, ``discretised`` gives the
    covariance of ``error_system``.
    """
    attitude, rows = n * n * h, []
    covariances = [_gauss_markov_covariances(strength, tau, h) for strength, tau in processes]
    for i, (own, cross, bias) in enumerate(covariances):
        attitude += own
        rows.append(
            [
                -scale * cross,
                *[bias if i == j else type(bias)(3, 1) for j in range(len(covariances))],
            ]
        )
    top = [scale**2 * attitude, *[row[0] for row in rows]]
    return ca.vertcat(*[ca.horzcat(*[ca.diag(entry) for entry in row]) for row in (top, *rows)])


def _gauss_markov_covariances(strength, tau, h):
    """Variance that one process adds to the angle, covariance of the two, its own variance.

    They are (3,) each.
    """
    z, s2 = h / tau, strength * strength
    return (
        s2 * h**3 * (4 * phi(3, 2 * z) - 2 * phi(3, z)),
        s2 * (h * phi(1, z)) ** 2 / 2,
        s2 * h * phi(1, 2 * z),
    )


def discretised(f, density, h, halvings: int = 0):
    """exp(F h) and Q, (m, m) each, of x' = F x + w for any constant F.

    w is white noise of ``density`` (m, m).

    Q is the sum of M_k h^(k+1)/(k+1)! with M_0 = ``density`` and M_(k+1) = F M_k + M_k F^T, because
    Q' = F Q + Q F^T + density. The sum is taken over h / 2^``halvings`` and then doubled, by Q(2 h)
    = Q(h) + exp(F h) Q(h) exp(F h)^T. The result is exact to rounding where |F| h < 2^``halvings``
    / 2.
    """
    h = h / 2**halvings
    power = transition = type(f).eye(f.shape[0])
    moment, q = density, density * h
    for k in range(1, TERMS):
        power, moment = f @ power, f @ moment + moment @ f.T
        transition, q = (
            transition + power * h**k / factorial(k),
            q + moment * h ** (k + 1) / factorial(k + 1),
        )
    for _ in range(halvings):
        transition, q = transition @ transition, q + transition @ q @ transition.T
    return transition, q
