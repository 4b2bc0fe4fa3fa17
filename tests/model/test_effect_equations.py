"""Each effect against its equation, written a second time over whole logs in numpy and scipy."""

from math import factorial

import numpy as np
import pytest
from built import built
from catalogue_cases import (
    CASES,
    H,
    as_part,
    everything,
    excited,
    inputs,
    motion,
    outputs,
    own,
    run,
)
from scipy.signal import lfilter, lfilter_zi
from scipy.spatial.transform import Rotation

from pyimu.block.normals import normals
from pyimu.fmu import simulate
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects.dynamics import MEMORY
from pyimu.model.kinds import KINDS
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, N_INPUT

ROUNDING = 1e-11
"""Relative; the sums of a few hundred samples in another order."""


class Motion:
    """The signals of a motion as the test made them, and those that follow from them, each (n,
    columns), in plain numpy.
    """

    def __init__(self, u):
        self.u, self.n = u, len(u)

    def __getattr__(self, name):
        return self.u[:, COLUMNS[name]]

    @staticmethod
    def slope(v):
        return np.diff(v, axis=0, prepend=v[:1]) / H

    @property
    def t(self):
        return H * np.arange(1, self.n + 1)[:, None]

    @property
    def vibration(self):
        """Exponential means with a time constant of one second, the first from the first sample,
        the second from zero.
        """
        a = 1 - np.exp(-H)
        mean = lfilter(
            [a], [1, a - 1], self.specific_force, axis=0, zi=(1 - a) * self.specific_force[:1]
        )[0]
        return lfilter([a], [1, a - 1], (self.specific_force - mean) ** 2, axis=0)

    @property
    def world_to_body(self):
        return Rotation.from_quat(self.attitude, scalar_first=True).inv()


def lag(x, p, u, w):
    """Sampled poles of the analogue low-pass; zeros from the Taylor series of its gain, at rest in
    its first input.
    """
    poles = np.exp(H * np.roots([1, 2 * p["zeta"] * p["wn"], p["wn"] ** 2]))
    a = np.real(np.poly(poles))
    series = np.array([[(-k * H) ** m / factorial(m) for k in range(3)] for m in range(3)])
    g1 = -2 * p["zeta"] / p["wn"]
    gain = np.polynomial.Polynomial([1.0, g1, g1**2 - 1 / p["wn"] ** 2])
    b = np.linalg.solve(series, (np.polynomial.Polynomial(series @ a) * gain).coef[:3])
    return lfilter(b, a, x, axis=0, zi=lfilter_zi(b, a)[:, None] * x[0])[0]


def first_order_lag(x, p, m, w):
    """dy/dt = (x - y) / tau, the slope that of the cubic through the last four outputs."""
    cubic, nodes = np.polynomial.Polynomial.fit, np.arange(-3, 1)
    slope = np.array([cubic(nodes, unit, 3).deriv()(0.0) for unit in np.eye(4)]) * p["tau"] / H
    out = [x[0]] * 3
    for now in x:
        out.append((now - slope[:3] @ np.array(out[-3:])) / (1 + slope[3]))
    return np.array(out[3:])


def time_delay(x, p, u, w):
    """The cubic through four samples by numpy's polynomial fit; before the log the first sample."""
    held = np.vstack([np.repeat(x[:1], MEMORY + 3, axis=0), x])
    steps = min(p["td"] / H, MEMORY - 2)
    first = max(int(steps) - 1, 0)
    nodes = np.arange(first, first + 4)
    cubic = np.polyfit(nodes, np.eye(4), 3)
    weights = np.array([np.polyval(cubic[:, j], steps) for j in range(4)])
    newest = len(held) - len(x)
    return sum(c * held[newest - j : len(held) - j] for c, j in zip(weights, nodes))


def size_effect(x, p, m, w):
    """Element by element: e_i . (a x r_i + w x (w x r_i))."""
    rate, acceleration, y = m.rate, m.slope(m.rate), np.array(x)
    for i, arm in enumerate(p["r"]):
        y[:, i] += (np.cross(acceleration, arm) + np.cross(rate, np.cross(rate, arm)))[:, i]
    return y


def earth_rate(x, p, m, w):
    """Expressed in north-west-up as the paper prints it, turned into east-north-up."""
    lat = m.latitude[:, 0]
    nwu = 7.292115e-5 * np.column_stack([np.cos(lat), np.zeros_like(lat), np.sin(lat)])
    enu = nwu @ np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).T
    return x + p["k"] * m.world_to_body.apply(enu)


