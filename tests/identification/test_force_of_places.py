"""The accelerometer beside the force that a reference's attitude and positions make."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline, Slerp

import pyimu
from pyimu.identification.fit.band import Band
from pyimu.identification.fit.place import SCALE, UNKNOWN, Place
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.logs.trials import BAND_SHARE
from pyimu.identification.reference.place import BEYOND
from pyimu.identification.reference.upright import with_upright_places
from pyimu.model.kinds import OWN
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, N_INPUT
from pyimu.recording.recording import Recording

RATE, FINE, GRAVITY = 100.0, 5, 9.8
GYRO_NOISE, ACCEL_NOISE, BODY_NOISE, PLACE_NOISE = 2e-3, 0.02, 1e-4, 1e-4
PLACES = ("ref_east", "ref_north", "ref_up")
NED = Rotation.from_matrix([[0.0, 1, 0], [1, 0, 0], [0, 0, -1]])


def waves(rng, time, size, low, high):
    """Twelve waves on each of three axes, and their first and second derivatives (n, 3)."""
    frequency, phase = rng.uniform(low, high, (3, 12)), rng.uniform(0, 2 * np.pi, (3, 12))
    size, turn = size * rng.standard_normal((3, 12)) / np.sqrt(6), 2 * np.pi * frequency
    angle = turn[:, :, None] * time + phase[:, :, None]
    made = (size * turn**k for k in range(3))
    shapes = np.sin(angle), np.cos(angle), -np.sin(angle)
    return [np.einsum("ij,ijn->ni", a, s) for a, s in zip(made, shapes, strict=True)]


def hand(
    seed=1,
    minutes=2.0,
    arm=(0.0, 0.0, 0.0),
    errs=lambda force, rate: force,
    late=0.0,
    heading=0.0,
    world=None,
    reference="position",
    scale=1.0,
    lean=1.0,
):
    """A log of a hand that carries a sensor ``arm`` m from the point that cameras track, whose
    positions are ``scale`` times as large as its way; it leans by ``lean`` as far as it turns.
    """
    rng = np.random.default_rng(seed)
    fine = np.arange(round(minutes * 60 * RATE * FINE)) / (RATE * FINE)
    turned = waves(rng, fine, 0.5, 0.1, 1.2)[0] * [lean, lean, 1.0]
    attitude = RotationSpline(fine, Rotation.from_rotvec(turned))
    place, velocity, push = waves(rng, fine, 0.15, 0.2, 2.0)
    rows = np.arange(200, len(fine) - FINE, FINE)
    time, felt = fine[rows], fine[rows] - late
    arm = np.array(arm)
    rate, slope, turn = attitude(felt, 1), attitude(felt, 2), attitude(felt)
    there = np.column_stack([np.interp(felt, fine, p) for p in push.T])
    force = turn.inv().apply(there + [0.0, 0.0, GRAVITY])
    force += np.cross(slope, arm) + np.cross(rate, np.cross(rate, arm))

    def noisy(values, std):
        return values + std * rng.standard_normal(values.shape)

    body = attitude(time) * Rotation.from_rotvec(noisy(np.zeros((len(time), 3)), BODY_NOISE))
    body = body if world is None else world * body
    about = Rotation.from_rotvec([0.0, 0.0, heading])
    groups = {"ref_q": body.as_quat(scalar_first=True)}
    if reference == "position":
        seen = about.apply(noisy(scale * place[rows], PLACE_NOISE))
        groups |= dict(zip(PLACES, seen.T, strict=True))
    elif reference == "velocity":
        groups["ref_velocity"] = about.apply(noisy(velocity[rows], 20 * PLACE_NOISE))
    else:
        point = attitude(time).inv().apply(push[rows] + [0.0, 0.0, GRAVITY])
        groups = {"ref_rate": attitude(time, 1), "ref_force": point}
    return Recording.from_arrays(
        name="hand",
        time=time,
        gyro=noisy(rate, GYRO_NOISE),
        accel=noisy(errs(force, rate), ACCEL_NOISE),
        **groups,
    )


def place_of(closed):
    """The arm [m] that was found, and what the accelerometer is compared with."""
    (entry,) = [e for e in closed.references if e["sensor"] == "accel"]
    return np.array(entry["arm"]["value"]), entry


@pytest.mark.parametrize(
    "reference, late",
    [
        ("position", 0.3),
        pytest.param("position", 0.0, marks=pytest.mark.long),
        pytest.param("velocity", 0.0, marks=pytest.mark.long),
    ],
)
def test_a_blameless_accelerometer_is_examined_by_places_and_its_arm_found(reference, late):
    """With gravity 6 mm/s^2 off what it is taken for, as at another place; where the clocks are so
    far apart that force and places have nothing in common, by the clock that the gyro shows.
    """
    arm = (0.05, -0.03, 0.1)
    closed = pyimu.close(hand(arm=arm, reference=reference, late=late))
    assert closed.verdict == "clean" and not closed.not_examined, closed.report()
    found, entry = place_of(closed)
    assert entry["kind"] == reference
    # A thousandth is what the noise of the attitude, differentiated twice, makes of it.
    std = np.array(entry["arm"]["std"])
    assert np.all(np.abs(found - arm) < 5 * std + 1e-3 * np.linalg.norm(arm)), (found, std)
    for name in ("scale_factor", "turn_on_bias"):
        (one,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("accel", name)]
        assert np.all(np.abs(one.value) < 5 * one.std), (name, one.value, one.std)


def gain_and_scale(closed):
    """The accelerometer's scale factors, their errors, and the scale of the positions."""
    (one,) = [e for e in closed.estimated if (e.sensor, e.effect) == ("accel", "scale_factor")]
    (scale,) = [e["scale"] for e in closed.references if e["sensor"] == "accel"]
    return one.value, one.std, scale


