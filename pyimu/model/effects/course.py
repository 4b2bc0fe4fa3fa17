"""Bias and scale factor that change with the time since power-on, and with age."""

import casadi as ca

from pyimu.model.effect import Environment, Law, Parameter, Scan, effect

EVENTS = 4
"""Steps of the bias that one sensor can have."""


@effect(
    stage="bias", term="warm-up transient", equation=r"y = x + A e^{-t / \tau}", source="no source"
)
def warm_up(
    x,
    A: Parameter("{y}", description="bias at power-on that dies away"),
    tau: Parameter(
        "s", (), 300.0, "time constant", form=True, minimum=1e-6, scan=Scan("span", 1.0, 1.0, 14)
    ),
    t: Environment("time"),
):
    return x + A * ca.exp(-t / tau)


@effect(
    stage="bias",
    term="rate (acceleration) ramp",
    equation=r"y = x + R t",
    source="Hidalgo 2012, table 3, rate ramp",
    law=Law(
        ramp=lambda R: R,
        transfer=r"\text{none: no random process}",
        psd=r"\frac{R^2}{(2 \pi f)^3}\ \text{(a formal label)}",
        allan=r"\frac{R \tau}{\sqrt 2}",
        note=(
            "A ramp has no density: the label of the field's tables has a divergent Allan "
            "integral, and only the Allan deviation can be compared."
        ),
    ),
    family="growth with time",
    symptom="ramps",
)
def rate_ramp(
    x, R: Parameter("{y}/s", description="bias that grows with time"), t: Environment("time")
):
    return x + R * t


@effect(
    stage="bias",
    term="bias steps, shock shifts",
    equation=r"y = x + \sum_k A_k\, 1(t \ge t_k)",
    source="no source; steps as shock or remounting leaves them",
)
def bias_step(
    x,
    A: Parameter(
        "{y}",
        (3, EVENTS),
        description="change of axis i's bias at event k",
        columns=tuple(f"event {k + 1}" for k in range(EVENTS)),
    ),
    t0: Parameter(
        "s",
        (EVENTS,),
        description="time of event k since power-on",
        form=True,
        scan=Scan("instant", 1.0),
    ),
    t: Environment("time"),
):
    return x + A @ (t >= t0)


@effect(
    stage="bias",
    term="ageing of bias and scale factor",
    equation=r"y = x + (a + t)(k_b + k_s x)",
    source="no source for the form; IEEE Std 528-2019, long-term stability",
    family="growth with time",
)
def ageing(
    x,
    kb: Parameter("{y}/s", description="bias per time since calibration"),
    ks: Parameter("1/s", description="relative scale factor error per time since calibration"),
    age: Parameter("s", (), 0.0, "time from calibration to power-on", reference=True),
    t: Environment("time"),
):
    return x + (age + t) * (kb + ks * x)
