"""The motion of ``RoverDrive``: where the drives lead, and that attitude, rate, position and force
are those of one motion.
"""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pyimu.block.parameters import with_values
from pyimu.errors import UserError
from pyimu.rover.drives import block, drive, free_drive

ROUGH = {"roughness": 0.01, "terrain": 11, "lever_arm": (0.2, -0.1, 0.4), "heading0": 0.7}
SHAKEN = {
    "motor_frequency": 3.0,
    "motor_rate": (0.01, 0.02, 0.03),
    "motor_force": (0.1, 0.2, 0.3),
    "tread_rate": (0.01, 0.02, 0.01),
    "tread_force": (0.05, 0.02, 0.03),
}
SHORT = {"start_time": 2.0, "length": 0.3, "angle": 0.4, "boulder_forward": (0.8, 0.1, 4.0)}
NAMES = ("straight", "obstacle", "ackermann", "turn_on_spot")


def attitude(m):
    return Rotation.from_quat(m.q, scalar_first=True)


def planet(m):
    """The planet's rate (3,) rad/s in east-north-up axes."""
    latitude = m.parameters["latitude"]
    return m.parameters["rotation_rate"] * np.array([0, np.cos(latitude), np.sin(latitude)])


def turning(m):
    """Rate (n, 3) against the ground, body axes."""
    return m.rate - attitude(m).inv().apply(planet(m))


# Where the drives lead: Hidalgo 2012, section 6.1


def rounding(m):
    """What rounding may leave: a handful of operations on metres and radians."""
    return 32 * np.finfo(float).eps * max(5.0, np.pi)


@pytest.mark.parametrize("name", ["straight", "obstacle"])
def test_straight_drives_end_after_5_m_without_a_turn(name):
    m = drive(name, sample_rate=10.0, heading0=0.3, roughness=0.0)
    way = m.position[:, :2] @ np.array([np.cos(0.3), np.sin(0.3)])
    across = m.position[:, :2] @ np.array([-np.sin(0.3), np.cos(0.3)])
    assert abs(way[-1] - 5.0) <= rounding(m)
    assert np.abs(across).max() <= rounding(m) and np.all(np.diff(way) >= 0)
    assert np.abs(m.yaw - 0.3).max() <= rounding(m)
    assert m.speed.max() <= 0.01 * (1 + 1e-12) or name == "obstacle"


def test_ackermann_is_half_a_circle_of_1_25_m():
    m = drive("ackermann", sample_rate=10.0)
    from_centre = m.position[:, :2] - [0.0, 1.25]
    assert np.abs(np.linalg.norm(from_centre, axis=1) - 1.25).max() <= rounding(m)
    assert np.abs(m.position[-1, :2] - [0.0, 2.5]).max() <= rounding(m)
    assert abs(abs(m.yaw[-1]) - np.pi) <= rounding(m)
    cruising = (m.time > 62) & (m.time < 60 + np.pi * 125)
    np.testing.assert_allclose(m.turn_rate[cruising], 0.008, rtol=1e-12)


def test_turn_on_the_spot_goes_to_180_deg_and_back():
    m = drive("turn_on_spot", sample_rate=10.0, pause=1.0)
    assert np.abs(m.position[:, :2]).max() == 0.0
    yaw = np.unwrap(m.yaw)
    assert abs(yaw.max() - np.pi) <= rounding(m) and abs(yaw[-1]) <= rounding(m)
    assert np.abs(m.turn_rate).max() <= 0.02 * (1 + 1e-12)
    np.testing.assert_array_equal(m.q[-1], m.q[0])  # it stands where it stood, on the same ground