def transport_rate(x, p, m, w):
    """East-north-up turns about up by the change of longitude times sin(latitude), about west-east
    by that of latitude.
    """
    lat, v, radius = m.latitude[:, 0], m.velocity, 6371008.8
    dlon, dlat = v[:, 0] / (radius * np.cos(lat)), v[:, 1] / radius
    enu = np.column_stack([-dlat, dlon * np.cos(lat), dlon * np.sin(lat)])
    return x + p["k"] * m.world_to_body.apply(enu)


def before(v):
    return np.vstack([v[:1], v[:-1]])


def thermal_hysteresis(x, p, m, w):
    """The play operator, sample by sample: dragged along once the temperature has run ahead by the
    half width.
    """
    temperature, played = m.temperature[:, 0], []
    at = temperature[0]
    for now in temperature:
        at = min(max(at, now - p["width"]), now + p["width"])
        played.append(at)
    return x + np.outer(np.array(played) - temperature, p["kh"])


def stationary(phi, deviation, w):
    """First-order process of this stationary deviation, its first value a draw of it."""
    b = np.empty_like(w)
    b[0] = deviation * w[0]
    for k in range(1, len(w)):
        b[k] = phi * b[k - 1] + deviation * np.sqrt(1 - phi**2) * w[k]
    return b


def gauss_markov(x, p, m, w):
    return x + stationary(np.exp(-H / p["tau"]), p["q"] * np.sqrt(p["tau"] / 2), w)


def bias_instability(x, p, m, w):
    """Six processes from f_low to f_high; each adds s^2 / (pi f_k) / (1 + (f / f_k)^2) to the
    density.
    """
    corners = np.geomspace(p["f_low"], p["f_high"], 6)
    spacing = np.log(corners[1] / corners[0])
    end = 0.535 + 1.363 / spacing
    weight = np.array([end, 1, 1, 1, 1, end]) * spacing / np.pi
    return x + sum(
        stationary(np.exp(-2 * np.pi * f * H), p["B"] * np.sqrt(c), w[:, 3 * k : 3 * k + 3])
        for k, (f, c) in enumerate(zip(corners, weight))
    )


def angle_quantization(x, p, m, w):
    """Differences of the rounded angle."""
    angle = np.vstack([np.zeros(3), np.cumsum(x * H, axis=0)])
    return np.diff(p["q"] * np.floor(angle / p["q"] + 0.5), axis=0) / H


def products(f):
    return np.column_stack(
        [
            f[:, 0] ** 2,
            f[:, 1] ** 2,
            f[:, 2] ** 2,
            f[:, 1] * f[:, 2],
            f[:, 2] * f[:, 0],
            f[:, 0] * f[:, 1],
        ]
    )


