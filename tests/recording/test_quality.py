"""Quality findings: faults put into clean samples must be found at their place, and clean samples
raise nothing.
"""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from places import measured

from pyimu.identification.fit.bad_rows import bad_samples
from pyimu.recording.log import read_recording
from pyimu.recording.quality.clipping import clipped, clipping_level, touched_level
from pyimu.recording.quality.inspect import inspect
from pyimu.recording.quality.resolution import quantization_step
from pyimu.recording.quality.spikes import spikes
from pyimu.recording.quality.stuck import FALSE_ALARMS, stuck_runs
from pyimu.recording.recording import Recording
from pyimu.report.meaning import MEANING

G = 9.80665


def real(name):
    return read_recording(measured(name))


def recording(gyro=None, accel=None, period=0.01, **groups):
    n = len(gyro if gyro is not None else accel)
    return Recording.from_arrays(
        "log", time=np.arange(n) * period, gyro=gyro, accel=accel, **groups
    )


def noise(n=20_000, sigma=0.01, seed=0):
    return sigma * np.random.default_rng(seed).standard_normal((n, 3))


def driven(n=20_000, seed=0):
    """Rate (n, 3) of a varied motion with noise."""
    t = np.arange(n) * 0.01
    motion = np.column_stack(
        [3 * np.sin(2 * t) * np.sin(0.1 * t), 2 * np.sin(5 * t), np.sin(11 * t) * np.cos(0.3 * t)]
    )
    return motion + noise(n, seed=seed)


def found(r, kind):
    return {f.column: f for f in inspect(r) if f.kind == kind}


# Clean samples raise nothing


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("signal", [noise, driven])
def test_clean_samples_raise_nothing(signal, seed):
    r = recording(signal(seed=seed), signal(seed=seed + 100) + [0, 0, G])
    assert inspect(r) == ()


@pytest.mark.parametrize("step", [0.3, 1.0, 2.0])
def test_coarse_comb_at_rest_raises_only_its_step(step):
    """Quantized at up to two sigma a static sensor repeats itself often; that is no stuck
    sample.
    """
    r = recording(np.round(noise(200_000, 1.0) / step) * step)
    assert {f.kind for f in inspect(r)} == {"quantization_step"}


def test_sine_and_constant_rate_are_no_clipping():
    t = np.arange(20_000) * 0.01
    table = np.clip(3 * np.sin(0.5 * t), -2, 2)
    assert not clipped(2 * np.sin(t) + noise()[:, 0]).any()
    assert not clipped(table + noise()[:, 0]).any()


@pytest.mark.parametrize("taken_out", [0.0, 1e-6, 0.1])
def test_a_coarse_converters_topmost_value_is_no_limit(taken_out):
    """Turns at 44.6 deg/s behind steps of 0.98 deg/s, wider than the band that a plateau has: the
    topmost value has its share of a normal law, less than the next one. A limit is still one. So it
    is where a bias of some deg/s that drifts was taken out since, and no two samples are equal.
    """
    bias = taken_out * np.arange(2400) / 2400
    for seed in range(20):
        noise = 0.4 * np.random.default_rng(seed).standard_normal(2400)
        turns = np.repeat([0.0, 44.6] * 4, 300) + noise
        assert not clipped(np.round(turns / 0.98) * 0.98 + bias).any()
    swings, limit = 60.0 * np.sin(np.arange(2400) / 40) + noise, 43 * 0.98
    cut = np.round(np.minimum(swings, limit) / 0.98) * 0.98 + bias
    assert clipped(cut)[swings > limit].all() and not clipped(cut)[swings < limit - 0.98].any()


def test_empty_accelerometer_and_short_recordings():
    assert inspect(recording(noise(3))) == ()
    assert inspect(recording(accel=np.full((100, 3), np.nan))) == ()


# Faults


@settings(max_examples=30, deadline=None)
@given(start=st.integers(10, 19_000), length=st.integers(5, 50))
def test_stuck_run_is_found_at_its_place(start, length):
    values = driven()[:, 0]
    values[start : start + length] = values[start]
    assert stuck_runs(values) == [(start, start + length)]


def test_stuck_runs_in_a_thousandth_of_the_samples():
    values = noise()
    for start in range(500, 20_000, 5000):
        values[start : start + 5, 1] = values[start, 1]
    assert found(recording(values), "stuck_samples")["gyro_y"].count == 20


