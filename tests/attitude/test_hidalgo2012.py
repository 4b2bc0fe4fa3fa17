"""The filter as published, against its equations written once more in numpy, and derivatives."""

import casadi as ca
import numpy as np
import pytest
from attitude_cases import (
    GRAVITY,
    H,
    K,
    N,
    drive,
    error,
    measured,
    output,
    parameters,
    part,
    rover_rate,
)
from built import built
from scipy.spatial.transform import Rotation

from pyimu import Recording, attitude
from pyimu.attitude import attitude_hidalgo2012, attitude_ukf
from pyimu.attitude.filter.hidalgo2012_state import ACROSS
from pyimu.attitude.filter.sigma_point_filter import propagate
from pyimu.attitude.filter.unscented import Estimate, sigma_points
from pyimu.errors import UserError
from pyimu.fmu import simulate
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.symbolic import mrp
from pyimu.symbolic.earth import normal_gravity
from pyimu.symbolic.process_noise import error_system
from pyimu.symbolic.van_loan import van_loan
from pyimu.units import STANDARD_GRAVITY

BARE = {"low_pass": 0.0, "gravity": GRAVITY}
"""No low-pass filter, and the gravity of the simulated world."""

STD0 = np.array([0.05, 0.08, 0.3, 0.01, 0.02, 0.03])


def rows(gyro, accel) -> np.ndarray:
    """The block's inputs (n, 7)."""
    return np.column_stack([gyro, accel, np.full(len(gyro), 25.0)])


# The paper's equations in numpy, with its f = a = 1


class Published:
    """The error as modified Rodrigues parameters with f = a = 1, and Q scaled to it."""

    def __init__(self, std0, lam, accel_std, tolerance, walk, n=N, k=K):
        self.q, self.bias, self.lam = Rotation.identity(), np.zeros(3), lam
        quarter = np.diag([0.25] * 3 + [1.0] * 3)
        self.p = quarter @ np.diag(std0**2) @ quarter
        q = np.kron([[n**2 * H + k**2 * H**3 / 3, -(k**2) * H**2 / 2], [0, k**2 * H]], np.eye(3))
        q[3:, :3] = q[:3, 3:]
        floor = np.diag([1e-18 * H] * 3 + [1e-20 * H] * 3)
        self.noise = quarter @ (q + floor) @ quarter
        self.r = accel_std**2 + 1e-8 + 1e-4 / H
        self.tolerance, self.walk = tolerance, walk**2 * H
        self.gravity, self.variance = GRAVITY, accel_std**2

    def points(self):
        root = np.linalg.cholesky((6 + self.lam) * self.p)
        weights = np.full(13, 0.5 / (6 + self.lam))
        weights[0] = self.lam / (6 + self.lam)
        return np.vstack([np.zeros(6), root.T, -root.T]), weights

    def turn(self, measured, earth):
        """From sample k to sample k + 1, by the rate of sample k."""
        x, w = self.points()
        own = [
            measured - self.bias - b - (self.q * Rotation.from_mrp(p)).inv().apply(earth)
            for p, b in zip(x[:, :3], x[:, 3:])
        ]
        turned = [
            self.q * Rotation.from_mrp(p) * Rotation.from_rotvec(v * H)
            for p, v in zip(x[:, :3], own)
        ]
        errors = np.array([(turned[0].inv() * t).as_mrp() for t in turned])
        moved = np.hstack([errors, x[:, 3:]])
        mean = w @ moved
        mean[3:] = 0
        self.p = (moved - mean).T @ (w[:, None] * (moved - mean)) + self.noise
        self.q = turned[0] * Rotation.from_mrp(mean[:3])

    def correct(self, force):
        """The correction where the gate lets it pass; gives the NIS, 0 without it."""
        size = np.linalg.norm(force)
        self.variance += self.walk
        gain = self.variance / (self.variance + self.r)
        self.gravity += gain * (size - self.gravity)
        self.variance *= 1 - gain
        if abs(self.gravity - GRAVITY) > self.tolerance:
            return 0.0
        x, w = self.points()
        seen = np.array(
            [(self.q * Rotation.from_mrp(p)).inv().apply([0, 0, GRAVITY]) for p in x[:, :3]]
        )
        mean = w @ seen
        s = (seen - mean).T @ (w[:, None] * (seen - mean)) + self.r * np.eye(3)
        k = x.T @ (w[:, None] * (seen - mean)) @ np.linalg.inv(s)
        change = k @ (force - mean)
        self.p = self.p - k @ s @ k.T
        self.q, self.bias = self.q * Rotation.from_mrp(change[:3]), self.bias + change[3:]
        return (force - mean) @ np.linalg.solve(s, force - mean)


