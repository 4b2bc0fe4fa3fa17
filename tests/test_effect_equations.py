"""Each effect against its equation, written a second time over whole logs in numpy and scipy."""

from math import factorial

import numpy as np
import pytest
from catalogue_cases import CASES, H, excited, motion, own, run
from scipy.signal import lfilter, lfilter_zi

from pyimu.effect import CATALOGUE, Sensor
from pyimu.effects.dynamics import MEMORY
from pyimu.noise import normals

FORCE, TEMPERATURE = slice(3, 6), 6


def lag(x, p, u, w):
    """Sampled poles of the analogue low-pass; zeros from the Taylor series of its gain, at rest in its first input."""
    poles = np.exp(H * np.roots([1, 2 * p["zeta"] * p["wn"], p["wn"] ** 2]))
    a = np.real(np.poly(poles))
    series = np.array([[(-k * H) ** m / factorial(m) for k in range(3)] for m in range(3)])
    g1 = -2 * p["zeta"] / p["wn"]
    gain = np.polynomial.Polynomial([1.0, g1, g1 ** 2 - 1 / p["wn"] ** 2])
    b = np.linalg.solve(series, (np.polynomial.Polynomial(series @ a) * gain).coef[:3])
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
    rounding = 1e-11
    if name == "lag":
        # 1 + a1 + a2 is the square of the angle: what is lost in that difference, no formula has back.
        rounding = 16 * np.finfo(float).eps / (sensor.values[name]["wn"] * H) ** 2
    np.testing.assert_allclose(run(sensor, u, w), want, rtol=rounding, atol=rounding * np.abs(x).max())


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


@pytest.mark.parametrize("zeta", [0.3, 0.7071067811865476, 1.0, 2.0])
@pytest.mark.parametrize("wn", [30.0, 3000.0])
def test_lag_follows_its_transfer_function_to_third_order_in_the_sample_period(wn, zeta):
    """Steady response to 2 Hz against G(j omega): halving the sample period makes the error an eighth.

    A lag far shorter than the sample period is an interpolation between samples, short by its share of the period, and
    its error falls to a quarter.
    """
    w = 2 * np.pi * 2.0
    gain = wn ** 2 / (wn ** 2 - w ** 2 + 2j * zeta * wn * w)

    def error(h):
        t = h * np.arange(round(20.0 / h))
        u = np.zeros((len(t), 7))
        u[:, 0] = np.sin(w * t)
        y = Sensor("gyro", {"lag": {"wn": wn, "zeta": zeta}})
        return np.abs(run(y, u, h=h)[:, 0] - np.imag(gain * np.exp(1j * w * t)))[len(t) // 2:].max()
    coarse, fine = error(0.01), error(0.005)
    assert coarse < (w * 0.01) ** 3
    assert fine < coarse / (6 if wn * 0.01 < 1 else 3)


def test_lag_and_delay_start_in_the_steady_state():
    """A constant motion shows no transient at power-on."""
    u = np.tile([0.1, -0.2, 0.3, 1.0, 2.0, 9.8, 25.0], (50, 1))
    for name in ("lag", "time_delay"):
        np.testing.assert_allclose(run(excited(name, "accel"), u), u[:, 3:6], rtol=1e-13)
