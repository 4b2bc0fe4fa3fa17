"""Hard and soft iron: found in a log within what is claimed, refused where the log cannot tell,
kept in a file, and undone before the attitude.

The world is made by numpy and scipy alone.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import GRAVITY, N_ACCEL, H, N, attitude_after, part
from scipy.linalg import polar
from scipy.spatial.transform import Rotation
from scipy.stats import f, norm

from pyimu.attitude import MagnetometerCalibration, run
from pyimu.characterization.magnetometer.estimate import magnetometer_fit
from pyimu.errors import UserError
from pyimu.recording.recording import Recording

FIELD = np.array([0.0, 19e-6, -45e-6])
"""T; east, north, up, of a dip of 67 degrees."""

BIAS = np.array([14e-6, -22e-6, 9e-6])
MATRIX = np.array([[1.06, 0.03, -0.02], [0.01, 0.96, 0.04], [-0.03, 0.02, 0.99]])
MATRIX = MATRIX / np.cbrt(np.linalg.det(MATRIX))
NOISE = 2e-7
"""T; of a sample."""

ROWS, STILL = 9000, 150
PERIOD = 2 * H
"""s; half the rate at which the cases are drawn."""

IN_PLACE = {"accel_std": 0.0, "accel_correlation_time": 0.0}
"""The filter's settings for a body that turns in place: its tilt is then as good as it says."""


def log(seed: int, axes=(1, 1, 1), rows: int = ROWS, **more) -> tuple[Recording, Rotation]:
    """A body that is turned by hand about its ``axes``, all the ways round, after a rest; the
    attitude. ``more`` are groups of the recording.
    """
    rng, t = np.random.default_rng(seed), np.arange(2 * rows)[:, None, None] * H
    omega, phase = rng.uniform(0.2, 1.5, (3, 3)), rng.uniform(0, 2 * np.pi, (3, 3))
    rate = np.sum(np.sin(omega * t + phase), axis=2) * axes
    rate[: 2 * STILL] = 0
    attitude = attitude_after(rate)[1::2]
    normal = rng.standard_normal
    gyro = rate.reshape(rows, 2, 3).mean(axis=1) + N / np.sqrt(PERIOD) * normal((rows, 3))
    accel = attitude.apply([0, 0, GRAVITY], inverse=True)
    accel += N_ACCEL / np.sqrt(PERIOD) * normal((rows, 3))
    mag = attitude.apply(FIELD, inverse=True) @ MATRIX.T + BIAS + NOISE * normal((rows, 3))
    groups = {"gyro": gyro, "accel": accel, "mag": mag} | more
    return Recording.from_arrays(time=PERIOD * np.arange(rows), **groups), attitude


def found_in(recording: Recording):
    attitude = run(recording, part(), magnetometer=False, smooth=True, settings=IN_PLACE)
    return magnetometer_fit(recording, attitude)


def off_from_truth(found) -> np.ndarray:
    """Error (12,) of bias and matrix, the bias as a share of the field."""
    calibration = found.calibration
    bias = (calibration.bias - BIAS) / found.strength
    return np.append(bias, (calibration.matrix - MATRIX).ravel())


def squared_error(found) -> float:
    """That in standard deviations squared, of 11 unknowns: the determinant of the matrix is 1."""
    scale = np.append(np.full(3, found.strength), np.ones(9))
    values, vectors = np.linalg.eigh(found.covariance / np.outer(scale, scale))
    return float(np.sum((vectors[:, 1:].T @ off_from_truth(found)) ** 2 / values[1:]))


RUNS = 20


@pytest.mark.long
def test_bias_and_matrix_lie_within_their_covariance():
    """A covariance from so many blocks makes the squares those of Hotelling (1931)."""
    founds = [found_in(log(seed)[0]) for seed in range(RUNS)]
    degrees = founds[0].blocks - 11
    squares = np.array([squared_error(v) for v in founds])
    p = f.sf(squares * degrees / 11 / (founds[0].blocks - 1), 11, degrees)
    # The least and the mean of even draws, the latter of variance 1 / 12 / RUNS.
    assert p.min() > 1 - 0.999 ** (1 / RUNS), p
    assert abs(p.mean() - 0.5) < norm.isf(0.0005) / np.sqrt(12 * RUNS), p