@pytest.mark.parametrize(
    "lam",
    [0.0, pytest.param(1.0, marks=pytest.mark.long), pytest.param(3.0, marks=pytest.mark.long)],
)
def test_filter_is_sections_4_and_5_of_the_paper_with_f_and_a_one(lam):
    """Rows at rest and in a drive with pushes and Earth rate, by numpy and scipy.

    Rounding: 1000 steps of some thousand operations each are 5e-10 of a standard deviation if all
    of it adds up, and the gain multiplies none of it by more than one.
    """
    n = 1000
    rng, latitude = np.random.default_rng(1), 0.9
    world = drive(rover_rate(n, still=200), latitude=latitude)
    gyro, accel, _ = measured(world, rng, np.array([0.01, -0.02, 0.015]))
    accel[500:600] += [0.5, 0.0, 2.0]
    settings = {"accel_std": 0.2, "gravity_tolerance": 0.3, "gravity_walk": 0.3, "lambda": lam}
    block = attitude_hidalgo2012(part())
    p = parameters(block, std0=STD0, latitude=latitude, **BARE | settings)
    y, _ = block.run(rows(gyro, accel), p=p)
    earth = 7.292115e-5 * np.array([0, np.cos(latitude), np.sin(latitude)])
    plain = Published(STD0, lam, 0.2, 0.3, 0.3)
    q, bias, std, nis = np.empty((n, 4)), np.empty((n, 3)), np.empty((n, 6)), np.empty(n)
    for i in range(n):
        if i:
            plain.turn(gyro[i - 1], earth)
        nis[i] = plain.correct(accel[i])
        q[i], bias[i] = plain.q.as_quat(scalar_first=True), plain.bias
        std[i] = np.sqrt(np.diag(plain.p)) * [4, 4, 4, 1, 1, 1]
    far = error(output(block, y, "q"), Rotation.from_quat(q, scalar_first=True))
    assert (np.abs(far) < 5e-10 * std[:, :3]).all()
    assert (np.abs(output(block, y, "gyro_bias") - bias) < 5e-10 * std[:, 3:]).all()
    np.testing.assert_allclose(output(block, y, "std"), std, rtol=5e-10)
    np.testing.assert_allclose(output(block, y, "nis"), nis, rtol=1e-7, atol=1e-12)
    quasi_static = output(block, y, "quasi_static")
    np.testing.assert_array_equal(quasi_static, nis > 0)
    assert 0.5 < quasi_static.mean() < 0.95


# Derivatives


def test_weights_of_lambda_give_the_mean_to_third_order_and_the_fourth_moment_n_plus_lambda():
    """Of exp(e c x): casadi's derivatives by e at zero are the moments of c x under the weights."""
    e, c, lam = ca.SX.sym("e"), ca.SX.sym("c", 6), ca.SX.sym("lambda")
    rng = np.random.default_rng(0)
    a = rng.normal(size=(6, 6))
    p = a @ a.T
    sigma = sigma_points(ca.SX(ca.DM(p)), lam)
    mean, found = sigma.mean([ca.exp(e * ca.dot(c, x)) for x in sigma.points]), []
    for _ in range(5):
        found.append(ca.substitute(mean, e, 0))
        mean = ca.jacobian(mean, e)
    moments = ca.Function("moments", [c, lam], found)
    root = np.linalg.cholesky(p)
    for spread in (0.0, 1.0, 3.0, 10.0):
        along = rng.normal(size=6)
        got = [float(m) for m in moments(along, spread)]
        seen = root.T @ along
        want = [1, 0, seen @ seen, 0, (6 + spread) * np.sum(seen**4)]
        # A sum of 13 products of six, each rounded.
        np.testing.assert_allclose(got, want, atol=100 * 2.2e-16 * max(want))


