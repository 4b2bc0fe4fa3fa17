"""Answers to the other axes' motion."""

import casadi as ca

from pyimu.model.effect import Environment, Parameter, effect


@effect(
    stage="gain",
    term="anisoinertia, product of the cross-axis rates",
    equation=r"y_i = x_i + c_i x_j x_k",
    sensors=("gyro",),
    source="IEEE Std 528-2019, anisoinertia (B), defined there for mechanical gyros",
)
def anisoinertia(
    x,
    c: Parameter("1/({y})", description="drift per product of the rates about the two other axes"),
):
    return x + c * ca.vertcat(x[1] * x[2], x[2] * x[0], x[0] * x[1])


@effect(
    stage="gain",
    term="vibropendulous error, cross coupling",
    equation=r"y_i = x_i + \sum_{j \ne i} k_{ij} x_i x_j",
    sensors=("accel",),
    source="cross-coupling coefficients K_ip and K_io of IEEE Std 1293, whose text was not checked",
)
def vibropendulous(
    x,
    kp: Parameter(
        "1/({y})",
        (3, 3),
        diagonal=False,
        description="relative change of axis i's scale factor per force along axis j",
    ),
):
    return x + x * (kp @ x)


@effect(
    stage="gain",
    term="angular acceleration sensitivity",
    equation=r"y_i = x_i + \sum_{j \ne i} c_{ij} \dot\omega_j",
    sensors=("gyro",),
    source="IEEE Std 528-2001, 2.11, angular acceleration sensitivity",
)
def angular_acceleration(
    x,
    c: Parameter(
        "s",
        (3, 3),
        diagonal=False,
        description="output of axis i per angular acceleration about axis j",
    ),
    acceleration: Environment("angular_acceleration"),
):
    return x + c @ acceleration
