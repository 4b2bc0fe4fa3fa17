"""The noise of positions, which is differentiated twice: as much as there is is taken out."""

import numpy as np
import pytest
import test_filtered_places
from scipy.spatial.transform import Rotation, RotationSpline
from test_filtered_places import GRAVITY, PLACES, Wand
from test_force_of_places import waves

from pyimu.identification.close import undeclared
from pyimu.identification.fit.columns import in_band
from pyimu.identification.fit.fit import Fit, begin
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.maximum_likelihood import fit
from pyimu.identification.fit.reference_noise import with_reference_noise
from pyimu.identification.fit.trials import accel_trial
from pyimu.identification.logs.trials import prepared
from pyimu.identification.model.left_to_data import left_to_data, prior_of_structure
from pyimu.identification.search.forward import _first
from pyimu.model.kinds import OWN
from pyimu.recording.recording import Recording
from pyimu.recording.reference.file import with_references

PLACE_NOISE, FRAMES = 1e-3, 140.9


def trial_of(wand: Wand, **changes):
    (trial,), _ = prepared([accel_trial(wand.log(**changes), False)], [], True)
    return trial


def fitted(trial) -> Fit:
    """The model of a part that nobody declared beside the noise of its reference."""
    start = undeclared(1.0 / trial.h)
    free = left_to_data(start, False, start.accel, [trial])
    first = _first(begin(start.accel, free, [trial], prior_of_structure(start.accel, free)), False)
    return fit(with_reference_noise(first, [], False)[0])


def scales(found: Fit) -> np.ndarray:
    """Scale factors (k,) that were found, of a sensor that has none, in standard errors."""
    keys = [k for k in found.free if isinstance(k, Coefficient) and k.effect == "scale_factor"]
    values = found.sensor.values["scale_factor"]["s"]
    return np.array([values[k.index] / found.std[k] for k in keys])


def test_as_much_noise_is_drawn_as_positions_have():
    """The low-pass that the force goes through is no reason to draw it twice over. It is read off
    two windows of 64 rows: four standard errors of a variance by so many are 4 sqrt(2 / 128).
    """
    wand = Wand(seed=41, place_noise=PLACE_NOISE)
    trial, without = trial_of(wand), trial_of(wand, places=Wand(seed=41, place_noise=0.0).place)
    there = in_band(trial, (trial.u - without.u)[:, OWN["accel"]])
    drawn = in_band(trial, fitted(trial).trials[0].noise)
    assert drawn.var(axis=0).mean() == pytest.approx(there.var(axis=0).mean(), rel=0.5)


def test_a_long_arm_is_no_noise_of_positions(monkeypatch):
    """Before it is found 0.4 m of it leave ten times the noise that there is: taken for noise, they
    had scale factors 13 standard errors off.
    """
    monkeypatch.setattr(test_filtered_places, "ARM", np.array([0.3, -0.2, 0.25]))
    off = scales(fitted(trial_of(Wand(seed=52, place_noise=PLACE_NOISE))))
    assert len(off) == 3 and np.abs(off).max() < 4.5


def test_noise_above_the_motion_does_not_come_down_into_the_band():
    """Cameras of 141 Hz beside rows of 200 Hz: images of what lies at 59 Hz fold to nothing, by
    0.1 m/s^2 of a quadrotor that leans by as much; and attitudes that are noisy turn it down. What
    is left is no more than twice the noise that positions have at the end of the band.
    """
    found = fitted(hovering(np.random.default_rng(61)))
    (trial,), (left,) = found.trials, found.residuals()
    band = trial.band_hz
    most = PLACE_NOISE * (2.0 * np.pi * band) ** 2 * np.sqrt(2.0 * band / FRAMES)
    assert np.all(left.residual.std(axis=0) < 2.0 * most)
    assert np.abs(scales(found)).max() < 4.5


def hovering(rng):
    """The trial of a body that is pushed to and fro and leans by a few degrees."""
    time = np.arange(0.0, 90.0, 1.0 / 200.0)
    frames = np.arange(0.1003, 89.9, 1.0 / FRAMES)
    lean = waves(np.random.default_rng(rng.integers(99)), np.append(time, frames), 0.01, 0.3, 2.0)
    push = waves(np.random.default_rng(rng.integers(99)), np.append(time, frames), 0.2, 0.1, 0.6)
    order = np.argsort(np.append(time, frames))
    turn = RotationSpline(np.append(time, frames)[order], Rotation.from_rotvec(lean[0][order]))
    body, n = turn(time), len(time)
    force = body.inv().apply(push[2][:n] + [0.0, 0.0, GRAVITY])
    seen = turn(frames) * Rotation.from_rotvec(1e-3 * rng.standard_normal((len(frames), 3)))
    places = push[0][n:] + PLACE_NOISE * rng.standard_normal((len(frames), 3))
    cameras = Recording.from_arrays(
        name="cameras",
        time=frames,
        ref_q=seen.as_quat(scalar_first=True),
        **dict(zip(PLACES, places.T, strict=True)),
    )
    log = Recording.from_arrays(
        name="hovering",
        time=time,
        gyro=turn(time, 1) + 2e-3 * rng.standard_normal((n, 3)),
        accel=force + 0.01 * rng.standard_normal((n, 3)),
    )
    (log,) = with_references([log], [cameras])
    (trial,), _ = prepared([accel_trial(log, False)], [], True)
    return trial
