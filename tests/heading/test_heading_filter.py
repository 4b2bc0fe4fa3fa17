"""The heading filter: exact where there is no noise, honest where there is, the same as a unit."""

import numpy as np
import pytest
from built import built
from fmu_toy import Unit
from heading_cases import H, K, N, log, measured, turns
from scipy.stats import chi2

from pyimu.attitude.heading.estimator import MOVED, about_the_vertical, heading_estimator
from pyimu.attitude.heading.variables import INPUTS, STATUS
from pyimu.errors import UserError
from pyimu.fmu import FORMS, simulate, simulate_blocks
from pyimu.heading import HeadingFilter
from pyimu.model.part import Part
from pyimu.model.part_file import part as part_of
from pyimu.model.sensor import Sensor

G = 9.80665


def part(n=N, k=K, **more):
    gyro = {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k}} | more
    return Part(
        "test", 1 / H, Sensor("gyro", gyro), Sensor("accel", {"angle_random_walk": {"N": 1e-3}})
    )


def rows(n, **values):
    """Inputs (n, 9) of the block, level and at rest."""
    u = np.zeros((n, len(INPUTS)))
    for v, column in zip(INPUTS, u.T, strict=True):
        column[:] = v.start
    names = [v.name for v in INPUTS]
    for name, value in values.items():
        u[:, names.index(name)] = value
    return u


def run(block, u, **start):
    """Outputs (n,) by name."""
    p, at = block.start.copy(), {v.name: i for i, v in enumerate(block.parameters)}
    for name, value in start.items():
        p[at[name]] = value
    y, _ = block.run(u, p=p)
    return {v.name: y[:, i] for i, v in enumerate(block.outputs)}


def kalman(gyro, still, n, k, std0, s0):
    """The same filter in plain numpy, rests declared: heading, bias and scale factor, and their
    covariance, by matrices of the textbook.
    """
    x, P = np.array([0.0, 0.0, s0]), np.diag(np.square(std0))
    for m, rests in zip(gyro, still, strict=True):
        g, moves = 1 / (1 + x[2]), 1.0 - rests
        r = g * (m - x[1])
        F = np.array([[1, -g * H * moves, -g * r * H * moves], [0, 1, 0], [0, 0, 1]])
        x = x + np.array([r * H * moves, 0, 0])
        Q = np.zeros((3, 3))
        Q[0, 0] = moves * g**2 * (n**2 * H + k**2 * H**3 / 3)
        Q[0, 1] = Q[1, 0] = -moves * g * k**2 * H**2 / 2
        Q[1, 1] = k**2 * H
        P = F @ P @ F.T + Q
        if rests:
            S = P[1, 1] + n**2 / H + 1e-10
            gain = P[:, 1] / S
            x, P = x + gain * (m - x[1]), P - np.outer(gain, P[1])
    return x, P