def test_propagation_starts_as_the_kinematics_of_the_rodrigues_parameters():
    """d/dh of mean and covariance at h = 0 are those of p' by ``mrp.error_derivative``, b' = 0, at
    the sigma points, whatever their size; the Earth's rate drops out of none of them.
    """
    rng, h = np.random.default_rng(3), ca.SX.sym("h")
    rate = rng.normal(size=3)
    a = rng.normal(size=(6, 6)) / 3
    p = a @ a.T
    x = Estimate(ca.SX([1, 0, 0, 0]), ca.SX.zeros(3), ca.SX(0, 1), ca.SX(ca.DM(p)))
    after = propagate(x, ca.SX(ca.DM(rate)), lambda r, _: r, ca.SX(6, 6), h, 2.0)
    slope = [ca.jacobian(v, h) for v in (after.covariance, after.q)]
    covariance, q = (np.array(v) for v in ca.Function("slope", [h], slope)(0))
    root = np.linalg.cholesky(8 * p)
    points = np.vstack([np.zeros(6), root.T, -root.T])
    weights = np.array([2 / 8] + [0.5 / 8] * 12)
    moving = np.zeros((13, 6))
    for i, point in enumerate(points):
        found = mrp.error_derivative(ca.DM(point[:3]), ca.DM(rate), ca.DM(-point[3:]))
        moving[i, :3] = np.array(found).ravel()
    mean = weights @ moving
    off = moving - mean
    want = np.einsum("n,ni,nj", weights, off, points) + np.einsum("n,ni,nj", weights, points, off)
    np.testing.assert_allclose(covariance.reshape(6, 6), want, atol=1e-13)
    np.testing.assert_allclose(q.ravel()[1:], (rate + mean[:3]) / 2, atol=1e-14)


def test_added_covariance_is_that_of_the_linear_error_system():
    """F and G as casadi's Jacobians of the error's kinematics, Q by Van Loan, for a body at rest.

    A period of 2 s and a walk that is as large as the noise make all blocks count.
    """
    h, n, k = 2.0, np.array([1e-3, 2e-3, 3e-3]), np.array([1e-3, 5e-4, 2e-3])
    p, b, eta = (ca.SX.sym(name, 3) for name in ("p", "b", "eta"))
    slope = mrp.error_derivative(p, ca.SX.zeros(3), -b - ca.DM(n) * eta)
    zero = ca.Function(
        "system", [p, b, eta], [ca.jacobian(slope, ca.vertcat(p, b)), ca.jacobian(slope, eta)]
    )(0, 0, 0)
    f = np.vstack([np.array(zero[0]), np.zeros((3, 6))])
    g = np.zeros((6, 6))
    g[:3, :3], g[3:, 3:] = np.array(zero[1]), np.diag(k)
    np.testing.assert_allclose(
        f, np.array(error_system(ca.DM.zeros(3), ca.DM(n), [(ca.DM(k), ca.DM.zeros(3))])[0])
    )
    gyro = Sensor("gyro", {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k}})
    block = attitude_hidalgo2012(Part("walking", 1 / h, gyro, Sensor("accel", {})))
    values = parameters(block, std0=np.zeros(6), **BARE)
    _, state = block.run(rows(np.zeros((2, 3)), np.full((2, 3), np.nan)), p=values)
    found = np.zeros((6, 6))
    found[np.triu_indices(6)] = state[7:28]
    want = van_loan(f, g @ g.T, h)
    scale = np.sqrt(np.diag(want))
    off = np.triu(found - want) / np.outer(scale, scale)
    # Least N and K are a millionth of these, squared.
    assert np.abs(off).max() < 2e-11
    assert (np.diag(found[:3, 3:]) < 0).all()


# The gate


def test_gravity_is_that_of_the_latitude():
    """At the pole with a tolerance below the difference from the equator."""
    block = attitude_hidalgo2012(part())
    accel = np.tile([0.0, 0.0, float(normal_gravity(np.pi / 2))], (300, 1))
    for latitude, static in ((np.pi / 2, 1), (0.0, 0), (10.0, 0)):
        p = parameters(block, gravity_tolerance=0.02, latitude=latitude)
        y, _ = block.run(rows(np.zeros((300, 3)), accel), p=p)
        assert output(block, y, "quasi_static")[-1] == static
    p = parameters(block, gravity_tolerance=0.02, gravity=accel[0, 2])
    y, _ = block.run(rows(np.zeros((300, 3)), accel), p=p)
    assert output(block, y, "quasi_static").all()


