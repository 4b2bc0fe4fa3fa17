"""Bias that belongs to one power-on, and bias that follows the sign of the input."""

import casadi as ca

from pyimu.model.effect import Parameter, effect


def _either_sign(y, ba):
    return ca.if_else(ba != 0, ca.fabs(y) <= ca.fabs(ba) / 2, 0)


def _of_its_sign(y, ba):
    return y - ba / 2 * ca.sign(y)


@effect(
    stage="gain",
    term="bias asymmetry",
    equation=r"y = x + \tfrac{b_a}{2}\, \mathrm{sign}\, x",
    sensors=("accel",),
    # Where the bias is less for positive input, small outputs come from inputs of either sign.
    invertible=False,
    lost=_either_sign,
    restore=_of_its_sign,
    source="coefficient K0' of IEEE Std 1293, whose text was not checked",
)
def bias_asymmetry(
    x,
    ba: Parameter("{y}", description="bias for positive less bias for negative input, K0'"),
):
    return x + ba / 2 * ca.sign(x)


@effect(
    stage="bias",
    magnetic=True,
    term="turn-on bias",
    equation=r"y = x + b_0",
    source="Groves 2013, eqs. 4.16 and 4.17, terms b_a and b_g",
    per_power_on=True,
)
def turn_on_bias(x, b0: Parameter("{y}", description="turn-on bias, a new draw at each power-on")):
    return x + b0
