"""``pyimu.characterize``: what comes out is what was put in.

Also pieces, gaps and several logs, and the page, the data and the part.
"""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from report_pages import alone
from scipy.stats import binom, norm

import pyimu
from pyimu import Recording, UserError, part
from pyimu.characterization.allan import overlapping_deviation
from pyimu.characterization.evidence import Excerpt, LevelHistogram, Timeline
from pyimu.characterization.report import page as report_page
from pyimu.characterization.report.channel_notes import frequency
from pyimu.characterization.run import characterize
from pyimu.characterization.samples import Collector, Samples
from pyimu.characterization.store import Store
from pyimu.characterization.temperature.warm_up import find_warm_up
from pyimu.errors import Finding
from pyimu.recording.log import open_log

H = 0.01
ROWS = 2**15
N, K, STEP, G = 2e-4, 1e-5, 2e-2, 9.80665
"""White noise and walk of the gyro [rad/sqrt(s), rad/s/sqrt(s)], step of the accelerometer [m/s^2].
"""

ALPHA = 1e-3 / 20
"""Probability with which each statistical test may fail where all is right; there are at most
twenty."""


def draw(seed, rows=ROWS):
    """A gyro and an accelerometer (n, 3) at rest and level.

    The gyro has white noise and a walk, the accelerometer rounded white noise.
    """
    rng = np.random.default_rng(seed)
    gyro = N / np.sqrt(H) * rng.standard_normal((rows, 3)) + K * np.sqrt(H) * np.cumsum(
        rng.standard_normal((rows, 3)), axis=0
    )
    accel = STEP * np.round(
        (10 * N / np.sqrt(H) * rng.standard_normal((rows, 3)) + [0, 0, G]) / STEP
    )
    return gyro, accel


def recording(seed=1, name="rest", rows=ROWS, **changes):
    gyro, accel = draw(seed, rows)
    return Recording.from_arrays(
        name, time=H * np.arange(rows), **{"gyro": gyro, "accel": accel} | changes
    )


DRAWN = {}
"""Results and their pages by the result's id: a page takes seconds to draw."""


def page(result):
    """The page of a result, drawn once."""
    if id(result) not in DRAWN:
        DRAWN[id(result)] = result, report_page.page(result)
    return DRAWN[id(result)][1]


@pytest.fixture(scope="module")
def found():
    return pyimu.characterize(recording())


@pytest.fixture(scope="module")
def several():
    return pyimu.characterize([recording(k, f"test_{k}", 2**13, accel=None) for k in range(3)])


# What comes out


def test_the_package_is_the_function(found):
    assert callable(pyimu.characterize) and found.kinds == ("gyro", "accel") and found.level == 0.95
    assert [c.name for c in found.logs[0].channels] == [
        "gyro_x",
        "gyro_y",
        "gyro_z",
        "accel_x",
        "accel_y",
        "accel_z",
    ]


@pytest.mark.parametrize("axis", "xyz")
def test_coefficients_come_back(found, axis):
    """Within the normal law of their standard errors.

    The walk is compared in squares, whose distribution is nearer to the normal.
    """
    white, walk = (found.coefficients[f"gyro_{axis}", t].mean for t in "NK")
    assert abs(white.value - N) <= norm.isf(ALPHA / 2) * white.std
    assert (
        not walk.needed
        or abs(walk.value**2 - K**2) <= norm.isf(ALPHA / 2) * 2 * walk.value * walk.std
    )
    # Rounding adds h q^2 / 12 to the density.
    accel = found.coefficients[f"accel_{axis}", "N"].mean
    assert (
        abs(accel.value - np.sqrt(100 * N**2 + STEP**2 * H / 12)) <= norm.isf(ALPHA / 2) * accel.std
    )


def test_a_strong_walk_is_needed_and_comes_back():
    """White noise and walk cross at 2 s of 328 s."""
    strong = N
    gyro = draw(11)[0] + strong * np.sqrt(H) * np.cumsum(
        np.random.default_rng(12).standard_normal((ROWS, 3)), axis=0
    )
    c = pyimu.characterize(recording(gyro=gyro, accel=None))
    true = np.hypot(strong, K)
    for walk in (c.coefficients[f"gyro_{axis}", "K"].mean for axis in "xyz"):
        assert (
            walk.needed
            and abs(walk.value**2 - true**2) <= norm.isf(ALPHA / 6) * 2 * walk.value * walk.std
        )