@pytest.mark.parametrize(
    ("again", "kind"), [("by chance", "repeated_samples"), ("every 17th", "held_samples")]
)
def test_repeats_of_all_axes_are_of_their_sensor(again, kind):
    """Even ones are of a sensor slower than its log: 16 samples in 17 rows."""
    rng, rows = np.random.default_rng(2), np.arange(8192)
    same = rng.uniform(size=len(rows)) < 0.06 if again == "by chance" else rows % 17 == 16
    gyro = rng.normal(size=(len(rows), 3))[np.maximum.accumulate(np.where(same, 0, rows))]
    log = Recording.from_arrays("log", time=0.01 * rows, gyro=gyro, accel=9.81 + 0 * gyro)
    (found,) = [f for f in inspect(log) if f.kind in ("repeated_samples", "held_samples")]
    assert (found.kind, found.column) == (kind, "gyro")
    if kind == "held_samples":
        assert found.detail["rows"] == pytest.approx(17 / 16, abs=1e-3)
    else:
        assert found.count == np.sum(same[1:])


def test_stuck_threshold_is_that_of_the_geometric_law():
    """On a comb with repeat probability p the shortest stuck run of n samples has n (1 - p) p^(m -
    1) < 0.001.
    """
    rng, n = np.random.default_rng(3), 100_000
    values = rng.integers(0, 4, n).astype(float)
    shortest = next(m for m in range(5, 99) if n * 0.75 * 0.25 ** (m - 1) < FALSE_ALARMS)
    assert stuck_runs(values) == []
    values[5000 : 5000 + shortest + 4] = values[4999] + 1
    assert len(stuck_runs(values)) == 1


@pytest.mark.parametrize("size", [0.15, -0.5, 30])
def test_spike_is_found_at_its_place(size):
    values = noise()
    values[777, 2] += size
    assert np.argwhere(spikes(values)).tolist() == [[777, 2]]
    assert found(recording(values), "spikes")["gyro_z"].detail["largest"] == pytest.approx(
        abs(size), rel=0.3
    )


def test_corrupt_row_is_a_spike_in_every_column():
    values = driven()
    values[777] = 100
    assert np.argwhere(spikes(values)).tolist() == [[777, 0], [777, 1], [777, 2]]


@pytest.mark.parametrize("rows", [[777, 779, 785], [777, 778], [777, 790]])
def test_spikes_near_each_other_are_found(rows):
    values = driven()
    values[rows, 1] += [5, -8, 6][: len(rows)]
    assert np.argwhere(spikes(values)).tolist() == [[row, 1] for row in rows]


@pytest.mark.parametrize("seed", range(3))
def test_one_sample_in_200_may_be_a_spike(seed):
    """Of 300 in three columns some five have three more within a window, or one at the next row but
    one in another column."""
    rng, values = np.random.default_rng(seed), driven(seed=seed)
    hit = rng.random(values.shape) < 0.005
    values += hit * rng.uniform(3, 30, hit.shape) * rng.choice([-1, 1], hit.shape)
    found = spikes(values)
    assert not np.any(found & ~hit) and np.sum(found) > 0.95 * np.sum(hit)


def with_gaps(every, lost=30):
    """A motion of which ``lost`` of ``every`` rows are missing, and the numbers of the others."""
    rows = np.setdiff1d(np.arange(20_000), np.add.outer(np.arange(100, 19_900, every), range(lost)))
    return driven()[rows], rows


@pytest.mark.parametrize("every", [5000, 2000, 500])
def test_the_edges_of_a_gap_are_no_spikes(every):
    """Beside a gap a sample has no neighbours to be judged by."""
    values, rows = with_gaps(every)
    r = Recording.from_arrays("log", time=rows * 0.01, gyro=values)
    assert len(r.segments) == 1 + 20_000 // every and not found(r, "spikes")


@pytest.mark.parametrize("near", [2, 3, 10])
def test_a_spike_near_a_gap_is_found(near):
    values, rows = with_gaps(5000)
    values[100 + near, 1] += 5
    r = Recording.from_arrays("log", time=rows * 0.01, gyro=values)
    assert np.argwhere(spikes(values, r.segments)).tolist() == [[100 + near, 1]]
    assert found(r, "spikes")["gyro_y"].detail["first_row"] == 100 + near


@pytest.mark.parametrize("mark", [spikes, lambda v: bad_samples(v, []) & np.isfinite(v)])
def test_what_is_beside_missing_samples_of_a_fast_motion_is_no_spike(mark):
    """Beside a line across them every sample would be one, those that are left again, and so on."""
    values = 10 * driven() - 9 * noise()
    values[12_000, 0] += 5
    values[3000:3040] = np.nan
    assert np.argwhere(mark(values)).tolist() == [[12_000, 0]]


def test_shock_is_no_spike():
    """A decaying vibration of all axes after an impact."""
    values = noise()
    t = np.arange(100) * 0.01
    values[5000:5100] += (2 * np.exp(-t / 0.05) * np.cos(2 * np.pi * 20 * t))[:, None] * [
        1,
        0.5,
        -0.7,
    ]
    assert not spikes(values).any()


