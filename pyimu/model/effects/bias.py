"""Bias that belongs to one power-on."""

from pyimu.model.effect import Parameter, effect


@effect(
    stage="bias",
    term="turn-on bias",
    equation=r"y = x + b_0",
    source="Groves 2013, eqs. 4.16 and 4.17, terms b_a and b_g",
    per_power_on=True,
)
def turn_on_bias(x, b0: Parameter("{y}", description="turn-on bias, a new draw at each power-on")):
    return x + b0