def test_deviations_are_those_of_the_samples(found):
    """At some hundred cluster times from one sample to half the record.

    They are the same sums, taken in another order.
    """
    gyro, _ = draw(1)
    for i, channel in enumerate(found.logs[0].sensors["gyro"].channels):
        curve = channel.noise.allan
        m = np.rint(curve.tau / H).astype(int)
        assert m[0] == 1 and m[-1] == ROWS // 2 and 90 <= len(m) <= 130
        np.testing.assert_allclose(
            curve.deviation, overlapping_deviation(np.ascontiguousarray(gyro[:, i]), m), rtol=1e-14
        )
        assert np.all((curve.low < curve.deviation) & (curve.deviation < curve.high)) and np.all(
            np.diff(curve.high / curve.low) > -0.05
        )


def test_limits_hold_the_true_deviation(several):
    """At 1 s, in nine channels, each with the probability of the level."""
    true = np.sqrt(N**2 + K**2 / 3)
    held = [
        bool(a.low[i] <= true <= a.high[i])
        for log in several.logs
        for c in log.sensors["gyro"].channels
        for a in [c.noise.allan]
        for i in [int(np.argmin(np.abs(a.tau - 1.0)))]
    ]
    assert len(held) == 9 and sum(held) >= binom.ppf(ALPHA, 9, 0.95)


def test_several_logs_have_means_and_spread(several):
    for axis in "xyz":
        each = [c.coefficient("N").value for c in several.channel(f"gyro_{axis}")]
        s = several.coefficients[f"gyro_{axis}", "N"]
        assert (s.mean.value, s.spread, s.logs) == (
            pytest.approx(np.mean(each)),
            pytest.approx(np.std(each, ddof=1)),
            3,
        )
        assert (
            s.mean.low < s.mean.value < s.mean.high
            and s.mean.std < 0.7 * several.logs[0].sensors["gyro"].channels[0].coefficient("N").std
        )
    # A curve of its own colour and name for each.
    assert all(f"{name}</text>" in page(several) for name in ("test_0", "test_1", "test_2"))
    assert "Log by log" in page(several) and "test_2" in page(several) and "±" in several.report()


def test_the_spectrum_is_one_sided(found):
    """White noise N has the density 2 N^2, at frequencies where the walk is negligible.

    The mean of many is within its normal law.
    """
    psd = found.logs[0].sensors["gyro"].psd
    high = psd.frequency > 5.0
    weights = psd.averages[high]
    mean = np.average(psd.density[high], axis=0, weights=weights)
    assert np.all(
        np.abs(mean / (2 * N**2) - 1)
        <= norm.isf(ALPHA / 6) / np.sqrt(weights.sum()) + (K / (2 * np.pi * 5 * N)) ** 2
    )


def test_a_line_is_found_and_leaves_the_coefficients_alone():
    gyro, _ = draw(3)
    gyro[:, 2] += 0.02 * np.sin(2 * np.pi * 20.0 * H * np.arange(ROWS))
    c = pyimu.characterize(recording(gyro=gyro, accel=None))
    x, _, z = c.logs[0].sensors["gyro"].channels
    assert not x.lines and [round(v.frequency, 2) for v in z.lines] == [20.0]
    assert z.lines[0].amplitude == pytest.approx(0.02, rel=0.02)
    white = z.coefficient("N")
    assert abs(white.value - N) <= norm.isf(ALPHA / 2) * white.std
    assert f"gyro_z has lines at {frequency(z.lines[0])} Hz" in c.report()


# Temperature, warm-up, motion


@pytest.fixture(scope="module")
def warm():
    """Half a degree a second back and forth, 1 mrad/s a kelvin on x."""
    temperature = 25 + 10 * np.sin(2 * np.pi * H * np.arange(ROWS) / 150)
    gyro, _ = draw(4)
    return pyimu.characterize(
        recording(
            gyro=gyro + np.outer(temperature - 25, [1e-3, 0, 0]),
            accel=None,
            temperature=temperature,
        )
    )


