"""The filter: its transition by perturbation, what it knows and what not, and if it is honest."""

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
from navigation_cases import SHORT, assumed, calibrated, declared, noisy, perfect, white
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from pyimu.ins import run, smoothing
from pyimu.ins.filter import ins_block, updates
from pyimu.ins.filter.layout import Layout, State
from pyimu.ins.filter.variables import POSITION_VALID
from pyimu.rover.trajectory import Drive, motion

RUNS = 40


@pytest.fixture(scope="module")
def runs_of_noise():
    """Filter and smoother over the first so many runs with white noise alone, whose turn-on biases
    are drawn from the standard deviations with which the filter starts; each is made once."""
    part, drive = white(calibrated()), replace(SHORT, vibration=0.0)
    truth = declared(perfect(drive, 50.0), drive)
    rng, found = np.random.default_rng(1), []
    settings = {f"gyro_bias_std0[{i}]": 0.01 for i in (1, 2, 3)}
    settings |= {f"accel_bias_std0[{i}]": 0.1 for i in (1, 2, 3)} | {"zupt_std": 1e-4}

    def first(count):
        for seed in range(len(found), count):
            log = noisy(truth, part, seed)
            gyro = log.gyro + rng.normal(scale=0.01, size=3)
            log = replace(log, gyro=gyro, accel=log.accel + rng.normal(scale=0.1, size=3))
            found.append(run(log, part, method="smoother", settings=settings))
        return truth, found[:count]

    return first


def mean_bounds(freedom, count):
    """99.9 % bounds of the mean of ``count`` chi-square numbers."""
    return chi2.ppf([0.0005, 0.9995], freedom * count) / count


def nees(track, truth, row):
    """Of the position in the plane."""
    std, c = track.position_std[row], track.correlation[row]
    both = c * std[0] * std[1]
    p = np.array([[std[0] ** 2, both], [both, std[1] ** 2]])
    e = track.position[row, :2] - [truth.ref_east[row], truth.ref_north[row]]
    return e @ np.linalg.solve(p, e)


@pytest.mark.long
@pytest.mark.parametrize("method", ("filter", "smoother"))
@pytest.mark.parametrize("at", (0.45, 0.7, 1.0))
def test_the_position_is_as_far_off_as_is_claimed(runs_of_noise, method, at):
    """Mean NEES over the runs, in motion and at the end, within its 99.9 % bounds."""
    truth, found = runs_of_noise(RUNS)
    row = int(at * (len(truth.time) - 1))
    tracks = [r.filter.track("filter") if method == "filter" else r.tracks[method] for r in found]
    low, high = mean_bounds(2, RUNS)
    assert low < np.mean([nees(t, truth, row) for t in tracks]) < high


@pytest.mark.long
def test_the_first_zero_velocity_of_a_stop_has_the_right_nis(runs_of_noise):
    _, found = runs_of_noise(RUNS)
    first = np.concatenate([r.first_zupts for r in found])
    assert len(first) == 4 * RUNS
    low, high = mean_bounds(3, len(first))
    assert low < first.mean() < high


@pytest.mark.long
def test_zero_rates_have_the_right_nis(runs_of_noise):
    """Those of the last stop, which follow from each other by what little is learnt of the bias."""
    _, found = runs_of_noise(RUNS)
    rows = slice(*found[0].stops[-1])
    nis = np.concatenate([r.filter.scalar("zaru_nis")[rows] for r in found])
    low, high = mean_bounds(3, len(nis))
    assert low < nis.mean() < high


def test_the_smoother_ends_where_the_filter_does_and_knows_no_less(runs_of_noise):
    for r in runs_of_noise(5)[1]:
        own, back = r.filter.track("filter"), r.tracks["smoother"]
        np.testing.assert_allclose(back.position[-1], own.position[-1], atol=1e-12)
        # the attitude's share goes with the position, and each has its own estimate of that
        other = np.linalg.norm(back.position - own.position, axis=1)[:, None]
        slack = other * np.linalg.norm(own.attitude_std, axis=1)[:, None]
        assert np.all(back.position_std <= own.position_std * (1 + 1e-6) + 1e-9 + slack)


