"""An encoder before a gear with play: the body stays behind it after each reversal, and no gyro."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.identification.close import undeclared
from pyimu.identification.fit.keys import Coefficient
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.logs.trials import aligned_trials
from pyimu.identification.reference.align import fitted_structure
from pyimu.identification.reference.play import unplayed
from pyimu.identification.reference.unfiltered import unplayed_logs
from pyimu.recording.reference.file import with_reference
from pyimu.recording.reference.play import PLAY, behind_play

GYRO_RATE, ENCODER_RATE, FINE = 100, 50, 1000
WHITE = np.radians(0.05)


def head(play: float, counts: int, seed: int, *, scale=0.0, told=behind_play, seconds=90):
    """A pan-tilt head that goes from point to point and rests there, its gyro and its encoders of
    so many ``counts``, which go on by ``play`` rad before it follows.
    """
    rng = np.random.default_rng(seed)
    angles = np.column_stack([_moves(rng, seconds, *np.radians(r)) for r in ((100, 120), (35, 80))])
    body = np.column_stack([told(a, play) for a in angles.T]) if play else angles
    attitude = Rotation.from_euler("ZY", body)
    turns = (attitude[:-1].inv() * attitude[1:]).as_rotvec() * FINE
    gyro = turns[: len(turns) // 10 * 10].reshape(-1, 10, 3).mean(axis=1) * (1.0 + scale)
    gyro += np.radians(rng.normal(0.0, 0.2, 3)) + WHITE * rng.standard_normal(gyro.shape)
    force = attitude.inv().apply([0.0, 0.0, 9.80665])[::10][: len(gyro)]
    log = pyimu.Recording.from_arrays(
        "head", time=(np.arange(len(gyro)) + 0.5) / GYRO_RATE, gyro=gyro, accel=force
    )
    rows = np.arange(0, len(angles) - FINE // 5, FINE // ENCODER_RATE)
    count = 2.0 * np.pi / counts
    q = Rotation.from_euler("ZY", np.round(angles[rows] / count) * count)
    encoders = pyimu.Recording.from_arrays(
        "encoders", time=rows / FINE, ref_q=q.as_quat(scalar_first=True)
    )
    return log, encoders


def _moves(rng, seconds: int, span: float, speed: float) -> np.ndarray:
    """Angles (n,) of moves within a ``span``, of polynomials of fifth degree, and of rests."""
    out, at = [np.zeros(2 * FINE)], 0.0
    while sum(map(len, out)) < seconds * FINE:
        goal = rng.uniform(-span, span)
        part = np.linspace(0.0, 1.0, int((abs(goal - at) / speed * 1.9 + 0.15) * FINE))
        out.append(at + (goal - at) * part**3 * (10.0 - 15.0 * part + 6.0 * part**2))
        at = goal
        out.append(np.full(int(rng.uniform(0.1, 1.5) * FINE), at))
    return np.concatenate(out)[: seconds * FINE]


def trials_of(log: pyimu.Recording):
    """The gyro's trial of a log, as the loop has it, and its sensor."""
    sensor = undeclared(log.sample_rate).gyro
    return aligned_trials(sensor, gyro_trial, [log], [], None), sensor


def undo_of_head(*given, **more):
    """What undoes the play of a head; None where none is seen."""
    (((trial,), _), _) = trials_of(with_reference(*head(*given, **more)))
    return unplayed(trial)


@pytest.mark.parametrize(
    ("play", "counts", "seed"), [(0.2, 4096, 1), (0.05, 1 << 20, 2), (1.0, 8192, 3)]
)
def test_play_is_found_about_both_joints(play, counts, seed):
    """Within a count, by which play may look wider, and a tenth."""
    found = undo_of_head(np.radians(play), counts, seed)
    widths = {joint.name: np.degrees(width) for joint, width in found.keywords["widths"].items()}
    assert set(widths) == {"vertical", "body_y"}
    for width in widths.values():
        assert width == pytest.approx(play, abs=0.1 * play + 360.0 / counts)


@pytest.mark.parametrize("counts", [4096, 1 << 20])
@pytest.mark.parametrize("seed", range(4, 7))
def test_encoders_without_play_have_none(counts, seed):
    assert undo_of_head(0.0, counts, seed) is None


def _backward(angle: np.ndarray, width: float) -> np.ndarray:
    return behind_play(angle[::-1].copy(), width)[::-1]


def test_what_runs_ahead_is_no_play():
    """Play backward in time: before each reversal, as no gear does."""
    assert undo_of_head(np.radians(0.2), 1 << 20, 7, told=_backward) is None


def test_the_gyro_has_its_scale_factor_behind_the_play():
    """0.2 deg of play look like 7,000 ppm of it otherwise."""
    log = with_reference(*head(np.radians(0.2), 1 << 16, 8, scale=3e-3))
    ((log,), _) = unplayed_logs(trials_of(log)[0], ([log], []))
    ((trial,), _), sensor = trials_of(log)
    fitted = fitted_structure(trial, sensor)
    for i in range(3):
        key = Coefficient("scale_factor", "s", (i,))
        found, std = fitted.sensor.values["scale_factor"]["s"][i], fitted.std[key]
        assert std < 1e-3 and abs(found - 3e-3) < 4.0 * std


@pytest.mark.long
def test_play_is_said_and_no_effect_is_added():
    log, encoders = head(np.radians(0.2), 1 << 16, 8, scale=3e-3)
    closed = pyimu.close(log, reference=encoders)
    (found,) = (f for f in closed.quality if f.kind == PLAY)
    assert not closed.added, closed.report()
    for name in ("vertical_play", "body_y_play"):
        assert found.detail[name] == pytest.approx(np.radians(0.2), rel=0.1)
    said = "the reference of head was taken before a gear with a play of 0.2"
    assert said in closed.report() and "about the vertical and 0.2" in closed.report()


angles = st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=50).map(np.array)


@given(angles, st.floats(1e-3, 0.5))
def test_a_body_is_never_farther_behind_than_half_its_play(angle, width):
    behind = behind_play(angle, width)
    assert np.all(np.abs(angle - behind) <= 0.5 * width + 1e-12)
    moved = np.diff(behind)
    assert np.all(moved * np.diff(angle) >= 0.0)