def test_temperature_is_found_and_taken_off(warm):
    x, y, _ = warm.logs[0].sensors["gyro"].channels
    assert (
        x.thermal.order >= 1
        and x.thermal.coefficients["kT"].value == pytest.approx(1e-3, rel=0.02)
        and y.thermal.order == 0
    )
    assert x.noise.as_measured is not None and y.noise.as_measured is None
    half = np.argmin(np.abs(x.noise.allan.tau - 75))
    assert x.noise.as_measured.deviation[half] > 50 * x.noise.allan.deviation[half]
    assert (
        x.coefficient("N").holds(N)
        or abs(x.coefficient("N").value - N) <= norm.isf(ALPHA / 2) * x.coefficient("N").std
    )


@pytest.fixture(scope="module")
def looped():
    """A day at 1 Hz with two cycles of 40 K, and on x a play of 2 K.

    Its loop opens by 4e-5 rad/s: 40 times what the walk makes in an hour.
    """
    rng, n, half, kh = np.random.default_rng(13), 43_200, 2.0, -1e-5
    temperature = 20 + 20 * np.sin(2 * np.pi * np.arange(n) / 21_600)
    played, out = temperature[0], np.empty(n)
    for i, t in enumerate(temperature):
        played = out[i] = max(t - half, min(t + half, played))
    gyro = N * rng.standard_normal((n, 3)) / 2 + 1e-8 * np.cumsum(
        rng.standard_normal((n, 3)), axis=0
    )
    gyro[:, 0] += kh * (out - temperature)
    return pyimu.characterize(
        Recording.from_arrays(
            "looped", time=np.arange(float(n)), gyro=gyro, temperature=temperature
        )
    )


def test_a_loop_is_taken_off_and_goes_into_the_part(looped):
    x, y, _ = looped.logs[0].sensors["gyro"].channels
    h = x.thermal.hysteresis
    assert h.warranted and not y.thermal.warranted and x.compensated_for == "temperature"
    # What is left of the loop is no walk: half a cycle's deviation is that of a channel that had
    # none.
    quarter = np.argmin(np.abs(x.noise.allan.tau - 5400))
    assert x.noise.as_measured.deviation[quarter] > 5 * x.noise.allan.deviation[quarter]
    assert (
        x.noise.allan.deviation[quarter] < 3 * y.noise.allan.deviation[quarter]
        and x.coefficient("K").high < 2e-7
    )
    values = looped.part().gyro.values["thermal_hysteresis"]
    assert (
        values["kh"][0] == pytest.approx(h.kh, rel=1e-4)
        and values["kh"][1] == 0
        and values["width"] == pytest.approx(h.width, rel=1e-4)
    )
    assert abs(-2 * values["kh"][0] * values["width"] - 4e-5) < 5 * h.opening.std
    data = looped.as_dict()["logs"][0]["sensors"]["gyro"]["channels"]["gyro_x"]["thermal"][
        "hysteresis"
    ]
    assert (data["kh"], data["width"], data["unit"], data["kh_unit"]) == (
        h.kh,
        h.width,
        "rad/s",
        "rad/s/K",
    )
    assert "rising less falling" in looped.report() and "a loop of ±" in looped.report()


def test_the_picture_of_temperature_has_the_curve_on_the_level_of_the_log(looped):
    """The residual's mean is zero, and the curve is the polynomial from which it is taken.

    The words do not call chance what an interval excludes.
    """
    for ch in looped.logs[0].channels:
        t = ch.thermal
        (at, drawn), slack = t.curve, 1e-12 + 1e-9 * np.ptp(t.bias)
        level = np.mean(t.bias - t.at(t.temperature))
        np.testing.assert_allclose(t.fitted, t.at(t.temperature) + level, rtol=0, atol=slack)
        np.testing.assert_allclose(drawn, t.at(at) + level, rtol=0, atol=slack)
        assert np.mean(t.residual) == pytest.approx(0, abs=slack)
        assert (at[0], at[-1]) == (t.temperature.min(), t.temperature.max())
    assert "which chance explains" not in page(looped)


def test_the_part_has_the_thermal_bias(warm):
    values = warm.part().gyro.values
    assert (
        values["thermal_bias"]["kT"][0] == pytest.approx(1e-3, rel=0.02)
        and values["thermal_bias"]["kT"][1] == 0
    )
    assert values["thermal_bias"]["T0"] == pytest.approx(25.0, abs=0.5)


