"""Motion that reaches the sensing elements and is not the motion meant: lever arms, the Earth,
undersampling.
"""

import casadi as ca

from pyimu.model.effect import Environment, Parameter, SamplePeriod, effect


@effect(
    stage="motion",
    term="size effect, lever arm",
    equation=r"y_i = x_i + e_i \cdot (\alpha \times r_i + \omega \times (\omega \times r_i))",
    source="rigid-body kinematics",
    sensors=("accel",),
)
def size_effect(
    x,
    r: Parameter(
        "m",
        (3, 3),
        description="position of element i from the point whose force is meant, along axis j",
    ),
    rate: Environment("rate"),
    acceleration: Environment("angular_acceleration"),
):
    arms = [r[i, :].T for i in range(3)]
    felt = [ca.cross(acceleration, arm) + ca.cross(rate, ca.cross(rate, arm)) for arm in arms]
    return x + ca.vertcat(*[felt[i][i] for i in range(3)])


@effect(
    stage="motion",
    term="Earth rate not modelled",
    equation=r"y = x + k\, R_{nb}^T \Omega_n(\varphi)",
    source="Hidalgo 2012, Earth rotation vector; Groves 2013, eq. 2.123",
    sensors=("gyro",),
)
def earth_rate(
    x,
    k: Parameter(
        "1",
        (),
        known=1.0,
        description="share of the Earth rate that is added; 1 where it had been left out",
    ),
    earth: Environment("earth_rate"),
):
    return x + k * earth


@effect(
    stage="motion",
    term="transport rate not modelled",
    equation=r"y = x + k\, R_{nb}^T [-v_N, v_E, v_E \tan\varphi] / R",
    source="Groves 2013, eq. 5.44, for a sphere",
    sensors=("gyro",),
)
def transport_rate(
    x,
    k: Parameter(
        "1",
        (),
        known=1.0,
        description="share of the transport rate that is added; 1 where it had been left out",
    ),
    transport: Environment("transport_rate"),
):
    return x + k * transport


@effect(
    stage="motion",
    term="coning from undersampling",
    equation=(
        r"y = x - c \tfrac{h}{12}\, x_{k-1} \times x_k = x - c \tfrac{h^2}{12}\, x \times "
        r"\dot\omega"
    ),
    source=(
        "two-sample correction of the rotation vector, as in Savage; no source checked for the "
        "factor 1/12; c = 1 is a read-out without it"
    ),
    sensors=("gyro",),
)
def coning(
    x,
    c: Parameter("1", (), known=1.0, description="share of the coning correction that is missing"),
    acceleration: Environment("angular_acceleration"),
    h: SamplePeriod(),
):
    return x - c * h**2 / 12 * ca.cross(x, acceleration)


@effect(
    stage="motion",
    term="sculling from undersampling",
    equation=(
        r"y = x - c \tfrac{h}{12} (\omega_{k-1} \times x_k + x_{k-1} \times \omega_k) = x + c "
        r"\tfrac{h^2}{12} (\dot\omega \times x + \dot f \times \omega)"
    ),
    source=(
        "two-sample correction of the velocity increment, as in Savage; no source checked for the "
        "factor 1/12; c = 1 is a read-out without it"
    ),
    sensors=("accel",),
)
def sculling(
    x,
    c: Parameter("1", (), description="share of the sculling correction that is missing"),
    rate: Environment("rate"),
    acceleration: Environment("angular_acceleration"),
    jerk: Environment("jerk"),
    h: SamplePeriod(),
):
    return x + c * h**2 / 12 * (ca.cross(acceleration, x) + ca.cross(jerk, rate))
