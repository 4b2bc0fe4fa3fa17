"""The bandwidth of white noise through low-passes that run much faster than the samples, or at
their rate.
"""

import numpy as np
import pytest
from scipy.signal import butter, cheby1, freqz, lfilter, sosfilt
from scipy.stats import norm

import pyimu
from pyimu.characterization.spectrum.bandwidth import find_bandwidth
from pyimu.characterization.spectrum.psd import psd_one_sided
from pyimu.recording.recording import Recording

H, N, FASTER = 0.01, 60_000, 16


def noise(rng, corner, order):
    """White noise (N,) through a Butterworth filter at ``FASTER`` times the rate, every so many."""
    if corner is None:
        return rng.standard_normal(N)
    sections = butter(order, corner, fs=FASTER / H, output="sos")
    return sosfilt(sections, rng.standard_normal(N * FASTER))[::FASTER]


@pytest.fixture(scope="module")
def channels():
    """x at 15 Hz of second order, y at 8 Hz of first, z level."""
    rng = np.random.default_rng(42)
    gyro = 1e-3 * np.column_stack([noise(rng, *of) for of in ((15.0, 2), (8.0, 1), (None, 0))])
    log = Recording("filtered", time=H * np.arange(N), gyro=gyro)
    return pyimu.characterize(log)


def test_the_corner_and_the_order_are_those_of_the_filter(channels):
    """Within three and a half standard errors, and half a percent.

    As much is the corner of a filter at 1600 Hz off that of one in continuous time, which the
    bilinear transform bends by (pi 15 / 1600)^2 / 3 and more where it falls.
    """
    x = channels.logs[0].sensors["gyro"].channels[0].bandwidth
    assert (x.low_pass.kind, x.low_pass.order) == ("analog", 2)
    assert abs(x.frequency.value - 15.0) < norm.isf(2e-4) * x.frequency.std + 0.075
    assert x.frequency.std < 0.5 and x.frequency.low < x.frequency.value < x.frequency.high


def test_what_folds_back_is_allowed_for(channels):
    """Of a filter of first order much comes back; it adds to 8 Hz what the last samples make."""
    y = channels.logs[0].sensors["gyro"].channels[1].bandwidth
    assert y.low_pass.order == 1 and y.frequency.holds(8.0)
    assert abs(y.frequency.value - 8.0) < norm.isf(2e-4) * y.frequency.std + 0.04


def test_a_level_spectrum_has_none(channels):
    assert channels.logs[0].sensors["gyro"].channels[2].bandwidth is None


def test_it_is_said_and_written(channels):
    assert "gyro_x: bandwidth 1" in channels.report()
    found = channels.as_dict()["logs"][0]["sensors"]["gyro"]["channels"]
    assert found["gyro_x"]["bandwidth"]["order"] == 2 and found["gyro_z"]["bandwidth"] is None


SHORT, SEEDS = 18_000, 20

AT_THE_RATE = {
    "digital 1": butter(1, 5, fs=1 / H),
    "digital 2": butter(2, 35, fs=1 / H),
    "digital 4": butter(4, 20, fs=1 / H),
    "exponential 1": ([0.3], [1, -0.7]),
    "moving 1": (np.ones(5) / 5, [1]),
    "moving 2": (np.convolve(np.ones(4), np.ones(4)) / 16, [1]),
    "none": cheby1(3, 1, 15, fs=1 / H),
}


def half_power(b, a):
    """The frequency at which half of the power goes through, by the filter's own response."""
    f, response = freqz(b, a, worN=100_000, fs=1 / H)
    return f[np.argmax(np.abs(response) ** 2 < 0.5)]


def bandwidth_of(x):
    s = psd_one_sided(x, H)
    every = np.ones(len(s.frequency))
    return find_bandwidth(s.frequency, s.density[:, 0], s.averages, every, (), H, 0.95)