def test_the_smoother_does_not_show_where_its_segments_are_cut(monkeypatch):
    """A part with gains to estimate, of which what follows a cut tells most."""
    log = assumed().specimen(4).simulate(motion(SHORT, 50.0), seed=4)
    tracks = []
    for size in (100, 10_000):
        monkeypatch.setattr(smoothing, "SEGMENT", size)
        tracks.append(run(log, assumed(), method="smoother").tracks["smoother"])
    for name in ("position", "velocity", "position_std"):
        cut, whole = (getattr(t, name) for t in tracks)
        # the recursion is the same; the rounding of its solutions is not
        np.testing.assert_allclose(cut, whole, atol=1e-6)


def test_smoothing_lowers_the_error_along_the_path(runs_of_noise):
    truth, found = runs_of_noise(12)
    place = np.column_stack([truth.ref_east, truth.ref_north])

    def rms(track):
        return np.sqrt(np.mean(np.sum((track.position[:, :2] - place) ** 2, axis=1)))

    pairs = [(rms(r.tracks["smoother"]), rms(r.filter.track("filter"))) for r in found]
    assert np.mean([a < b for a, b in pairs]) > 0.9


def test_a_rest_does_not_tell_a_tilt_from_a_bias(runs_of_noise):
    """Over 5 s at rest the horizontal bias stays as unknown as it was but for what the tilt's prior
    says (0.3 rad is 2.9 m/s^2), whatever the noise."""
    truth, found = runs_of_noise(5)
    row = int(np.argmax(truth.moving > 0)) - 5
    std = np.array([r.filter.vector("accel_bias_std")[row] for r in found])
    want = 1 / np.hypot(1 / 0.1, 1 / (0.3 * 9.80665))
    np.testing.assert_allclose(std[:, :2], want, rtol=0.02)
    assert std[:, 2].max() < 0.5 * want


# The transition


def states(layout, x, error):
    """The nominal values (n,) of the state x with an ``error`` (n,) added, as in the docstring."""
    q = ca.DM(x)[: layout.nominal]
    none = ca.DM(0, 1)
    symbol = State(
        q[:4], q[4:7], q[7:10], q[10:13], q[13:16], none, none, none, none, q[16:], ca.DM(15, 15)
    )
    moved = updates.changed(layout, symbol, ca.SX(ca.DM(error)))
    values = list(vars(moved).values())[:5]
    return np.array(ca.evalf(ca.vertcat(*values))).ravel()


def difference(centre, a, b):
    """The error (15,) of the nominal values b against a, of positions about a ``centre`` (3,)."""
    pair = [Rotation.from_quat(v[:4], scalar_first=True) for v in (a, b)]
    turn = pair[1] * pair[0].inv()
    about = Rotation.from_rotvec(turn.as_rotvec() * [0.0, 0.0, 1.0])
    axes = pair[0].as_matrix()
    return np.concatenate(
        [
            turn.as_rotvec(),
            turn.inv().apply(b[4:7]) - a[4:7],
            about.inv().apply(b[7:10] - centre) - (a[7:10] - centre),
            axes @ (b[10:13] - a[10:13]),
            axes @ (b[13:16] - a[13:16]),
        ]
    )


