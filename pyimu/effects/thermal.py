"""Bias that follows the temperature of the part."""

from pyimu.effect import Environment, Parameter, effect

ORIGIN = Parameter("degC", (), 25.0, "temperature at which the thermal bias is zero", reference=True)


@effect(stage="bias", term="bias temperature sensitivity", equation=r"y = x + k_T (T - T_0)",
        source="Hidalgo 2012, table 1; IEEE Std 528-2019, bias temperature sensitivity")
def thermal_bias(x, kT: Parameter("{y}/K", description="bias per kelvin"), T0: ORIGIN, T: Environment("temperature")):
    return x + kT * (T - T0)


@effect(stage="bias", term="bias temperature sensitivity, second order", equation=r"y = x + k_2 (T - T_0)^2",
        source="no source for the coefficient; second term of the bias polynomial in temperature")
def thermal_bias_quadratic(x, k2: Parameter("{y}/K^2", description="bias per kelvin squared"), T0: ORIGIN,
                           T: Environment("temperature")):
    return x + k2 * (T - T0) ** 2