@pytest.mark.parametrize("sigma", [0, 1e-3])
def test_clipping_is_found_with_its_level(sigma):
    """Before and after a small correction that moves the level, slowly."""
    wander = sigma * np.sin(np.arange(20_000) * 0.003)
    values = np.clip(driven()[:, 0], -2.2, 2.5) + wander
    low, high = clipping_level(values)
    assert (low, high) == pytest.approx((-2.2, 2.5), abs=2 * sigma + 1e-9)
    assert clipped(values).sum() == pytest.approx(
        np.sum(np.abs(values - 0.15 - wander) >= 2.35 - 1e-9), rel=0.1
    )


def test_a_signal_that_is_at_one_limit_or_the_other_most_of_the_time_is_clipped():
    """Two thirds of a sine of twice the limit lie at it: the extremes are all that is quiet."""
    t = np.linspace(0.0, 40.0 * np.pi, 20_000)
    values = np.clip(2.0 * np.sin(t) + noise()[: len(t), 0], -1.0, 1.0)
    assert clipping_level(values) == (-1.0, 1.0)


def test_clipping_of_one_side():
    assert clipping_level(np.minimum(driven()[:, 0], 2.5))[0] is None


@pytest.mark.parametrize("step", [0.0, 1e-3])
def test_a_level_that_single_samples_touch(step):
    """The six highest of 20,000, none beside another, and of a converter's: no plateau."""
    values = np.random.default_rng(0).laplace(size=20_000)
    level = np.sort(values)[-6] if not step else step * np.floor(np.sort(values)[-6] / step)
    values = np.minimum(step * np.round(values / step) if step else values, level)
    assert clipping_level(values) == (None, None)
    assert touched_level(values) == (None, pytest.approx(level))


