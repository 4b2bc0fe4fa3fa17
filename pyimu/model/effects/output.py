"""The read-out: threshold, resolution and range. All lose information."""

import casadi as ca

from pyimu.model.effect import Law, Parameter, SamplePeriod, Scan, State, effect


def _inside(y, d):
    return ca.if_else(d > 0, y == 0, 0)


def _outside(y, d):
    return y + d * ca.sign(y)


@effect(
    stage="output",
    term="dead zone, threshold",
    equation=r"y = x - \max(-d, \min(d, x))",
    smooth=False,
    invertible=False,
    lost=_inside,
    restore=_outside,
    source="no source; threshold as mechanical stops and digital filters leave it",
    family="dead zone",
    symptom="does not answer to small input",
)
def dead_zone(x, d: Parameter("{y}", minimum=0.0, description="largest input without output")):
    return x - ca.fmax(-d, ca.fmin(d, x))


@effect(
    stage="output",
    term="dead band, hard",
    equation=r"y = x\ (|x| > d),\quad 0\ (|x| \le d)",
    smooth=False,
    invertible=False,
    lost=_inside,
    source=(
        "no source for the form; dead band and threshold of IEEE Std 528, whose text was not "
        "checked, as firmware that suppresses small outputs leaves it"
    ),
    family="dead zone",
    symptom="does not answer to small input",
    phrase="a hard dead zone of",
)
def hard_dead_zone(
    x,
    d: Parameter(
        "{y}",
        minimum=0.0,
        scan=Scan("zone", 0.002, 0.5, 16),
        reads="threshold",
        description="largest input whose output is zero; larger ones pass as they are",
    ),
):
    return ca.if_else(ca.logic_and(d > 0, ca.fabs(x) <= d), 0, x)


@effect(
    stage="output",
    term="quantization of angle (velocity) increments",
    equation=(
        r"y = q\, (\lfloor \theta_k / q + 1/2 \rfloor - \lfloor \theta_{k-1} / q + 1/2 \rfloor) / "
        r"h,\; \dot\theta = x"
    ),
    smooth=False,
    invertible=False,
    source="Hidalgo 2012, table 3, quantization noise with Q = q / sqrt(12)",
    law=Law(
        rounding=lambda q: q / ca.sqrt(12),
        transfer=r"Q \sqrt{h}\, s,\quad Q = q / \sqrt{12}",
        psd=r"\frac{4 Q^2}{h} \sin^2(\pi f h) \approx (2 \pi f)^2 Q^2 h",
        allan=r"\frac{\sqrt 3\, Q}{\tau}",
        note=(
            "The angle's rounding error is independent from sample to sample where other noise "
            "turns the sensor by half a step a sample or more."
        ),
    ),
)
def angle_quantization(
    x,
    q: Parameter(
        "{Y}", minimum=0.0, description="step of the integrated output; 0 switches rounding off"
    ),
    left: State("{Y}"),
    h: SamplePeriod(),
):
    due = left + h * x
    given = q * ca.floor(due / q + 0.5)
    return ca.if_else(q > 0, given / h, x), {"left": ca.if_else(q > 0, due - given, 0)}


def _at_limit(y, limit):
    return ca.if_else(limit > 0, ca.fabs(y) >= limit, 0)


@effect(
    stage="output",
    term="input range, saturation",
    equation=r"y = \max(-L, \min(L, x))",
    smooth=False,
    invertible=False,
    lost=_at_limit,
    source="no source; clipping at the ends of the input range",
    symptom="clips",
    phrase="saturation at",
)
def saturation(
    x,
    limit: Parameter(
        "{y}",
        minimum=0.0,
        scan=Scan("range", 0.3, 0.98, 12),
        reads="ceiling",
        description="largest output; 0 switches the limit off",
    ),
):
    # Not by fmin and fmax, which would make full scale of an input that is NaN.
    return ca.if_else(ca.logic_and(limit > 0, ca.fabs(x) > limit), ca.sign(x) * limit, x)


@effect(
    stage="output",
    term="resolution, quantization",
    equation=r"y = q \lfloor x / q + 1/2 \rfloor",
    smooth=False,
    invertible=False,
    source="no source; rounding of the rate to steps q",
    law=Law(
        white=lambda q, h: q**2 * h / 12,
        transfer=r"q \sqrt{h / 12}",
        psd=r"\frac{q^2 h}{12}",
        allan=r"q \sqrt{\frac{h}{12\, \tau}}",
        note="Rounding of the rate is white noise where other noise exceeds half a step.",
    ),
    symptom="rounds coarsely",
    phrase="rounding to",
)
def quantization(
    x,
    q: Parameter(
        "{y}", minimum=0.0, reads="step", description="step of the output; 0 switches rounding off"
    ),
):
    return ca.if_else(q > 0, q * ca.floor(x / q + 0.5), x)