EQUATIONS = {
    "size_effect": size_effect,
    "earth_rate": earth_rate,
    "transport_rate": transport_rate,
    "coning": lambda x, p, m, w: x - p["c"] * H / 12 * np.cross(before(x), x),
    "sculling": lambda x, p, m, w: (
        x - p["c"] * H / 12 * (np.cross(before(m.rate), x) + np.cross(before(x), m.rate))
    ),
    "lag": lag,
    "first_order_lag": first_order_lag,
    "time_delay": time_delay,
    "scale_factor": lambda x, p, m, w: x * (1 + p["s"]),
    "scale_factor_asymmetry": lambda x, p, m, w: np.where(
        x > 0, x * (1 + p["sa"]), x * (1 - p["sa"])
    ),
    "scale_factor_nonlinearity": lambda x, p, m, w: x * (1 + p["s2"] * x),
    "scale_factor_cubic": lambda x, p, m, w: x * (1 + p["s3"] * x * x),
    "misalignment": lambda x, p, m, w: x + np.einsum("ij,kj->ki", p["m"], x),
    "anisoinertia": lambda x, p, m, w: x + p["c"] * np.roll(x, -1, 1) * np.roll(x, 1, 1),
    "vibropendulous": lambda x, p, m, w: x + np.einsum("ij,ki,kj->ki", p["kp"], x, x),
    "cross_axis_nonlinearity": lambda x, p, m, w: (
        x + np.square(x) @ p["k"].T + p["kx"] * np.prod(x, 1, keepdims=True) / x
    ),
    "spin_sensitivity": lambda x, p, m, w: x + np.einsum("ij,ki,kj->ki", p["s"], m.rate, m.rate),
    "bias_asymmetry": lambda x, p, m, w: np.where(x > 0, x + p["ba"] / 2, x - p["ba"] / 2),
    "angular_acceleration": lambda x, p, m, w: x + m.slope(m.rate) @ p["c"].T,
    "scale_factor_g_sensitivity": lambda x, p, m, w: (
        x + np.einsum("ij,ki,kj->ki", p["P"], x, m.specific_force)
    ),
    "thermal_scale_factor": lambda x, p, m, w: (
        x * (1 + np.outer(m.temperature[:, 0] - p["T0"], p["kS"]))
    ),
    "thermal_misalignment": lambda x, p, m, w: (
        x + (m.temperature - p["T0"]) * np.einsum("ij,kj->ki", p["mT"], x)
    ),
    "clock_skew": lambda x, p, m, w: x + p["eps"] * m.t * m.slope(x),
    "turn_on_bias": lambda x, p, m, w: x + p["b0"],
    "g_sensitivity": lambda x, p, m, w: x + np.einsum("ij,kj->ki", p["G"], m.specific_force),
    "g2_sensitivity": lambda x, p, m, w: x + products(m.specific_force) @ p["Q"].T,
    "vibration_rectification": lambda x, p, m, w: x + m.vibration @ p["V"].T,
    "thermal_bias": lambda x, p, m, w: x + np.outer(m.temperature[:, 0] - p["T0"], p["kT"]),
    "thermal_bias_quadratic": lambda x, p, m, w: (
        x + np.outer(np.square(m.temperature[:, 0] - p["T0"]), p["k2"])
    ),
    "thermal_bias_cubic": lambda x, p, m, w: (
        x + np.outer((m.temperature[:, 0] - p["T0"]) ** 3, p["k3"])
    ),
    "temperature_rate": lambda x, p, m, w: x + m.slope(m.temperature) * p["kd"],
    "thermal_hysteresis": thermal_hysteresis,
    "warm_up": lambda x, p, m, w: x + p["A"] * np.exp(-m.t / p["tau"]),
    "rate_ramp": lambda x, p, m, w: x + p["R"] * m.t,
    "bias_step": lambda x, p, m, w: (
        x + sum(np.outer(m.t >= t0, a) for t0, a in zip(p["t0"], p["A"].T))
    ),
    "ageing": lambda x, p, m, w: x + (p["age"] + m.t) * p["kb"] + (p["age"] + m.t) * p["ks"] * x,
    "supply_sensitivity": lambda x, p, m, w: x + (m.supply - p["V0"]) * p["kV"],
    "magnetic_sensitivity": lambda x, p, m, w: x + m.mag @ p["C"].T,
    "vibration_line": lambda x, p, m, w: (
        x + p["A"] * np.sin(2 * np.pi * p["f0"] * m.t + p["phase"])
    ),
    "angle_random_walk": lambda x, p, m, w: x + p["N"] * w / np.sqrt(H),
    "rate_random_walk": lambda x, p, m, w: (
        x + np.vstack([np.zeros(3), np.cumsum(p["K"] * np.sqrt(H) * w, 0)[:-1]])
    ),
    "gauss_markov": gauss_markov,
    "second_gauss_markov": gauss_markov,
    "bias_instability": bias_instability,
    "rate_dependent_noise": lambda x, p, m, w: x * (1 + p["k"] * w / np.sqrt(H)),
    "sampling_jitter": lambda x, p, m, w: x + p["sj"] * w * m.slope(x),
    "dead_zone": lambda x, p, m, w: np.sign(x) * np.maximum(np.abs(x) - p["d"], 0),
    "hard_dead_zone": lambda x, p, m, w: x * (np.abs(x) > p["d"]),
    "angle_quantization": angle_quantization,
    "saturation": lambda x, p, m, w: np.clip(x, -p["limit"], p["limit"]),
    "quantization": lambda x, p, m, w: p["q"] * np.rint(x / p["q"]),
}


@pytest.fixture(scope="module")
def fmu(tmp_path_factory):
    """A part that has every effect, all at the identity, and an FMU that can be told so."""
    part = as_part(
        *(
            Sensor(kind, {name: {} for name, e in CATALOGUE.items() if kind in e.sensors})
            for kind in KINDS
        )
    )
    return part, built(as_part(*map(everything, KINDS)).block, tmp_path_factory)[2]


