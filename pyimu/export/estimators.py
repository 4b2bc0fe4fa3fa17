"""Files of estimators: Kalibr, OpenVINS, VINS-Fusion, Isaac ROS, ROS 2 and PX4's EKF2."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from pyimu.export.densities import present
from pyimu.export.header import header
from pyimu.model.part import Part

NOISE = {"angle_random_walk", "rate_random_walk", "bias_instability"}
WALKING = NOISE | {"gauss_markov", "second_gauss_markov"}
"""Effects that white noise and random walk stand for."""

EKF2_PERIOD = 0.01
"""s, the step of EKF2's prediction (PX4, EKF2_PREDICT_US, 10000 us by default)."""

EKF2_BOUNDS = {
    "EKF2_GYR_NOISE": (0.0001, 0.1),
    "EKF2_ACC_NOISE": (0.01, 1.0),
    "EKF2_GYR_B_NOISE": (0.0, 0.01),
    "EKF2_ACC_B_NOISE": (0.0, 0.01),
}
"""What PX4's parameter reference allows, in rad/s, m/s^2, rad/s^2 and m/s^3."""


def _figures(part: Part, inflate: float) -> tuple[dict[str, tuple[float, float]], tuple[str, ...]]:
    """N and K, inflated, of the worst axis of each sensor that has any, and where K is from."""
    found = present(part)
    said = tuple(f"{kind} random walk: {d.said}" for kind, d in found.items())
    worst = {kind: (inflate * d.worst[0], inflate * d.worst[1]) for kind, d in found.items()}
    return worst, said


def _lines(entries: Mapping[str, tuple[float | str, str]], indent: str = "") -> str:
    return "".join(
        f"{indent}{key}: {value if isinstance(value, str) else _number(value)}"
        f"{f'  # {comment}' if comment else ''}\n"
        for key, (value, comment) in entries.items()
    )


def _number(value: float) -> str:
    """Six figures, with the point that YAML 1.1 wants in a number with an exponent."""
    text = f"{value:.6g}"
    mantissa, e, exponent = text.partition("e")
    return f"{mantissa if '.' in mantissa else f'{mantissa}.0'}{e}{exponent}"


def _kalibr_entries(part: Part, inflate: float) -> tuple[dict, tuple[str, ...]]:
    figures, said = _figures(part, inflate)
    names = {"accel": ("accelerometer", "m/s"), "gyro": ("gyroscope", "rad/s")}
    entries = {}
    for kind, (name, unit) in names.items():
        if kind in figures:
            per = {"accel": ("^2", "^3"), "gyro": ("", "^2")}[kind]
            for what, value, power in zip(
                ("noise_density", "random_walk"), figures[kind], per, strict=True
            ):
                entries[f"{name}_{what}"] = (value, f"{unit}{power}/sqrt(Hz)")
    return entries, said


def kalibr(part: Part, inflate: float) -> str:
    """``imu.yaml`` of Kalibr (wiki, YAML formats).

    Its densities are such that a sample has the standard deviation density / sqrt(period) (wiki,
    IMU noise model), which is the root of a two-sided density: N itself.
    """
    entries, said = _kalibr_entries(part, inflate)
    rest = {"rostopic": ("/imu0", ""), "update_rate": (part.sample_rate, "Hz")}
    return header(part, WALKING, said) + _lines({**entries, **rest})


def openvins(part: Part, inflate: float) -> str:
    """``kalibr_imu_chain.yaml`` of OpenVINS (config/euroc_mav), intrinsics at the identity.

    It reads the same four figures as Kalibr (OpenVINS' docs, sensor calibration).
    """
    entries, said = _kalibr_entries(part, inflate)
    square = [[1.0 if i == j else 0.0 for j in range(3)] for i in range(3)]
    pose = [[1.0 if i == j else 0.0 for j in range(4)] for i in range(4)]
    rest = {
        "rostopic": ("/imu0", ""),
        "time_offset": (0.0, "s"),
        "update_rate": (part.sample_rate, "Hz"),
        "model": ('"kalibr"', ""),
    }
    matrices = {"Tw": square, "R_IMUtoGYRO": square, "Ta": square, "R_IMUtoACC": square}
    zeros = {"Tg": [[0.0] * 3] * 3}
    return (
        "%YAML:1.0\n\n"
        + header(part, WALKING, said)
        + "imu0:\n"
        + _matrix("T_i_b", pose)
        + _lines({**entries, **rest}, "  ")
        + "".join(_matrix(name, rows) for name, rows in {**matrices, **zeros}.items())
    )


def _matrix(name: str, rows: list[list[float]]) -> str:
    return f"  {name}:\n" + "".join(f"    - [{', '.join(map(str, row))}]\n" for row in rows)


