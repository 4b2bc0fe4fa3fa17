"""Late sensors: their samples are brought to the rows, or the outputs turned on over the delay."""

import numpy as np
import pytest
from attitude_cases import GRAVITY, H, output, parameters
from scipy.spatial.transform import Rotation

from pyimu.attitude import attitude_ukf, run
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

SWING, PULSATION = 0.5, 2 * np.pi
"""rad, rad/s: of a body that swings about its first axis, from rest, with up to 3 rad/s."""

N, REST = 3000, 0.5
FASTER = SWING * PULSATION**2
"""rad/s^2; largest angular acceleration."""

EVEN_TURN = FASTER * H**2 / 8
"""rad; by so much at most an angle departs from its chord over a period."""

LATE = {
    "delay": {"time_delay": {"td": 0.0234}},
    "second-order lag": {"lag": {"wn": 60.0, "zeta": 0.70710678}},
    "first-order lag": {"first_order_lag": {"tau": 0.0234}},
    "lag and delay": {"lag": {"wn": 120.0, "zeta": 0.70710678}, "time_delay": {"td": 0.0117}},
}
"""All of about 23 ms, in which the body turns by 4 degrees."""


def angle(t):
    return np.where(t > REST, SWING * (1 - np.cos(PULSATION * (t - REST))), 0)


def rate_at(t):
    return np.where(t > REST, SWING * PULSATION * np.sin(PULSATION * (t - REST)), 0)


def swing(instant: bool = True) -> tuple[np.ndarray, np.ndarray, np.ndarray, Rotation]:
    """Time (N,), true rate and force (N, 3), and attitude at the rows.

    The rate is that of the row's ``instant``, else the mean of the period that it ends.
    """
    time = H * np.arange(1, N + 1)
    rate = np.zeros((N, 3))
    rate[:, 0] = rate_at(time) if instant else (angle(time) - angle(time - H)) / H
    attitude = Rotation.from_euler("x", angle(time)[:, None])
    return time, rate, attitude.inv().apply([0, 0, GRAVITY]), attitude


