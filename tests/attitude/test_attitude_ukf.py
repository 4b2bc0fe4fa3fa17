"""The attitude filter on bodies whose motion is known: consistency, closed forms, its updates, and
what it survives.

The world is made by numpy and scipy alone; the filter's statistics are held against their own
distributions.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.attitude.ukf import attitude_ukf
from pyimu.attitude.unscented import LARGEST_STD
from pyimu.attitude.variables import UNKNOWN_LATITUDE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.simulate import simulate

GRAVITY = 9.80665
H = 0.01
EARTH = 7.292115e-5
N, K, N_ACCEL = 1e-3, 2e-4, 1e-2
WHITE = {"accel_std": 0.0, "accel_correlation_time": 0.0}
"""Settings under which the filter's model of the specific force is white noise alone."""


def part(n: float = N, k: float = K, n_accel: float = N_ACCEL, **more) -> Part:
    gyro = Sensor("gyro", {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k}, **more})
    return Part("test", 1 / H, gyro, Sensor("accel", {"angle_random_walk": {"N": n_accel}}))


def parameters(block, **values) -> np.ndarray:
    """Start values of the block's parameters with some replaced, scalars or vectors by name."""
    at = {v.name: i for i, v in enumerate(block.parameters)}
    p = block.start.copy()
    for name, value in values.items():
        names = [name] if np.ndim(value) == 0 else [f"{name}[{i + 1}]" for i in range(len(value))]
        p[[at[n] for n in names]] = value
    return p


def inputs(n: int, **values) -> np.ndarray:
    """Rows of the block's inputs (n, 12), level and at rest, with some replaced."""
    u = np.zeros((n, 12))
    u[:, 5], u[:, 6] = GRAVITY, 25.0
    columns = {
        "gyro": slice(0, 3),
        "accel": slice(3, 6),
        "temperature": 6,
        "heading": 7,
        "heading_variance": 8,
        "heading_valid": 9,
        "heading_age": 10,
        "stationary": 11,
    }
    for name, value in values.items():
        u[:, columns[name]] = value
    return u


def output(block, y: np.ndarray, name: str) -> np.ndarray:
    """A named output of rows y (n, ny): (n,) or (n, size)."""
    names = [v.name for v in block.outputs]
    columns = [i for i, v in enumerate(names) if v == name or v.startswith(f"{name}[")]
    return y[:, columns[0]] if names[columns[0]] == name else y[:, columns]


@dataclass(frozen=True)
class Drive:
    """Body rate against the world (n, 3), true only over the step that ends with its row; attitude
    after each row.
    """

    rate: np.ndarray
    attitude: Rotation
    force: np.ndarray
    inertial: np.ndarray


def drive(rate: np.ndarray, start: Rotation | None = None, latitude: float | None = None) -> Drive:
    """A body that turns in place by ``rate`` (n, 3) rad/s, each row held for one period."""
    quaternions, q = [], start or Rotation.identity()
    for turn in Rotation.from_rotvec(rate * H):
        q = q * turn
        quaternions.append(q.as_quat())
    attitude = Rotation.from_quat(quaternions)
    force = attitude.apply([0, 0, GRAVITY], inverse=True)
    earth = (
        np.zeros(3)
        if latitude is None
        else EARTH * np.array([0, np.cos(latitude), np.sin(latitude)])
    )
    before = Rotation.concatenate([start or Rotation.identity(), attitude[:-1]])
    return Drive(rate, attitude, force, rate + before.apply(earth, inverse=True))


def rover_rate(n: int, still: int = 0) -> np.ndarray:
    """A gentle drive: turns, pitching over boulders; the first ``still`` rows at rest."""
    t = np.arange(n)[:, None] * H
    rate = np.array([0.2, 0.25, 0.3]) * np.sin(
        np.array([0.9, 0.7, 0.3]) * t + np.array([0.0, 1.0, 2.0])
    )
    rate[:still] = 0
    return rate