@pytest.mark.parametrize("placed", (0.0, 1.0))
def test_the_transition_is_what_the_mechanisation_makes_of_small_errors(placed):
    """F by central differences of the strapdown step itself, of a body that moves and turns, so
    well known that all of its motion counts. Where its position is measured the heading's error
    turns it about itself from then on, and else about where that was before."""
    layout, rng = Layout(white(calibrated())), np.random.default_rng(0)
    predict, h = ins_block._predict(layout), 0.01
    block = ins_block.ins_of_log(layout)
    state, _ = (np.array(v).ravel() for v in block.initial(block.start_inputs, block.start))
    turn = Rotation.from_rotvec([0.2, -0.3, 1.0]).as_quat(scalar_first=True)
    bias = rng.normal(size=6) * 0.01
    bias[3:] += Rotation.from_quat(turn, scalar_first=True).inv().apply([0.0, 0.0, 9.80665])
    state[:16] = np.concatenate([turn, [0.5, -0.3, 0.1], [3.0, 2.0, 1.0], bias])
    state[layout.centre] = [-1.0, 4.0, 2.0]
    state[layout.nominal : layout.packed] = 0.0
    memory = layout.packed + 7
    rate, force = np.array([0.1, -0.2, 0.6]), np.array([0.4, 0.3, 9.7])
    state[memory : memory + 12] = np.concatenate([rate, force, rate, state[4:7]])
    state[layout.begun] = 1.0
    p = block.start.copy()
    p[0] = 0.8
    u = block.start_inputs.copy()
    u[:6], u[POSITION_VALID] = np.concatenate([rate, force]), placed

    def after(nominal):
        s = state.copy()
        s[:16] = nominal
        return np.array(predict(s, u, p, h)[0]).ravel()[:16]

    found = np.array(predict(state, u, p, h)[-1]).reshape(15, 15).T
    base, step = after(state[:16]), 1e-5
    centre = np.array(predict(state, u, p, h)[0]).ravel()[layout.centre]
    np.testing.assert_allclose(centre, state[7:10] if placed else state[layout.centre])
    numeric = np.empty((15, 15))
    for i in range(15):
        error = np.zeros(15)
        error[i] = step
        ends = [difference(centre, base, after(states(layout, state, s * error))) for s in (1, -1)]
        numeric[:, i] = (ends[0] - ends[1]) / (2 * step)
    # what F leaves out is of the order of h^2 times a rate (0.7 rad/s) or a force (10 m/s^2)
    np.testing.assert_allclose(found, numeric, atol=h**2 * 10 * 0.6)
    biggest = np.abs(numeric - np.eye(15)).max()
    assert biggest > 100 * h**2


# What goes wrong


def test_a_gap_is_not_bridged_silently():
    """Its variance of the position is what the stated top speed allows."""
    part, drive = white(calibrated()), replace(SHORT, vibration=0.0)
    log = noisy(declared(perfect(drive), drive), part, 3)
    rows = (log.time < 7.0) | (log.time > 10.0)
    cut = replace(
        log, time=log.time[rows], **{name: values[rows] for name, values in log.groups.items()}
    )
    found = run(cut, part, method="filter", settings={"top_speed": 1.0, "top_acceleration": 5.0})
    std = found.filter.vector("position_std")
    row = int(np.searchsorted(cut.time, 10.0))
    assert 2.0 < std[row, 0] < 4.0
    assert int(found.filter.scalar("status")[row - 1]) == 0
    bare = run(log, part, method="filter").filter.vector("position_std")
    assert bare[int(np.searchsorted(log.time, 10.0)), 0] < 0.5


def test_a_rest_declared_while_it_moves_is_weighed_down_and_counted():
    part, drive = white(calibrated()), replace(SHORT, vibration=0.0)
    log = noisy(declared(perfect(drive), drive), part, 5)
    log.stationary[(log.time > 8.0) & (log.time < 8.2)] = 1.0
    found = run(log, part, method="filter")
    status = found.filter.scalar("status").astype(int)
    assert np.count_nonzero(status & 2) > 0
    assert "contradicted" in found.report()


def test_a_vehicles_constraint_lowers_the_error_of_its_path():
    part, drive = white(calibrated()), replace(SHORT, vibration=0.0, tilt=(0.0, 0.0))
    truth = declared(perfect(drive, 50.0), drive)
    pairs = []
    for seed in range(12):
        log = noisy(truth, part, 100 + seed)
        pairs.append([run(log, part, method="filter", nhc=n).errors["filter"].rms for n in (0, 1)])
    free, held = np.array(pairs).T
    assert np.median(held) < 0.8 * np.median(free)


def test_a_long_drive_on_a_steady_course_says_how_little_it_knows():
    """Without stops the standard deviation grows as its error does."""
    part = white(calibrated())
    drive = Drive(legs=1, side=30.0, first_rest=5.0, stops=0.0)
    log = noisy(declared(perfect(drive, 50.0), drive), part, 2)
    found = run(log, part, method="filter")
    row = int(np.searchsorted(log.time, 90.0))
    error = found.errors["filter"]
    std = np.hypot(*found.filter.vector("position_std")[row, :2])
    assert std > 10.0
    assert error.horizontal[row] < 5 * std
