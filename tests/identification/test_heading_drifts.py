"""A reference whose heading drifts slowly: that is along the vertical, and no bias of a sensor."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.heading_drifts import DRIFTS, with_steady_heading
from pyimu.model.kinds import OWN
from pyimu.recording.reference.file import with_reference

FINE, RATE, REFERENCE_RATE, SECONDS = 200, 50, 50, 300
WHITE = np.radians(0.05)
DRIFT = np.radians(0.03)


def drift_at(time: np.ndarray) -> np.ndarray:
    """A rate that comes and goes within two minutes, and stays in the mean."""
    return DRIFT * (0.3 + np.sin(2 * np.pi * time / 120.0))


def trial_of(seed: int, heading: float = 0.0, bias=lambda time, force: 0.0):
    """A unit in a hand that leans by some tens of degrees, beside attitudes whose heading drifts by
    ``heading`` times ``drift_at``, with a ``bias`` (n, 3).
    """
    rng, n = np.random.default_rng(seed), SECONDS * FINE
    band = butter(2, [0.05, 1.0], "bandpass", fs=FINE, output="sos")
    angles = sosfiltfilt(band, rng.standard_normal((n, 3)), axis=0)
    angles *= np.radians([60.0, 20.0, 20.0]) / angles.std(axis=0)
    attitude = Rotation.from_euler("ZYX", angles)
    turns = (attitude[:-1].inv() * attitude[1:]).as_rotvec() * FINE
    every = FINE // RATE
    gyro = turns[: len(turns) // every * every].reshape(-1, every, 3).mean(axis=1)
    time = (np.arange(len(gyro)) + 0.5) / RATE
    up = attitude[every // 2 :: every][: len(gyro)].inv().apply([0.0, 0.0, 1.0])
    gyro = gyro + 0.002 + WHITE * rng.standard_normal(gyro.shape) + bias(time, up)
    log = pyimu.Recording.from_arrays("hand", time=time, gyro=gyro)
    rows = np.arange(0, n, FINE // REFERENCE_RATE)
    turned = heading * np.cumsum(drift_at(np.arange(n) / FINE))[rows] / FINE
    q = Rotation.from_rotvec(turned[:, None] * [0.0, 0.0, 1.0]) * attitude[rows]
    q = Rotation.from_rotvec(1e-4 * rng.standard_normal((len(rows), 3))) * q
    seen = pyimu.Recording.from_arrays("seen", time=rows / FINE, ref_q=q.as_quat(scalar_first=True))
    return gyro_trial(with_reference(log, seen), None)


def warms_up(time, up):
    return np.radians(0.1) * np.exp(-time / 60.0)[:, None] * np.array([0.0, 0.0, 1.0])


def follows_gravity(time, up):
    return np.radians(0.05) * up


def warms_up_across(time, up):
    return warms_up(time, up)[:, ::-1]


@pytest.mark.parametrize(("bias", "off"), [(lambda *_: 0.0, 0.3), (warms_up_across, 0.6)])
@pytest.mark.parametrize("seed", range(2))
def test_a_heading_that_drifts_is_the_references(seed, bias, off):
    """Beside a bias that changes, too, only what the body leans tells the two apart."""
    trial = trial_of(seed, 1.0, bias)
    steady, true = with_steady_heading(trial), drift_at(trial.time)
    (found,) = [f for f in steady.findings if f.kind == DRIFTS]
    assert found.detail["level"] == pytest.approx(np.sqrt(np.mean(true**2)), rel=off)
    taken = np.linalg.norm((trial.u - steady.u)[:, OWN["gyro"]], axis=1)
    assert np.sqrt(np.mean((taken - np.abs(true)) ** 2)) < off * DRIFT


@pytest.mark.parametrize("still", ["gyro", "reference"])
def test_beside_what_stands_still_no_drift_is_seen(still):
    trial = trial_of(0)
    y = trial.y * (still != "gyro")
    u = trial.u.copy()
    u[:, OWN["gyro"]] *= still != "reference"
    trial = replace(trial, y=y, u=u)
    assert with_steady_heading(trial) is trial


@pytest.mark.parametrize("bias", [lambda *_: 0.0, warms_up, follows_gravity])
@pytest.mark.parametrize("seed", range(2, 4))
def test_what_a_sensor_does_is_its_own(seed, bias):
    trial = trial_of(seed, 0.0, bias)
    assert with_steady_heading(trial) is trial