def measured(
    world: Drive, rng: np.random.Generator, bias: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gyro, accel and the true bias (n, 3) of one noise draw."""
    shape = world.rate.shape
    walk = bias + K * np.sqrt(H) * np.cumsum(rng.standard_normal(shape), axis=0)
    gyro = world.inertial + walk + N / np.sqrt(H) * rng.standard_normal(shape)
    return gyro, world.force + N_ACCEL / np.sqrt(H) * rng.standard_normal(shape), walk


def error(q: np.ndarray, truth: Rotation) -> np.ndarray:
    """Attitude error (n, 3) rad in body axes: truth = q exp(error)."""
    return (Rotation.from_quat(q, scalar_first=True).inv() * truth).as_rotvec()


# Consistency


TAIL = 1e-4
"""Probability on either side of a band."""


def within_chi2(value: float, degrees: float) -> None:
    low, high = chi2.ppf([TAIL, 1 - TAIL], degrees)
    assert low < value < high


@pytest.fixture(scope="module")
def block():
    return attitude_ukf(part())


STD0 = np.array([0.03, 0.03, 0.05, 0.01, 0.01, 0.01])


def one_draw(
    block,
    world: Drive,
    seed: int,
    std0: np.ndarray,
    heading_std: float,
    still: int,
    latitude: float,
):
    """Outputs (n, ny) and true bias (n, 3) of one seed, its initial error drawn from the initial
    covariance.
    """
    rng = np.random.default_rng(seed)
    first = std0 * rng.standard_normal(6)
    gyro, accel, bias = measured(world, rng, first[3:])
    n = len(gyro)
    q0 = Rotation.from_rotvec(first[:3]).inv().as_quat(scalar_first=True)
    u = inputs(n, gyro=gyro, accel=accel, stationary=np.arange(n) < still)
    if heading_std:
        yaw = world.attitude.as_euler("ZYX")[:, 0] + heading_std * rng.standard_normal(n)
        u[:, 7], u[:, 8], u[:, 9] = yaw, heading_std**2, np.arange(n) % 50 == 49
    y, state = block.run(u, p=parameters(block, q0=q0, std0=std0, latitude=latitude, **WHITE))
    return y, bias, state


def covariance_of(state: np.ndarray) -> np.ndarray:
    p = np.zeros((6, 6))
    p[np.triu_indices(6)] = state[7:28]
    return p + np.triu(p, 1).T


@pytest.mark.parametrize(
    "heading_std, still", [(0.0, 0), (0.02, 300)], ids=["gravity", "gravity, heading, zero rate"]
)
@pytest.mark.parametrize(
    "n, std0",
    [(50, STD0), (1500, STD0), (1500, STD0 / 50)],
    ids=["early", "late", "late, noise prevails"],
)
def test_normalised_estimation_error_squared_of_many_draws_is_chi2(
    block, heading_std, still, n, std0
):
    """Bar-Shalom, Li and Kirubarajan 2001, section 5.4: the sum over M draws has 6 M degrees of
    freedom.
    """
    world, total, draws = drive(rover_rate(n, still), latitude=0.8), 0.0, 48
    for seed in range(draws):
        y, bias, state = one_draw(block, world, seed, std0, heading_std, still, 0.8)
        turn = error(output(block, y, "q")[-1:], world.attitude[-1:])[0]
        e = np.concatenate([turn, bias[-1] - output(block, y, "gyro_bias")[-1]])
        total += e @ np.linalg.solve(covariance_of(state), e)
    within_chi2(total, 6 * draws)


def test_normalised_innovations_squared_are_white_chi2_of_three(block):
    world = drive(rover_rate(4000), latitude=0.8)
    y, _, _ = one_draw(block, world, 7, STD0, 0.0, 0, 0.8)
    nis = output(block, y, "nis")
    updated = nis > 0
    assert updated.mean() > 0.99
    within_chi2(nis[updated].sum(), 3 * updated.sum())
    z = chi2.cdf(nis[updated], 3) - 0.5
    assert abs(np.sum(z[1:] * z[:-1])) < 4.5 * np.sqrt(len(z)) / 12


def test_output_std_is_the_root_of_the_covariances_diagonal(block):
    y, _, state = one_draw(block, drive(rover_rate(300)), 1, STD0, 0.0, 0, UNKNOWN_LATITUDE)
    np.testing.assert_allclose(
        output(block, y, "std")[-1], np.sqrt(np.diag(covariance_of(state))), rtol=1e-14
    )


# Propagation


def test_noise_free_propagation_is_the_product_of_rotations():
    block, world = attitude_ukf(part(0, 0)), drive(rover_rate(2000), latitude=0.8)
    u = inputs(2000, gyro=world.inertial, accel=np.full(3, 50.0))
    y, _ = block.run(u, p=parameters(block, latitude=0.8, std0=np.zeros(6)))
    assert not output(block, y, "quasi_static").any()
    assert np.abs(error(output(block, y, "q"), world.attitude)).max() < 1e-12


def test_earth_rate_alone_turns_nothing_at_a_known_latitude():
    block, start = attitude_ukf(part(0, 0)), Rotation.from_rotvec([0.3, -0.5, 1.0])
    world = drive(np.zeros((500, 3)), start, latitude=-0.6)
    u = inputs(500, gyro=world.inertial, accel=np.full(3, 50.0))
    settings = {"q0": start.as_quat(scalar_first=True), "std0": np.zeros(6)}
    known, _ = block.run(u, p=parameters(block, latitude=-0.6, **settings))
    assert np.abs(error(output(block, known, "q"), world.attitude)).max() < 1e-13
    for unknown in (UNKNOWN_LATITUDE, np.nan):
        y, _ = block.run(u, p=parameters(block, latitude=unknown, **settings))
        turned = np.linalg.norm(error(output(block, y, "q")[-1:], start))
        np.testing.assert_allclose(turned, EARTH * 500 * H, rtol=1e-9)


def test_heading_variance_without_heading_grows_as_hidalgos_q():
    """Level and still, gravity says nothing of yaw: sigma^2 = s^2 + N^2 t + K^2 t^3/3 + s_b^2 t^2
    of noise alone.
    """
    block, n, std0 = attitude_ukf(part()), 3000, np.array([0.01, 0.01, 0.02, 1e-3, 1e-3, 1e-4])
    y, _ = block.run(inputs(n), p=parameters(block, std0=std0))
    t = H * np.arange(1, n + 1)
    expected = std0[2] ** 2 + N**2 * t + K**2 * t**3 / 3 + (std0[5] * t) ** 2
    np.testing.assert_allclose(output(block, y, "std")[:, 2] ** 2, expected, rtol=1e-3)


def test_quaternion_keeps_its_length_and_covariance_stays_definite_over_a_long_run(block):
    state, p = None, parameters(block, std0=np.full(6, 0.05))
    for chunk in range(10):
        rate = rover_rate(10_000) * 5
        u = inputs(10_000, gyro=rate, accel=np.array([0.2, -0.3, GRAVITY]))
        y, state = block.run(u, p=p, state=state)
        np.testing.assert_allclose(np.linalg.norm(output(block, y, "q"), axis=1), 1, atol=4e-15)
        covariance = covariance_of(state)
        scale = np.sqrt(np.diag(covariance))
        assert np.linalg.eigvalsh(covariance / np.outer(scale, scale)).min() > 1e-9
        assert (scale[:3] <= LARGEST_STD * (1 + 1e-12)).all()


def test_half_run_and_half_run_are_the_whole_run(block):
    world = drive(rover_rate(400))
    gyro, accel, _ = measured(world, np.random.default_rng(0), np.zeros(3))
    u = inputs(400, gyro=gyro, accel=accel)
    whole, _ = block.run(u)
    first, state = block.run(u[:150])
    np.testing.assert_array_equal(np.vstack([first, block.run(u[150:], state=state)[0]]), whole)


def test_declared_errors_of_the_sensors_are_undone():
    """A sensor with known scale factor, misalignment, thermal bias, g-sensitivity: the same
    attitude as an ideal one.
    """
    m = np.array([[0, 0.01, -0.02], [0.005, 0, 0.01], [0.02, -0.01, 0]])
    g = np.array([[1e-3, 0, 2e-4], [0, -1e-3, 0], [3e-4, 0, 5e-4]])
    declared = part(
        0,
        0,
        scale_factor={"s": [0.03, -0.02, 0.01]},
        misalignment={"m": m},
        g_sensitivity={"G": g},
        thermal_bias={"kT": [1e-3, 2e-3, -1e-3]},
    )
    block, world = attitude_ukf(declared), drive(rover_rate(500))
    gyro, _ = simulate(declared, world.rate, world.force, 35.0, seed=None)
    assert np.abs(gyro - world.rate).max() > 0.01
    y, _ = block.run(
        inputs(500, gyro=gyro, accel=world.force, temperature=35.0),
        p=parameters(block, std0=np.zeros(6)),
    )
    assert np.abs(error(output(block, y, "q"), world.attitude)).max() < 1e-12


# The updates


@pytest.mark.parametrize(
    "start",
    [[0, 0, 0], [np.pi, 0, 0], [0, np.pi / 2, 0.3]],
    ids=["level", "upside down", "nose down"],
)
@pytest.mark.parametrize("wrong", [0.2, 1.5, 2.8])
def test_tilt_converges_to_gravitys_direction(start, wrong):
    block, truth = attitude_ukf(part()), Rotation.from_rotvec(start)
    axis = truth.apply([0, 0, 1], inverse=True)
    off = np.cross(axis, [0.6, 0.48, 0.64])
    q0 = (truth * Rotation.from_rotvec(wrong * off / np.linalg.norm(off))).as_quat(
        scalar_first=True
    )
    accel = truth.apply([0, 0, GRAVITY], inverse=True)
    y, _ = block.run(
        inputs(3000, accel=accel),
        p=parameters(block, q0=q0, std0=np.array([1, 1, 1, 1e-3, 1e-3, 1e-3]), **WHITE),
    )
    seen = Rotation.from_quat(output(block, y, "q")[-1], scalar_first=True).apply(
        [0, 0, 1], inverse=True
    )
    assert np.arccos(min(1, seen @ axis)) < 1e-3


def test_bias_across_gravity_is_found(block):
    bias = np.array([0.004, -0.006, 0.0])
    y, _ = block.run(inputs(20_000, gyro=bias), p=parameters(block, **WHITE))
    np.testing.assert_allclose(output(block, y, "gyro_bias")[-1, :2], bias[:2], atol=3e-5)


@pytest.mark.parametrize("acceleration", [6.0, 3.0], ids=["jolt", "push"])
def test_acceleration_closes_the_gate_and_gravity_opens_it(block, acceleration):
    accel = np.tile([0.0, 0.0, GRAVITY], (3000, 1))
    accel[1000:2000, 0] = acceleration
    y, _ = block.run(inputs(3000, accel=accel))
    gate, closed = output(block, y, "quasi_static"), slice(1000, 2000)
    assert gate[:1000].all() and not gate[closed].any() and gate[2500:].all()
    np.testing.assert_array_equal(output(block, y, "nis")[closed], 0)


def test_push_that_the_magnitude_does_not_see_closes_the_gate_by_its_scatter():
    """The k-th sample of a push a is a (1 - m)^k off the mean, of which the scatter is an
    exponential mean; until the mean has followed.
    """
    block, push, accel = attitude_ukf(part(0, 0)), 1.0, np.tile([0.0, 0.0, GRAVITY], (2000, 1))
    assert np.hypot(GRAVITY, push) - GRAVITY < 0.06
    accel[1000:, 0] = push
    y, _ = block.run(inputs(2000, accel=accel), p=parameters(block, std0=np.full(6, 1e-9)))
    k, m, g = np.arange(1, 1001), H / (1.0 + H), H / (0.3 + H)
    off = (push * (1 - m) ** k) ** 2
    scatter = np.array([np.sum(g * (1 - g) ** (n - k[:n]) * off[:n]) for n in k])
    white = N_ACCEL**2 / H + 1e-4**2
    np.testing.assert_array_equal(
        output(block, y, "quasi_static")[1000:], scatter <= 0.3**2 + 2 * 3 * white
    )


@pytest.mark.parametrize("yaw", [np.pi - 0.02, -np.pi + 0.02, 3.0])
def test_heading_update_goes_the_short_way_across_the_wrap(block, yaw):
    q0 = Rotation.from_euler("ZYX", [yaw, 0, 0]).as_quat(scalar_first=True)
    for heading in (yaw + 0.05, yaw - 0.05, yaw + 0.05 + 2 * np.pi):
        u = inputs(1, heading=heading, heading_variance=0.02**2, heading_valid=1)
        std0 = np.array([0.01, 0.01, 0.1, 1e-6, 1e-6, 1e-6])
        y, _ = block.run(u, p=parameters(block, q0=q0, std0=std0))
        prior = 0.1**2 + N**2 * H
        moved = (output(block, y, "yaw")[0] - yaw + np.pi) % (2 * np.pi) - np.pi
        wanted = (heading - yaw + np.pi) % (2 * np.pi) - np.pi
        np.testing.assert_allclose(moved, prior / (prior + 0.02**2) * wanted, rtol=0.01)
        np.testing.assert_allclose(
            output(block, y, "std")[0, 2] ** 2, prior * 0.02**2 / (prior + 0.02**2), rtol=0.01
        )


def test_heading_of_a_body_that_points_up_is_not_used(block):
    q0 = Rotation.from_euler("ZYX", [0.3, -np.pi / 2, 0]).as_quat(scalar_first=True)
    p = parameters(block, q0=q0)
    plain, _ = block.run(inputs(5, accel=np.array([GRAVITY, 0, 0])), p=p)
    told, _ = block.run(
        inputs(
            5, accel=np.array([GRAVITY, 0, 0]), heading=1.0, heading_variance=1e-4, heading_valid=1
        ),
        p=p,
    )
    np.testing.assert_array_equal(told, plain)


def test_zero_rate_update_averages_the_gyro_and_holds_the_attitude():
    """A still body's bias without random walk: a mean of n samples and the prior, each weighed by
    its variance.
    """
    block, n = attitude_ukf(part(k=0)), 500
    gyro = np.array([0.01, -0.02, 0.005]) + N / np.sqrt(H) * np.random.default_rng(
        3
    ).standard_normal((n, 3))
    q0 = Rotation.from_rotvec([0.1, 0.2, 0.3])
    accel = np.full(3, 50.0)
    y, _ = block.run(
        inputs(n, gyro=gyro, accel=accel, stationary=1),
        p=parameters(block, q0=q0.as_quat(scalar_first=True), stationary_std=0.0),
    )
    information = n / (N**2 / H)
    expected = information * gyro.mean(axis=0) / (information + 1 / 0.01**2)
    np.testing.assert_allclose(output(block, y, "gyro_bias")[-1], expected, rtol=1e-6)
    np.testing.assert_allclose(
        output(block, y, "std")[-1, 3:], (information + 1 / 0.01**2) ** -0.5, rtol=1e-6
    )
    assert np.abs(error(output(block, y, "q"), q0)).max() < 1e-12


# What it survives


BAD = [np.nan, np.inf, -np.inf, 1e300]


@pytest.mark.parametrize("bad", BAD)
@pytest.mark.parametrize("column", range(12))
def test_input_that_is_not_finite_never_poisons_the_state(block, column, bad):
    u = inputs(
        60,
        gyro=np.array([0.1, 0.0, -0.05]),
        heading_variance=1e-2,
        heading_valid=np.arange(60) % 10 == 9,
    )
    u[20:30, column] = bad
    y, state = block.run(u)
    assert np.isfinite(y).all() and np.isfinite(state).all()
    status = output(block, y, "status")
    assert not status[:20].any() and not status[30:].any()
    if column < 7:
        np.testing.assert_array_equal(status[20:30], 1)


def test_everything_lost_from_the_first_sample_on_leaves_an_honest_attitude(block):
    u = np.full((3000, 12), np.nan)
    y, state = block.run(u)
    assert np.isfinite(y).all() and np.isfinite(state).all()
    np.testing.assert_allclose(output(block, y, "std")[-1, :3], LARGEST_STD, rtol=1e-3)


def test_lost_gyro_holds_the_last_rate_and_widens_by_the_unknown_angle():
    """Over a loss of T s, the angle's variance grows by s^2 T^2 about the lost axis, and not about
    the others.
    """
    block, n = attitude_ukf(part(1e-6, 0)), 100
    u = inputs(n, gyro=np.array([0.0, 0.0, 0.2]), accel=np.full(3, 50.0))
    u[50:, 2] = np.nan
    y, _ = block.run(u, p=parameters(block, std0=np.full(6, 1e-6), lost_rate_std=0.3))
    np.testing.assert_allclose(output(block, y, "yaw")[-1], 0.2 * n * H, rtol=1e-9)
    np.testing.assert_allclose(output(block, y, "std")[-1, 2], 0.3 * 50 * H, rtol=1e-6)
    assert output(block, y, "std")[-1, :2].max() < 1e-4


def test_saturated_gyro_is_marked_and_widens_the_covariance():
    block = attitude_ukf(part(saturation={"limit": 2.0}))
    u = inputs(40, gyro=np.zeros(3))
    u[20:30, 1] = 2.0
    y, _ = block.run(u)
    status, std = output(block, y, "status"), output(block, y, "std")
    np.testing.assert_array_equal(
        status, np.where((np.arange(40) >= 20) & (np.arange(40) < 30), 2, 0)
    )
    assert std[20, 1] > std[19, 1] + 1e-5 and std[20, 0] < std[19, 0] + 1e-5


def test_start_values_show_the_given_attitude(block):
    q0 = Rotation.from_euler("ZYX", [0.3, -0.2, 3.0])
    _, y = block.initial(
        parameters(block, q0=2 * q0.as_quat(scalar_first=True), bias0=[1e-3, 2e-3, 3e-3])
    )
    y = np.array(y).T
    assert np.abs(error(output(block, y, "q"), q0)).max() < 1e-15
    np.testing.assert_allclose(
        [output(block, y, n)[0] for n in ("yaw", "pitch", "roll")], [0.3, -0.2, 3.0], atol=1e-14
    )
    np.testing.assert_array_equal(output(block, y, "gyro_bias")[0], [1e-3, 2e-3, 3e-3])