@pytest.mark.parametrize("name", NAMES)
def test_it_stands_before_and_after_and_nowhere_else(name):
    m = drive(name, sample_rate=50.0, **ROUGH | SHORT)
    moving = np.flatnonzero(m.standing == 0)
    between = m.standing[moving[0] : moving[-1]]
    turns_back = 2 if name == "turn_on_spot" else 0  # for an instant, without speed or acceleration
    assert between.sum() <= turns_back
    assert abs(m.time[moving[0]] - 2.0) < 0.05  # the first cm/s^2 of the ramp are no motion
    still = m.standing == 1
    assert np.abs(turning(m)[still]).max() < 1e-5
    np.testing.assert_allclose(np.linalg.norm(m.specific_force[still], axis=1), 9.80665, rtol=1e-6)
    before, after = m.outputs[m.time < 1.9], m.outputs[-50:]
    assert np.ptp(before[:, :16], axis=0).max() == 0 and np.ptp(after[:, :16], axis=0).max() == 0


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.long] * (n == "obstacle")) for n in NAMES]
)
def test_the_sample_rate_does_not_change_the_motion(name):
    """976 and 50 Hz have every half second in common. There the times differ by their rounding,
    2^-52 of some 60 s, and the motion by that times its derivatives, which stay below 30 SI units.
    """
    fine = drive(name, sample_rate=976.0, **ROUGH | SHORT | SHAKEN)
    coarse = drive(name, sample_rate=50.0, **ROUGH | SHORT | SHAKEN)
    n = int(min(fine.time[-1], coarse.time[-1]) * 2)
    a, b = fine.outputs[487::488][:n], coarse.outputs[24::25][:n]
    yaw = [2, 6]  # q and -q, pi and -pi
    assert np.abs(a - b)[:, [i for i in range(a.shape[1]) if i not in yaw]].max() < 30 * 60 * 2**-52


# Attitude and rate, position and force


def turn_left_over(m):
    """What the rate leaves of the turn over two samples (rad), its bound, and the largest turn.

    The midpoint rule over 2 h errs by (2 h)^3 (omega''/24 + omega x omega'/12) (Magnus expansion,
    Iserles and Norsett 1999); the derivatives are differences, the factor 1.5 is for what they miss
    between the samples, and rounding is that of a quaternion.
    """
    h, turn, omega = m.time[0], attitude(m), turning(m)
    steps = Rotation.from_rotvec(2 * h * omega[1:-1])
    left = (steps.inv() * turn[:-2].inv() * turn[2:]).magnitude()
    slope = np.linalg.norm(np.diff(omega, axis=0), axis=1).max() / h
    bend = np.linalg.norm(np.diff(omega, 2, axis=0), axis=1).max() / h**2
    largest = np.linalg.norm(omega, axis=1).max()
    bound = 1.5 * (2 * h) ** 3 * (bend / 24 + largest * slope / 12) + 16 * np.finfo(float).eps
    return left, bound, 2 * h * largest


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("shaken", [False, True])
def test_integrated_rate_less_the_planets_is_the_attitude(name, shaken):
    more = SHAKEN if shaken else {}
    m = drive(name, sample_rate=50.0, rest=1.0, **ROUGH | SHORT | more)
    left, bound, largest = turn_left_over(m)
    assert left.max() <= bound < 0.1 * largest


def force_by_differences(m):
    """Specific force (n - 4, 3) from second differences of the sensor's position, and its bound.

    A second difference errs by h^2/12 of the fourth derivative, which the fourth difference says,
    and by 4 roundings of the position over h^2, gravity by those of a rotation; the velocity's
    error, h^2/6 of the third derivative, enters times twice the planet's rate. A position near
    nought is the difference of lengths of the vehicle, tenths of a metre.
    """
    h, turn = m.time[1] - m.time[0], attitude(m)
    arm = [m.parameters[f"lever_arm[{i}]"] for i in (1, 2, 3)]
    place = m.position + turn.apply(arm)
    second = np.diff(place, 2, axis=0)[1:-1] / h**2
    fourth = np.abs(np.diff(place, 4, axis=0)).max() / h**4
    velocity = (place[3:-1] - place[1:-3]) / (2 * h)
    gravity = np.array([0, 0, m.parameters["gravity"]])
    force = second + 2 * np.cross(planet(m), velocity) + gravity
    lengths = max(np.abs(place).max(), 0.1)
    rounding = 16 * np.finfo(float).eps * (lengths / h**2 + gravity[2])
    bound = 1.5 * h**2 / 12 * fourth + rounding
    return turn[2:-2].inv().apply(force), bound


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("shaken", [False, True])
def test_second_differences_of_the_position_are_the_force(name, shaken):
    more = SHAKEN if shaken else {}
    m = drive(name, sample_rate=50.0, rest=1.0, **ROUGH | SHORT | more)
    found, bound = force_by_differences(m)
    assert np.abs(found - m.specific_force[2:-2]).max() <= np.sqrt(3) * bound
    assert bound < 0.2 * np.abs(m.specific_force - m.specific_force[0]).max()