def test_the_axes_are_turned_as_the_polar_decomposition_says():
    found = found_in(log(1)[0])
    truth = Rotation.from_matrix(polar(MATRIX)[0]).as_rotvec()
    away = (found.misalignment - truth) / found.misalignment_std
    assert np.abs(away).max() < norm.isf(0.0005 / 3)
    assert np.abs(truth).max() > 5 * found.misalignment_std.max()


AXES = {"swapped": [[0, 1, 0], [1, 0, 0], [0, 0, -1]], "down": np.diag([1.0, -1.0, -1.0])}


@pytest.mark.parametrize("case", AXES)
def test_axes_that_lie_otherwise_are_found(case):
    """As in parts whose magnetometer has a frame of its own: the field and its dip stay as here."""
    recording, _ = log(12)
    own = np.array(AXES[case], dtype=float)
    found = found_in(replace(recording, mag=recording.mag @ own.T))
    off = np.append(found.calibration.bias - own @ BIAS, (found.calibration.matrix - own @ MATRIX))
    claimed = np.append(found.bias_std, found.matrix_std)
    assert np.all(np.abs(off) < norm.isf(0.0005 / 12) * claimed) and found.along > 0
    dip = np.arctan2(-FIELD[2], FIELD[1])
    assert abs(found.dip - dip) < norm.isf(0.0005) * found.dip_std


def test_the_noise_is_that_of_a_sample_at_rest():
    """Of 150 samples a standard deviation is known to 1 / sqrt(2 n), and by differences to 1.5
    times the variance of that (von Neumann 1941).
    """
    noise = found_in(log(2)[0]).noise
    std = np.sqrt(1.5 / 2 / STILL)
    np.testing.assert_allclose(noise, NOISE * np.sqrt(PERIOD), rtol=norm.isf(0.0005 / 3) * std)