@pytest.mark.parametrize("step", [0.0, 1e-4, 1e-3, 1e-2, 0.1])
def test_extremes_of_a_free_sensor_are_no_level(step):
    """Noise, turns that reverse smoothly or stand at their ends, samples that hold, and a motion
    that repeats to the last digit: a side is taken for a level by chance once in 10,000."""
    rng, n = np.random.default_rng(0), 5000
    turn = 9.8 * np.sin(np.cumsum(rng.uniform(0, 0.1, n)))
    for values in (
        rng.standard_normal(n),
        rng.laplace(size=n),
        turn,
        turn + 0.02 * rng.standard_normal(n),
        np.where(np.arange(n) % 300 < 100, 2.0, 0.0) + 0.01 * rng.standard_normal(n),
        np.repeat(rng.standard_normal(n // 4), 4),
        np.tile(rng.standard_normal(n // 20), 20),
    ):
        assert touched_level(step * np.round(values / step) if step else values) == (None, None)


def test_clipped_samples_are_not_called_stuck():
    values = driven()
    values[:, 0] = np.clip(values[:, 0], -2, 2)
    kinds = {f.kind for f in inspect(recording(values)) if f.column == "gyro_x"}
    assert kinds == {"clipping"}


@given(st.floats(1e-4, 10), st.floats(-5, 5), st.integers(0, 5))
@settings(max_examples=30, deadline=None)
def test_quantization_step_is_found_with_any_offset(step, offset, seed):
    values = np.round(noise(5000, 3 * step, seed)[:, 0] / step) * step + offset * step
    assert quantization_step(values) == pytest.approx(step, rel=1e-6)


def test_quantization_step_rounded_once_more():
    """Levels of 1/2048 g, printed with 1e-4 g."""
    values = np.round(np.round(noise(20_000, 3 / 2048)[:, 0] * 2048) / 2048, 4)
    assert quantization_step(values) == pytest.approx(1 / 2048, rel=0.02)


def test_quantization_step_over_a_wide_range():
    values = np.round(driven()[:, 0] / 0.001) * 0.001
    assert quantization_step(values) is None or quantization_step(values) == pytest.approx(
        0.001, rel=1e-9
    )
    values = np.round(driven()[:, 0] / 0.01) * 0.01
    assert quantization_step(values) == pytest.approx(0.01, rel=1e-9)


def test_rounding_of_the_file_is_no_quantization():
    assert quantization_step(np.round(noise()[:, 0], 5)) is None
    assert quantization_step(noise()[:, 0]) is None


def test_constant_channel():
    values = noise()
    values[:, 1] = 0.25
    finding = found(recording(values), "constant_channel")["gyro_y"]
    assert finding.count == len(values) and finding.detail == {"value": 0.25}


def test_gravity_down_unless_declared():
    accel = noise() - [0, 0, G]
    assert "accel_z" in found(recording(accel=accel), "gravity_down")
    assert not found(recording(accel=-accel), "gravity_down")
    assert not found(recording(accel=accel, frame_declared=True), "gravity_down")


def test_the_other_sign_is_undone_as_the_meaning_of_gravity_down_says(tmp_path):
    """An accelerometer whose sign is iOS's, in axes forward-left-up."""
    advice = re.search(r"\[scale\] (accel = \{.*?\})", MEANING["gravity_down"])[1]
    names = [f'"a{a}" = "accel_{a} [count]"' for a in "xyz"]
    lines = ["[columns]", '"t" = "time [s]"', *names, "[scale]", advice]
    (tmp_path / "map.toml").write_text("\n".join(lines))
    force = noise()[:50] + [1.0, 2.0, G]
    rows = [f"{0.01 * k},{x!r},{y!r},{z!r}" for k, (x, y, z) in enumerate((-force).tolist())]
    (tmp_path / "log.csv").write_text("\n".join(["t,ax,ay,az", *rows]))
    read = read_recording(tmp_path / "log.csv", tmp_path / "map.toml")
    np.testing.assert_array_equal(read.accel, force)


def test_a_gravity_of_one_is_a_log_in_g():
    """Whichever axis it is on, and in motion too; not where it is in m/s^2, or near nothing."""
    rng = np.random.default_rng(3)
    moved = 0.3 * np.sin(np.arange(4000) / 30)[:, None] * (np.arange(4000) > 2000)[:, None]
    accel = moved + 1e-3 * rng.standard_normal((4000, 3)) + np.array([0.6, 0.0, -0.8])
    (finding,) = found(recording(accel=accel), "force_in_g").values()
    assert finding.detail["magnitude"] == pytest.approx(1.0, abs=0.01)
    for other in (G * accel, accel - [0.6, 0.0, -0.8], 1.62 * accel):
        assert not found(recording(accel=other), "force_in_g")


@pytest.mark.parametrize("degrees, right", [(298.0, "K"), (-248.0, "degC"), (85.0, None)])
def test_a_temperature_of_no_electronics_is_in_the_other_unit(degrees, right):
    warm = Recording.from_arrays(
        time=np.arange(2000) * 0.01, gyro=noise(2000), temperature=np.full(2000, degrees)
    )
    assert [f.detail["as"] for f in inspect(warm) if f.kind == "temperature_unit"] == (
        [right] if right else []
    )


def test_jitter_of_the_times():
    rng = np.random.default_rng(0)
    time = np.arange(20_000) * 0.01 + 5e-4 * rng.uniform(-1, 1, 20_000)
    jitter = found(Recording.from_arrays(time=time, gyro=noise()), "jitter")["time"].detail["rms"]
    assert jitter == pytest.approx(5e-4 * np.sqrt(2 / 3), rel=0.02)


def test_findings_are_plain_types():
    values = driven()
    values[:, 0] = np.clip(values[:, 0], -2, 2)
    values[777, 1] = 50
    values[900:920, 2] = 1
    for finding in inspect(recording(values)):
        plain = finding.as_dict()
        assert type(plain["count"]) is int and all(
            type(v) in (int, float, str) for v in plain["detail"].values()
        )


# Measured recordings


def test_repoimu_clipping():
    level = found(real("repoimu_tstick_test05_trial1"), "clipping")["gyro_x"].detail["level"]
    assert abs(level) == pytest.approx(7.36, rel=0.02)
    assert clipping_level(real("repoimu_tstick_test06_trial1").gyro[:, 1])[1] == pytest.approx(
        7.43, rel=0.02
    )
    assert not found(real("repoimu_tstick_test07_trial1"), "clipping")


def test_adis16405_steps():
    steps = found(real("adis16405_unit1_static").slice(0, 100_000), "quantization_step")
    assert steps["gyro_x"].detail["step"] == pytest.approx(np.deg2rad(0.05), rel=1e-6)
    assert steps["accel_z"].detail["step"] == pytest.approx(3.33e-3 * G, rel=1e-6)


def test_adis16405_has_no_stuck_samples():
    assert not found(real("adis16405_unit1_static"), "stuck_samples")


@pytest.mark.parametrize(
    "name", ["broad_02_undisturbed_slow_rotation_B", "broad_07_undisturbed_fast_rotation_B"]
)
def test_broad_gyro_step(name):
    r = real(name)
    assert found(r, "quantization_step")["gyro_x"].detail["step"] == pytest.approx(
        0.001065, rel=1e-3
    )
    assert not found(r, "clipping") and not found(r, "stuck_samples")


def test_morpinet_axes_point_down():
    assert {f.kind for f in inspect(real("morpinet_rccar_n"))} == {"gravity_down"}
