"""Effects on the gain, in the order in which they act."""

from __future__ import annotations

import numpy as np

from effect_logs.scene import T0
from effect_logs.term import ROTATING, Case, Term


def misalignment(x, case: Case):
    return x + x @ case.c.T


def scale_factor(x, case: Case):
    return x + case.c * x


def scale_factor_asymmetry(x, case: Case):
    return x + case.c * np.abs(x)


def scale_factor_nonlinearity(x, case: Case):
    return x + case.c * x**2


def scale_factor_cubic(x, case: Case):
    return x + case.c * x**3


def _of_the_others(x):
    """The product of the two other axes' inputs, for each axis (n, 3)."""
    return np.roll(x, -1, axis=1) * np.roll(x, -2, axis=1)


def anisoinertia(x, case: Case):
    return x + case.c * _of_the_others(x)


def vibropendulous(x, case: Case):
    return x + x * (x @ case.c.T)


def cross_axis_nonlinearity(x, case: Case):
    """Squares by the coefficients beside the diagonal, the two others' product by those on it."""
    return x + x**2 @ _beside_the_diagonal(case.c).T + np.diag(case.c) * _of_the_others(x)


def _beside_the_diagonal(c):
    return c * (1 - np.eye(3))


def spin_sensitivity(x, case: Case):
    rate = case.scene.rate
    return x + rate * (rate @ case.c.T)


def angular_acceleration(x, case: Case):
    return x + case.scene.slope("gyro") @ case.c.T


def scale_factor_g_sensitivity(x, case: Case):
    return x + (case.scene.force @ case.c.T) * x


def thermal_scale_factor(x, case: Case):
    return x + case.c * (case.scene.warmth - T0)[:, None] * x


def thermal_misalignment(x, case: Case):
    return x + (case.scene.warmth - T0)[:, None] * (x @ case.c.T)


def bias_asymmetry(x, case: Case):
    """Half the coefficient, with the sign of the input."""
    return x + case.c / 2 * np.sign(x)


DEG, G = np.deg2rad(1.0), 9.80665
FOR_FORCE = ("table", "tumble", "rover", "shaker")


def _both(function, parameter: str, gyro: float, accel: float, **more) -> Term:
    sizes = {"gyro": gyro, "accel": accel}
    return Term(function.__name__, function, sizes, parameter=parameter, **more)


TERMS = (
    _both(misalignment, "m", 0.02, 0.02, shape=(3, 3), hollow=True, forms=("declared",)),
    _both(scale_factor, "s", 0.03, 0.03, forms=("declared",)),
    _both(scale_factor_asymmetry, "sa", 1e-3, 1e-3),
    _both(scale_factor_nonlinearity, "s2", 1.6e-5 / DEG, 5e-3 / G),
    _both(scale_factor_cubic, "s3", 1.28e-7 / DEG**2, 5e-3 / G**2),
    Term(
        "anisoinertia",
        anisoinertia,
        {"gyro": 1.6e-5 / DEG},
        motions=("tumble", "rover"),
        parameter="c",
    ),
    Term(
        "vibropendulous",
        vibropendulous,
        {"accel": 5e-3 / G},
        (3, 3),
        hollow=True,
        motions=FOR_FORCE,
        parameter="kp",
    ),
    Term(
        "cross_axis_nonlinearity",
        cross_axis_nonlinearity,
        {"accel": 5e-3 / G},
        (3, 3),
        motions=FOR_FORCE,
        parameter="k",
        told=_beside_the_diagonal,
    ),
    Term("spin_sensitivity", spin_sensitivity, {"accel": 0.2e-3 * G}, (3, 3), parameter="s"),
    _both(angular_acceleration, "c", 1e-4, 0.2e-3 * G, shape=(3, 3), hollow=True),
    Term(
        "scale_factor_g_sensitivity",
        scale_factor_g_sensitivity,
        {"gyro": 3e-4 / G},
        (3, 3),
        motions=ROTATING,
        parameter="P",
    ),
    _both(thermal_scale_factor, "kS", 3.08e-4, 2e-4),
    _both(thermal_misalignment, "mT", 1e-4, 1e-4, shape=(3, 3), hollow=True),
    Term("bias_asymmetry", bias_asymmetry, {"accel": 5e-3 * G}, motions=FOR_FORCE, parameter="ba"),
)
