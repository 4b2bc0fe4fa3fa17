"""What lies between the motion and the sampled signal: bandwidth and delay."""

import casadi as ca

from pyimu.model.effect import (
    INPUT,
    Confound,
    Parameter,
    SamplePeriod,
    Scan,
    State,
    effect,
    is_number,
    kept,
)

MEMORY = 32
"""Samples that ``time_delay`` remembers."""

LONGEST_DELAY = MEMORY - 2
"""Sample periods that it reaches back: the cubic needs a sample on either side."""


LATE = Confound(
    "a clock of the reference that is early by as much in all logs",
    "one clock for sensor and reference",
)


def _too_long(h, td):
    return td > LONGEST_DELAY * h * (
        1 + 1e-9
    )  # a delay that was worked out from a rate may be rounded


@effect(
    stage="dynamics",
    term="bandwidth, second-order lag",
    equation=r"y = \frac{\omega_n^2}{s^2 + 2 \zeta \omega_n s + \omega_n^2} x",
    invertible=False,
    source=(
        "no source for the coefficients; second-order low-pass of a read-out: its poles exactly, "
        "its gain to second order in s"
    ),
    family="delay",
    delay=lambda wn, zeta: ca.if_else(wn > 0, 2 * zeta / wn, 0),
    confound=LATE,
    symptom="answers late",
    phrase="a second-order lag at",
)
def lag(
    x,
    wn: Parameter(
        "rad/s",
        (),
        minimum=0.0,
        scan=Scan("rate", 0.06, 4.0, 10),
        said="frequency",
        description="natural frequency; 0 switches the lag off",
    ),
    zeta: Parameter(
        "1",
        (),
        0.7071067811865476,
        minimum=0.1,
        maximum=2.0,
        said="ratio",
        description="damping ratio",
    ),
    x1: State("{y}", start=INPUT),
    x2: State("{y}", start=INPUT),
    y1: State("{y}", start=INPUT),
    y2: State("{y}", start=INPUT),
    h: SamplePeriod(),
):
    b, a = _second_order(wn * h, zeta)
    felt = kept(
        x, x1
    )  # behind a missing input the filter swings on as if the last one had been held
    y = ca.if_else(wn > 0, b[0] * felt + b[1] * x1 + b[2] * x2 - a[0] * y1 - a[1] * y2, felt)
    return ca.if_else(is_number(x), y, x), {"x1": felt, "x2": x1, "y1": y, "y2": y1}


def _second_order(angle: ca.SX, zeta: ca.SX) -> tuple[tuple, tuple]:
    """Coefficients (b0, b1, b2), (a1, a2) of the sampled low-pass; ``angle`` is natural frequency
    times sample period.

    The poles are exp(s h) of the continuous ones. The zeros follow from B(e^(s h)) = A(e^(s h))
    G(s) up to s^2, which sets gain, delay and curvature at low frequency; the bilinear rule would
    ring where the lag is short against h.
    """
    root = ca.sqrt(ca.fabs(zeta * zeta - 1)) * angle
    oscillating = 2 * ca.exp(-zeta * angle) * ca.cos(root)
    creeping = ca.exp(root - zeta * angle) + ca.exp(-root - zeta * angle)
    a1, a2 = -ca.if_else(zeta < 1, oscillating, creeping), ca.exp(-2 * zeta * angle)
    g1, g2 = -2 * zeta / angle, (4 * zeta * zeta - 1) / (angle * angle)
    total, first, second = 1 + a1 + a2, a1 + 2 * a2, a1 + 4 * a2
    first_b = first - total * g1
    second_b = second - 2 * first * g1 + 2 * total * g2
    b2 = (second_b - first_b) / 2
    b1 = first_b - 2 * b2
    return (total - b1 - b2, b1, b2), (a1, a2)


@effect(
    stage="dynamics",
    term="bandwidth, first-order lag",
    equation=(
        r"y = \frac{1}{1 + \tau s} x,\quad s \to \frac{11 - 18 z^{-1} + 9 z^{-2} - 2 z^{-3}}{6 h}"
    ),
    source=(
        "no source for the coefficient; single-pole low-pass, an exponential average in continuous "
        "time, its derivative by the backward difference of third order"
    ),
    family="delay",
    delay=lambda tau: tau,
    confound=LATE,
    symptom="answers late",
    phrase="a first-order lag of",
)
def first_order_lag(
    x,
    tau: Parameter(
        "s",
        (),
        minimum=0.0,
        scan=Scan("period", 0.3, 28.0, 10),
        description="time constant of the single pole; 0 switches the lag off",
    ),
    x1: State("{y}", start=INPUT),
    y1: State("{y}", start=INPUT),
    y2: State("{y}", start=INPUT),
    y3: State("{y}", start=INPUT),
    h: SamplePeriod(),
):
    # The difference over past outputs is right to third order in s h, and its inverse
    # x = y + tau dy/dt has no memory of what it restored: it cannot ring.
    share = 1 / (1 + 11 / 6 * tau / h)
    past = tau / h * (18 * y1 - 9 * y2 + 2 * y3) / 6

    def answer(felt):
        return share * (felt + past)

    felt = kept(x, x1)  # behind a missing input it goes on as if the last one had been held
    return answer(x), {"x1": felt, "y1": answer(felt), "y2": y1, "y3": y2}


@effect(
    stage="dynamics",
    term="time delay, timestamp offset",
    equation=r"y(t) = x(t - t_d)",
    invertible=False,
    limits={f"td must not be above {LONGEST_DELAY} sample periods": _too_long},
    source="no source for the coefficient; third-order Lagrange interpolation between samples",
    family="delay",
    delay=lambda td: td,
    confound=LATE,
    symptom="answers late",
    phrase="a time delay of",
)
def time_delay(
    x,
    td: Parameter(
        "s",
        (),
        minimum=0.0,
        scan=Scan("period", 0.3, 28.0, 10),
        description=(
            f"delay of the output behind the motion, at most {LONGEST_DELAY} sample periods"
        ),
    ),
    past: State("{y}", (MEMORY, 3), start=INPUT),
    h: SamplePeriod(),
):
    samples = ca.vertcat(x.T, past)
    delay = ca.fmin(ca.fmax(td / h, 0), LONGEST_DELAY)
    weights = ca.vertcat(*[_lagrange(j, delay) for j in range(MEMORY + 1)])
    return ca.if_else(td > 0, (weights.T @ samples).T, x), {"past": samples[:-1, :]}


def _lagrange(j: int, delay: ca.SX) -> ca.SX:
    """Weight of the sample ``j`` periods old in a cubic through the four samples around ``delay``
    (in periods).

    Below one period there is no newer sample to centre on, so the cubic runs through the newest
    four.
    """
    d = ca.fabs(delay - j)
    centred = ca.if_else(
        d < 1, (1 - d * d) * (2 - d) / 2, ca.if_else(d < 2, (1 - d) * (2 - d) * (3 - d) / 6, 0)
    )
    if j > 3:
        return centred
    newest = 1
    for other in set(range(4)) - {j}:
        newest = newest * (delay - other) / (j - other)
    return ca.if_else(delay < 1, newest, centred)