def test_the_lever_arm_adds_the_force_of_a_rigid_body():
    """Groves 2013, section 2.2: alpha x l + omega x (omega x l), and the planet's 2 omega_e x v.

    The angular acceleration is a central difference, wrong by h^2/6 of its second derivative, which
    the third difference of the rate says.
    """
    arm = np.array([0.3, -0.2, 0.5])
    given = {"sample_rate": 50.0, "rest": 1.0} | ROUGH | SHORT | SHAKEN
    with_arm = drive("turn_on_spot", **given | {"lever_arm": arm})
    at_origin = drive("turn_on_spot", **given | {"lever_arm": (0, 0, 0)})
    h, omega = with_arm.time[0], turning(at_origin)
    alpha = (omega[2:] - omega[:-2]) / (2 * h)
    w = omega[1:-1]
    of_planet = attitude(at_origin).inv().apply(planet(at_origin))[1:-1]
    velocity = np.cross(w, arm)
    want = np.cross(alpha, arm) + np.cross(w, velocity) + 2 * np.cross(of_planet, velocity)
    got = (with_arm.specific_force - at_origin.specific_force)[1:-1]
    bound = np.abs(np.diff(omega, 3, axis=0)).max() / h / 6 * np.linalg.norm(arm) * 1.5 * np.sqrt(3)
    assert np.abs(got - want).max() <= bound + 1e-12 < 0.3 * np.abs(got).max()


def test_speed_is_the_velocity_along_the_body():
    m = drive("obstacle", sample_rate=50.0, rest=1.0, **ROUGH | SHORT)
    velocity = (m.position[2:] - m.position[:-2]) / (2 * m.time[0])
    along = attitude(m)[1:-1].inv().apply(velocity)[:, 0]
    third = np.abs(np.diff(m.position, 3, axis=0)).max() / m.time[0] / 6 * 1.5 * np.sqrt(3)
    assert np.abs(along - m.speed[1:-1]).max() <= third + 1e-12 < 1e-4


@pytest.mark.parametrize("name", NAMES)
def test_the_acceleration_of_a_move_has_no_jumps(name):
    """The force changes from sample to sample by less and less: by h times a bounded jerk."""
    steps = [
        np.abs(
            np.diff(drive(name, sample_rate=f, rest=1.0, **ROUGH | SHORT).specific_force, axis=0)
        ).max()
        for f in (50.0, 200.0)
    ]
    assert steps[1] < 0.3 * steps[0]


def test_angles_are_those_of_the_attitude():
    m = drive("ackermann", sample_rate=20.0, **ROUGH)
    want = attitude(m).as_euler("ZYX")
    np.testing.assert_allclose(np.column_stack([m.yaw, m.pitch, m.roll]), want, atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(m.q, axis=1), 1.0, rtol=4e-16 * 8)


# Free drives


COMMANDS = st.lists(
    st.tuples(st.floats(0.3, 3.0), st.floats(-0.03, 0.03), st.floats(-0.05, 0.05)),
    min_size=1,
    max_size=5,
)


@settings(max_examples=15, deadline=None)
@given(COMMANDS)
def test_a_free_drive_goes_as_far_as_its_commands_say(commands):
    """The three lags have gain 1: distance and heading are the integrals of the commands, once it
    stands again. The way between is that of a fine integration.
    """
    durations, speeds, rates = np.array(commands).T
    durations = np.round(durations * 50) / 50
    times = np.concatenate([[0.0], np.cumsum(durations)])
    times = np.round(times, 2)  # or a sum may lie beyond its sample by rounding
    table = np.column_stack([times, [*speeds, 0.0], [*rates, 0.0]])
    m = free_drive(table, sample_rate=50.0, rest=20.0, roughness=0.0, ramp_time=1.0)
    assert abs(np.unwrap(m.yaw)[-1] - durations @ rates) < 1e-12
    fine = free_drive(table, sample_rate=400.0, rest=20.0, roughness=0.0, ramp_time=1.0)
    mean = (fine.turn_rate[1:] + fine.turn_rate[:-1]) / 2
    heading = np.concatenate([[0.0], np.cumsum(mean / 400.0)]) + fine.yaw[0]
    way = fine.speed[:, None] * np.column_stack([np.cos(heading), np.sin(heading)])
    place = np.cumsum((way[1:] + way[:-1]) / 800.0, axis=0)[-1] + fine.position[0, :2]
    assert np.abs(m.position[-1, :2] - place).max() < 1e-6
    # The last sample is there or not as the end of the table rounds.
    there = fine.outputs[7::8]
    count = min(len(m.time), len(there))
    assert len(m.time) - count <= 1
    np.testing.assert_allclose(m.outputs[:count], there[:count], atol=1e-9)


