"""What lies between the motion and the sampled signal: bandwidth and delay."""

import casadi as ca

from pyimu.effect import INPUT, Parameter, SamplePeriod, Scan, State, effect

MEMORY = 32
"""Samples that ``time_delay`` remembers; it reaches back ``MEMORY - 2`` sample periods."""


@effect(stage="dynamics", term="bandwidth, second-order lag",
        equation=r"y = \frac{\omega_n^2}{s^2 + 2 \zeta \omega_n s + \omega_n^2} x", invertible=False,
        source="no source for the coefficients; second-order low-pass of a gyro's read-out, discretised by the trapezoidal rule")
def lag(x, wn: Parameter("rad/s", (), minimum=0.0, scan=Scan("rate", 0.06, 4.0, 10),
                         description="natural frequency; 0 switches the lag off"),
        zeta: Parameter("1", (), 0.7071067811865476, minimum=0.1, maximum=2.0, description="damping ratio"),
        x1: State("{y}", start=INPUT), x2: State("{y}", start=INPUT),
        y1: State("{y}", start=INPUT), y2: State("{y}", start=INPUT), h: SamplePeriod()):
    c = 2 / (wn * h)
    a0, a1, a2 = c * c + 2 * zeta * c + 1, 2 - 2 * c * c, c * c - 2 * zeta * c + 1
    y = ca.if_else(wn > 0, (x + 2 * x1 + x2 - a1 * y1 - a2 * y2) / a0, x)
    return y, {"x1": x, "x2": x1, "y1": y, "y2": y1}


@effect(stage="dynamics", term="time delay, timestamp offset", equation=r"y(t) = x(t - t_d)", invertible=False,
        source="no source for the coefficient; third-order Lagrange interpolation between samples")
def time_delay(x, td: Parameter("s", (), minimum=0.0, scan=Scan("period", 0.3, 28.0, 10),
                                description="delay of the output behind the motion"),
               past: State("{y}", (MEMORY, 3), start=INPUT), h: SamplePeriod()):
    samples = ca.vertcat(x.T, past)
    delay = ca.fmin(ca.fmax(td / h, 0), MEMORY - 2)
    weights = ca.vertcat(*[_lagrange(j, delay) for j in range(MEMORY + 1)])
    return (weights.T @ samples).T, {"past": samples[:-1, :]}


def _lagrange(j: int, delay: ca.SX) -> ca.SX:
    """Weight of the sample ``j`` periods old in a cubic through the four samples around ``delay`` (in periods).

    Below one period there is no newer sample to centre on, so the cubic runs through the newest four.
    """
    d = ca.fabs(delay - j)
    centred = ca.if_else(d < 1, (1 - d * d) * (2 - d) / 2, ca.if_else(d < 2, (1 - d) * (2 - d) * (3 - d) / 6, 0))
    if j > 3:
        return centred
    newest = 1
    for other in set(range(4)) - {j}:
        newest = newest * (delay - other) / (j - other)
    return ca.if_else(delay < 1, newest, centred)