def test_warm_up_is_told_from_a_walk():
    """At most twice in forty records of a walk, each at odds of a thousand.

    It is always found where it is twenty times what noise makes.
    """
    n, rng = 20_000, np.random.default_rng(5)
    records = [rng.standard_normal(n) + 3e-3 * np.cumsum(rng.standard_normal(n)) for _ in range(40)]
    assert sum(find_warm_up(x, H) is not None for x in records) <= binom.isf(ALPHA, 40, 1e-3)
    decay = 20.0 * np.exp(-np.arange(n) / 2000)
    for x in records[:5]:
        w = find_warm_up(x + decay, H)
        assert abs(w.amplitude - 20.0) <= 5 * w.std + 2.0 and w.tau == pytest.approx(20.0, rel=0.1)


def test_a_warm_up_is_taken_off_and_said(tmp_path):
    """With one of a hundred times the noise of a second neither a walk nor a ramp is needed.

    The part says that it was there.
    """
    gyro = draw(14)[0]
    gyro[:, 0] += 0.02 * np.exp(-H * np.arange(ROWS) / 20)
    c = pyimu.characterize(recording(gyro=gyro, accel=None))
    x, y, _ = c.logs[0].sensors["gyro"].channels
    assert (x.compensated_for, y.compensated_for) == (
        "warm-up",
        "",
    ) and x.warm_up.tau == pytest.approx(20.0, rel=0.1)
    assert (
        x.noise.as_measured is not None
        and abs(x.coefficient("N").value - N) <= norm.isf(ALPHA / 2) * x.coefficient("N").std
    )
    assert x.coefficient("K").high < 10 * K and not x.coefficient("R").needed
    assert (
        "gyro_x: a warm-up was taken off" in c.report()
        and "a warm-up was taken off" in c.part().description
    )


def test_a_moving_log_is_called_one():
    gyro, _ = draw(6, 4096)
    moving = gyro + np.outer(np.sin(0.5 * H * np.arange(4096)), [0, 1.0, 0])
    c = pyimu.characterize(recording(rows=4096, gyro=moving, accel=None))
    assert [f.column for f in c.findings if f.kind == "motion"] == ["gyro_y"]
    assert "not at rest: gyro_y" in c.report() and "not at rest: gyro_y" in page(c)
    assert not [f for f in pyimu.characterize(recording(rows=4096)).findings if f.kind == "motion"]


def test_faults_that_reach_the_coefficients_are_named():
    """At the top of the page and in the part; slight ones are findings only."""
    gyro, accel = draw(15, 8192)
    gyro[:, 0] = np.clip(gyro[:, 0], -1.5e-3, 1.5e-3)
    gyro[[1000, 5000], 1] += 5.0
    gyro[3000:3300, 2] = gyro[3000, 2]
    accel[:, 0] = np.round(accel[:, 0] / 0.1) * 0.1
    accel[4000, 1] += 0.5
    c = pyimu.characterize(recording(rows=8192, gyro=gyro, accel=accel))
    assert {
        ("clipping", "gyro_x"),
        ("spikes", "gyro_y"),
        ("stuck_samples", "gyro_z"),
        ("quantization_step", "accel_x"),
        ("quantization_step", "accel_y"),
    } <= {(f.kind, f.column) for f in c.findings}
    for said in (c.report(), page(c), c.part().description):
        for text in (
            "gyro_x: clipped samples",
            "gyro_y: the spikes are in N",
            "gyro_z: stuck samples",
            "accel_x: steps as coarse as the noise",
        ):
            assert text in said, text
        assert "accel_y: " not in said.replace("accel_y: no effect", "").partition("Temperature")[0]
    # Clipped on both sides, shown on both.
    assert {column for kind, column in c.logs[0].evidence if kind == "clipping"} == {
        "gyro_x low",
        "gyro_x high",
    }


def test_a_wrapped_column_does_not_move():
    gyro = draw(16, 4096)[0]
    gyro[:, 0] = 1e-4 * (
        (np.round(gyro[:, 0] / 1e-4 + 0.05 * np.arange(4096)).astype(int) * 400 + 2**15) % 2**16
        - 2**15
    )
    segments = [(0, 4096)]
    s = Samples("gyro", H, H * np.arange(4096), list(gyro.T), segments, np.empty(0), None)
    assert [f.column for f in s.motion()] == ["gyro_x"] and s.motion({"gyro_x"}) == []