def test_force_and_rate_of_a_free_drive_are_those_of_its_motion():
    table = np.array([[0.0, 0.02, 0.0], [3.0, 0.03, 0.05], [8.0, -0.01, -0.02], [14.0, 0.0, 0.0]])
    m = free_drive(table, sample_rate=100.0, rest=5.0, boulders=True, **ROUGH | SHAKEN)
    found, bound = force_by_differences(m)
    assert np.abs(found - m.specific_force[2:-2]).max() <= np.sqrt(3) * bound
    assert bound < 0.2 * np.abs(m.specific_force - m.specific_force[0]).max()
    left, turned_bound, largest = turn_left_over(m)
    assert left.max() <= turned_bound < 0.1 * largest
    assert m.standing[-1] == 1 and m.standing[:1000].max() == 0


def test_a_missing_command_is_the_last_one():
    made = block(50.0)
    p = with_values(made, {"drive": 0})
    u = np.tile([0.02, 0.01], (100, 1))
    holes = u.copy()
    holes[20:40, 0], holes[50, 1], holes[60, 0] = np.nan, np.nan, np.inf
    np.testing.assert_array_equal(made.run(holes, p=p)[0], made.run(u, p=p)[0])


@pytest.mark.parametrize("number", range(5))
def test_half_and_half_is_the_whole_run(number):
    made = block(50.0)
    p = with_values(made, {"drive": number, "start_time": 1.0, **ROUGH, **SHAKEN})
    u = np.random.default_rng(2).standard_normal((600, 2)) * 0.01
    whole, last = made.run(u, p=p)
    first, state = made.run(u[:250], p=p)
    second, end = made.run(u[250:], p=p, state=state)
    np.testing.assert_array_equal(np.vstack([first, second]), whole)
    np.testing.assert_array_equal(end, last)


ANY = st.fixed_dictionaries(
    {
        "terrain": st.integers(0, 10**7),
        "heading0": st.floats(-4.0, 4.0),
        "roughness": st.floats(0.0, 0.02),
        "boulders": st.booleans(),
        "boulder_height": st.tuples(*[st.floats(0.0, 0.1)] * 3),
        "boulder_width": st.tuples(*[st.floats(0.3, 1.5)] * 3),
        "boulder_forward": st.tuples(*[st.floats(-1.0, 1.0)] * 3),
        "boulder_left": st.tuples(*[st.floats(-1.0, 1.0)] * 3),
        "lever_arm": st.tuples(*[st.floats(-1.0, 1.0)] * 3),
        "latitude": st.floats(-1.5, 1.5),
        "cruise_speed": st.floats(0.01, 0.1),
        "ramp_time": st.floats(0.5, 2.0),
        "radius": st.floats(0.5, 5.0),
    }
)


@settings(max_examples=20, deadline=None)
@given(st.sampled_from(NAMES), ANY, st.sampled_from(["Earth", "Mars", "Moon"]))
def test_on_any_ground_attitude_rate_place_and_force_are_of_one_motion(name, parameters, body):
    more = {"start_time": 1.0, "length": 0.5, "angle": 0.2, "body": body}
    try:
        m = drive(name, sample_rate=50.0, rest=1.0, **parameters, **more)
    except UserError as refused:
        # A fast drive along a narrow curve may be over before its ramp is.
        assume("shorter than its ramp_time" not in str(refused))
        raise
    found, bound = force_by_differences(m)
    assert np.abs(found - m.specific_force[2:-2]).max() <= np.sqrt(3) * bound
    left, bound, _ = turn_left_over(m)
    assert left.max() <= bound
