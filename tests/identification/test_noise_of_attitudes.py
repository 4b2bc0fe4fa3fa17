"""The noise of attitudes, which is differentiated: least of it is slow, as a bias is, and it turns
with the body.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import f as ratio

from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.search.choice import Tried
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.recording.recording import Recording

H, ROWS = 0.01, 24_000
DENSITY, NOISE, LATE = 1e-4, np.radians(0.2), 0.008
"""rad/sqrt(s) of the gyro; rad of an attitude; s by which the sensor is late."""

SENSOR = Sensor(
    "gyro", {"angle_random_walk": {"N": [DENSITY] * 3}, "rate_random_walk": {"K": [1e-6] * 3}}
)
ALARM = 1e-4


def rate(time: np.ndarray) -> np.ndarray:
    """A hand's turn (n, 3) rad/s at 0.2 to 1.5 Hz, beside one about z that goes on."""
    rng, out = np.random.default_rng(7), np.zeros((len(time), 3))
    for axis in range(3):
        for frequency in rng.uniform(0.2, 1.5, 25):
            at = 2 * np.pi * (frequency * time + rng.random())
            out[:, axis] += 0.3 * rng.standard_normal() * np.sin(at)
    return out + [0.0, 0.0, 1.0]


@cache
def log(late: float, seed: int = 1) -> Recording:
    """A gyro beside noisy attitudes in its rows, of which the reference knows nothing else."""
    rng, time = np.random.default_rng(seed), H * np.arange(ROWS)
    middle = rate(time[:-1] + 0.5 * H)
    turned = [Rotation.identity()]
    for step in Rotation.from_rotvec(H * middle):
        turned.append(turned[-1] * step)
    attitude = Rotation.concatenate(turned)
    attitude *= Rotation.from_rotvec(NOISE * rng.standard_normal((ROWS, 3)))
    gyro = rate(time - late) + DENSITY / np.sqrt(H) * rng.standard_normal((ROWS, 3))
    return Recording.from_arrays(
        time=time, gyro=gyro, ref_q=attitude.as_quat(canonical=False, scalar_first=True)
    )


def trial_of(late: float, band: float = 3.0):
    return replace(gyro_trial(log(late)), band_hz=band)


def fitted(late: float) -> Fit:
    return begin(SENSOR, frozenset(), [trial_of(late)])


def test_what_a_delay_leaves_of_a_motion_is_no_noise_of_attitudes():
    """The innovations beside a sensor that is 8 ms late are those beside one in time, to the fifth
    of 0.2 deg of attitudes that the bend of 1 rad/s at 1.5 Hz over 8 ms is not.
    """
    on_time, late = fitted(0.0), fitted(LATE)
    for i in range(3):
        assert late.noise[i].r < 1.2 * on_time.noise[i].r


def test_a_delay_is_found_beside_noisy_attitudes():
    """It explains some 30,000 nat; a noise that took the motion for its own left none of them."""
    tried = Tried(with_reference_noise(fitted(LATE), [])[0], SENSOR.values)
    seen = tried.looked()[0]
    (delay,) = [c for c in seen.above() if c.effect == "time_delay"]
    found = tried.refine(delay)
    key = next(k for k in found.fit.std if getattr(k, "effect", "") == "time_delay")
    td = float(found.fit.sensor.values["time_delay"]["td"])
    assert found.gain > 1000.0 and td == pytest.approx(LATE, abs=5 * found.fit.std[key])


def slow(values: np.ndarray, rows: int) -> np.ndarray:
    """Mean square (3,) of means (n, 3) over so many ``rows``."""
    count = len(values) // rows
    means = values[: count * rows].reshape(count, rows, 3).mean(axis=1)
    return np.mean(means**2, axis=0), count


def test_as_much_slow_noise_is_drawn_as_attitudes_of_a_body_that_turns_have():
    """Of an attitude that is wrong by a, the rate is wrong by da/dt + w x a. What turns is hardly
    seen in a second's noise, and is most of that in 5 s. Drawn and real means over 5 s are each as
    good as independent.
    """
    trial, time = trial_of(0.0), H * np.arange(ROWS)
    made = with_reference_noise(fitted(0.0), [], believed=True)[0].trials[0]
    wrong = in_band(trial, trial.u[:, OWN["gyro"]] - rate(time))
    rows = round(5.0 / (trial.h * trial.band.stride))
    there, count = slow(wrong, rows)
    drawn, _ = slow(in_band(trial, made.noise), rows)
    limits = ratio.ppf([ALARM / 6, 1 - ALARM / 6], count, count)
    for i in range(3):
        assert limits[0] < drawn[i] / there[i] < limits[1]