def test_it_is_the_kalman_filter_of_the_textbook():
    """To the least noise that the block adds, 1e-10 of K and 1e-9 of N."""
    rng = np.random.default_rng(1)
    rate = turns(rng, 60.0)
    gyro, still = measured(rate, rng, 0.01, 0.02), (rate == 0).astype(float)
    std0 = (0.02, 0.03, 0.01)
    found = run(
        heading_estimator(part()),
        rows(len(rate), gyro_z=gyro, stationary=still),
        scale_factor0=0.008,
        rest_time=0.0,
        **{f"std0[{i + 1}]": v for i, v in enumerate(std0)},
    )
    x, P = kalman(gyro, still, N, K, std0, 0.008)
    got = [found[name][-1] for name in ("turned", "bias", "scale_factor")]
    std = [found[name][-1] for name in ("heading_std", "bias_std", "scale_factor_std")]
    np.testing.assert_allclose(got, x, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(std, np.sqrt(np.diag(P)), rtol=1e-6)


@pytest.mark.parametrize("declared", [True, False])
def test_heading_and_bias_are_as_good_as_claimed(declared):
    """The mean of squared errors over their variance of 40 runs is chi-squared, to 1 in 1e4; with
    rests that are detected there is more that may go wrong, and it may be half as much again."""
    squares = []
    for i in range(40):
        rng = np.random.default_rng([4, i])
        rate = turns(rng, 100.0)
        s, b = 0.01 * rng.standard_normal(), 0.02 * rng.standard_normal()
        still = (rate == 0).astype(float)
        shake = 0.5 * rng.standard_normal((len(rate), 3)) * (1 - still[:, None])
        force = shake + [0.0, 0.0, G] + 1e-3 / np.sqrt(H) * rng.standard_normal((len(rate), 3))
        u = rows(len(rate), gyro_z=measured(rate, rng, s, b))
        u[:, 1:4] = force
        if declared:
            u[:, -1] = still
        found = run(
            heading_estimator(part()), u, **{"std0[1]": 0.0, "std0[2]": 0.02, "std0[3]": 0.01}
        )
        truth = H * np.sum(rate)
        squares.append(
            [
                ((found["turned"][-1] - truth) / found["heading_std"][-1]) ** 2,
                ((found["scale_factor"][-1] - s) / found["scale_factor_std"][-1]) ** 2,
            ]
        )
        assert found["at_rest"].any()
    low, high = chi2.ppf([1e-4, 1 - 1e-4], 40) / 40
    nees = np.mean(squares, axis=0)
    assert (nees > low).all() and (nees < high * (1.0 if declared else 1.5)).all(), nees


def test_a_rest_makes_no_heading_of_noise():
    """Ten minutes at rest, whose noise would turn it by N sqrt(600 s); what the run takes for sway,
    which it knows from some thirty values, is a share of it."""
    rng = np.random.default_rng(2)
    gyro = measured(np.zeros(30_000), rng, b=0.01)
    found = run(heading_estimator(part()), rows(len(gyro), gyro_z=gyro), **{"std0[1]": 0.0})
    assert found["at_rest"].mean() > 0.95
    assert abs(found["turned"][-1]) < 4 * found["heading_std"][-1]
    assert found["heading_std"][-1] < 0.5 * N * np.sqrt(600.0)
    assert abs(found["bias"][-1] - 0.01) < 0.01


def test_a_heading_corrects_the_start_and_one_that_contradicts_is_said():
    block = heading_estimator(part())
    valid = np.zeros(500)
    valid[:100] = 1
    u = rows(500, heading=3.0, heading_valid=valid, heading_variance=1e-4)
    found = run(block, u, **{"heading0": 2.9, "std0[1]": 0.2})
    assert found["yaw"][-1] == pytest.approx(3.0, abs=1e-2)
    assert not found["status"].any()
    wrong = run(block, u, **{"heading0": 1.0, "std0[1]": 0.01})
    assert int(wrong["status"][0]) & 64 and 64 in STATUS


def test_a_heading_is_compared_on_the_circle():
    """3.1 and -3.1 rad are 0.083 rad apart."""
    u = rows(200, heading=-3.1, heading_valid=1, heading_variance=1e-6)
    found = run(heading_estimator(part()), u, **{"heading0": 3.1, "std0[1]": 0.1})
    assert not found["status"].any()
    assert found["turned"][-1] == pytest.approx(2 * np.pi - 3.1, abs=1e-3)
    assert found["yaw"][-1] == pytest.approx(-3.1, abs=1e-3)


def test_a_missing_gyro_widens_the_heading_by_the_unknown_rate():
    """One number of standard deviation 1 rad/s over a second is 1 rad; in the next it may turn
    back, and 2 rad^2 are added.
    """
    gyro = np.zeros(400)
    gyro[200:300] = np.nan
    found = run(
        heading_estimator(part()),
        rows(400, gyro_z=gyro),
        **{"rest_time": 0.0, "std0[1]": 0.0, "std0[2]": 0.0, "std0[3]": 0.0},
    )
    assert found["heading_std"][299] == pytest.approx(3.0**0.5, rel=1e-3)
    assert (found["status"][200:300].astype(int) & 1).all() and not found["status"][:200].any()


@pytest.mark.parametrize("bad", [np.nan, 1e9, 200.0])
def test_a_missing_sample_of_a_turn_holds_the_last_rate(bad):
    """Every tenth, missing, absurd, or more than half a turn in a period; turning at 0.5 rad/s."""
    gyro = np.full(1000, 0.5)
    gyro[5::10] = bad
    found = run(heading_estimator(part()), rows(1000, gyro_z=gyro), rest_time=0.0)
    assert found["turned"][-1] == pytest.approx(0.5 * 1000 * H, rel=1e-12)
    assert (found["status"][5::10] == (2 if bad == 200.0 else 1)).all()


def test_the_unit_has_no_parameter_without_effect():
    """Of a gyro with noise, a range and rounding on three axes, those about the vertical."""
    block = heading_estimator(part_of("mpu6050"))
    names = [v.name for v in block.parameters]
    assert "gyro_error.saturation.limit[3]" in names and "gyro_error.quantization.q[3]" in names
    assert not [n for n in names if n.startswith("gyro") and n.endswith(("[1]", "[2]"))]
    depends = {
        c
        for f, at in ((block.step, 2), (block.initial, 1))
        for y in (0, 1)
        for c in f.jac_sparsity(y, at).get_triplet()[1]
    }
    assert depends == set(range(len(names)))


def test_it_runs_without_an_accelerometer_and_without_a_rest():
    rng = np.random.default_rng(3)
    rate = 0.3 + 0.1 * np.sin(5 * np.arange(3000) * H)
    track = HeadingFilter(part()).run(log(measured(rate, rng, k=0.0), H * np.cumsum(rate)))
    assert not track.at_rest.any()
    # Without a rest the bias is never seen: of consumer parts it is 0.1 rad/s.
    assert track.heading_std[-1] == pytest.approx(0.1 * 60, rel=0.1)


def test_errors_of_one_axis_are_undone_and_the_others_are_named():
    """A bias of 0.001 rad/s/K over 20 K; misalignment needs the other axes."""
    gyro = part_of("imt30").gyro.with_values("misalignment").with_values("time_delay", td=0.01)
    one = part_of("imt30").with_sensor(gyro)
    left = about_the_vertical(one)
    assert "misalignment" not in left.gyro.values and "time_delay" not in left.gyro.values
    assert "thermal_bias" in left.gyro.values
    text = heading_estimator(one).description
    assert "misalignment" in text and "time_delay" in text
    warm = part(thermal_bias={"kT": [0, 0, 1e-3], "T0": 25.0})
    found = run(
        heading_estimator(warm), rows(500, gyro_z=0.02, temperature=45.0), **{"rest_time": 0.0}
    )
    np.testing.assert_allclose(found["turned"], 0.0, atol=1e-12)


def test_an_unknown_setting_is_refused():
    with pytest.raises(UserError, match="rest_time"):
        HeadingFilter(part(), settings={"rest_tme": 1.0}).run(log(np.zeros(100)))


@pytest.fixture(scope="module")
def fmus(tmp_path_factory):
    return built(heading_estimator(part()), tmp_path_factory)


def eventful(n=800, missing=True):
    """Inputs (n, 9) with turns, shaking, rests, headings and ``missing`` samples."""
    rng = np.random.default_rng(8)
    rate = np.where(np.arange(n) % 300 < 150, 0.0, 0.4)
    u = rows(n, gyro_z=measured(rate, rng, 0.01, 0.01), heading=H * np.cumsum(rate))
    u[:, 1:4] += np.where(rate[:, None] == 0, 0.0, 0.5 * rng.standard_normal((n, 3)))
    u[::100, 6], u[700:, 8] = 1, 1
    if missing:
        u[450:455, 0] = np.nan
    return u


@pytest.mark.parametrize("form", FORMS)
def test_the_unit_gives_the_bits_of_python(fmus, form):
    # A row of NaN reaches the row before it in fmpy's scalar forms; see the next test for those.
    block, u = heading_estimator(part()), eventful(missing=form == "block")
    y, _ = block.run(u)
    make = simulate_blocks if form == "block" else simulate
    found = make(fmus[form], u, sample_period=H)
    np.testing.assert_array_equal(found[1:], y)
    assert y[:, [v.name for v in block.outputs].index("at_rest")].any()


@pytest.mark.parametrize("form", (2, 3))
def test_a_state_taken_back_makes_the_same_run_again(fmus, form):
    u = eventful()
    with Unit(fmus[form]).start() as unit:
        unit.run(u[:400], period=H)
        state = unit.save()
        first = unit.run(u[400:], first=400, period=H)
        unit.restore(state)
        np.testing.assert_array_equal(unit.run(u[400:], first=400, period=H), first)
        unit.release(state)


@pytest.mark.parametrize("drift", [2e-3, -3.5e-3])
def test_a_gyro_that_warms_up_as_its_part_does_not_say_is_known_anew_by_each_rest(drift):
    """Rests of 8 s every 25 s, and a bias that goes away in minutes: each rest is seen, and shows
    the bias to five standard deviations of what its mean does, and half of a drift that is too
    small to show at its beginning: what was known of the bias before counts as much as the rest.
    """
    n, seconds, period, still = 3e-4, 300.0, 25.0, 8.0
    time = H * np.arange(round(seconds / H))
    moving = time % period >= still
    bias = drift * (1 - np.exp(-time / 60.0))
    block = heading_estimator(part(n, 2e-6))
    for seed in range(4):
        rng = np.random.default_rng(seed)
        rate = 0.5 * np.sin(2 * np.pi * time / 7 + seed) * moving
        gyro = rate + bias + n / np.sqrt(H) * rng.standard_normal(len(time))
        shaken = 0.3 * moving * rng.standard_normal(len(time))
        level = 1e-3 / np.sqrt(H) * rng.standard_normal(len(time))
        y = run(
            block,
            rows(len(time), **{"gyro_z": gyro, "accel[1]": shaken + level, "accel[3]": G - level}),
        )
        seen = (time % period > 2.5) & (time % period < still - 0.5)
        assert y["at_rest"][seen].all()
        ends = np.flatnonzero(seen & ~np.roll(seen, -1))
        hidden = np.sqrt(MOVED * (1 / still + 1 / 1.5))
        assert np.abs(y["bias"] - bias)[ends].max() < n * (hidden / 2 + 5 / np.sqrt(still))
