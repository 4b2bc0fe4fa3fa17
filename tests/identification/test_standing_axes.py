"""Axes that hardly turn in the fitted rows, beside references with noise: their scale factors are
not shown, and what they leave where the axis turns later is not blamed on the model.
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

import pyimu
from pyimu.identification.fit.high_differences import differences, white_of
from pyimu.identification.fit.standing import standing
from pyimu.identification.fit.trials import gyro_trial
from pyimu.recording.recording import Recording

RATE, SECONDS = 100.0, 300.0
LATER = 0.75
"""Share of the log after which z turns fast."""

HELD = 0.7
"""Share of it after which the rows are a log of their own, which judges."""

WHITE = np.radians(0.05)
"""rad/s; noise of a sample of the gyro."""

TRUE = np.array([0.004, -0.003, -0.006])
"""Scale factors."""

ALARM = 1e-4


def log(time: np.ndarray, **groups: np.ndarray) -> Recording:
    return Recording.from_arrays("table", time=time, **groups)


def table(noise: float, turns: float = 0.0, own: bool = False, seed: int = 1):
    """A table that turns x and y to and fro, and z by ``turns`` deg/s until late in the log,
    against a rate with ``noise`` deg/s on a sample, at times of its ``own`` or not.
    """
    rng, time = np.random.default_rng(seed), np.arange(SECONDS * RATE) / RATE
    rate = np.radians(60.0) * np.sin(2 * np.pi * np.outer(time, [0.07, 0.11, 0.09]) + [0, 1, 0])
    later = np.maximum(time - LATER * SECONDS, 0.0)
    rate[:, 2] = np.radians(turns) * np.sin(0.1 * np.pi * time)
    rate[:, 2] += np.radians(60.0) * np.sin(0.2 * np.pi * later)
    gyro = rate * (1 + TRUE) + 0.01 + WHITE * rng.standard_normal(rate.shape)
    at = time[::2] if own else time
    seen = rate[::2] if own else rate
    seen = seen + np.radians(noise) * rng.standard_normal(seen.shape)
    if not own:
        return log(time, gyro=gyro, ref_rate=seen)
    return log(time, gyro=gyro), log(at, ref_rate=seen)


def parts(made: Recording) -> list[Recording]:
    """What is fitted of a log, and what judges."""
    groups = {g: v for g in ("gyro", "ref_rate", "ref_q") if (v := getattr(made, g)) is not None}
    at = int(np.searchsorted(made.time, HELD * SECONDS))
    rows = slice(at), slice(at, None)
    return [log(made.time[r], **{g: v[r] for g, v in groups.items()}) for r in rows]


def judged(made: Recording, part=None):
    fitted, held = parts(made)
    return pyimu.close(fitted, part, holdout=held)


def closed(noise: float, turns: float = 0.0, own: bool = False):
    made = table(noise, turns, own=own)
    if not own:
        return judged(made)
    (fitted, held), references = map(parts, made)
    return pyimu.close(fitted, holdout=held, reference=references)


def scale_factors(found):
    (it,) = [e for e in found.estimated if (e.sensor, e.effect) == ("gyro", "scale_factor")]
    return it


@pytest.mark.parametrize("own", [False, True])
@pytest.mark.parametrize("noise", [0.0, 0.1])
def test_an_axis_that_turns_in_the_held_out_rows_alone_is_not_judged(noise, own):
    """Its scale factor went to -1 beside the noise of the reference, and the verdict was that
    the reference belongs to another body.
    """
    found = closed(noise, own=own)
    assert not found.added and not found.formulas, found.report()
    if found.verdict == "undecidable":
        assert "give a log to fit that moves so" in found.reason and "on z" in found.reason
    else:
        assert found.verdict == "clean" and noise, found.report()
    s = scale_factors(found)
    assert s.shown.tolist() == [True, True, False] and abs(s.value[2]) < 1e-6
    assert np.sum(((s.value - TRUE) / s.std)[:2] ** 2) < chi2.isf(ALARM, 2), s
    left = found.errors["gyro"]
    assert np.all((left.after.per_axis / left.noise_per_axis)[:2] < 1.1)


@pytest.mark.parametrize(
    "turns, own",
    [
        (0.03, False),
        (0.3, True),
        (3.0, False),
        pytest.param(0.03, True, marks=pytest.mark.long),
        pytest.param(0.3, False, marks=pytest.mark.long),
        pytest.param(3.0, True, marks=pytest.mark.long),
    ],
)
def test_a_slow_turn_below_the_noise_of_its_reference_gives_a_scale_factor_or_none(turns, own):
    """A random walk stood for the slow turn, and a scale factor of -98 % took the noise away."""
    found = closed(0.1, turns, own)
    assert not found.added and not found.formulas, found.report()
    assert found.verdict in ("clean", "undecidable"), found.report()
    s = scale_factors(found)
    shown = s.shown
    assert np.sum(((s.value - TRUE) / s.std)[shown] ** 2) < chi2.isf(ALARM, shown.sum()), s
    assert shown[2] or s.value[2] == 0.0 or abs(s.value[2] - TRUE[2]) < 5 * s.std[2]
    assert shown[2] == (turns == 3.0) or turns == 0.3


def test_a_part_that_leaves_its_scale_factors_to_the_data_is_not_spoilt_either(tmp_path):
    part = tmp_path / "part.toml"
    part.write_text(
        'name = "one"\nsample_rate = {value = 100.0, unit = "Hz"}\n[gyro]\n'
        'scale_factor = "estimate"\nturn_on_bias = "estimate"\nangle_random_walk = "estimate"\n'
    )
    s = scale_factors(judged(table(0.1), part))
    assert s.shown.tolist() == [True, True, False] and abs(s.value[2]) < 1e-6


def turned_in_turn(noise: float, seed: int) -> Recording:
    """A log that turns about x first, then about y, and about z in its last quarter, against an
    attitude with ``noise`` deg about each axis.
    """
    rng, time = np.random.default_rng(seed), np.arange(SECONDS * RATE) / RATE
    angles = [
        np.radians(140) * np.sin(2 * np.pi * 0.1 * np.clip(time - first, 0.0, last - first))
        for first, last in ((10.0, 110.0), (120.0, 200.0), (LATER * SECONDS, SECONDS))
    ]
    q = Rotation.from_euler("XYZ", np.column_stack(angles))
    step = (q[:-1].inv() * q[1:]).as_rotvec() * RATE
    rate = 0.5 * (np.vstack([step[:1], step]) + np.vstack([step, step[-1:]]))
    gyro = rate * (1 + TRUE) + 0.01 + WHITE * rng.standard_normal(rate.shape)
    seen = q * Rotation.from_rotvec(np.radians(noise) * rng.standard_normal(rate.shape))
    return log(time, gyro=gyro, ref_q=seen.as_quat(scalar_first=True))


@pytest.mark.parametrize("seed", [pytest.param(1, marks=pytest.mark.long), 4])
def test_beside_an_attitude_the_axes_that_turn_keep_their_scale_factors(seed):
    """What is left before anything is fitted is motion, which the past of it predicts. The rate of
    an axis that stands is the reference's noise, which is no motion of what that leaves."""
    found = judged(turned_in_turn(0.03, seed))
    assert not found.added and found.verdict in ("clean", "undecidable"), found.report()
    s = scale_factors(found)
    assert s.shown.tolist() == [True, True, False] and abs(s.value[2]) < 1e-6
    assert np.sum(((s.value - TRUE) / s.std)[:2] ** 2) < chi2.isf(ALARM, 2), s


