"""Files of simulators: Gazebo's SDF and MATLAB's imuSensor."""

from __future__ import annotations

import math
from xml.sax.saxutils import escape

import numpy as np

from pyimu.export.densities import Densities, present
from pyimu.export.header import header
from pyimu.model.part import AXES, Part
from pyimu.shaping import flicker_floor

WALK_TIME = 3600.0
"""s, the correlation time that stands for a random walk, which Gazebo has not: within a simulation
of minutes the two are alike."""

TRIADS = {"gyro": "angular_velocity", "accel": "linear_acceleration"}


def gazebo(part: Part, inflate: float) -> str:
    """A sensor of SDF 1.9 for Gazebo (sdformat, noise of an imu).

    A sample has the standard deviation N sqrt(rate). ``dynamic_bias_stddev`` drives the bias:
    Gazebo's steps have the variance sigma^2 tau / 2 (1 - exp(-2 dt / tau)), which for a long tau is
    sigma^2 dt, so that sigma is K. ``bias_mean`` has a random sign there, so that a bias that was
    measured stands in ``mean``; ``bias_stddev`` is the part's tolerance.
    """
    found = present(part)
    blocks = "".join(
        f"      <{tag}>\n{''.join(_axis(part, found[kind], i, inflate) for i in range(3))}"
        f"      </{tag}>\n"
        for kind, tag in TRIADS.items()
        if kind in found
    )
    kept = {"angle_random_walk", "rate_random_walk", "bias_instability", "turn_on_bias"}
    words = header(part, kept | {"gauss_markov", "quantization"}, mark="   ").rstrip("\n")
    comment = escape(words).replace("--", "- -")
    return (
        f'<?xml version="1.0"?>\n<sdf version="1.9">\n  <!--\n{comment}\n  -->\n'
        f'  <sensor name="{escape(part.name)}" type="imu">\n'
        f"    <always_on>true</always_on>\n    <update_rate>{part.sample_rate:.10g}</update_rate>\n"
        f"    <imu>\n{blocks}    </imu>\n  </sensor>\n</sdf>\n"
    )


def _axis(part: Part, d: Densities, i: int, inflate: float) -> str:
    kind, values = d.kind, part.sensor(d.kind).values
    q = float(values.get("quantization", {}).get("q", np.zeros(3))[i])
    bias = float(values.get("turn_on_bias", {}).get("b0", np.zeros(3))[i])
    markov = values.get("gauss_markov")
    tau = float(markov["tau"][i]) if markov and "rate_random_walk" not in values else WALK_TIME
    noise = {
        "mean": bias,
        "stddev": inflate * d.N[i] * math.sqrt(part.sample_rate),
        "bias_mean": 0.0,
        "bias_stddev": _tolerance(part, kind, i),
        "dynamic_bias_stddev": inflate * d.K[i],
        "dynamic_bias_correlation_time": tau,
        **({"precision": q} if q else {}),
    }
    inner = "".join(f"            <{n}>{v:.8g}</{n}>\n" for n, v in noise.items())
    form = "gaussian_quantized" if q else "gaussian"
    return (
        f'        <{AXES[i]}>\n          <noise type="{form}">\n{inner}          </noise>\n'
        f"        </{AXES[i]}>\n"
    )


def _tolerance(part: Part, kind: str, i: int) -> float:
    """The standard deviation of the bias over specimens; a uniform one has size / sqrt(3)."""
    for t in part.tolerances:
        if t.key == (kind, "turn_on_bias", "b0"):
            return float(t.array[i]) / (math.sqrt(3) if t.distribution == "uniform" else 1.0)
    return 0.0


def matlab(part: Part, inflate: float) -> str:
    """A script that makes MATLAB's ``imuSensor`` (Navigation Toolbox, gyroparams and accelparams).

    A sample's noise is NoiseDensity sqrt(SampleRate / 2) there: the root of a one-sided density,
    sqrt(2) N. RandomWalk is K and BiasInstability B as read off an Allan deviation, as in its
    example of the Allan variance. AxesMisalignment and scale factors over temperature are in
    percent.
    """
    kept = {
        "angle_random_walk",
        "rate_random_walk",
        "bias_instability",
        "turn_on_bias",
        "saturation",
        "quantization",
        "thermal_bias",
        "thermal_scale_factor",
        "g_sensitivity",
        "misalignment",
    }
    lines = [
        "% for imuSensor of the Navigation Toolbox, and of the Sensor Fusion and Tracking Toolbox",
        f"imu = imuSensor('accel-gyro', 'SampleRate', {part.sample_rate:.10g});",
    ]
    names = {"gyro": "Gyroscope = gyroparams", "accel": "Accelerometer = accelparams"}
    lines += [
        f"imu.{names[d.kind]}({_parameters(part, d, inflate)});" for d in present(part).values()
    ]
    return header(part, kept, mark="%") + "\n".join(lines) + "\n"


def _parameters(part: Part, d: Densities, inflate: float) -> str:
    kind, values = d.kind, part.sensor(d.kind).values
    si = {"gyro": "rad/s", "accel": "m/s^2"}[kind]
    found = {"NoiseDensity": math.sqrt(2) * inflate * d.N}

    def take(name: str, effect: str, parameter: str, factor: float = 1.0) -> None:
        value = values.get(effect, {}).get(parameter)
        if value is not None and np.any(value):
            found[name] = factor * value

    take("MeasurementRange", "saturation", "limit")
    take("Resolution", "quantization", "q")
    take("ConstantBias", "turn_on_bias", "b0")
    take("BiasInstability", "bias_instability", "B", flicker_floor(1.0))
    take("RandomWalk", "rate_random_walk", "K")
    take("TemperatureBias", "thermal_bias", "kT")
    take("TemperatureScaleFactor", "thermal_scale_factor", "kS", 100.0)
    m = values.get("misalignment", {}).get("m")
    if m is not None and np.any(m):
        found["AxesMisalignment"] = 100 * (np.eye(3) + m)
    G = values.get("g_sensitivity", {}).get("G")
    if G is not None and np.any(G):
        found["AccelerationBias"] = np.diag(G)
    for name in ("MeasurementRange", "Resolution"):  # one figure for all axes
        if name in found:
            found[name] = np.max(found[name])
    written = [f"'{name}', {_matlab(value)}" for name, value in found.items()]
    return f" ...  % {si}\n    " + ", ...\n    ".join(written)


def _matlab(value: np.ndarray | float) -> str:
    array = np.asarray(value)
    if array.ndim == 2:
        return "[" + "; ".join(" ".join(f"{v:.8g}" for v in row) for row in array) + "]"
    if array.ndim == 1:
        return "[" + " ".join(f"{v:.8g}" for v in array) + "]"
    return f"{float(array):.8g}"
