"""Samples that are means over a time damp the motion a little, too little to be a lag."""

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.identification.close import undeclared
from pyimu.identification.fit.damping import Damped, beyond_noise
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.logs.trials import aligned_trials
from pyimu.identification.reference.align import fitted_structure
from pyimu.identification.search.damped import (
    DAMPED,
    OF_MEANS,
    damped_trial,
    damps_by,
    means_over_a_period,
    sharp_trial,
)
from pyimu.recording.reference.file import with_reference

FINE, RATE, REFERENCE_RATE = 500, 100, 50
WHITE = np.radians(0.05)
GATE = 8.0
"""nat, as the gates of the loop are."""


def in_the_hand(seed: int, seconds: int, means: bool, noise: float = np.radians(0.005)):
    """A unit in a hand that turns to and fro, at up to 1 Hz, whose samples are means over their
    period, or what the gyro showed at one instant; its attitudes have ``noise`` in rad.
    """
    log, attitude, _, rng = _unit(seed, seconds, means)
    rows = np.arange(0, len(attitude) - FINE // 5, FINE // REFERENCE_RATE)
    q = Rotation.from_rotvec(noise * rng.standard_normal((len(rows), 3))) * attitude[rows]
    tracked = pyimu.Recording.from_arrays(
        "tracked", time=rows / FINE, ref_q=q.as_quat(scalar_first=True)
    )
    return log, tracked


def beside_rates(seed: int, seconds: int, means: bool, noise: float):
    """The same beside a gyro that shows the turns at instants, with ``noise`` in rad/s, on a clock
    that is 3 ms off.
    """
    log, _, turns, rng = _unit(seed, seconds, means)
    rates = turns[:, turns.shape[1] // 2]
    rates = rates + noise * rng.standard_normal(rates.shape)
    return log, pyimu.Recording.from_arrays("rates", time=log.time + 0.003, ref_rate=rates)


def _unit(seed: int, seconds: int, means: bool):
    rng, n, every = np.random.default_rng(seed), seconds * FINE, FINE // RATE
    band = butter(2, [0.05, 1.0], "bandpass", fs=FINE, output="sos")
    angles = sosfiltfilt(band, rng.standard_normal((n, 3)), axis=0)
    angles *= np.radians([60.0, 20.0, 20.0]) / angles.std(axis=0)
    attitude = Rotation.from_euler("ZYX", angles)
    turns = (attitude[:-1].inv() * attitude[1:]).as_rotvec() * FINE
    turns = turns[: len(turns) // every * every].reshape(-1, every, 3)
    gyro = turns.mean(axis=1) if means else turns[:, every // 2]
    gyro = gyro + 0.002 + WHITE * rng.standard_normal(gyro.shape)
    force = attitude.inv().apply([0.0, 0.0, 9.80665])[::every][: len(gyro)]
    time = (np.arange(len(gyro)) + 0.5) / RATE
    log = pyimu.Recording.from_arrays("hand", time=time, gyro=gyro, accel=force)
    return log, attitude, turns, rng


def fitted(*given, made=in_the_hand, **more):
    log = with_reference(*made(*given, **more))
    sensor = undeclared(log.sample_rate).gyro
    (((trial,), _), _) = aligned_trials(sensor, gyro_trial, [log], [], None), sensor
    known, _ = with_reference_noise(fitted_structure(trial, sensor), [])
    return fit(known)


@pytest.mark.parametrize("seed", range(3))
def test_means_over_a_period_damp_as_theirs_do(seed):
    one = fitted(seed, 120, True)
    assert np.sqrt(OF_MEANS * damps_by(one, GATE).falls) == pytest.approx(1.0 / RATE, rel=1e-6)
    assert means_over_a_period(one, GATE)


@pytest.mark.parametrize("noise", [0.005, 0.2])
@pytest.mark.parametrize("means", [True, False])
def test_the_noise_of_neither_looks_like_damping(means, noise):
    """Of the reference's rates it would, of the gyro's it would take from it: by the reference
    alone these damp by 5e-7 s^2 more beside 0.2 deg/s.
    """
    one = fitted(20, 120, means, np.radians(noise), made=beside_rates)
    seen, true = beyond_noise(one), means / RATE**2 / OF_MEANS
    # A mean over the fine steps of the rates is taken off, of which a sample shows one.
    assert abs(seen.falls - true) < 4.0 * seen.std + 0.04 / RATE**2 / OF_MEANS
    assert means_over_a_period(one, GATE) == means


@pytest.mark.parametrize("noise", [0.005, 0.2])
@pytest.mark.parametrize("seed", range(3, 6))
def test_nothing_is_damped_of_samples_of_an_instant(noise, seed):
    """Nor by the noise of a reference, whatever that makes of the one side."""
    one = fitted(seed, 120, False, noise=np.radians(noise))
    assert damps_by(one, GATE) is None


def test_a_trial_is_sharp_again():
    (trial,) = fitted(6, 60, True).trials
    bent = damped_trial(trial, Damped(falls=4e-6))
    assert [f.kind for f in bent.findings][-1] == DAMPED and np.ptp(bent.u - trial.u) > 0.0
    again = sharp_trial(bent)
    assert again.findings == trial.findings
    np.testing.assert_array_equal(again.u, trial.u)


@pytest.mark.long
@pytest.mark.parametrize("made", [in_the_hand, beside_rates])
@pytest.mark.parametrize("seed", range(7, 10))
def test_means_are_no_effect_and_no_formula(made, seed):
    """Products of rates and of their slopes, which follow the bent motion, were."""
    log, reference = made(seed, 600, True, np.radians(0.005))
    closed = pyimu.close(log, reference=reference)
    assert not closed.added, closed.report()
    assert [f.kind for f in closed.quality if f.kind == DAMPED]
