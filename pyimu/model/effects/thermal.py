"""Errors that follow the temperature of the part, its rate and its past."""

import casadi as ca

from pyimu.model.effect import Confound, Environment, Parameter, Scan, State, effect

ORIGIN = Parameter(
    "degC", (), 25.0, "temperature at which the thermal error is zero", reference=True
)


@effect(
    stage="bias",
    term="bias temperature sensitivity",
    equation=r"y = x + k_T (T - T_0)",
    source="Hidalgo 2012, table 1",
    symptom="drifts with temperature",
)
def thermal_bias(
    x,
    kT: Parameter("{y}/K", description="bias per kelvin"),
    T0: ORIGIN,
    T: Environment("temperature"),
):
    return x + kT * (T - T0)


@effect(
    stage="bias",
    term="bias temperature sensitivity, second order",
    equation=r"y = x + k_2 (T - T_0)^2",
    source=(
        "polynomial of third order as autopilots fit it (ArduPilot, pull request 16262; PX4, "
        "parameters TC_G)"
    ),
    symptom="drifts with temperature",
)
def thermal_bias_quadratic(
    x,
    k2: Parameter("{y}/K^2", description="bias per kelvin squared"),
    T0: ORIGIN,
    T: Environment("temperature"),
):
    return x + k2 * (T - T0) ** 2


@effect(
    stage="bias",
    term="bias temperature sensitivity, third order",
    equation=r"y = x + k_3 (T - T_0)^3",
    source=(
        "polynomial of third order as autopilots fit it (ArduPilot, pull request 16262; PX4, "
        "parameters TC_G)"
    ),
)
def thermal_bias_cubic(
    x,
    k3: Parameter("{y}/K^3", description="bias per kelvin cubed"),
    T0: ORIGIN,
    T: Environment("temperature"),
):
    return x + k3 * (T - T0) ** 3


@effect(
    stage="bias",
    term="bias temperature-gradient sensitivity",
    equation=r"y = x + k_d \dot T",
    source=(
        "no source for the equation; data sheets state its coefficient per K/min (STIM300, bias "
        "over temperature gradients)"
    ),
    confound=Confound(
        "a thermometer that lags behind the part, whose bias follows its temperature",
        "a thermometer on the part itself, or a temperature that rests between its changes",
    ),
)
def temperature_rate(
    x,
    kd: Parameter("{y}*s/K", description="bias per rate of temperature"),
    Td: Environment("temperature_rate"),
):
    return x + kd * Td


@effect(
    stage="bias",
    term="bias thermal hysteresis",
    equation=r"y = x + k_h (\mathrm{play}_w(T) - T)",
    source=(
        "no source for the play operator as a model of a sensor; the operator: Visintin, "
        "Differential Models of Hysteresis, 1994"
    ),
)
def thermal_hysteresis(
    x,
    kh: Parameter(
        "{y}/K", description="bias per kelvin by which the play lags behind the temperature"
    ),
    width: Parameter(
        "K",
        (),
        1.0,
        "half width of the play",
        form=True,
        minimum=0.0,
        scan=Scan("swing", 0.02, 0.45, 10),
    ),
    T: Environment("temperature"),
    played: State("degC", (), start="T"),
):
    played = ca.fmax(T - width, ca.fmin(T + width, played))
    return x + kh * (played - T), {"played": played}


@effect(
    stage="gain",
    term="scale factor temperature sensitivity",
    equation=r"y = (1 + k_S (T - T_0))\, x",
    source=(
        "no source for the equation; data sheets state its coefficient per K (ADIS16460 rev. B, "
        "table 1)"
    ),
)
def thermal_scale_factor(
    x,
    kS: Parameter("1/K", description="relative scale factor error per kelvin"),
    T0: ORIGIN,
    T: Environment("temperature"),
):
    return x + kS * (T - T0) * x


@effect(
    stage="gain",
    term="misalignment temperature sensitivity",
    equation=r"y = x + (T - T_0) M_T x,\; \mathrm{diag}\, M_T = 0",
    source="no source for the equation; the linear term of a misalignment that follows temperature",
    confound=Confound(
        "a mounting that turns as the temperature changes",
        "a reference that is fixed to the part itself",
    ),
)
def thermal_misalignment(
    x,
    mT: Parameter(
        "rad/K",
        (3, 3),
        diagonal=False,
        description="part of axis j seen by axis i, per kelvin",
    ),
    T0: ORIGIN,
    T: Environment("temperature"),
):
    return x + (T - T0) * (mT @ x)