def test_what_passes_a_gate_on_the_magnitude_across_gravity():
    """The largest acceleration across gravity that is not seen, and its mean square by an axis."""
    block = attitude_hidalgo2012(part())
    tolerance = block.start[[v.name for v in block.parameters].index("gravity_tolerance")]
    largest = np.sqrt((STANDARD_GRAVITY + tolerance) ** 2 - STANDARD_GRAVITY**2)
    for factor, static in ((0.99, 1), (1.01, 0)):
        accel = np.tile([factor * largest, 0.0, STANDARD_GRAVITY], (3000, 1))
        y, _ = block.run(rows(np.zeros((3000, 3)), accel), p=block.start)
        assert output(block, y, "quasi_static")[-1] == static
    # By the exact root instead of its first term.
    assert ACROSS == pytest.approx(largest / 2, rel=tolerance / STANDARD_GRAVITY)


# The low-pass filter


def test_attitude_is_late_by_the_low_pass_filter_and_one_sample():
    """A steady turn, long after its start: 2 zeta / (2 pi 10 Hz), and the period of the sample."""
    rate, n = np.array([0.2, -0.1, 0.3]), 400
    turning = np.where(np.arange(n)[:, None] >= 100, rate, 0.0)
    block = attitude_hidalgo2012(part(n=0.0, k=0.0))
    y, _ = block.run(
        rows(turning, np.full((n, 3), np.nan)), p=parameters(block, low_pass=10.0, std0=np.zeros(6))
    )
    late = error(output(block, y, "q")[-1:], Rotation.from_rotvec(turning.sum(axis=0) * H))
    np.testing.assert_allclose(late[0], rate * (2**0.5 / (2 * np.pi * 10) + H), rtol=1e-9)


def test_noise_behind_the_low_pass_filter_has_the_density_that_r_and_q_assume():
    """The angle after many samples of white noise has the variance N^2 t, filtered or not; chi-
    square of 3 x 200 degrees of freedom within four standard deviations.
    """
    block, n = attitude_hidalgo2012(part(k=0.0)), 1000
    p, rng, squares = parameters(block, std0=np.zeros(6)), np.random.default_rng(5), 0.0
    for _ in range(200):
        gyro = N / np.sqrt(H) * rng.standard_normal((n, 3))
        gyro[-50:] = 0
        y, _ = block.run(rows(gyro, np.full((n, 3), np.nan)), p=p)
        squares += np.sum(error(output(block, y, "q")[-1:], Rotation.identity()) ** 2)
    assert abs(squares / (N**2 * (n - 50) * H) - 600) < 4 * np.sqrt(2 * 600)


# What the docstring says of the paper


def test_first_order_compensation_leaves_the_square_of_m():
    """0.13 deg/s at 140 deg/s and 3 %, which the part's own compensation does not leave."""
    m, rate = np.diag([0.03] * 3), np.radians([140.0, 0.0, 0.0])
    measured_rate = (np.eye(3) + m) @ rate
    left = np.degrees(measured_rate - m @ measured_rate - rate)
    assert np.abs(left).max() == pytest.approx(0.13, abs=0.005)
    block = attitude_hidalgo2012(part(n=0.0, k=0.0, scale_factor={"s": [0.03] * 3}))
    gyro = np.tile(measured_rate, (50, 1))
    p = parameters(block, std0=np.zeros(6), **BARE)
    y, _ = block.run(rows(gyro, np.full((50, 3), np.nan)), p=p)
    late = error(output(block, y, "q")[-1:], Rotation.from_rotvec(rate * H * 49))
    assert np.abs(late).max() < 1e-12


# Over a recording


@pytest.fixture(scope="module")
def log() -> Recording:
    world = drive(rover_rate(3000, still=1500))
    gyro, accel, _ = measured(world, np.random.default_rng(0), np.array([0.01, -0.02, 0.015]))
    reference = world.attitude.as_quat(scalar_first=True)
    return Recording.from_arrays(
        time=H * np.arange(3000),
        gyro=gyro,
        accel=accel,
        ref_q=reference,
        stationary=np.arange(3000) < 1500,
    )