@pytest.mark.parametrize("name, kind", CASES)
def test_effect_keeps_its_equation_through_the_fmu(fmu, name, kind):
    """The FMU on a motion that excites the effect, against the equation in plain numpy."""
    assert name in EQUATIONS, f"write the equation of {name} into EQUATIONS, in numpy"
    part, path = fmu
    sensor, u, n = excited(name, kind), motion(400), 400
    settings = {v.name: v.start for v in (*part.block.parameters, *sensor.variables)} | {"seed": 5}
    y = simulate(path, inputs(u, part), sample_period=H, start_values=settings)[1:, outputs(kind)]
    w, x = normals(5, [c.number for c in sensor.noise], 1, n), u[:, own(kind)]
    want = EQUATIONS[name](x, sensor.values[name], Motion(u), w)
    assert np.all(np.abs(want - x).max(0) > ROUNDING * 1e3 * np.abs(x).max()), (
        "the motion does not excite the effect"
    )
    tolerance = ROUNDING
    if name == "lag":
        # 1 + a1 + a2 is the square of the angle: what is lost in that difference, no formula has
        # back.
        tolerance = 16 * np.finfo(float).eps / (sensor.values[name]["wn"] * H) ** 2
    if name == "angle_quantization":
        # The sum of all angles rounds otherwise than what is left over from sample to sample:
        # seldom a whole step.
        late = np.abs(y - want) > tolerance
        assert late.mean() < 0.01
        np.testing.assert_allclose(np.cumsum(y, 0)[~late], np.cumsum(want, 0)[~late], atol=1e-9)
        return
    np.testing.assert_allclose(y, want, rtol=tolerance, atol=tolerance * np.abs(x).max())


def test_every_equation_belongs_to_an_effect():
    assert set(EQUATIONS) == set(CATALOGUE)


@pytest.mark.parametrize("steps", [0.0, 0.3, 1.0, 1.7, 2.5, 17.25, MEMORY - 2])
def test_time_delay_is_the_shifted_sinusoid_within_the_bound_of_the_cubic(steps):
    """|error| <= max |x''''| h^4 / 24 max |product of the distances to the four nodes|."""
    omega, t = 2 * np.pi * np.array([1.0, 3.0, 8.0]), H * np.arange(500)[:, None]
    u = np.zeros((500, N_INPUT))
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
    longest, longer = (
        Sensor("gyro", {"time_delay": {"td": s * H}}) for s in (MEMORY - 2, MEMORY + 5)
    )
    np.testing.assert_array_equal(run(longer, motion(100)), run(longest, motion(100)))


@pytest.mark.parametrize("zeta", [0.3, 0.7071067811865476, 1.0, 2.0])
@pytest.mark.parametrize("wn", [30.0, 3000.0])
def test_lag_follows_its_transfer_function_to_third_order_in_the_sample_period(wn, zeta):
    """Steady response to 2 Hz against G(j omega): halving the sample period makes the error an
    eighth.

    A lag far shorter than the sample period is an interpolation between samples, short by its share
    of the period, and its error falls to a quarter.
    """
    w = 2 * np.pi * 2.0
    gain = wn**2 / (wn**2 - w**2 + 2j * zeta * wn * w)

    def error(h):
        t = h * np.arange(round(20.0 / h))
        u = np.zeros((len(t), N_INPUT))
        u[:, 0] = np.sin(w * t)
        y = Sensor("gyro", {"lag": {"wn": wn, "zeta": zeta}})
        return np.abs(run(y, u, h=h)[:, 0] - np.imag(gain * np.exp(1j * w * t)))[
            len(t) // 2 :
        ].max()

    coarse, fine = error(0.01), error(0.005)
    assert coarse < (w * 0.01) ** 3
    assert fine < coarse / (6 if wn * 0.01 < 1 else 3)


def test_lag_and_delay_start_in_the_steady_state():
    """A constant motion shows no transient at power-on."""
    u = np.zeros((50, N_INPUT))
    u[:, :7] = [0.1, -0.2, 0.3, 1.0, 2.0, 9.8, 25.0]
    for name in ("lag", "time_delay"):
        np.testing.assert_allclose(run(excited(name, "accel"), u), u[:, 3:6], rtol=1e-13)
