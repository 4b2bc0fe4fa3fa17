"""Gyro errors that specific force causes, and bias that vibration leaves behind."""

import casadi as ca

from pyimu.model.effect import Environment, Parameter, effect


@effect(
    stage="gain",
    term="scale factor acceleration sensitivity",
    equation=r"y = (1 + P f)\, x",
    sensors=("gyro",),
    source="no source for the equation; data sheets state its coefficient in ppm/g (STIM300)",
)
def scale_factor_g_sensitivity(
    x,
    P: Parameter(
        "1/(m/s^2)",
        (3, 3),
        description="relative scale factor error of axis i per force along axis j",
    ),
    f: Environment("specific_force"),
):
    return x + (P @ f) * x


@effect(
    stage="bias",
    term="acceleration-sensitive drift (g-sensitivity)",
    equation=r"y = x + G f",
    source="IEEE Std 528-2019, acceleration-sensitive drift rate; Groves 2013, eq. 4.17, G_g f",
    sensors=("gyro",),
    symptom="drifts with acceleration",
)
def g_sensitivity(
    x,
    G: Parameter(
        "{y}/(m/s^2)", (3, 3), description="drift of axis i per specific force along axis j"
    ),
    f: Environment("specific_force"),
):
    return x + G @ f


@effect(
    stage="bias",
    term="acceleration-squared-sensitive drift, anisoelastic",
    sensors=("gyro",),
    equation=r"y = x + Q\, [f_x^2, f_y^2, f_z^2, f_y f_z, f_z f_x, f_x f_y]^T",
    source=(
        "IEEE Std 528-2019, acceleration-squared-sensitive drift rate: squares and products of "
        "components"
    ),
    symptom="drifts with acceleration squared",
)
def g2_sensitivity(
    x,
    Q: Parameter(
        "{y}/(m/s^2)^2",
        (3, 6),
        columns=("xx", "yy", "zz", "yz", "zx", "xy"),
        description="drift of axis i per product of forces: xx, yy, zz, yz, zx, xy",
    ),
    f: Environment("specific_force"),
):
    return x + Q @ ca.vertcat(
        f[0] ** 2, f[1] ** 2, f[2] ** 2, f[1] * f[2], f[2] * f[0], f[0] * f[1]
    )


@effect(
    stage="bias",
    term="vibration rectification error",
    equation=r"y = x + V \langle f_\mathrm{vib}^2 \rangle",
    source=(
        "no source for the equation; data sheets state its coefficient per g^2 (ADIS16460 rev. B, "
        "table 1)"
    ),
)
def vibration_rectification(
    x,
    V: Parameter(
        "{y}/(m/s^2)^2", (3, 3), description="bias of axis i per mean square vibration along axis j"
    ),
    square: Environment("vibration"),
):
    return x + V @ square
