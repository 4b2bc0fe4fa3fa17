"""Gain errors: the output's slope against the input, and its bends."""

import casadi as ca

from pyimu.model.effect import Parameter, effect


@effect(
    stage="gain",
    magnetic=True,
    term="scale factor error",
    equation=r"y = (1 + s) x",
    source="Hidalgo 2012, section 3.2, matrix M; Groves 2013, eqs. 4.16 and 4.17",
    symptom="has another scale factor",
)
def scale_factor(x, s: Parameter("1", description="relative scale factor error")):
    return x + s * x


@effect(
    stage="gain",
    term="scale factor asymmetry",
    equation=r"y = x + s_a |x|",
    source=(
        "scale factor asymmetry of IEEE Std 528, whose text was not checked; here half the "
        "difference of the slopes"
    ),
    symptom="scales the two senses differently",
)
def scale_factor_asymmetry(
    x,
    sa: Parameter(
        "1", description="half the difference of the slopes for positive and negative input"
    ),
):
    return x + sa * ca.fabs(x)


@effect(
    stage="gain",
    term="scale factor nonlinearity, second order",
    equation=r"y = x + s_2 x^2",
    source=(
        "no source for a gyro; of an accelerometer K2 of IEEE Std 1293, whose text was not checked"
    ),
)
def scale_factor_nonlinearity(
    x,
    s2: Parameter(
        "1/({y})", description="relative change of the scale factor per input, second order"
    ),
):
    return x + s2 * x**2


@effect(
    stage="gain",
    term="scale factor nonlinearity, third order",
    equation=r"y = x + s_3 x^3",
    source=(
        "no source for a gyro; of an accelerometer K3 of IEEE Std 1293, whose text was not checked"
    ),
)
def scale_factor_cubic(
    x,
    s3: Parameter("1/({y})^2", description="relative change of the scale factor per squared input"),
):
    return x + s3 * x**3
