"""Ground and suspension of ``RoverDrive`` against independent solutions."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.block.parameters import with_values
from pyimu.plant.ground import LONGEST, PRIME, SHORTEST, WAVES, boulder, uniform, waves
from pyimu.plant.suspension import Rocker
from pyimu.rover.drives import block, drive

ROCKER = Rocker()
UNEVEN = Rocker(0.6, -0.1, -0.8, 1.0, 0.4, 0.15)


# The ground


def drawn(terrain, number):
    """``uniform`` in whole numbers of Python."""
    x = terrain + 1
    for i, key in enumerate((2, 3, 5)):
        x = (x + int(key**0.5 % 1 * PRIME) + number * (7919 if i == 0 else 1)) % PRIME
        x = pow(x, 3, PRIME)
    return x / PRIME


UNIFORM = ca.Function("u", [t := ca.SX.sym("t")], [ca.vertcat(*[uniform(t, i) for i in range(24)])])


@given(st.integers(0, PRIME - 2))
def test_random_numbers_are_exact_in_doubles(terrain):
    got = np.array(UNIFORM(terrain)).ravel()
    assert got.tolist() == [drawn(terrain, i) for i in range(24)]


def test_random_numbers_of_successive_terrains_are_even_and_independent():
    """Chi-square of the cells of each number, and of pairs of numbers and of terrains; at 1e-6 each
    of 24 numbers passes but once in 40,000 runs of other constants.
    """
    u = np.array(UNIFORM.map(4000)(np.arange(4000)[None])).T
    cells = (u * 16).astype(int)
    pairs = [cells[:, i] * 16 + cells[:, i + 1] for i in range(23)]
    following = [cells[:-1, i] * 16 + cells[1:, i] for i in range(24)]
    for values, size in (*((c, 16) for c in cells.T), *((p, 256) for p in (*pairs, *following))):
        want = len(values) / size
        score = ((np.bincount(values, minlength=size) - want) ** 2 / want).sum()
        assert score < chi2.isf(1e-6, size - 1)


@pytest.mark.parametrize("terrain", [0, 1, PRIME - 2])
def test_waves_have_the_lengths_and_the_roughness_asked_for(terrain):
    found = np.array(ca.DM(waves(ca.DM(terrain)))).reshape(WAVES, 4)
    lengths = 2 * np.pi / np.hypot(found[:, 0], found[:, 1])
    assert np.all((lengths >= SHORTEST) & (lengths < LONGEST)) and np.all(np.diff(lengths) > 0)
    assert abs((found[:, 3] ** 2).sum() / 2 - 1.0) < 1e-14
    np.testing.assert_allclose(found[:, 3] / lengths, found[0, 3] / lengths[0], rtol=1e-13)


def test_a_boulder_is_as_high_and_as_wide_as_it_says():
    height = [float(boulder(ca.DM(r * r), 0.15, 0.6)) for r in (0.0, 0.15, 0.3, 0.4)]
    np.testing.assert_allclose(height, [0.15, 0.15 * 0.75**4, 0.0, 0.0], atol=1e-16)


def height(m, found, places):
    """Height (n,) m of the ground at places (n, 2), in plain numpy."""
    phase = places @ found[:, :2].T + found[:, 2]
    total = m.parameters["roughness"] * (np.sin(phase) * found[:, 3]).sum(axis=1)
    along = Rotation.from_euler("z", m.parameters["heading0"]).as_matrix()[:2, :2]
    for i in (1, 2, 3):
        size, width, *middle = (
            m.parameters[f"boulder_{n}[{i}]"] for n in ("height", "width", "forward", "left")
        )
        square = ((places - along @ middle) ** 2).sum(axis=1)
        if m.name == "obstacle":
            total += size * np.clip(1 - 4 * square / width**2, 0, None) ** 4
    return total


@pytest.mark.parametrize("name", ["obstacle", "ackermann", "turn_on_spot"])
def test_the_body_lies_on_its_six_wheels(name):
    """Heights of the ground under the wheels in numpy, the suspension by ``Rocker`` in numbers."""
    m = drive(name, sample_rate=5.0, heading0=0.4, terrain=3, roughness=0.01)
    made = block(5.0)
    p = with_values(made, {n: m.parameters[n] for n in ("terrain", "heading0")})
    found = np.array(made.initial(made.start_inputs, p)[0]).ravel()[1 : 1 + 4 * WAVES]
    heading = np.column_stack([np.cos(m.yaw), np.sin(m.yaw)])
    heights = []
    for x, y in ROCKER.wheels:
        left = np.column_stack([-heading[:, 1], heading[:, 0]])
        places = m.position[:, :2] + x * heading + y * left
        heights.append(height(m, found.reshape(WAVES, 4), places))
    want = [np.array(ca.DM(v)).ravel() for v in _poses(np.array(heights))]
    for got, by_hand in zip((m.roll, m.pitch, m.position[:, 2]), want, strict=True):
        np.testing.assert_allclose(got, by_hand, atol=1e-13)
    assert np.ptp(m.pitch) > 0.01


def _poses(heights):
    symbol = ca.SX.sym("h", 6)
    return ca.Function("pose", [symbol], list(ROCKER.pose(symbol))).map(heights.shape[1])(heights)


# The suspension


def side_by_equations(rocker, front, middle, rear):
    """Rocker's inclination and axle's height of a side, by solving the linkage for rigid bodies."""
    axle_of_bogie = np.array([(rocker.front + rocker.middle) / 2, rocker.bogie - rocker.axle])
    half = (rocker.front - rocker.middle) / 2

    def up(angle, x, z):
        """Height of a point (x, z) of a body that is inclined nose up by an angle."""
        return np.sin(angle) * x + np.cos(angle) * z

    def missing(unknown):
        axle, rise, bogie = unknown
        pivot = axle + up(rise, *axle_of_bogie)
        wheels = [
            pivot + up(bogie, half, -rocker.bogie),
            pivot + up(bogie, -half, -rocker.bogie),
            axle + up(rise, rocker.rear, -rocker.axle),
        ]
        return np.array(wheels) - [front, middle, rear]

    found, _, converged, _ = fsolve(missing, [rocker.axle, 0.0, 0.0], full_output=True, xtol=1e-14)
    assert np.abs(missing(found)).max() < 1e-12
    return found[1], found[0] - rocker.axle


HEIGHTS = st.tuples(*[st.floats(-0.12, 0.12)] * 3)


@given(HEIGHTS, st.sampled_from([ROCKER, UNEVEN]))
def test_a_side_is_the_linkage_solved_numerically(heights, rocker):
    got = [float(x) for x in rocker.side(*map(ca.DM, heights))]
    np.testing.assert_allclose(got, side_by_equations(rocker, *heights), atol=1e-10)


def wheels_in_space(rocker, unknown):
    """Heights of the six wheels of the whole suspension in three dimensions."""
    up, roll, pitch, rise, left, right = unknown
    body = Rotation.from_euler("ZYX", [0.0, pitch, roll])
    half = (rocker.front - rocker.middle) / 2
    heights = []
    for y, angle, bogie in ((rocker.track / 2, rise, left), (-rocker.track / 2, -rise, right)):
        side = Rotation.from_euler("Y", -angle)
        link = Rotation.from_euler("Y", -bogie)
        pivot = side.apply([(rocker.front + rocker.middle) / 2, y, rocker.bogie - rocker.axle])
        ends = [
            pivot + link.apply([half, 0, -rocker.bogie]),
            pivot + link.apply([-half, 0, -rocker.bogie]),
            side.apply([rocker.rear, y, -rocker.axle]),
        ]
        heights += [up + body.apply(end)[2] + rocker.axle for end in ends]
    return np.array(heights)


@given(st.tuples(*[st.floats(-0.1, 0.1)] * 6), st.sampled_from([ROCKER, UNEVEN]))
def test_the_pose_is_the_whole_suspension_but_for_the_leaning_of_its_sides(heights, rocker):
    """In space the sides lean with the body's roll, by which a link's height above its lower end
    shrinks by the share 1 - cos(roll). In an angle that is at most this share of the height of the
    links over their length, twice for two links one above the other.
    """
    roll, pitch, up = (float(x) for x in rocker.pose(ca.DM(heights)))
    start = [up, roll, pitch, 0.0, 0.0, 0.0]
    found, *_ = fsolve(
        lambda x: wheels_in_space(rocker, x) - heights, start, xtol=1e-13, full_output=True
    )
    assert np.abs(wheels_in_space(rocker, found) - heights).max() < 1e-10
    share = 1 - np.cos(found[1])
    tall = rocker.axle + 0.2  # of the links, and by how much the wheels differ
    short = rocker.front - rocker.middle
    assert abs(up - found[0]) <= share * tall + 1e-10
    assert abs(pitch - found[2]) <= 2 * share * tall / short + 1e-10
    assert abs(roll - found[1]) <= 2 * share * tall / rocker.track + 1e-10


@given(st.tuples(*[st.floats(0.0, 1.0, exclude_max=True)] * 6), st.sampled_from([ROCKER, UNEVEN]))
def test_wheels_within_reach_of_the_suspension_have_a_pose(heights, rocker):
    """Which is what the limits of the unit's parameters promise."""
    pose = rocker.pose(ca.DM(heights) * rocker.reach * (1 - 1e-9))
    assert np.isfinite([float(x) for x in pose]).all()


