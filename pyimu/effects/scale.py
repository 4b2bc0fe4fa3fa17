"""Gain errors: the output's slope against the input."""

import casadi as ca

from pyimu.effect import Parameter, effect


@effect(stage="gain", term="scale factor error", equation=r"y = (1 + s) x", source="IEEE Std 528-2019, scale factor error")
def scale_factor(x, s: Parameter("1", description="relative scale factor error")):
    return x + s * x


@effect(stage="gain", term="scale factor asymmetry", equation=r"y = x + s_a |x|",
        source="IEEE Std 528-2019, scale factor asymmetry; half the difference between the two slopes")
def scale_factor_asymmetry(x, sa: Parameter("1", description="half the difference of the slopes for positive and negative input")):
    return x + sa * ca.fabs(x)
