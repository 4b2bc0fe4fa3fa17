"""Effects on the bias, in the order in which they act."""

from __future__ import annotations

import numpy as np
from scipy.signal import lfilter

from effect_logs.scene import T0, V0
from effect_logs.term import SHAKEN, Case, Term

DEG, G, HOUR = np.deg2rad(1.0), 9.80665, 3600.0


def g_sensitivity(x, case: Case):
    return x + case.scene.force @ case.c.T


def g2_sensitivity(x, case: Case):
    f, g, h = case.scene.force.T
    return x + np.column_stack([f**2, g**2, h**2, g * h, h * f, f * g]) @ case.c.T


def vibration_rectification(x, case: Case):
    """By the mean square, over about a second, of what is faster than that."""
    force = case.scene.force
    share = -np.expm1(-case.scene.h)
    taps = [share], [1, share - 1]
    mean = lfilter(*taps, force, axis=0, zi=(1 - share) * force[:1])[0]
    square = lfilter(*taps, (force - mean) ** 2, axis=0)
    return x + square @ case.c.T


def _power(degree: int):
    def apply(x, case: Case):
        return x + (case.scene.warmth - T0)[:, None] ** degree * case.c

    return apply


def temperature_rate(x, case: Case):
    slope = np.gradient(case.scene.warmth, case.scene.h)
    return x + slope[:, None] * case.c


def thermal_hysteresis(x, case: Case):
    """kh (play - T): the play follows the temperature by its half width behind."""
    warmth, width = case.scene.warmth, case.form["width"]
    play, at = np.empty_like(warmth), warmth[0]
    for k, t in enumerate(warmth.tolist()):
        at = max(t - width, min(t + width, at))
        play[k] = at
    return x + (play - warmth)[:, None] * case.c


def warm_up(x, case: Case):
    return x + np.exp(-case.scene.time / case.form["tau"])[:, None] * case.c


def rate_ramp(x, case: Case):
    return x + case.scene.time[:, None] * case.c


def bias_step(x, case: Case):
    return x + (case.scene.time >= case.form["t0"])[:, None] * case.c


def ageing(x, case: Case):
    """(a + t)(kb + ks x), a = 0; ks is as large against x as kb is against a typical bias."""
    return x + case.scene.time[:, None] * (case.c + case.form["ks"] * case.c * x)


def supply_sensitivity(x, case: Case):
    return x + (case.scene.supply - V0)[:, None] * case.c


def magnetic_sensitivity(x, case: Case):
    return x + case.scene.mag @ case.c.T


def vibration_line(x, case: Case):
    phase = 2 * np.pi * case.form["f0"] * case.scene.time + case.form["phase"]
    return x + np.sin(phase)[:, None] * case.c


def _during(low: float, high: float, name: str):
    """A time drawn between shares of the log's length."""

    def form(rng, scene):
        return {name: float(rng.uniform(low, high) * scene.time[-1])}

    return form


def _width(rng, scene):
    return {"width": float(rng.uniform(0.5, 2.0))}


def _line(rng, scene):
    return {"f0": float(rng.uniform(3.0, 47.0)), "phase": float(rng.uniform(0, 2 * np.pi))}


def _ageing(rng, scene):
    return {"ks": float(rng.choice([0.0, 3.0]))}


def _two(name, apply, parameter, gyro, accel, **more) -> Term:
    return Term(name, apply, {"gyro": gyro, "accel": accel}, parameter=parameter, **more)


THERMAL = ("table", "tumble", "rover", "thermal_cycle")
SLOW = {"motions": THERMAL, "slow": True}

TERMS = (
    Term("g_sensitivity", g_sensitivity, {"gyro": 0.1 * DEG / G}, (3, 3), parameter="G"),
    Term(
        "g2_sensitivity",
        g2_sensitivity,
        {"gyro": 36 * DEG / HOUR / G**2},
        (3, 6),
        motions=SHAKEN,
        parameter="Q",
    ),
    _two(
        "vibration_rectification",
        vibration_rectification,
        "V",
        36 * DEG / HOUR / G**2,
        1.78e-3 / G,
        shape=(3, 3),
        motions=SHAKEN,
    ),
    _two("thermal_bias", _power(1), "kT", 1.15e-4, 0.5e-3 * G, **SLOW),
    _two("thermal_bias_quadratic", _power(2), "k2", 4.89e-7, 0.0173e-3 * G, **SLOW),
    _two("thermal_bias_cubic", _power(3), "k3", 5.38e-8, 0.384e-6 * G, **SLOW),
    _two("temperature_rate", temperature_rate, "kd", 100 * DEG / HOUR * 60, 0.03 * G, **SLOW),
    _two(
        "thermal_hysteresis",
        thermal_hysteresis,
        "kh",
        18 * DEG / HOUR,
        0.5e-3 * G,
        form=_width,
        **SLOW,
    ),
    _two("warm_up", warm_up, "A", 0.2 * DEG, 5e-3 * G, form=_during(0.05, 0.3, "tau"), **SLOW),
    _two("rate_ramp", rate_ramp, "R", 5.59 * DEG / HOUR**2, 0.5e-3 * G / HOUR, slow=True),
    _two(
        "bias_step",
        bias_step,
        "A",
        50 * DEG / HOUR,
        2e-3 * G,
        form=_during(0.1, 0.6, "t0"),
        slow=True,
    ),
    _two(
        "ageing",
        ageing,
        "kb",
        0.0205 * DEG / HOUR**2,
        0.171e-6 * G / HOUR,
        form=_ageing,
        slow=True,
    ),
    _two("supply_sensitivity", supply_sensitivity, "kV", 2 * DEG, 0.1 * G, needs=("supply",)),
    _two(
        "magnetic_sensitivity",
        magnetic_sensitivity,
        "C",
        10 * DEG / HOUR * 1e4,
        1.0 * G,
        shape=(3, 3),
        needs=("mag",),
    ),
    # Its sign is half a turn of the phase, which the catalogue keeps for each axis.
    _two("vibration_line", vibration_line, "A", 0.05 * DEG, 5e-3 * G, form=_line, told=np.abs),
)
