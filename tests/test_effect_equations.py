"""Each effect against its equation, written a second time over whole logs in numpy and scipy."""

import numpy as np
import pytest
from catalogue_cases import CASES, H, excited, motion, own, run
from scipy.signal import bilinear, lfilter, lfilter_zi

from pyimu.effect import CATALOGUE, Sensor
from pyimu.effects.dynamics import MEMORY
from pyimu.noise import normals

FORCE, TEMPERATURE = slice(3, 6), 6


def lag(x, p, u, w):
    """The analogue low-pass through scipy's bilinear transform, at rest in its first input."""
    b, a = bilinear([p["wn"] ** 2], [1, 2 * p["zeta"] * p["wn"], p["wn"] ** 2], 1 / H)
    return lfilter(b, a, x, axis=0, zi=lfilter_zi(b, a)[:, None] * x[0])[0]


def time_delay(x, p, u, w):
    """The cubic through four samples by numpy's polynomial fit; before the log the first sample."""
    held = np.vstack([np.repeat(x[:1], MEMORY + 3, axis=0), x])
    steps = min(p["td"] / H, MEMORY - 2)
    first = max(int(steps) - 1, 0)
    nodes = np.arange(first, first + 4)
    cubic = np.polyfit(nodes, np.eye(4), 3)
    weights = np.array([np.polyval(cubic[:, j], steps) for j in range(4)])
    newest = len(held) - len(x)
    return sum(c * held[newest - j:len(held) - j] for c, j in zip(weights, nodes))


EQUATIONS = {
    "lag": lag,
    "time_delay": time_delay,
    "scale_factor": lambda x, p, u, w: x * (1 + p["s"]),
    "scale_factor_asymmetry": lambda x, p, u, w: np.where(x > 0, x * (1 + p["sa"]), x * (1 - p["sa"])),
    "misalignment": lambda x, p, u, w: x + np.einsum("ij,kj->ki", p["m"], x),
    "turn_on_bias": lambda x, p, u, w: x + p["b0"],
    "thermal_bias": lambda x, p, u, w: x + np.outer(u[:, TEMPERATURE] - p["T0"], p["kT"]),
    "thermal_bias_quadratic": lambda x, p, u, w: x + np.outer(np.square(u[:, TEMPERATURE] - p["T0"]), p["k2"]),
    "g_sensitivity": lambda x, p, u, w: x + np.einsum("ij,kj->ki", p["G"], u[:, FORCE]),
    "angle_random_walk": lambda x, p, u, w: x + p["N"] * w / np.sqrt(H),
    "rate_random_walk": lambda x, p, u, w: x + np.vstack([np.zeros(3), np.cumsum(p["K"] * np.sqrt(H) * w, 0)[:-1]]),
    "saturation": lambda x, p, u, w: np.clip(x, -p["limit"], p["limit"]),
    "quantization": lambda x, p, u, w: p["q"] * np.rint(x / p["q"]),
}


@pytest.mark.parametrize("name, kind", CASES)
def test_effect_keeps_its_equation(name, kind):
    assert name in EQUATIONS, f"write the equation of {name} into EQUATIONS, in numpy"
    sensor, u = excited(name, kind, 0.5 if name == "saturation" else 0.05), motion(400)
    w = normals(5, [c.number for c in sensor.noise], 1, 400)
    x = u[:, own(kind)]
    want = EQUATIONS[name](x, sensor.values[name], u, w)
    assert np.all(np.abs(want - x).max(0) > 1e-3 * np.abs(x).max()), "the motion does not excite the effect"
    np.testing.assert_allclose(run(sensor, u, w), want, rtol=1e-11, atol=1e-11 * np.abs(x).max())


def test_every_equation_belongs_to_an_effect():
    assert set(EQUATIONS) == set(CATALOGUE)


@pytest.mark.parametrize("steps", [0.0, 0.3, 1.0, 1.7, 2.5, 17.25, MEMORY - 2])
def test_time_delay_is_the_shifted_sinusoid_within_the_bound_of_the_cubic(steps):
    """|error| <= max |x''''| h^4 / 24 max |product of the distances to the four nodes|."""
    omega, t = 2 * np.pi * np.array([1.0, 3.0, 8.0]), H * np.arange(500)[:, None]
    u = np.zeros((500, 7))
    u[:, :3] = np.sin(omega * t + 0.4)
    y = run(Sensor("gyro", {"time_delay": {"td": steps * H}}), u)
    first = max(int(steps) - 1, 0)
    distances = abs(np.prod(steps - np.arange(first, first + 4)))
    bound = (omega * H) ** 4 / 24 * distances
    # The argument omega t of the sine is rounded in the effect's input and again in the truth.
    rounding = 4 * np.finfo(float).eps * omega * t[-1]
    late = MEMORY + 3
    error = np.abs(y - np.sin(omega * (t - steps * H) + 0.4))[late:].max(0)
    assert np.all(error <= bound + rounding)
    # The bound is reached to a good part, or it would prove nothing.
    assert np.all(error >= 0.5 * bound - rounding)


def test_time_delay_reaches_back_as_far_as_it_remembers():
    longest, longer = (Sensor("gyro", {"time_delay": {"td": s * H}}) for s in (MEMORY - 2, MEMORY + 5))
    np.testing.assert_array_equal(run(longer, motion(100)), run(longest, motion(100)))


@pytest.mark.parametrize("zeta", [0.3, 0.7071067811865476, 2.0])
def test_lag_has_the_gain_and_phase_of_its_transfer_function(zeta):
    """Response to a sinusoid in the steady state, at the frequency that the trapezoidal rule warps onto omega."""
    wn, w = 30.0, 2 * np.pi * 4.0
    t = H * np.arange(3000)
    u = np.zeros((3000, 7))
    u[:, 0] = np.sin(w * t)
    y = run(Sensor("gyro", {"lag": {"wn": wn, "zeta": zeta}}), u)[2000:, 0]
    s = 2j / H * np.tan(w * H / 2)
    gain = wn ** 2 / (s ** 2 + 2 * zeta * wn * s + wn ** 2)
    np.testing.assert_allclose(y, np.imag(gain * np.exp(1j * w * t[2000:])), atol=1e-12)


def test_lag_and_delay_start_in_the_steady_state():
    """A constant motion shows no transient at power-on."""
    u = np.tile([0.1, -0.2, 0.3, 1.0, 2.0, 9.8, 25.0], (50, 1))
    for name in ("lag", "time_delay"):
        np.testing.assert_allclose(run(excited(name, "accel"), u), u[:, 3:6], rtol=1e-13)
