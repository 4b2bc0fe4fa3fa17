"""Noise. Coefficients are roots of two-sided densities; processes with a stationary state start in
it.
"""

import casadi as ca

from pyimu.model.effect import (
    Environment,
    Law,
    Noise,
    Parameter,
    SamplePeriod,
    Scan,
    State,
    effect,
)

POLES = 6
"""Gauss-Markov processes that make up ``bias_instability``, evenly in the logarithm from ``f_low``
to ``f_high``."""


DECADES = (2, 5)
"""From ``f_low`` to ``f_high`` at least and at most; nearer or farther the sum of processes is no
1/f noise."""


def end_weight(spacing):
    """Weight of the first and the last of them, which stand in for those beyond, at their spacing
    in the natural logarithm.

    Fitted: f S(f) keeps to B^2 / 2 pi within 0.25 dB from ``f_low`` to ``f_high`` where these are
    two to five decades apart.
    """
    return 0.535 + 1.363 / spacing


@effect(
    stage="noise",
    magnetic=True,
    term="angle (velocity) random walk",
    equation=r"y = x + N w / \sqrt{h}",
    source="Hidalgo 2012, section 3.2 and table 3; IEEE Std 528-2001, 2.10",
    law=Law(white=lambda N: N**2, transfer="N", psd="N^2", allan=r"\frac{N}{\sqrt\tau}"),
)
def angle_random_walk(
    x,
    N: Parameter(
        "{Y}/sqrt(s)",
        minimum=0.0,
        density=True,
        description="root of the two-sided white noise density",
    ),
    w: Noise(),
    h: SamplePeriod(),
):
    return x + N * w / ca.sqrt(h)


@effect(
    stage="noise",
    term="rate (acceleration) random walk",
    equation=r"y = x + b,\; \dot b = K w",
    source="Hidalgo 2012, section 3.2 and table 3",
    law=Law(
        walk=lambda K: K**2,
        transfer=r"\frac{K}{s}",
        poles="0",
        psd=r"\frac{K^2 h^2}{4 \sin^2(\pi f h)} \approx \frac{K^2}{(2 \pi f)^2}",
        allan=r"K \sqrt{\frac{\tau}{3} \left(1 + \frac{1}{2 n^2}\right)}",
    ),
)
def rate_random_walk(
    x,
    K: Parameter(
        "{y}/sqrt(s)",
        minimum=0.0,
        density=True,
        description="root of the two-sided density of the bias's derivative",
    ),
    b: State("{y}"),
    w: Noise(),
    h: SamplePeriod(),
):
    return x + b, {"b": b + K * ca.sqrt(h) * w}


def _gauss_markov(b, variance, angle, w, started):
    """Next value of a Gauss-Markov process, ``angle`` sample periods over its time constant on; its
    first is a stationary draw.
    """
    kept, fresh = ca.exp(-angle), ca.sqrt(-variance * ca.expm1(-2 * angle))
    return ca.if_else(started, kept * b + fresh * w, ca.sqrt(variance) * w)


MARKOV_LAW = Law(
    markov=lambda q, tau: [(q**2 * tau / 2, tau)],
    transfer=r"\frac{q}{s + 1 / \tau_c}",
    poles=r"-1 / \tau_c",
    psd=(
        r"\frac{q^2 h\, (1 - a^2)\, \tau_c / 2}{1 - 2 a \cos(2 \pi f h) + a^2} \approx "
        r"\frac{q^2 \tau_c^2}{1 + (2 \pi f \tau_c)^2},\quad a = e^{-h / \tau_c}"
    ),
    allan=(
        r"q \tau_c \sqrt{\tfrac{1}{\tau} \left[1 - \tfrac{\tau_c}{2 \tau} \left(3 - "
        r"4 e^{-\tau / \tau_c} + e^{-2 \tau / \tau_c}\right)\right]}"
    ),
    note=(
        "The closed form is the continuous one (IEEE Std 952-2020, annex C); samples lie "
        r"above, in the variance by at most $\left(h / (\sqrt{2}\, \tau) + h / (\sqrt{12}\, "
        r"\tau_c)\right)^2$ of it. The coefficient `tau` is the correlation time $\tau_c$; "
        r"$\tau$ alone is the cluster time."
    ),
    shown={"tau": 10.0},
)
"""Of each Gauss-Markov process that a sensor can have."""

MARKOV_DRIVE = Parameter(
    "{y}/sqrt(s)",
    minimum=0.0,
    description="root of the two-sided density of the noise that drives it",
)


def _correlation_time(start):
    return Parameter(
        "s", (3,), start, "correlation time, tau_c of the equation", form=True, minimum=1e-6
    )


def _markov_step(x, q, tau, b, started, w, h):
    b = _gauss_markov(b, q**2 * tau / 2, h / tau, w, started)
    return x + b, {"b": b, "started": 1}


@effect(
    stage="noise",
    term="exponentially correlated (Gauss-Markov) noise",
    equation=r"y = x + b,\; \dot b = -b / \tau_c + q w",
    source=(
        "first-order Gauss-Markov process, exponentially correlated noise of IEEE Std 952; its "
        "text was not checked"
    ),
    law=MARKOV_LAW,
)
def gauss_markov(
    x,
    q: MARKOV_DRIVE,
    tau: _correlation_time(100.0),
    b: State("{y}"),
    started: State("1", ()),
    w: Noise(),
    h: SamplePeriod(),
):
    return _markov_step(x, q, tau, b, started, w, h)