@pytest.mark.long
def test_samples_by_a_magnet_do_not_count():
    """A twentieth of the log beside a magnet moves no coefficient by more than is claimed."""
    clean, _ = log(3)
    mag = clean.mag.copy()
    mag[4000 : 4000 + ROWS // 20] += [30e-6, 0, -20e-6]
    found = [found_in(r) for r in (clean, log(3, mag=mag)[0])]
    moved = off_from_truth(found[1]) - off_from_truth(found[0])
    claimed = np.append(found[1].bias_std / found[1].strength, found[1].matrix_std.ravel())
    assert np.all(np.abs(moved) < norm.isf(0.0005 / 12) * claimed)


TURNS = {
    "about the vertical alone": ((0, 0, 1), r"1 more axis \((x|y)\), held level"),
    "about x alone": ((1, 0, 0), r"1 more axis \((y|z)\), held level"),
}


@pytest.mark.parametrize("case", TURNS)
def test_a_log_with_too_few_turns_is_refused(case):
    axes, said = TURNS[case]
    with pytest.raises(UserError, match=f"cannot be calibrated.*{said}"):
        found_in(log(4, axes)[0])


def test_a_log_at_rest_is_refused():
    with pytest.raises(UserError, match="at least 140 are needed"):
        found_in(log(5, (0, 0, 0))[0])


def test_the_attitude_is_better_once_it_is_undone():
    """Of another log, by the calibration of the first: uncalibrated the bias alone turns the
    heading by a radian, calibrated it is as good as the covariance of the calibration.
    """
    calibration = found_in(log(6)[0]).calibration
    recording, attitude = log(7)
    given = [run(recording, part(), settings=IN_PLACE, magnetometer=m) for m in (True, calibration)]
    raw, undone = (
        (attitude * Rotation.from_quat(r.q, scalar_first=True).inv()).as_rotvec()[STILL:, 2]
        for r in given
    )
    assert np.sqrt(np.mean(raw**2)) > 0.2 and np.sqrt(np.mean(undone**2)) < 0.01
    assert "magnetometer, calibrated" in given[1].report()


def test_the_calibration_of_an_ideal_magnetometer_changes_nothing():
    recording, _ = log(8, rows=1000)
    one, other = (run(recording, part(), magnetometer=m) for m in (True, MagnetometerCalibration()))
    np.testing.assert_array_equal(one.q, other.q)


# The file


def test_a_file_reads_back_as_the_same_numbers(tmp_path):
    path = MagnetometerCalibration(BIAS, MATRIX).write(tmp_path / "magnetometer.toml")
    back = MagnetometerCalibration.read(path)
    np.testing.assert_array_equal(back.bias, BIAS)
    np.testing.assert_array_equal(back.matrix, MATRIX)


GOOD = 'bias = {value = [1, 2, 3], unit = "uT"}\nmatrix = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n'
BAD = {
    "no unit": (GOOD.replace(', unit = "uT"', ""), "bias: expected {value"),
    "another unit": (GOOD.replace("uT", "deg"), "bias: 'deg' cannot be converted to 'T'"),
    "no matrix": (GOOD.splitlines()[0], "matrix is missing"),
    "a row too few": (GOOD.replace(", [0, 0, 1]", ""), "expected 3 x 3 finite numbers"),
    "singular": (GOOD.replace("[0, 0, 1]", "[0, 0, 0]"), "is singular"),
    "unknown key": (GOOD + "biass = 1\n", "did you mean bias?"),
    "no TOML": ("bias = ", "cannot be read as TOML"),
}


def test_a_bias_in_microtesla_is_read(tmp_path):
    (tmp_path / "m.toml").write_text(GOOD)
    bias = MagnetometerCalibration.read(tmp_path / "m.toml").bias
    np.testing.assert_allclose(bias, [1e-6, 2e-6, 3e-6], rtol=1e-15)


@pytest.mark.parametrize("case", BAD)
def test_a_file_that_is_none_is_said_with_its_key(case, tmp_path):
    text, said = BAD[case]
    (tmp_path / "m.toml").write_text(text)
    with pytest.raises(UserError, match="m.toml: ") as error:
        MagnetometerCalibration.read(tmp_path / "m.toml")
    assert said in str(error.value)


def test_a_calibration_without_a_magnetometer_is_an_error():
    recording, _ = log(9, rows=200)
    with pytest.raises(UserError, match="no column mag_x"):
        run(replace(recording, mag=None), part(), magnetometer=MagnetometerCalibration())
    with pytest.raises(UserError, match="expected True, False, a MagnetometerCalibration"):
        run(recording, part(), magnetometer=3)


# The command line


def test_characterize_writes_a_calibration_that_attitude_takes(pyimu, tmp_path):
    recording, _ = log(10)
    path = recording.write(tmp_path / "log.parquet")
    code, out, err = pyimu("characterize", path, "--out", "found")
    assert code == 0 and "magnetometer: bias" in out, err
    calibration = MagnetometerCalibration.read(tmp_path / "found" / "magnetometer.toml")
    np.testing.assert_allclose(calibration.bias, BIAS, atol=1e-6)
    entry = json.loads((tmp_path / "found" / "report.json").read_text())["logs"][0]["magnetometer"]
    np.testing.assert_array_equal(entry["matrix"]["value"], calibration.matrix)
    code, out, err = pyimu("attitude", path, "--magnetometer", "found/magnetometer.toml")
    assert code == 0 and "magnetometer, calibrated" in out, err


@pytest.mark.long
def test_a_log_that_does_not_turn_enough_is_said_and_characterised_all_the_same(pyimu, tmp_path):
    """And one whose field is none of the Earth's, as in gauss under a header of T."""
    path = log(13, (0, 0, 1), 3000)[0].write(tmp_path / "flat.parquet")
    code, out, err = pyimu("characterize", path, "--out", "found")
    assert code == 0 and "cannot be calibrated" in out, err
    assert not (tmp_path / "found" / "magnetometer.toml").exists()
    report = json.loads((tmp_path / "found" / "report.json").read_text())["logs"][0]
    assert report["magnetometer"] is None and "1 more axis" in report["magnetometer_reason"]
    recording, _ = log(14)
    path = replace(recording, mag=1e4 * recording.mag).write(tmp_path / "gauss.parquet")
    assert "see to the unit of mag_x" in pyimu("characterize", path, "--out", "gauss")[1]


def test_a_calibration_beside_none_is_an_error(pyimu, tmp_path):
    path = log(11, rows=200)[0].write(tmp_path / "log.csv")
    words = ("--magnetometer", "m.toml", "--no-magnetometer")
    code, out, err = pyimu("attitude", path, *words)
    assert code == 2 and out == "" and "give one of the two" in err
    code, out, err = pyimu("attitude", path, *words[:2])
    assert code == 2 and out == "" and "m.toml: no such file" in err