@pytest.mark.parametrize(
    "scale, gain",
    [
        (1.03, np.zeros(3)),
        pytest.param(1.0, np.array([0.03, -0.02, 0.01]), marks=pytest.mark.long),
        pytest.param(0.97, np.array([0.02, 0.02, 0.02]), marks=pytest.mark.long),
    ],
)
def test_the_scale_of_positions_is_no_scale_factor_of_the_accelerometer(scale, gain):
    """Gravity tells them apart as far as it is known at an unknown place, 0.15 %."""
    log = hand(arm=(0.05, -0.03, 0.1), scale=scale, errs=lambda f, w: f * (1.0 + gain))
    closed = pyimu.close(log)
    assert closed.verdict == "clean" and not closed.added, closed.report()
    value, std, found = gain_and_scale(closed)
    assert np.all(np.abs(value - gain) < 5 * std) and np.all(std < 0.0025), (value, std)
    assert found["value"] == pytest.approx(scale, abs=5 * found["std"]) and found["std"] < 0.0025
    said = [f for f in closed.quality if f.kind == "positions_scale"]
    assert bool(said) is found["told"] is (scale != 1.0), said
    if said:
        assert said[0].detail["low"] < scale < said[0].detail["high"]
        assert "times as large as the way of the body" in closed.report()


def quiet_part():
    """A part that declares the noise of ``hand`` and no error."""
    part = Part("hand", RATE)
    for kind, noise in (("gyro", GYRO_NOISE), ("accel", ACCEL_NOISE)):
        N = [noise / np.sqrt(RATE)] * 3
        walk = {"rate_random_walk": {"K": [1e-7] * 3}}
        part = part.with_sensor(Sensor(kind, {"angle_random_walk": {"N": N}} | walk))
    return part


@pytest.mark.parametrize(
    "scale, gain",
    [
        (1.03, np.array([0.02, 0.02, 0.02])),
        pytest.param(1.03, np.zeros(3), marks=pytest.mark.long),
        pytest.param(1.0, np.array([0.01, 0.0, 0.0]), marks=pytest.mark.long),
    ],
)
def test_beside_a_declared_part_gravity_tells_which_of_the_two_is_off(scale, gain):
    """Both are, in the first: of gains that all axes share none is seen by itself."""
    log = hand(arm=(0.05, -0.03, 0.1), scale=scale, errs=lambda f, w: f * (1.0 + gain))
    closed = pyimu.close(log, part=quiet_part())
    assert closed.verdict == ("named" if gain.any() else "clean"), closed.report()
    assert {(a.sensor, a.effect) for a in closed.added} <= {("accel", "scale_factor")}
    (found,) = [e["scale"] for e in closed.references if e["sensor"] == "accel"]
    assert found["value"] == pytest.approx(scale, abs=5 * found["std"]) and found["std"] < 0.0025
    if gain.any():
        value, std, _ = gain_and_scale(closed)
        at = np.isfinite(std) & (gain != 0.0)
        assert np.all(np.abs(value - gain)[at] < 5 * std[at]) and at.sum() == np.sum(gain != 0.0)