@effect(
    stage="noise",
    term="second exponentially correlated (Gauss-Markov) noise",
    equation=r"y = x + b,\; \dot b = -b / \tau_c + q w",
    source=(
        "as gauss_markov; two processes of different correlation times beside the random walk are "
        "usual in models of accelerometers, no source for a second one"
    ),
    law=MARKOV_LAW,
)
def second_gauss_markov(
    x,
    q: MARKOV_DRIVE,
    tau: _correlation_time(1.0),
    b: State("{y}"),
    started: State("1", ()),
    w: Noise(),
    h: SamplePeriod(),
):
    return _markov_step(x, q, tau, b, started, w, h)


def _no_flicker(h, B, f_low, f_high):
    ratio = f_high / f_low
    return ca.logic_or(ratio < 10 ** DECADES[0] * (1 - 1e-9), ratio > 10 ** DECADES[1] * (1 + 1e-9))


def flicker_processes(B, f_low, f_high):
    """Variance and rate [rad/s] of each Gauss-Markov process of ``bias_instability``, slowest
    first.

    A band of fewer or more than ``DECADES``, which only a unit that is running can be given, ends
    where these end.
    """
    spacing = ca.log(ca.fmin(ca.fmax(f_high / f_low, 10 ** DECADES[0]), 10 ** DECADES[1])) / (
        POLES - 1
    )
    weights = [end_weight(spacing) if k in (0, POLES - 1) else 1.0 for k in range(POLES)]
    return [
        (weight * spacing / ca.pi * B**2, 2 * ca.pi * f_low * ca.exp(k * spacing))
        for k, weight in enumerate(weights)
    ]


@effect(
    stage="noise",
    term="bias instability, flicker noise",
    equation=r"y = x + \sum_k b_k,\; S(f) \approx \frac{B^2}{2 \pi f}",
    limits={f"f_high must lie {DECADES[0]} to {DECADES[1]} decades above f_low": _no_flicker},
    source=(
        "Hidalgo 2012, table 3 for the density; no source for this sum of Gauss-Markov processes, "
        "one a decade"
    ),
    law=Law(
        markov=lambda B, f_low, f_high: [
            (variance, 1 / rate) for variance, rate in flicker_processes(B, f_low, f_high)
        ],
        floor=lambda B: ca.sqrt(2 * ca.log(2) / ca.pi) * B,
        transfer=(
            r"c\, \frac{\prod_{k=1}^{5} (s + z_k)}{\prod_{k=1}^{6} (s + a_k)},\quad "
            r"|H|^2 = \sum_k \frac{g_k^2}{a_k^2 + \omega^2}"
        ),
        poles=r"-a_k = -2 \pi f_{low} (f_{high} / f_{low})^{(k - 1) / 5}",
        psd=r"\approx \frac{B^2}{2 \pi f} \quad (f_{low} \le f \le f_{high})",
        allan=r"\approx \sqrt{\tfrac{2 \ln 2}{\pi}}\, B = 0.664\, B",
        note=(
            "A sum of six Gauss-Markov processes stands for the density. From $f_{low}$ to "
            r"$f_{high}$ it departs from $B^2 / (2 \pi f)$ by at most 0.25 dB; the line of the "
            "Allan deviation is the integral of the sum's density."
        ),
    ),
    symptom="flickers",
)
def bias_instability(
    x,
    B: Parameter(
        "{y}",
        minimum=0.0,
        description="coefficient of the 1/f noise; the Allan deviation's floor is 0.664 B",
    ),
    f_low: Parameter(
        "Hz",
        (),
        1e-5,
        "lower end of the band in which the density is 1/f",
        form=True,
        minimum=1e-12,
    ),
    f_high: Parameter(
        "Hz",
        (),
        1.0,
        f"upper end of that band, {DECADES[0]} to {DECADES[1]} decades above",
        form=True,
        minimum=1e-12,
    ),
    b: State("{y}", (POLES, 3)),
    started: State("1", ()),
    w: Noise(3 * POLES),
    h: SamplePeriod(),
):
    draws = ca.reshape(w, 3, POLES).T
    following = [
        _gauss_markov(b[k, :].T, variance, rate * h, draws[k, :].T, started)
        for k, (variance, rate) in enumerate(flicker_processes(B, f_low, f_high))
    ]
    return x + sum(following), {"b": ca.horzcat(*following).T, "started": 1}


@effect(
    stage="noise",
    term="rate-dependent noise, scale factor noise",
    equation=r"y = x + k x w / \sqrt{h}",
    source="no source; white noise whose root density grows with the input",
    law=Law(
        white=lambda k, x: (k * x) ** 2,
        transfer=r"k\, |x|",
        psd="k^2 x^2",
        allan=r"\frac{k |x|}{\sqrt\tau}",
        note="White noise in proportion to the size of the input.",
    ),
)
def rate_dependent_noise(
    x,
    k: Parameter(
        "sqrt(s)", minimum=0.0, description="root of the two-sided density of the relative error"
    ),
    w: Noise(),
    h: SamplePeriod(),
):
    return x + k * x * w / ca.sqrt(h)


@effect(
    stage="bias",
    term="sinusoidal noise, vibration line",
    equation=r"y = x + A \sin(2 \pi f_0 t + \varphi)",
    source="sinusoidal noise of IEEE Std 952; its text was not checked",
)
def vibration_line(
    x,
    A: Parameter("{y}", description="amplitude"),
    f0: Parameter("Hz", (), 20.0, "frequency", form=True, minimum=0.0, scan=Scan("line", 8.0)),
    phase: Parameter("rad", description="phase at power-on", form=True, scan=Scan("phase")),
    t: Environment("time"),
):
    return x + A * ca.sin(2 * ca.pi * f0 * t + phase)
