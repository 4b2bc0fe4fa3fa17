"""The estimate before and at the first sample, and the bias that it holds.

A tilt, the accelerometer's bias and its gains start without knowledge of each other. The resting
force is made of them, and so is what is known of it: the first zero velocities tell them together.
"""

from __future__ import annotations

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.filter.layout import (
    BASE,
    GYRO_BIAS,
    POSITION,
    RESTING,
    TURN,
    VELOCITY,
    Layout,
    State,
)
from pyimu.ins.filter.weight import in_world, upright_of
from pyimu.symbolic import quaternion

OF_WHEELS = ("speed_scale_std", "speed_late_std", *["lever_arm_std"] * 2, "crab_std")
"""Parameters that say how far each of ``State.wheels`` may be off."""


def first(layout: Layout, force, settings: Settings) -> State:
    """The estimate at the first sample: level by its ``force`` (3,), at the origin."""
    at = settings.scalar
    fx, fy, fz = ca.vertsplit(force)
    roll, pitch = ca.atan2(fy, fz), ca.atan2(-fx, ca.sqrt(fy * fy + fz * fz))
    roll, pitch = (
        ca.if_else(at["tilt0"] > 0.5, at[name], seen)
        for name, seen in (("roll0", roll), ("pitch0", pitch))
    )
    return _begun(layout, quaternion.from_euler(roll, pitch, at["heading0"]), settings)


def zero(layout: Layout, settings: Settings) -> State:
    """The estimate before the first sample."""
    return _begun(layout, quaternion.from_euler(0, 0, settings.scalar["heading0"]), settings)


def _begun(layout: Layout, q, settings: Settings) -> State:
    """The estimate at the start in an attitude ``q``."""
    at, n = settings.scalar, layout.errors

    def three(name: str) -> list:
        return [at[f"{name}[{i}]"] for i in (1, 2, 3)]

    std = ca.vertcat(
        *[at["tilt_std0"]] * 2,
        at["heading_std0"],
        *[at["velocity_std0"]] * 2,
        at["climb_std0"],
        *[at["position_std0"]] * 3,
        *three("gyro_bias_std0"),
        *three("accel_bias_std0"),
        *[gain.std for gain in layout.gains],
        *[layout.mounting_std] * (2 * layout.nhc),
        *[at[name] for name in OF_WHEELS * layout.wheels],
        *[at["position_lasting_std"] for _ in range(3 * layout.lasting)],
    )
    none, upright = ca.SX.zeros(3), upright_of(settings)
    gains = ca.SX.zeros(len(layout.gains))
    axes = quaternion.to_matrix(q)
    resting = axes.T @ upright
    spread = ca.SX.eye(n)
    spread[GYRO_BIAS, GYRO_BIAS] = axes
    spread[RESTING, TURN] = ca.skew(upright)
    spread[RESTING, RESTING] = axes
    spread[RESTING, BASE : BASE + len(layout.gains)] = axes @ layout.slopes("accel", resting)
    velocity, bias = (ca.vertcat(*three(name)) for name in ("velocity0", "gyro_bias0"))
    # v + e + phi x v is known to velocity_std0, not e
    spread[VELOCITY, TURN] = ca.skew(velocity)
    if layout.lasting:
        # the first position is the origin, which is off by its error
        spread[POSITION, layout.of_positions] = -ca.SX.eye(3)
    covariance = spread @ ca.diag(std**2) @ spread.T
    more = [ca.SX.zeros(n) for n in (2 * layout.nhc, 5 * layout.wheels, 3 * layout.lasting)]
    known = (q, velocity, none, bias, resting, gains, *more, none)
    return State(*known, ca.densify(covariance))


def bias_of(layout: Layout, x: State, settings: Settings) -> tuple:
    """The accelerometer's bias (3,) and its covariance (3, 3), in body axes."""
    axes, upright = quaternion.to_matrix(x.q), upright_of(settings)
    weight = axes.T @ upright
    bias = x.resting - weight - layout.matrix(x.gains, "accel") @ weight
    slope = ca.SX(3, layout.errors)
    slope[:, TURN] = -axes.T @ in_world(layout, x, axes) @ ca.skew(upright)
    slope[:, RESTING] = axes.T
    slope[:, BASE : BASE + len(layout.gains)] = -layout.slopes("accel", weight)
    return bias, slope @ x.covariance @ slope.T
