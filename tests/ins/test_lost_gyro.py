"""A gyro without numbers or at its limit: only the axis that is lost may have turned, and a heading
that nobody knows is not made up."""

from dataclasses import replace

import numpy as np
import pytest
from navigation_cases import SHORT, calibrated, declared, noisy, perfect, white
from scipy.spatial.transform import Rotation

from pyimu.ins import run
from pyimu.ins.compensated import compensated
from pyimu.recording.recording import Recording
from pyimu.units import STANDARD_GRAVITY

FAR = 5.0
"""Standard deviations that no estimate of these runs is off by."""

TRUE_YAW, LATITUDE = 2.0, 0.8


@pytest.fixture(scope="module")
def log():
    return declared(noisy(perfect(SHORT), calibrated(), 3), SHORT)


def with_gyro(log, rows, axes, value):
    gyro = log.gyro.copy()
    gyro[np.ix_(rows, axes)] = value
    return replace(log, gyro=gyro)


def filtered(log, **settings):
    return run(log, calibrated(), method="filter", settings=settings).filter


def yaw_off(log, found):
    """deg; by how much the heading at the end differs from the reference's, less at the start."""
    off = np.unwrap(found.scalar("yaw")) - yaw_of(log.ref_q)
    return abs(np.degrees(off[-1] - off[0] + np.pi) % 360 - 180)


def yaw_of(q):
    w, x, y, z = q.T
    return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def end_off(log, found):
    """m, and the standard deviation that is claimed of it."""
    place = found.vector("position")[-1, :2] - [log.ref_east[-1], log.ref_north[-1]]
    return np.linalg.norm(place), np.linalg.norm(found.vector("position_std")[-1, :2])


@pytest.mark.parametrize("axis", (0, 1))
def test_an_axis_about_which_the_body_did_not_turn_costs_no_heading(log, axis):
    """Three seconds without numbers about roll or pitch. What it does to the yaw is of second order
    in the angle that the last rate's noise makes until it has faded out, 0.012 rad."""
    lost = with_gyro(log, (log.time > 7.0) & (log.time < 10.0), [axis], np.nan)
    found = filtered(lost)
    assert yaw_off(log, found) < yaw_off(log, filtered(log)) + 0.2
    off, std = end_off(log, found)
    assert off < FAR * std


@pytest.mark.parametrize("axes", ([2], [0, 1, 2]))
def test_a_heading_that_may_be_any_stays_as_it_was(log, axes):
    """On a straight leg nothing is turned, and a gyro that is lost there leaves the heading unknown
    but where it is: the stops that follow turn it by less than a tenth of what is claimed of it. It
    was turned by 100 deg."""
    straight = (log.time > 6.0) & (log.time < 8.5)
    assert np.abs(np.degrees(np.diff(yaw_of(log.ref_q[straight])))).sum() < 1.0
    found = filtered(with_gyro(log, straight, axes, np.nan))
    claimed = np.degrees(found.vector("attitude_std")[-1, 2])
    assert claimed > 90.0
    assert yaw_off(log, found) < 0.1 * claimed
    off, std = end_off(log, found)
    assert off < FAR * std


def test_a_rate_at_its_limit_counts_as_far_as_it_goes(log):
    """Of turns of 45 deg/s a gyro that ends at 40 shows eight ninths."""
    limit = np.radians(40.0)
    part = calibrated()
    values = part.gyro.values | {"saturation": {"limit": np.full(3, limit)}}
    part = part.with_sensor(replace(part.gyro, values=values))
    clipped = replace(log, gyro=np.clip(log.gyro, -limit, limit))
    found = run(clipped, part, method="filter").filter
    turned = np.degrees(np.abs(np.diff(yaw_of(log.ref_q))).sum())
    assert yaw_off(log, found) < turned / 9 + 6.0


def test_a_part_is_undone_axis_by_axis(log):
    """Scale factors of 2 % and of -3 %, of a gyro that has no numbers about x for a while."""
    gains = {"gyro": np.array([0.02, 0.0, -0.03]), "accel": np.array([0.0, 0.01, 0.0])}
    part = calibrated()
    for kind, s in gains.items():
        sensor = part.sensor(kind)
        part = part.with_sensor(replace(sensor, values=sensor.values | {"scale_factor": {"s": s}}))
    off = replace(log, gyro=log.gyro * (1 + gains["gyro"]), accel=log.accel * (1 + gains["accel"]))
    rows = (log.time > 7.0) & (log.time < 8.0)
    lost = with_gyro(off, rows, [0], np.nan)
    found = compensated(lost, part)
    np.testing.assert_allclose(found.gyro, with_gyro(log, rows, [0], np.nan).gyro, atol=1e-12)
    np.testing.assert_allclose(found.accel, log.accel, atol=1e-12)
    ends = [run(r, p, method="filter") for r, p in ((off, part), (log, calibrated()))]
    places = [e.filter.vector("position")[-1] for e in ends]
    np.testing.assert_allclose(places[0], places[1], atol=1e-6)


def at_rest(noise, seconds=120.0, h=0.02):
    """What a filter has for the yaw at the end of a rest, and its standard deviations of attitude,
    by that of the heading it began with, which was 0.1 rad off."""
    n, rng = round(seconds / h), np.random.default_rng(5)
    earth = 7.292115e-5 * np.array([0.0, np.cos(LATITUDE), np.sin(LATITUDE)])
    to_body = Rotation.from_euler("z", TRUE_YAW).inv()
    up = np.tile([0.0, 0.0, STANDARD_GRAVITY], (n, 1))
    part = white(calibrated())
    quiet = {"angle_random_walk": {"N": np.full(3, noise)}}
    part = part.with_sensor(replace(part.gyro, values=part.gyro.values | quiet))
    log = Recording.from_arrays(
        time=h * np.arange(n),
        gyro=np.tile(to_body.apply(earth), (n, 1))
        + noise / np.sqrt(h) * rng.standard_normal((n, 3)),
        accel=up + 0.003 * rng.standard_normal((n, 3)),
        stationary=np.ones(n),
    )
    small = {f"gyro_bias_std0[{i}]": 1e-7 for i in (1, 2, 3)}

    def end(std):
        how = {"settings": small | {"heading_std0": std}, "heading0": TRUE_YAW - 0.1}
        found = run(log, part, method="filter", latitude=LATITUDE, **how).filter
        return found.scalar("yaw")[-1], found.vector("attitude_std")[-1]

    return end


def test_the_earths_rate_turns_a_heading_that_is_nearly_known():
    """By a gyro of 3e-7 rad/sqrt(s). A tilt, which the accelerometer's bias hides, turns the rate
    about the vertical into one to the east: that of a heading off by tilt tan(latitude)."""
    yaw, std = at_rest(3e-7)(0.2)
    tilt = std[:2].max()
    assert std[2] == pytest.approx(tilt * np.tan(LATITUDE), rel=0.05)
    assert abs(yaw - TRUE_YAW) < 3 * std[2]


def test_it_does_not_turn_a_heading_of_which_nothing_is_known():
    """By a gyro of 1e-3 rad/sqrt(s): it was turned by tens of degrees."""
    yaw, std = at_rest(1e-3)(3.0)
    assert std[2] == pytest.approx(3.0, rel=1e-2)
    assert abs(yaw - (TRUE_YAW - 0.1)) < 1e-3