def test_run_takes_the_filter_by_name_and_its_parameters_beside_it(log):
    found = attitude.run(log, part(), settings="hidalgo2012")
    ours = attitude.run(log, part())
    assert (found.method, ours.method) == ("hidalgo2012", "ukf")
    assert "filter hidalgo2012" in found.report() and "uses no column" in found.report()
    assert found.as_dict()["filter"] == "hidalgo2012"
    assert {"lambda", "low_pass"} <= set(found.parameters) and "lambda" not in ours.parameters
    # Beside what the low-pass filter is late by: 0.0325 s at up to 0.45 rad/s.
    assert found.tilt_std[-1] < 0.01
    assert found.error.inclination.max() < 0.0325 * 0.45 + 4 * found.tilt_std.max()
    named = attitude.run(log, part(), settings={"filter": "hidalgo2012", "low_pass": 0.0})
    assert named.error.inclination.max() < found.error.inclination.max()
    same = attitude.run(log, part(), settings={"filter": "ukf"})
    np.testing.assert_array_equal(same.q, ours.q)


def test_rows_that_are_missing_are_held_and_leave_no_trace(log):
    gyro, accel = log.gyro.copy(), log.accel.copy()
    gyro[700:720, 1], accel[800:900] = np.nan, np.nan
    recording = Recording.from_arrays(time=log.time, gyro=gyro, accel=accel)
    found = attitude.run(
        recording, part(), settings={"filter": "hidalgo2012", "lost_rate_std": 0.1}
    )
    assert np.isfinite(found.q).all() and np.isfinite(found.std).all()
    np.testing.assert_array_equal(
        np.flatnonzero(found.status & 1), [*range(700, 720), *range(800, 900)]
    )
    assert not found.quasi_static[800:900].any()
    # 0.2 s of 0.1 rad/s.
    assert found.std[719, 1] > 0.01


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ("hidalgo2021", ("hidalgo2021", "ukf", "did you mean hidalgo2012?")),
        ({"filter": "other"}, ("other", "known are ukf, hidalgo2012")),
        ({"filter": "hidalgo2012", "motion_time": 1.0}, ("motion_time", "lambda")),
        ({"filter": "hidalgo2012", "lambda": -1.0}, ("lambda", "0 or more")),
        ({"lambda": 1.0}, ("lambda", "unknown setting")),
    ],
)
def test_what_is_wrong_in_the_settings_is_said_in_one_line(log, settings, said):
    with pytest.raises(UserError) as wrong:
        attitude.run(log, part(), settings=settings)
    assert all(text in str(wrong.value) for text in said)


def test_command_line_takes_the_filter_by_name(pyimu, log, tmp_path):
    path = log.write(tmp_path / "log.csv")
    code, out, err = pyimu("attitude", path, "--out", "out", "--settings", "hidalgo2012")
    assert code == 0 and err == "" and "filter hidalgo2012" in out
    code, _, err = pyimu("attitude", path, "--out", "other", "--settings", "hidalgo")
    assert code == 2 and err.count("\n") == 1 and "hidalgo2012" in err
    assert not (tmp_path / "other").exists()


def test_gravity_seems_to_tell_of_a_heading_that_is_not_known_well():
    """Nothing in these rows tells of it, and the package's own filter learns nothing."""
    n, std0 = 3000, np.array([0.05, 0.05, 1.0, 1e-3, 1e-3, 1e-3])
    gyro, accel, _ = measured(drive(rover_rate(n)), np.random.default_rng(0), np.zeros(3))
    found = []
    for block, more in ((attitude_hidalgo2012(part()), BARE), (attitude_ukf(part()), {})):
        u = np.zeros((n, len(block.inputs)))
        u[:, :7] = rows(gyro, accel)
        y, _ = block.run(u, p=parameters(block, std0=std0, **more))
        found.append(output(block, y, "heading_std")[-1])
    assert found[0] < 0.8 and found[1] > 1.0


def test_unit_gives_the_bits_of_the_run(log, tmp_path_factory):
    """The unit of FMI 3 with the parameters of the result."""
    result = attitude.run(log, part(), settings="hidalgo2012")
    block = attitude_hidalgo2012(part())
    path = built(block, tmp_path_factory)[3]
    given = {"start_values": dict(result.parameters), "sample_period": log.sample_period}
    y = simulate(path, rows(log.gyro, log.accel), **given)
    for name in ("q", "gyro_bias", "std", "quasi_static", "nis", "status", "heading_std"):
        np.testing.assert_array_equal(output(block, y[1:], name), getattr(result, name))
