"""Answers to the other axes' motion, and to turns."""

import casadi as ca

from pyimu.model.effect import Environment, Parameter, effect


def _of_the_others(x):
    """The product of the two other axes' components, for each axis (3,)."""
    return ca.vertcat(x[1] * x[2], x[2] * x[0], x[0] * x[1])


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
    return x + c * _of_the_others(x)


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
    term="cross-axis nonlinearity, second order",
    equation=r"y_i = x_i + \sum_{j \ne i} k_{ij} x_j^2 + k_{x,i} x_j x_k",
    sensors=("accel",),
    source="coefficients K_pp, K_oo and K_po of IEEE Std 1293, whose text was not checked",
)
def cross_axis_nonlinearity(
    x,
    k: Parameter(
        "1/({y})",
        (3, 3),
        diagonal=False,
        description="output of axis i per squared force along axis j: K_pp, K_oo",
    ),
    kx: Parameter(
        "1/({y})", description="output per product of the forces along the two other axes: K_po"
    ),
):
    return x + k @ x**2 + kx * _of_the_others(x)


@effect(
    stage="gain",
    term="spin-rate sensitivity, anisoinertia",
    equation=r"y_i = x_i + \omega_i \sum_j s_{ij} \omega_j",
    sensors=("accel",),
    source=(
        "IEEE Std 528-2019, anisoinertia (A), the product of the rates about input and pendulous "
        "axis, and spin-rate terms of IEEE Std 1293, whose text was not checked; no source for the "
        "square"
    ),
)
def spin_sensitivity(
    x,
    s: Parameter(
        "{y}/(rad/s)^2",
        (3, 3),
        description="output of axis i per product of the rates about axes i and j; i = j: spin",
    ),
    rate: Environment("rate"),
):
    return x + rate * (s @ rate)


@effect(
    stage="gain",
    term="angular acceleration sensitivity",
    # Of a gyro it is y = x + c dx/dt, whose inverse has the poles l / (1 + l), l = eig(c) / h; as
    # c has no diagonal, some l is below zero, and below -1/2 the pole is beyond 1.
    grows=True,
    equation=r"y_i = x_i + \sum_{j \ne i} c_{ij} \dot\omega_j",
    source=(
        "IEEE Std 528-2001, 2.11, angular acceleration sensitivity; of an accelerometer the "
        "angular-acceleration coefficient of IEEE Std 1293, whose text was not checked"
    ),
)
def angular_acceleration(
    x,
    c: Parameter(
        "{y}/(rad/s^2)",
        (3, 3),
        diagonal=False,
        description="output of axis i per angular acceleration about axis j",
    ),
    acceleration: Environment("angular_acceleration"),
):
    return x + c @ acceleration