@pytest.mark.parametrize("make", [table, turned_in_turn])
def test_without_a_log_to_judge_by_all_axes_are_fitted(make):
    """Of one log other rows are held out than those in which z turns."""
    found = pyimu.close(make(0.03, seed=1))
    assert not found.added and found.verdict in ("clean", "undecidable"), found.report()
    assert found.held_out == "middle 30 %"
    s = scale_factors(found)
    assert s.shown.all() and np.sum(((s.value - TRUE) / s.std) ** 2) < chi2.isf(ALARM, 3), s


@pytest.mark.parametrize("wobble, still", [(0.0, [2]), (1e-3, [])])
def test_an_axis_stands_that_shows_nothing_of_any_motion(wobble, still):
    """A table's own wobble, a thousandth of its turn, is a motion of z that must not be lost."""
    made = table(0.02)
    until = len(made.time) // 2
    rate, gyro = np.array(made.ref_rate[:until]), np.array(made.gyro[:until])
    more = wobble * rate[:, 0]
    rate[:, 2] += more
    gyro[:, 2] += more
    assert standing(gyro_trial(log(made.time[:until], gyro=gyro, ref_rate=rate))) == still


def test_white_noise_is_told_by_its_third_differences():
    """The mean of fifty, within four of its standard errors: a quarter of the rows counts, and
    third differences say as much as 1 in 2.31 of them would."""
    rng, rows = np.random.default_rng(3), 20_000
    found = [
        white_of(differences(rng.standard_normal((rows, 3)), [(0, rows)])).mean() for _ in range(50)
    ]
    std = np.sqrt(2 * 4 * 924 / 400 / (50 * 3 * rows))
    assert np.mean(found) == pytest.approx(1.0, abs=4 * std + 0.005)