# Pieces, gaps, segments


def test_a_log_in_pieces_gives_what_a_recording_does(tmp_path, monkeypatch):
    """From a file, in pieces that do not divide it: all curves and coefficients bit for bit."""
    from pyimu.characterization import log_samples, samples

    temperature = 25 + np.sin(H * np.arange(4096) / 5)
    whole = recording(7, "log", 4096, temperature=temperature)
    path = whole.write(tmp_path / "log.csv")
    monkeypatch.setattr(log_samples, "PIECE", 1000)
    monkeypatch.setattr(samples, "PIECE", 1000)
    a, b = characterize(path), characterize(open_log(path))
    monkeypatch.undo()
    c = characterize(pyimu.read_recording(path))
    for other in (b, c):
        for mine, its in zip(a.logs[0].channels, other.logs[0].channels, strict=True):
            np.testing.assert_array_equal(mine.noise.allan.deviation, its.noise.allan.deviation)
            np.testing.assert_array_equal(
                mine.noise.hadamard.deviation, its.noise.hadamard.deviation
            )
            assert [mine.coefficient(t).high for t in "QNBKR"] == [
                its.coefficient(t).high for t in "QNBKR"
            ]
        assert {(f.kind, f.column, f.count) for f in a.findings} == {
            (f.kind, f.column, f.count) for f in other.findings
        }


def test_gaps_are_not_bridged():
    """A jump of the bias across a gap does not enter the deviations.

    They are the sums over both sides, and the report says so.
    """
    gyro, _ = draw(8, 6000)
    gyro[2000:] += 1.0
    time = H * np.arange(6000)
    time[2000:] += 7.0
    c = pyimu.characterize(replace(recording(rows=6000, accel=None, gyro=gyro), time=time))
    s = c.logs[0].sensors["gyro"]
    assert (s.segments, s.segments_used, s.longest) == (2, 2, 4000)
    a = s.channels[0].noise.allan
    m = np.rint(a.tau / H).astype(int)
    halves = [
        overlapping_deviation(np.ascontiguousarray(x), m[2 * m <= len(x)])
        for x in (gyro[:2000, 0], gyro[2000:, 0])
    ]
    for k, size in enumerate(m):
        counts = [max(n - 2 * size + 1, 0) for n in (2000, 4000)]
        squares = [halves[i][k] ** 2 if k < len(halves[i]) else 0.0 for i in range(2)]
        assert a.deviation[k] == pytest.approx(
            np.sqrt(np.dot(counts, squares) / sum(counts)), rel=1e-12
        )
    assert "1 gap. Nothing is bridged" in c.report() and "Nothing is bridged" in page(c)
    assert isinstance(c.logs[0].evidence["gaps", "time"], Timeline)


def test_a_sensor_in_every_second_row_has_half_the_rate():
    gyro, accel = draw(9, 8000)
    accel[1::2] = np.nan
    c = pyimu.characterize(recording(rows=8000, gyro=gyro, accel=accel))
    sensors = c.logs[0].sensors
    assert (sensors["gyro"].h, sensors["accel"].h) == (
        pytest.approx(H),
        pytest.approx(2 * H),
    ) and sensors["accel"].segments == 1


@pytest.mark.parametrize("late", (False, True))
def test_an_empty_axis_is_named_and_the_others_are_characterised(late, monkeypatch):
    from pyimu.characterization import log_samples

    monkeypatch.setattr(log_samples, "PIECE", 1000)
    gyro = draw(17, 4096)[0]
    gyro[: 1000 if late else 4096, 1] = np.nan
    c = pyimu.characterize(recording(rows=4096, gyro=gyro, accel=None))
    x, y, z = c.logs[0].sensors["gyro"].channels
    assert x.noise is not None and z.noise is not None and y.noise is None
    reason = "its first 1,000 cells are empty" if late else "all its cells are empty"
    assert (
        reason in y.reason
        and f"gyro_y is left out: {reason}" in c.report()
        and ("no_samples", "gyro_y") in {(f.kind, f.column) for f in c.findings}
    )
    assert (
        np.isnan(y.mean)
        and c.part().gyro.values["turn_on_bias"]["b0"][1] == 0
        and "gyro_y" in page(c)
    )


