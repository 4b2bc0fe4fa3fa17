"""Effects with kinks beside attitudes whose noise, once differentiated, is as large as the motion
about them.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu.identification.fit.band import BEYOND
from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.keys import coefficients_of
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.reference.quiet_rate import with_quiet_rate
from pyimu.identification.search.own_kinks import with_own_kinks
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

H, ROWS, BAND = 0.01, 12_000, 3.0
DENSITY, NOISE, BIAS = 1e-4, np.radians(0.1), 0.01
SENSOR = Sensor(
    "gyro", {"angle_random_walk": {"N": [DENSITY] * 3}, "rate_random_walk": {"K": [1e-6] * 3}}
)
SIZES = {"dead_zone": ("d", 2e-3), "scale_factor_asymmetry": ("sa", 0.02)}


def rate(time: np.ndarray) -> np.ndarray:
    """Turns (n, 3) rad/s to and fro at 0.1 to 0.5 Hz, with rests of ten seconds between."""
    rng, out = np.random.default_rng(3), np.zeros((len(time), 3))
    for axis in range(3):
        for frequency in rng.uniform(0.1, 0.5, 12):
            at = 2 * np.pi * (frequency * time + rng.random())
            out[:, axis] += 0.06 * rng.standard_normal() * np.sin(at)
    return out * (np.sin(2 * np.pi * time / 20.0) > 0.0)[:, None]


def as_measured(effect: str, x: np.ndarray) -> np.ndarray:
    size = SIZES[effect][1]
    return x - np.clip(x, -size, size) if effect == "dead_zone" else x + size * np.abs(x)


@cache
def trial_of(effect: str, noise: float = NOISE, seed: int = 1) -> Trial:
    rng, time = np.random.default_rng(seed), H * np.arange(ROWS)
    turned = [Rotation.identity()]
    for step in Rotation.from_rotvec(H * rate(time[:-1] + 0.5 * H)):
        turned.append(turned[-1] * step)
    attitude = Rotation.concatenate(turned)
    attitude *= Rotation.from_rotvec(noise * rng.standard_normal((ROWS, 3)))
    # A dead zone is the output's, behind bias and noise; an asymmetry is the gain's.
    white = DENSITY / np.sqrt(H) * rng.standard_normal((ROWS, 3))
    x, behind = rate(time), BIAS + white
    gyro = (
        as_measured(effect, x + behind)
        if effect == "dead_zone"
        else as_measured(effect, x) + behind
    )
    log = Recording.from_arrays(
        time=time, gyro=gyro, ref_q=attitude.as_quat(canonical=False, scalar_first=True)
    )
    return with_quiet_rate(replace(gyro_trial(log), band_hz=BAND))


def beside(effect: str) -> Fit:
    """The model with the effect, its size fitted beside the reference as it is."""
    name, size = SIZES[effect]
    sensor = SENSOR.with_values(effect, **{name: np.full(3, 0.5 * size)})
    free = coefficients_of(sensor, effect)
    known = with_reference_noise(begin(sensor, free, [trial_of(effect)]), [])[0]
    return fit(known)


@pytest.mark.parametrize("effect", SIZES)
def test_kinks_are_where_the_sensors_own_signal_has_them(effect):
    """The size is the true one within its standard error, which by the reference's it is not."""
    name, size = SIZES[effect]
    smeared = beside(effect)
    found, _ = with_own_kinks(smeared, [])

    def missed(fitted: Fit) -> np.ndarray:
        std = [fitted.std[k] for k in sorted(coefficients_of(fitted.sensor, effect), key=str)]
        return (np.asarray(fitted.sensor.values[effect][name]) - size) / np.array(std)

    assert np.abs(missed(found)).max() < 4.0 < np.abs(missed(smeared)).max()


def test_no_kink_is_moved_beside_a_rate_that_was_measured():
    trial = trial_of("dead_zone")
    measured = begin(
        SENSOR.with_values("dead_zone", d=np.full(3, 1e-3)),
        frozenset(),
        [replace(trial, reference="rate", band_hz=None)],
    )
    found, held = with_own_kinks(measured, [trial])
    assert found is measured and held == [trial]


def loud(attitude: np.ndarray, noise: np.ndarray | float = 0.0) -> Trial:
    """A trial beside attitudes (n, 3) rad, small turns, with all that their rates have, of which
    some is ``noise``.
    """
    time = H * np.arange(ROWS)
    q = Rotation.from_rotvec(attitude + noise).as_quat(scalar_first=True)
    gyro = np.gradient(attitude, H, axis=0)
    log = Recording.from_arrays(time=time, gyro=gyro, ref_q=q)
    return replace(gyro_trial(log), band_hz=BAND)


def own(trial: Trial) -> np.ndarray:
    return trial.u[:, OWN["gyro"]]


def test_a_quiet_rate_has_the_motion_of_its_band():
    """To the 3e-5 that the filter takes an octave below its cutoff, away from the ends."""
    turns = np.outer(np.sin(2 * np.pi * BAND * H * np.arange(ROWS)), [1e-3, 2e-3, 0.0])
    was = loud(turns)
    quiet = with_quiet_rate(was)
    there, before = (in_band(was, own(t))[20:-20] for t in (quiet, was))
    np.testing.assert_allclose(there, before, atol=1e-4 * np.abs(before).max())


def test_a_quiet_rate_has_no_noise_above_its_band():
    own_noise, noise = NOISE * np.random.default_rng(5).standard_normal((2, ROWS, 3))
    was = loud(0.1 * own_noise, noise)
    quiet = with_quiet_rate(was)
    above = np.fft.rfftfreq(ROWS, H) > 2.0 * BEYOND * BAND
    power, before = (np.sum(np.abs(np.fft.rfft(own(t), axis=0)[above]) ** 2) for t in (quiet, was))
    assert quiet.cutoff == BEYOND * BAND and power < 1e-4 * before


def test_a_rate_that_was_measured_stays():
    was = replace(loud(np.zeros((ROWS, 3))), reference="rate")
    assert with_quiet_rate(was) is was