def test_the_scale_of_positions_acts_on_what_moves_the_body_alone():
    """R^T (k a + g) is the force that is given and (k - 1) of the scale's unknown, a hand's a."""
    rng = np.random.default_rng(3)
    q = Rotation.random(50, random_state=rng)
    push, up = rng.standard_normal((50, 3)), np.array([0.0, 0.0, GRAVITY])
    u = np.zeros((50, N_INPUT))
    u[:, OWN["accel"]] = q.inv().apply(push + up)
    u[:, COLUMNS["attitude"]] = q.as_quat(scalar_first=True)
    place = Place.of(u, np.arange(50) / RATE, GRAVITY, 0.015, scale_std=0.03)
    larger = u[:, OWN["accel"]] + 0.1 * place.forces[SCALE].T
    np.testing.assert_allclose(larger, q.inv().apply(1.1 * push + up), atol=1e-12)
    assert place.std[SCALE] == 0.03 and SCALE not in place.where and SCALE in place.unknown
    noise = rng.standard_normal((50, 3))
    more = place.scattered(noise).forces[SCALE] - place.forces[SCALE]
    np.testing.assert_allclose(more.T, noise, atol=1e-12)


@pytest.mark.long
def test_what_the_accelerometer_lacks_is_named_by_places():
    """A cubic of 2e-4 (m/s^2)^-2 on y, beside a part that nobody declared."""
    cubic = np.array([0.0, 2e-4, 0.0])
    closed = pyimu.close(hand(arm=(0.05, -0.03, 0.1), errs=lambda f, w: f + cubic * f**3))
    assert [(a.sensor, a.effect) for a in closed.added] == [("accel", "scale_factor_cubic")], (
        closed.report()
    )
    found = {e.effect: e for e in closed.estimated if e.sensor == "accel"}
    for name, value in (("scale_factor_cubic", 2e-4), ("scale_factor", 0.0)):
        assert found[name].value[1] == pytest.approx(value, abs=5 * found[name].std[1])


@pytest.mark.long
@pytest.mark.parametrize("heading", [1.0, -2.8])
def test_positions_in_axes_of_another_heading_are_turned_and_said(heading):
    closed = pyimu.close(hand(arm=(0.05, -0.03, 0.1), heading=heading))
    assert closed.verdict == "clean" and not closed.not_examined, closed.report()
    (found,) = [f for f in closed.quality if f.kind == "reference_heading"]
    assert found.detail["degrees"] == pytest.approx(np.degrees(abs(heading)), abs=0.1)
    way = "clockwise" if heading > 0.0 else "counter-clockwise"
    assert f" deg {way} about the vertical" in closed.report()


@pytest.mark.long
def test_attitudes_of_another_world_leave_the_accelerometer_out():
    closed = pyimu.close(hand(world=NED))
    assert not closed.added and closed.verdict == "undecidable"
    assert "positions and attitude" in closed.not_examined["accel"]


@pytest.mark.long
@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_positions_of_another_unit_leave_the_accelerometer_out(factor):
    log = hand(minutes=1.5)
    places = {n: factor * getattr(log, n) for n in PLACES}
    closed = pyimu.close(replace(log, **places))
    assert not closed.added and "metres" in closed.not_examined["accel"], closed.report()


@pytest.mark.long
def test_positions_of_a_few_rows_are_none():
    log = hand(minutes=1.5)
    few = {n: np.where(np.arange(len(log)) < 4, getattr(log, n), np.nan) for n in PLACES}
    closed = pyimu.close(replace(log, **few))
    assert "no reference of its force" in closed.not_examined["accel"]


def test_a_force_that_is_given_for_another_point_is_no_error_of_the_accelerometer():
    closed = pyimu.close(hand(arm=(0.3, 0.0, -0.1), reference="force"))
    assert closed.verdict == "clean" and not closed.not_examined, closed.report()
    found, entry = place_of(closed)
    np.testing.assert_allclose(found, (0.3, 0.0, -0.1), atol=5 * max(entry["arm"]["std"]) + 1e-4)


def test_a_short_arm_of_a_force_that_is_given_is_the_size_effect():
    """5 mm: no body is tracked so near its sensor, and a tactical unit is as large."""
    closed = pyimu.close(hand(arm=(0.005, 0.0, 0.0), reference="force"))
    assert [(a.sensor, a.effect) for a in closed.added] == [("accel", "size_effect")]


