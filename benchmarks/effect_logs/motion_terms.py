"""Effects of the motion and of the time at which it is sampled, in the order in which they act."""

from __future__ import annotations

import numpy as np
from scipy.signal import cont2discrete, lfilter, lfilter_zi

from effect_logs.scene import HZ, Scene
from effect_logs.term import BOTH, SHAKEN, Case, Term

FINER = 4
"""Times as many samples as the log has, for what filters the motion."""


def size_effect(x, case: Case):
    """Element i at r_i: e_i . (a x r_i + w x (w x r_i)) beside the force (rigid body)."""
    w, a = case.scene.rate, case.scene.slope("gyro")
    felt = [np.cross(a, r) + np.cross(w, np.cross(w, r)) for r in case.c]
    return x + np.column_stack([felt[i][:, i] for i in range(3)])


def earth_rate(x, case: Case):
    return x + case.c * case.scene.earth


def transport_rate(x, case: Case):
    return x + case.c * case.scene.transport


def coning(x, case: Case):
    return x - case.c * case.scene.h**2 / 12 * np.cross(x, case.scene.slope("gyro"))


def sculling(x, case: Case):
    s = case.scene
    turned = np.cross(s.slope("gyro"), x) + np.cross(s.slope("accel"), s.rate)
    return x + case.c * s.h**2 / 12 * turned


def _of_the_motion(x, case: Case, shown: np.ndarray):
    """The input with the motion replaced by what is ``shown`` of it."""
    return x + shown - case.scene.own(case.kind)


def _filtered(scene: Scene, kind: str, over, under) -> np.ndarray:
    """The motion through the transfer function ``over / under`` of s, held linear between samples
    four times as close as the log's.
    """
    before = 400
    at = scene.time[0] + np.arange(-before, FINER * len(scene.time)) / (FINER * HZ)
    b, a, _ = cont2discrete((over, under), 1 / (FINER * HZ), "foh")
    b, u = np.squeeze(b), scene.own(kind, at)
    start = lfilter_zi(b, a)[:, None] * u[0]
    return lfilter(b, a, u, axis=0, zi=start)[0][before::FINER]


def lag(x, case: Case):
    """Second order: wn^2 / (s^2 + 2 zeta wn s + wn^2), wn = 1 / c."""
    wn, zeta = 1 / case.c, case.form["zeta"]
    return _of_the_motion(
        x, case, _filtered(case.scene, case.kind, [wn**2], [1, 2 * zeta * wn, wn**2])
    )


def first_order_lag(x, case: Case):
    """A single pole: 1 / (c s + 1)."""
    return _of_the_motion(x, case, _filtered(case.scene, case.kind, [1.0], [case.c, 1.0]))


def time_delay(x, case: Case):
    s = case.scene
    return _of_the_motion(x, case, s.own(case.kind, s.time - case.c))


def clock_skew(x, case: Case):
    s = case.scene
    return _of_the_motion(x, case, s.own(case.kind, s.time * (1 + case.c)))


def _damping(rng, scene):
    return {"zeta": float(rng.choice([0.5, 0.7071067811865476, 1.0]))}


PLACE = ("ref_q", "latitude", "ref_velocity")

TERMS = (
    Term("size_effect", size_effect, {"accel": 2e-3}, (3, 3), parameter="r"),
    Term("earth_rate", earth_rate, {"gyro": 1.0}, (), known=True, needs=PLACE, parameter="k"),
    Term(
        "transport_rate", transport_rate, {"gyro": 1.0}, (), known=True, needs=PLACE, parameter="k"
    ),
    Term("coning", coning, {"gyro": 1.0}, (), known=True, motions=("tumble",), parameter="c"),
    Term("sculling", sculling, {"accel": 1.0}, (), known=True, motions=SHAKEN, parameter="c"),
    Term(
        "lag",
        lag,
        {"gyro": 1 / 264, "accel": 1 / 276},
        (),
        signed=False,
        form=_damping,
        parameter="wn",
        told=lambda c: 1 / c,
    ),
    Term(
        "first_order_lag",
        first_order_lag,
        {"gyro": 3.8e-3, "accel": 3.6e-3},
        (),
        signed=False,
        parameter="tau",
    ),
    Term(
        "time_delay",
        time_delay,
        {"gyro": 4.8e-3, "accel": 4.9e-3},
        (),
        signed=False,
        parameter="td",
    ),
    Term("clock_skew", clock_skew, dict.fromkeys(BOTH, 1e-4), (), signed=False, parameter="eps"),
)