def test_level_ground_has_no_tilt_and_a_plane_its_own():
    flat = [float(x) for x in ROCKER.pose(ca.DM.zeros(6) + 0.02)]
    np.testing.assert_allclose(flat, [0.0, 0.0, 0.02], atol=1e-15)
    for slope in (0.05, -0.1):
        climb = [slope * x for x, _ in ROCKER.wheels]
        roll, pitch, _ = (float(x) for x in ROCKER.pose(ca.DM(climb)))
        # a bogie's axle stands upright on its link: both are inclined by the arc sine
        np.testing.assert_allclose([roll, pitch], [0.0, -np.arcsin(slope)], atol=1e-15)
        lean = [slope * y for _, y in ROCKER.wheels]
        roll, pitch, _ = (float(x) for x in ROCKER.pose(ca.DM(lean)))
        np.testing.assert_allclose([roll, pitch], [np.arcsin(slope), 0.0], atol=1e-15)


def test_over_the_boulders_the_rover_pitches_and_rolls():
    """In drive 2, and in the others only where ``boulders`` says so."""
    level = {"sample_rate": 5.0, "roughness": 0.0}
    over = drive("obstacle", **level)
    assert np.rad2deg(np.abs(over.pitch).max()) > 2 and np.rad2deg(np.abs(over.roll).max()) > 2
    without = drive("straight", **level)
    assert np.abs(without.pitch).max() < 1e-15
    np.testing.assert_array_equal(drive("straight", **level, boulders=True).outputs, over.outputs)