def test_a_sensor_without_samples_is_named():
    c = pyimu.characterize(recording(rows=4096, accel=np.full((4096, 3), np.nan)))
    assert {f.column for f in c.findings if f.kind == "no_samples"} == {
        "accel_x",
        "accel_y",
        "accel_z",
    } and "no samples" in c.report()


def test_rows_and_samples():
    """A row's sample and back, where rows have missing cells."""
    missing = np.array([0.0, 3, 4, 9])
    s = Samples("gyro", H, np.arange(6.0), [], [], missing, None)
    rows = [1, 2, 5, 6, 7, 8]
    assert [s.place(r) for r in rows] == list(range(6)) and [s.row(k) for k in range(6)] == rows


def test_the_last_temperature_holds_for_a_minute():
    temperature = np.full(12_000, np.nan)
    temperature[[0, 3000]] = 20.0, 30.0
    with Store() as store:
        collector = Collector("gyro", store)
        log = recording(rows=12_000, temperature=temperature)
        held = np.concatenate(
            [collector._temperature(log.slice(a, a + 500)) for a in range(0, 12_000, 500)]
        )
    np.testing.assert_array_equal(held[[0, 2999, 3000, 8999]], [20.0, 20.0, 30.0, 30.0])
    assert np.all(np.isnan(held[9001:]))


def test_the_store_keeps_numbers_and_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    import tempfile

    monkeypatch.setattr(tempfile, "tempdir", None)
    with Store() as store:
        for k in range(5):
            store.append("a", np.arange(3.0) + k)
        assert (
            store.column("a").shape == (15,)
            and store.column("a")[-1] == 6.0
            and not len(store.column("none"))
        )
        room = store.room("b", 10)
        room[:] = 1.0
        assert store.room("b", 3).sum() == 0.0
        assert not list(tmp_path.iterdir())


# The page, the data, the part


def test_the_page_needs_nothing_beside_it(found):
    text = page(found)
    alone(text)
    assert all(
        target.startswith(("#", "data:")) for target in re.findall(r'(?:src|href)="([^"]*)"', text)
    )
    assert (
        text.index("Allan deviation")
        < text.index("<svg")
        < text.index("Coefficients")
        < text.index("Spectrum")
    )
    for word in (
        "one-sided",
        "deg/√h",
        "rad/√s",
        "µg/√Hz",
        "The log has no temperature",
        "quantization step",
        "viewport",
    ):
        assert word in text, word
    assert len(text) < 2_000_000


def test_the_curves_of_the_page_are_those_of_the_fit(found):
    """What the page draws is the fit at the cluster times and frequencies of the data."""
    for sensor in found.logs[0].sensors.values():
        for i, channel in enumerate(sensor.channels):
            noise, fit = channel.noise, channel.noise.fit
            np.testing.assert_array_equal(noise.fitted, fit.deviation(noise.allan.tau))
            squares = sum(deviation**2 for deviation in noise.terms.values())
            np.testing.assert_allclose(squares, fit.term_variances(noise.allan.tau).sum(axis=1))
            np.testing.assert_array_equal(
                sensor.fitted[:, i], 2 * fit.psd_two_sided(sensor.psd.frequency)
            )
            assert (
                noise.floor.deviation == noise.allan.deviation[noise.allan.tau == noise.floor.tau]
            )


def test_a_result_writes_itself(several, tmp_path):
    """Three files; the part is named by what the logs' names begin with."""
    assert isinstance(several, pyimu.Characterization)
    page_path = several.write(tmp_path / "new" / "out")
    assert page_path == tmp_path / "new" / "out" / "report.html"
    assert page_path.read_text(encoding="utf-8") == page(several)
    data = json.loads(page_path.with_name("report.json").read_text(encoding="utf-8"))
    assert data == several.as_dict()
    assert part(page_path.with_name("part.toml")).name == "test"
    assert len(list(page_path.parent.iterdir())) == 3


