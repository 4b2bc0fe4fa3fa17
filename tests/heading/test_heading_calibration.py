"""Self-calibration as Hong and Park 2008 print it, and the same by the loop's regression."""

import numpy as np
import pytest
from heading_cases import H, K, N, log, measured, turns
from scipy.stats import binom

from pyimu.heading import fit, self_calibrate
from pyimu.model.part_file import part

S, B = -0.1, 0.1
EVALUATION = 1e-3
"""s; sample period of the evaluation of section 3.1."""


def evaluation(late, size=4.266):
    """Motion of 10 s, heading reference late by so many s; the robot's heading begins at zero."""
    time = EVALUATION * np.arange(10_001)

    def heading(t):
        w = 2 * np.pi / 10
        return size * (t + (1 - np.cos(w * t)) / w)

    rate = np.diff(heading(time), prepend=heading(-EVALUATION)) / EVALUATION
    shown = heading(time - late)
    return rate, shown, (1 + S) * rate + B


@pytest.mark.parametrize("method", [self_calibrate, fit])
@pytest.mark.parametrize("reference", ["heading", "rate"])
def test_eqs_3_to_6_without_noise_are_exact(method, reference):
    rate, heading, gyro = evaluation(0.0)
    found = method(log(gyro, heading, rate, h=EVALUATION), reference)
    assert found.s == pytest.approx(S, abs=1e-9) and found.b0 == pytest.approx(B, abs=1e-9)
    assert found.s_bar == pytest.approx(1 / (1 + S), abs=1e-9)
    assert found.b_bar == pytest.approx(-B / (1 + S), abs=1e-9)


def test_the_published_errors_are_those_of_a_reference_12_9_ms_late():
    """4.80 % and 20.26 %, section 3.1: to the two places that are printed, half of the last being
    0.005; 12.9 ms itself is rounded, which is worth 0.05/12.9 of each."""
    rate, heading, gyro = evaluation(12.9e-3)
    heading[0] = 0.0
    by_heading = self_calibrate(log(gyro, heading, h=EVALUATION), "heading")
    off = 100 * np.array([(by_heading.s - S) / abs(S), (by_heading.b0 - B) / B])
    want, rounded = np.array([4.80, -20.26]), 0.005
    np.testing.assert_array_less(np.abs(off - want), rounded + np.abs(want) * 0.05 / 12.9)
    by_rate = self_calibrate(log(gyro, rate=rate, h=EVALUATION), "rate")
    assert by_rate.s == pytest.approx(S, abs=1e-9) and by_rate.b0 == pytest.approx(B, abs=1e-9)


@pytest.mark.parametrize("late", [-0.3, -0.0129, 0.0129, 0.0137])
def test_the_clock_offset_is_found_with_either_sign(late):
    """Of a heading by a cubic spline, whose error is of the order of (h w)^4/384 of the signal:
    (1e-3 * 0.628)^4/384 = 4e-16."""
    _, heading, gyro = evaluation(late)
    found = fit(log(gyro, heading, h=EVALUATION))
    assert found.late == pytest.approx(late, abs=1e-9)
    assert found.s == pytest.approx(S, abs=1e-8) and found.b0 == pytest.approx(B, abs=1e-8)


def test_a_ramp_does_not_tell_lateness_from_bias():
    """r(t + d) = r(t) + const: the offset is left alone, and said not to be known."""
    rate = np.linspace(-1, 1, 2000)
    gyro = measured(rate, np.random.default_rng(1), s=0.02, b=0.01, k=0.0)
    assert fit(log(gyro, rate=rate)).late is None


def runs(count, n=N, k=K, seed=0):
    """Errors (count, 3) of s by heading fit, rate fit and whitened, and the claimed std of the
    last (count,).
    """
    errors, claimed = [], []
    for i in range(count):
        rng = np.random.default_rng([seed, i])
        rate, s = turns(rng, 200.0), 0.03 * rng.standard_normal()
        one = log(measured(rate, rng, s, 0.01, n, k), H * np.cumsum(rate), rate)
        found = [self_calibrate(one, "heading"), self_calibrate(one, "rate"), fit(one, "heading")]
        errors.append([c.s - s for c in found])
        claimed.append(found[2].s_std)
    return np.array(errors), np.array(claimed)


def test_the_whitened_fit_claims_what_it_does():
    """24 logs: as many intervals hold the truth as may, but once in 1e4, and the mean error is
    within four standard errors."""
    errors, claimed = runs(24)
    z = errors[:, 2] / claimed
    inside = np.count_nonzero(np.abs(z) < 1.96)
    assert inside >= binom.ppf(1e-4, 24, 0.95)
    assert abs(z.mean()) < 4 / np.sqrt(24)
    rms = np.sqrt(np.mean(errors**2, axis=0))
    # Ratios of some 40 and 2.6, of spreads that 24 logs show to 1/sqrt(48) = 14 %.
    assert rms[0] > 10 * rms[2] and rms[1] > 1.5 * rms[2]


def test_the_rate_fit_is_biased_by_the_noise_in_its_regressor():
    """Errors in variables: s_bar is too small by the share var(w)/var(r_m), s too large by it."""
    n = 3.7e-3
    rng = np.random.default_rng(5)
    rate = turns(rng)
    gyro = measured(rate, rng, n=n, k=0.0)
    off = self_calibrate(log(gyro, rate=rate)).s
    share = n**2 / H / np.var(gyro)
    scatter = n / np.sqrt(H * np.sum((rate - rate.mean()) ** 2))
    assert off == pytest.approx(share / (1 - share), abs=4 * scatter) and share > 4 * scatter


def test_a_noisy_heading_pulls_nothing():
    """Its noise of 1 mrad would take var/var(rate), some percent, of s: windows keep that out."""
    z = []
    for i in range(10):
        rng = np.random.default_rng([3, i])
        rate = turns(rng, 120.0)
        heading = H * np.cumsum(rate) + 1e-3 * rng.standard_normal(len(rate))
        found = fit(log(measured(rate, rng, 0.02, 0.01), heading))
        assert found.window > 1
        z.append((found.s - 0.02) / found.s_std)
    assert abs(np.mean(z)) < 4 / np.sqrt(10) + 0.2


def test_segments_each_have_a_heading_of_their_own():
    """A gap within the calibration, over which the heading jumped by anything."""
    rng = np.random.default_rng(2)
    rate = turns(rng, 60.0)
    gyro, heading = (1 + S) * rate + B, H * np.cumsum(rate)
    heading[1500:] += 2.0
    gyro[1480:1500] = np.nan
    for found in (self_calibrate(log(gyro, heading)), fit(log(gyro, heading))):
        assert found.segments == 2
        assert found.s == pytest.approx(S, abs=1e-8) and found.b0 == pytest.approx(B, abs=1e-8)


def test_a_calibration_goes_into_a_part():
    rate, heading, gyro = evaluation(0.0)
    found = self_calibrate(log(gyro, heading, h=EVALUATION))
    gyro = found.in_part(part("imt30")).gyro
    assert gyro.values["scale_factor"]["s"][2] == pytest.approx(S, abs=1e-9)
    assert gyro.values["turn_on_bias"]["b0"][2] == pytest.approx(B, abs=1e-9)
    assert not gyro.values["scale_factor"]["s"][:2].any()