@pytest.mark.long
def test_a_force_at_the_sensor_has_no_arm():
    closed = pyimu.close(hand(reference="force"))
    assert closed.verdict == "clean"
    assert all(e["arm"] is None for e in closed.references)


@pytest.mark.long
def test_positions_between_frames_are_those_of_the_frames():
    """Brought from 40 Hz to the sensor's rate by lines and shortest arcs, as resampling does it."""
    log = hand(arm=(0.05, -0.03, 0.1))
    frames = np.arange(log.time[0] + 0.0013, log.time[-1], 0.025)
    inside = (log.time >= frames[0]) & (log.time <= frames[-1])
    curve = RotationSpline(log.time, Rotation.from_quat(log.ref_q, scalar_first=True))
    groups = {"time": log.time[inside], "gyro": log.gyro[inside], "accel": log.accel[inside]}
    arcs = Slerp(frames, curve(frames))
    groups["ref_q"] = arcs(groups["time"]).as_quat(scalar_first=True)
    for name in PLACES:
        nodes = CubicSpline(log.time, getattr(log, name))(frames)
        groups[name] = np.interp(groups["time"], frames, nodes)
    closed = pyimu.close(Recording.from_arrays(name="hand", **groups))
    _, entry = place_of(closed)
    assert closed.verdict == "clean", closed.report()
    assert entry["sample_rate"]["value"] == pytest.approx(40.0, rel=1e-3)


def test_what_was_differentiated_is_no_noisier_about_the_ends_of_a_stretch():
    """White positions, differentiated twice, through the low-pass and the band that it is for: 4000
    stretches have first and last rows whose variance is that of one from the middle within five
    standard errors of the ratio, 5 sqrt(4 / 4000). Turned about the one noisy row at an end they
    would have up to eighty times that.
    """
    n, stretches, cutoff = 1200, 4000, 4.0
    rng, time = np.random.default_rng(3), np.arange(n) / RATE
    pushed = np.diff(1e-3 * rng.standard_normal((n + 2, stretches)), 2, axis=0) * RATE**2
    place = Place(0.0, 0.0, np.zeros((UNKNOWN, 3, n)), np.zeros((n, 3)), time, cutoff)
    band = Band.below(BAND_SHARE * cutoff / BEYOND, RATE)
    rows = band.apply(place.below(pushed, [(0, n)]), [(0, n)])
    variance = np.mean(rows**2, axis=1)
    middle = variance[len(rows) // 2]
    np.testing.assert_allclose(variance[[0, -1]] / middle, 1.0, atol=5 * np.sqrt(4 / stretches))


Y_UP = Rotation.from_euler("x", -np.pi / 2)


def sideways(log, world=Y_UP):
    """The log with attitudes and positions as an optical system of another vertical has them."""
    places = world.apply(np.column_stack([getattr(log, n) for n in PLACES]))
    attitude = world * Rotation.from_quat(log.ref_q, scalar_first=True)
    q = attitude.as_quat(scalar_first=True)
    return replace(log, ref_q=q, **dict(zip(PLACES, places.T, strict=True)))


def test_attitudes_and_positions_with_y_up_are_turned_level():
    """As they were but for their heading, which nothing measures; and not the positions of
    attitudes whose z points down, which may be in another world than these.
    """
    log = hand(minutes=1.0)
    trials = [gyro_trial(sideways(log))]
    level = with_upright_places(sideways(log), trials).reference
    (found,) = level.findings
    assert (found.kind, found.detail["way"]) == ("reference_sideways", "y points up")
    was, now = (Rotation.from_quat(r.ref_q, scalar_first=True) for r in (log, level))
    about = now * was.inv()
    np.testing.assert_allclose(about.apply([0.0, 0.0, 1.0])[:, 2], 1.0, atol=1e-12)
    np.testing.assert_allclose(level.ref_up, log.ref_up, atol=1e-12)
    for other in (log, sideways(log, NED)):
        assert with_upright_places(other, [gyro_trial(other)]) is other


@pytest.mark.long
def test_an_accelerometer_beside_cameras_with_y_up_is_examined():
    closed = pyimu.close(sideways(hand(arm=(0.05, -0.03, 0.1))))
    assert closed.verdict == "clean" and not closed.not_examined, closed.report()
    assert "in a world in which y points up: undone" in closed.report()
    assert place_of(closed)[1]["kind"] == "position"