def test_the_data_are_those_of_the_result(found):
    data = json.loads(json.dumps(found.as_dict()))
    channel = data["logs"][0]["sensors"]["gyro"]["channels"]["gyro_x"]
    assert channel["coefficients"]["N"]["value"] == found.coefficients["gyro_x", "N"].mean.value
    assert channel["coefficients"]["B"] | {"high": 0} == {
        "value": None,
        "std": None,
        "low": 0.0,
        "high": 0,
        "unit": "rad/s",
        "needed": False,
    }
    assert (
        len(channel["allan"]["tau"])
        == len(channel["allan"]["high"])
        == len(found.logs[0].sensors["gyro"].channels[0].noise.allan.tau)
    )
    assert data["part"]["accel_z"]["N"]["unit"] == "m/s/sqrt(s)" and data["logs"][0]["rows"] == ROWS
    assert {f["kind"] for f in data["logs"][0]["quality"]} == {"quantization_step"}
    sensor = data["logs"][0]["sensors"]["gyro"]
    assert sensor["lines_from"] < 1 and 40 < sensor["lines_to"] < 50
    assert f"to {sensor['lines_to']:.4g} Hz; half the sample rate is 50 Hz" in page(found)


def test_lines_have_as_many_figures_as_they_are_known_to():
    gyro = draw(18)[0]
    gyro[:, 0] += 0.02 * np.sin(2 * np.pi * 20.123456 * H * np.arange(ROWS))
    c = pyimu.characterize(recording(gyro=gyro, accel=None))
    (line,) = c.logs[0].sensors["gyro"].channels[0].lines
    shown = frequency(line)
    assert (
        abs(float(shown) - line.frequency) <= line.frequency_std / 2
        and 10 ** -len(shown.partition(".")[2]) > line.frequency_std / 100
    )
    assert f"{shown} ±" in page(c) and f"{shown} Hz" in c.report()
    (data,) = c.as_dict()["logs"][0]["sensors"]["gyro"]["channels"]["gyro_x"]["lines"]
    assert (data["width"], data["ratio"], data["unit"]) == (0.0, line.ratio, "rad/s")


def test_findings_are_shown(found):
    shown = found.logs[0].evidence["quantization_step", "accel_x"]
    assert (
        isinstance(shown, LevelHistogram)
        and shown.step == pytest.approx(STEP)
        and shown.share.sum() <= 1
    )
    accel = draw(1)[1]
    accel[4000, 1] += 1.0
    c = pyimu.characterize(recording(accel=accel))
    spike = c.logs[0].evidence["spikes", "accel_y"]
    assert (
        isinstance(spike, Excerpt)
        and spike.values[spike.first] == accel[4000, 1]
        and spike.last == spike.first + 1
    )


def test_the_part_reads_back_and_gives_the_same_noise(found, tmp_path):
    """Simulated and characterised again: N of every axis within the normal law of both."""
    path = pyimu.save_part(found.part("again"), tmp_path / "part.toml")
    again = part(path)
    assert again.sample_rate == pytest.approx(100.0) and np.all(
        again.accel.values["quantization"]["q"] == pytest.approx(STEP)
    )
    still, level = np.zeros((ROWS, 3)), np.tile([0, 0, G], (ROWS, 1))
    rest = recording(gyro=still, accel=level, ref_rate=still, ref_force=level)
    second = pyimu.characterize(again.simulate(rest, seed=3))
    for key in (k for k in found.coefficients if k[1] == "N"):
        a, b = found.coefficients[key].mean, second.coefficients[key].mean
        assert abs(a.value - b.value) <= norm.isf(ALPHA / 12) * np.hypot(a.std, b.std)


# What cannot be used


def test_errors_say_what_is_wrong():
    flat = np.zeros((200, 3))
    cases = {
        "rest: no channel can be characterised: it is constant": recording(
            rows=200, gyro=flat, accel=None
        ),
        "at least 64 are needed": recording(rows=40),
    }
    for text, log in cases.items():
        with pytest.raises(UserError, match=re.escape(text)):
            pyimu.characterize(log)
    with pytest.raises(UserError, match="level 95: must lie between 0 and 1"):
        pyimu.characterize(recording(rows=200), level=95)
    coarse = replace(recording(rows=200), findings=(Finding("repeated_time", "time", 3),))
    with pytest.raises(
        UserError, match="3 of 203 rows have the time of the row before: .* float32"
    ):
        pyimu.characterize(coarse)
    with pytest.raises(UserError, match="no log"):
        pyimu.characterize([])