def part(gyro: dict, accel: dict, n: float = 1e-5) -> Part:
    return Part(
        "test",
        1 / H,
        Sensor("gyro", {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": 1e-6}, **gyro}),
        Sensor("accel", {"angle_random_walk": {"N": 1e-2}, **accel}),
    )


def measured(late: Part, seed: int | None = None):
    """The recording, and the attitude at its rows.

    A gyro of which the part says no delay has mean rates of periods.
    """
    time, rate, force, attitude = swing(instant=any(e.delay for e in late.gyro.effects))
    block = late.block
    u = np.hstack([rate, force, np.full((N, 1), 25.0)])
    y, _ = block.run(u, seed=seed) if seed is not None else block.run(u)
    return Recording("swing", time=time, gyro=y[:, :3], accel=y[:, 3:6]), attitude


def off(q: np.ndarray, truth: Rotation) -> np.ndarray:
    return (Rotation.from_quat(q, scalar_first=True).inv() * truth).magnitude()


START = {"q0": [1, 0, 0, 0]}

KNOWN = START | {"std0": [1e-4] * 3 + [1e-5] * 3}
"""A start from which the gyro turns the attitude on; what gravity adds to it is less."""

LEFT = "first-order lag"
"""What the inverse of this one leaves of the force tilts an attitude that begins unsure: by 1.9e-3
rad at most, a sixth of its standard deviation there."""

AFTER = slice(100, -10)
"""Rows for which there are samples, once the sensors have swung in."""


def prompt(start: dict) -> float:
    """By how much the filter errs at most from a ``start`` with sensors that are not late."""
    log, truth = measured(part({}, {}))
    return off(run(log, part({}, {}), **start).q, truth)[AFTER].max()


@pytest.fixture(scope="module")
def without_delay():
    return prompt(START)


@pytest.mark.parametrize(
    "kind, start", [*((k, KNOWN) for k in LATE), *((k, START) for k in LATE if k != LEFT)]
)
def test_a_late_sensor_is_brought_to_its_rows(kind, start):
    """To what the filter errs by without the delay, the turn between two samples, and of a lag the
    third order of its delay, (2 zeta / wn)^3 / 6 times the third derivative of the angle.
    """
    late = part(LATE[kind], LATE[kind])
    log, truth = measured(late)
    result = run(log, late, **start)
    third = (0.0234 * PULSATION) ** 3 * SWING / 2
    assert off(result.q, truth)[AFTER].max() < 1.2 * prompt(start) + EVEN_TURN + third
    assert off(run(log, part({}, {}), **start).q, truth)[AFTER].max() > 0.05
    assert result.left_in == ()


SHORT = {"time_delay": {"td": 0.2 * H}}
"""A delay below half a period: the sum of period times rates is the turn until later than the last
row."""


@pytest.mark.parametrize("accel", [{}, SHORT], ids=["unsaid", "as late"])
def test_a_delay_below_half_a_period_is_brought_to_the_rows(accel, without_delay):
    """To what the filter errs by without it, the turn between two samples, and what the rate of its
    middle leaves out of a period's turn, h^2/24 of the rate's change. An accelerometer of which
    nothing is said is of its row then.
    """
    late = part(SHORT, accel)
    log, truth = measured(late)
    middle = H**2 / 24 * FASTER
    found = off(run(log, late, q0=[1, 0, 0, 0]).q, truth)[AFTER]
    assert found.max() < 1.2 * without_delay + EVEN_TURN + middle
    assert off(run(log, part({}, {}), q0=[1, 0, 0, 0]).q, truth)[AFTER].max() > 0.008


def test_a_unit_with_a_delay_below_half_a_period_turns_back():
    """To the second order, (h/2 - d)^2 w'/2, and within its standard deviations."""
    late = part(SHORT, SHORT)
    log, truth = measured(late)
    block = attitude_ukf(late)
    u = np.tile([v.start for v in block.inputs], (N, 1))
    u[:, :6] = np.hstack([log.gyro, log.accel])
    y, _ = block.run(u, p=parameters(block, std0=np.array([1e-3] * 3 + [1e-6] * 3)))
    error = off(output(block, y, "q"), truth)[AFTER]
    assert error.max() < 1.2 * (0.3 * H) ** 2 * FASTER / 2 + EVEN_TURN
    assert (error < 3 * output(block, y, "std")[AFTER, 0]).all()


def test_an_accelerometer_of_another_delay_is_brought_to_the_gyros_instant():
    """An accelerometer that is later by D: taken to be as late as the gyro, the force is off by the
    turn over D; brought to it, by how the rate changes meanwhile, half of D w of it.
    """
    later, own = 0.03, {"time_delay": {"td": 0.0534}}
    late, alike = part(LATE["delay"], own), part(LATE["delay"], LATE["delay"])
    log, truth = measured(late)
    found, other = (off(run(log, p, q0=[1, 0, 0, 0]).q, truth)[AFTER] for p in (late, alike))
    known = (found**2).mean() ** 0.5, (other**2).mean() ** 0.5
    assert known[0] < PULSATION * later * known[1] + EVEN_TURN


def test_after_the_last_sample_the_turn_goes_on_and_the_standard_deviation_admits_it():
    """A delay of 25 samples: what the rows have that no sample is of any more."""
    far = {"time_delay": {"td": 0.25}}
    log, truth = measured(part(far, far))
    result = run(log, part(far, far), q0=[1, 0, 0, 0])
    error = off(result.q, truth)[-20:]
    std = np.linalg.norm(result.std[-20:, :3], axis=1)
    assert error[-1] > 0.1 and (error < 3 * std).all()
    assert (std < 3 * error.max()).all() and result.std[-40, 0] < 0.01


@pytest.mark.parametrize("kind", LATE)
def test_a_unit_turns_on_over_the_delay(kind):
    """What is left is of the second order, d^2 w'/2, and within its standard deviations."""
    late = part(LATE[kind], LATE[kind])
    log, truth = measured(late)
    shown, taken = (attitude_ukf(late, now) for now in (True, False))
    u = np.tile([v.start for v in shown.inputs], (N, 1))
    u[:, :6] = np.hstack([log.gyro, log.accel])
    p = parameters(shown, std0=np.array([1e-3] * 3 + [1e-6] * 3))
    (y, _), (before, _) = (block.run(u, p=p) for block in (shown, taken))
    error = off(output(shown, y, "q"), truth)[AFTER]
    second = 0.024**2 * FASTER / 2
    if kind != "first-order lag":
        assert off(output(taken, before, "q"), truth)[AFTER].max() > 0.05
    assert error.max() < 1.2 * second + 0.005
    std = output(shown, y, "std")[AFTER, 0]
    assert (error < 3 * std + 0.005).all()


def test_the_noise_of_the_prediction_is_in_the_standard_deviation():
    """A body at rest, a gyro of much noise and a long delay: the errors of the outputs are as large
    as said, by the chi-squared distribution of 200 runs' end, at 1e-4.
    """
    from scipy.stats import chi2

    late = part({"time_delay": {"td": 0.2}}, {}, n=5e-3)
    block = attitude_ukf(late)
    u = np.tile([v.start for v in block.inputs], (40, 1))
    rng, squares = np.random.default_rng(0), []
    p = parameters(block, std0=np.array([1e-6] * 3 + [1e-8] * 3), accel_std=100.0)
    for _ in range(200):
        u[:, :3] = 5e-3 / np.sqrt(H) * rng.standard_normal((40, 3))
        y, _ = block.run(u, p=p)
        error = off(output(block, y, "q")[-1:], Rotation.identity(1))[0]
        squares.append((error / output(block, y, "std")[-1, 0]) ** 2)
    low, high = chi2.ppf([1e-4, 1 - 1e-4], 600)
    # The change of the rate that the filter sees is noise here, and is counted a second time.
    assert 0.5 * low < sum(squares) < high


def test_a_heading_is_of_now_and_the_estimate_of_before():
    """A body that turns by 1 rad/s about the vertical with a delay of 0.2 s: a heading of now, and
    one that is 0.1 s and 0.3 s old, keep the yaw that is shown where it is.
    """
    late = part({"time_delay": {"td": 0.2}}, {})
    block = attitude_ukf(late)
    t = H * np.arange(1, 1001)
    u = np.tile([v.start for v in block.inputs], (1000, 1))
    u[:, 2] = 1.0
    names = [v.name for v in block.inputs]
    at = {n: names.index(n) for n in names if n.startswith("heading")}
    for age in (0.0, 0.1, 0.3):
        u[:, at["heading_valid"]] = np.arange(1000) % 20 == 19
        u[:, at["heading"]] = t - age
        u[:, at["heading_variance"]] = 1e-4
        u[:, at["heading_age"]] = age
        y, _ = block.run(u, p=parameters(block, std0=np.array([1e-3, 1e-3, 0.5] + [1e-6] * 3)))
        yaw = output(block, y, "yaw")
        off_by = (yaw - t + np.pi) % (2 * np.pi) - np.pi
        assert np.abs(off_by[-100:]).max() < 0.01


@pytest.mark.parametrize("kind", ["delay", "second-order lag"])
def test_both_forms_of_the_filter_show_the_same(kind):
    from pyimu.attitude.filter.sigma_point_filter import sigma_point_filter

    late = part(LATE[kind], LATE["first-order lag"])
    log, _ = measured(late)
    one, other = attitude_ukf(late), sigma_point_filter(late)
    u = np.tile([v.start for v in one.inputs], (N, 1))
    u[:, :6] = np.hstack([log.gyro, log.accel])
    p = parameters(one, std0=np.full(6, 1e-3))
    (a, _), (b, _) = one.run(u[:300], p=p), other.run(u[:300], p=p)
    np.testing.assert_allclose(output(one, a, "q"), output(one, b, "q"), atol=1e-7)
    np.testing.assert_allclose(output(one, a, "std"), output(one, b, "std"), rtol=1e-3)