def vins(part: Part, inflate: float) -> str:
    """The IMU's part of a configuration of VINS-Fusion.

    Its pre-integration adds acc_n^2 dt^2 a sample to the velocity (integration_base.h,
    midPointIntegration): acc_n is the standard deviation of a sample, N / sqrt(dt), and acc_w so
    that the bias takes steps of acc_w dt, K / sqrt(dt).
    """
    figures, said = _figures(part, inflate)
    (n_g, k_g), (n_a, k_a) = figures["gyro"], figures["accel"]
    root = math.sqrt(part.sample_rate)
    entries = {
        "imu": ("1", ""),
        "imu_topic": ('"/imu0"', ""),
        "acc_n": (n_a * root, "m/s^2, of a sample"),
        "gyr_n": (n_g * root, "rad/s, of a sample"),
        "acc_w": (k_a * root, "m/s^3, at the sample rate"),
        "gyr_w": (k_g * root, "rad/s^2, at the sample rate"),
        "g_norm": (9.80665, "m/s^2; put that of your place"),
    }
    rate = (f"the figures are those of {part.sample_rate:g} Hz",)
    return "%YAML:1.0\n---\n" + header(part, WALKING, said + rate) + _lines(entries)


def isaac(part: Part, inflate: float) -> str:
    """Parameters of Isaac ROS' visual SLAM node, continuous densities as Kalibr's."""
    figures, said = _figures(part, inflate)
    entries: dict[str, tuple[float | str, str]] = {"enable_imu_fusion": ("true", "")}
    for kind, units in (("gyro", ("rad/s", "rad/s^2")), ("accel", ("m/s^2", "m/s^3"))):
        if kind in figures:
            n, k = figures[kind]
            entries[f"{kind}_noise_density"] = (n, f"{units[0]}/sqrt(Hz)")
            entries[f"{kind}_random_walk"] = (k, f"{units[1]}/sqrt(Hz)")
    entries["calibration_frequency"] = (part.sample_rate, "Hz")
    head = header(part, WALKING, said)
    return f"{head}visual_slam_node:\n  ros__parameters:\n{_lines(entries, '    ')}"


def ros2(part: Part, inflate: float) -> str:
    """The covariances of ``sensor_msgs/Imu`` (REP 145): those of a sample, row by row.

    The variance of a sample is N^2 times the sample rate; that of a sensor whose noise the part
    does not have is zeros, which the message calls unknown.
    """
    entries, found = {}, present(part)
    for kind, name in (("gyro", "angular_velocity"), ("accel", "linear_acceleration")):
        N = found[kind].N if kind in found else np.zeros(3)
        variance = np.square(inflate * N) * part.sample_rate
        cells = [_number(v) for v in np.diag(variance).ravel()]
        unit = {"gyro": "(rad/s)^2", "accel": "(m/s^2)^2"}[kind]
        unit = unit if kind in found else "unknown"
        entries[f"{name}_covariance"] = (f"[{', '.join(cells)}]", unit)
    entries["orientation_covariance"] = ("[-1.0" + ", 0.0" * 8 + "]", "no orientation")
    head = header(part, {"angle_random_walk"})
    return f"{head}/**:\n  ros__parameters:\n{_lines(entries, '    ')}"


def px4(part: Part, inflate: float) -> str:
    """Parameters of PX4's EKF2 as QGroundControl loads them: vehicle, component, name, value, type.

    EKF2 takes the noise of a prediction's rate and the steps dt * b_noise of the bias, at
    ``EKF2_PERIOD``: N / sqrt(dt) and K / sqrt(dt). What lies beyond PX4's bounds is set to them.
    """
    figures, said = _figures(part, inflate)
    root = 1 / math.sqrt(EKF2_PERIOD)
    short = {kind: name for kind, name in (("gyro", "GYR"), ("accel", "ACC")) if kind in figures}
    wanted = {f"EKF2_{name}_NOISE": figures[kind][0] * root for kind, name in short.items()}
    wanted |= {f"EKF2_{name}_B_NOISE": figures[kind][1] * root for kind, name in short.items()}
    clipped = {n: float(np.clip(v, *EKF2_BOUNDS[n])) for n, v in wanted.items()}
    moved = tuple(
        f"{n}: {wanted[n]:.3g} lies beyond PX4's bounds" for n in wanted if clipped[n] != wanted[n]
    )
    note = (
        "EKF2's defaults (0.015, 0.35, 0.001, 0.003) allow for a vehicle's vibration; these do not"
    )
    rows = "".join(f"1\t1\t{name}\t{_number(value)}\t9\n" for name, value in clipped.items())
    return header(part, WALKING, (*said, *moved, note)) + rows