@pytest.mark.long
@pytest.mark.parametrize("kind", AT_THE_RATE)
def test_the_interval_holds_where_a_digital_filter_is_down(kind):
    """Of ``SEEDS`` intervals of 95 % one in 400 sets has fewer than 16 that do.

    Digital filters of first order and averages may be named as what looks like them.
    """
    b, a = AT_THE_RATE[kind]
    truth, rng = half_power(b, a), np.random.default_rng(3)
    found = [bandwidth_of(lfilter(b, a, rng.standard_normal(SHORT))) for _ in range(SEEDS)]
    assert sum(e.frequency.holds(truth) for e in found) >= 16
    width = np.median([e.frequency.high - e.frequency.low for e in found]) / truth
    assert width < 0.2
    if kind not in ("exponential 1", "none"):
        named = [f"{e.low_pass.kind} {e.low_pass.order}" for e in found if e.low_pass]
        assert named.count(kind) > SEEDS // 2
    if kind == "none":  # a ripple is no Butterworth filter's, and is not said to be
        assert sum(e.low_pass is None for e in found) > SEEDS // 2


def test_white_noise_beside_a_low_pass_is_that_below_it():
    """N is that of the noise before a filter that lets all of it through at 0 Hz.

    Its intervals have a standard error of 4 to 7 %; of 12 of 95 % fewer than 9 hold N in one set of
    400. Through a filter of first order it was 4 to 10 % too small where clusters within its memory
    were fitted.
    """
    ratio, held = [], 0
    for seed in range(4):
        x = lfilter(
            [0.1], [1, -0.9], np.random.default_rng(seed).standard_normal((SHORT, 3)), axis=0
        )
        log = Recording("averaged", time=H * np.arange(SHORT), gyro=1e-3 * x)
        for ch in pyimu.characterize(log).logs[0].sensors["gyro"].channels:
            N = ch.noise.fit["N"]
            ratio.append(N.value / (1e-3 * np.sqrt(H)))
            held += N.holds(1e-3 * np.sqrt(H))
            assert ch.bandwidth is not None
    assert held >= 9
    assert abs(np.mean(ratio) - 1) < norm.isf(2e-3) * 0.07 / np.sqrt(len(ratio))


def test_what_fits_alike_is_said(channels):
    report = channels.report()
    assert "as through an analog low-pass of second order" in report
    assert " or an exponential average of the samples)" in report


def test_between_samples_of_another_file_no_bandwidth_is_the_sensors(tmp_path):
    """A gyro at 200 Hz beside an accelerometer at 100 Hz, both level: between the samples of the
    second stands their mean, whose spectrum falls as that of a moving average does.
    """
    rng, n = np.random.default_rng(5), 16_000
    samples = rng.standard_normal((n, 3)) * 1e-3
    np.savetxt(tmp_path / "g.csv", np.column_stack([np.arange(n) * 5, samples]), delimiter=",")
    rows = np.arange(n // 2) * 10 + 1.7
    forces = [0.0, 0.0, 9.80665] + 0.03 * rng.standard_normal((n // 2, 3))
    np.savetxt(tmp_path / "a.csv", np.column_stack([rows, forces]), delimiter=",")
    of = '"column 1" = "time [ms]"\n' + "\n".join(
        f'"column {k}" = "GROUP_{axis} [UNIT]"' for k, axis in zip((2, 3, 4), "xyz", strict=True)
    )
    gyro, accel = (
        of.replace("GROUP", group).replace("UNIT", unit)
        for group, unit in (("gyro", "rad/s"), ("accel", "m/s^2"))
    )
    entry = f'[[file]]\nname = "a.csv"\n[file.columns]\n{accel}\n'
    (tmp_path / "map.toml").write_text(f"[columns]\n{gyro}\n{entry}")
    log = pyimu.read_recording(tmp_path / "g.csv", tmp_path / "map.toml")
    (said,) = (f for f in log.findings if f.kind == "other_file")
    assert said.detail["how"] == "between samples"
    sensors = pyimu.characterize(log).logs[0].sensors
    for channel in (*sensors["gyro"].channels, *sensors["accel"].channels):
        assert channel.bandwidth is None
