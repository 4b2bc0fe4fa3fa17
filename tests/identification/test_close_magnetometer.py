"""The magnetometer in ``close``: what is found of it, and when it is no calibration.

The world is made by numpy and scipy alone.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import binom, chi2
from turns import turned

import pyimu
from pyimu import Recording
from pyimu.attitude.calibration import MagnetometerCalibration, as_values, of_sensor
from pyimu.identification.close import undeclared
from pyimu.identification.magnetometer.examine import (
    FOUND,
    NOTHING,
    UNCONFIRMED,
    UNEVEN,
    Examined,
    examined,
)
from pyimu.identification.magnetometer.fit import fit, weakest
from pyimu.identification.magnetometer.rows import field_rows
from pyimu.identification.third_sensor import of_magnetometer
from pyimu.model.sensor import Sensor

RATE = 50.0
FIELD = np.array([3e-6, 18e-6, -45e-6])
"""T; east, north, up."""

NOISE = 2e-7
"""T; of a sample."""

BIAS = np.array([12e-6, -3e-6, 4e-6])
MATRIX = np.array([[1.03, 0.02, -0.01], [0.03, 0.98, 0.01], [-0.02, 0.04, 1.0]])
MATRIX /= np.cbrt(np.linalg.det(MATRIX))


def attitudes(seed: int, rows: int, axes=(1.0, 1.0, 1.0)) -> tuple[np.ndarray, Rotation]:
    """The body's rate (n, 3) rad/s and its attitude, turned by hand about ``axes``."""
    rng, t = np.random.default_rng(seed), np.arange(rows)[:, None, None] / RATE
    omega, phase = rng.uniform(0.3, 1.5, (3, 3)), rng.uniform(0, 2 * np.pi, (3, 3))
    rate = np.asarray(axes) * np.sum(0.7 * np.sin(omega * t + phase), axis=2)
    return rate, turned(Rotation.from_rotvec(rate[1:] / RATE), Rotation.from_euler("z", 0.4))


def log(seed: int, rows: int = 4000, field=FIELD, late: float = 0.0, name: str = "log", **more):
    """A log whose magnetometer has the errors ``bias`` and ``matrix``."""
    bias, matrix = more.get("bias", BIAS), more.get("matrix", MATRIX)
    rate, attitude = attitudes(seed, rows, more.get("axes", (1.0, 1.0, 1.0)))
    rng = np.random.default_rng(seed + 1000)
    true = attitude.apply(field, inverse=True)
    true = true + late * np.cross(rate, true)
    mag = true @ matrix.T + bias + NOISE * rng.standard_normal((rows, 3))
    gyro = rate + 1e-3 * rng.standard_normal((rows, 3))
    accel = attitude.apply([0, 0, 9.81], inverse=True) + 0.01 * rng.standard_normal((rows, 3))
    return Recording.from_arrays(
        name=name,
        time=np.arange(rows) / RATE,
        gyro=gyro,
        accel=accel,
        mag=more.get("mag", mag),
        ref_q=attitude.as_quat(scalar_first=True) if more.get("reference", True) else None,
    )


def look(*logs, holdout=(), part=None) -> Examined | str:
    return examined(part or undeclared(RATE), list(logs), list(holdout), {}, "")


@pytest.mark.long
def test_hard_and_soft_iron_are_found_within_their_errors():
    """Twelve coefficients less the scale of all axes: chi-squared of 11, over 20 draws."""
    total = 0.0
    for seed in range(20):
        found = look(log(seed, rows=3000, late=0.004))
        assert found.outcome == FOUND
        c, covariance = found.after.calibration, found.after.covariance
        off = np.concatenate([c.bias - BIAS, (c.matrix - MATRIX).ravel()])
        # The scale of all axes is not shown: the covariance is singular.
        scale = np.sqrt(np.diag(covariance))
        inverse = np.linalg.pinv(covariance / np.outer(scale, scale), 1e-9)
        total += off / scale @ inverse @ (off / scale)
    low, high = chi2.ppf([1e-4, 1 - 1e-4], 20 * 11)
    assert low < total < high


def test_what_it_leaves_is_noise():
    found = look(log(30))
    rows = 3 * found.errors.after.rows[0]
    low, high = np.sqrt(chi2.ppf([1e-4, 1 - 1e-4], rows) / rows) * NOISE
    assert low < found.errors.after.total < 1.02 * high
    np.testing.assert_allclose(found.white, NOISE, rtol=0.15)
    np.testing.assert_allclose(found.N, NOISE / np.sqrt(RATE), rtol=0.15)
    assert found.errors.before.total > 20 * NOISE


def test_the_field_of_a_log_and_the_delay_are_its_own():
    one, other = log(31, name="one", late=0.01), log(32, name="other", field=-0.5 * FIELD)
    fields = look(one, other).after.fields
    np.testing.assert_allclose(fields["one"].field, FIELD, atol=5e-8)
    np.testing.assert_allclose(fields["other"].field, -0.5 * FIELD, atol=5e-8)
    for name, late in (("one", 0.01), ("other", 0.0)):
        assert abs(fields[name].delay - late) < 4 * fields[name].delay_std < 2e-3


@pytest.mark.long
def test_a_calibrated_magnetometer_lacks_nothing_but_by_chance():
    """A gate of 1 %, in 60 logs."""
    seen = [look(log(s, rows=2000, bias=0, matrix=np.eye(3))) for s in range(40, 100)]
    passed = sum(found.gain > found.gate for found in seen)
    assert passed <= binom.ppf(0.9999, len(seen), 0.01)
    assert sum(found.outcome == NOTHING for found in seen) >= len(seen) - passed


def test_a_field_that_is_not_the_same_everywhere_is_no_calibration():
    """It changes with the way that the body is turned, as beside a table of steel."""
    plain = log(101, bias=0, matrix=np.eye(3))
    _, attitude = attitudes(101, 4000)
    up = attitude.apply([0, 0, 1], inverse=True)
    bent = 3e-6 * np.column_stack([up[:, 0] ** 2, up[:, 1] * up[:, 2], up[:, 2] ** 3])
    room = log(101, mag=plain.mag + attitude.apply(bent, inverse=True))
    found = look(room)
    assert found.outcome == UNEVEN and not found.adopted and found.times_noise > 3


@pytest.mark.filterwarnings("error")
def test_a_simulated_magnetometer_without_noise():
    """What a prior alone knows is not lost beside samples that tell the rest to the last digit."""
    _, attitude = attitudes(120, 12000)
    true = attitude.apply(FIELD, inverse=True)
    nothing = look(log(120, rows=12000, mag=true))
    assert nothing.outcome == NOTHING
    found = look(log(120, rows=12000, mag=true @ MATRIX.T + BIAS))
    assert found.outcome == FOUND
    np.testing.assert_allclose(found.after.calibration.bias, BIAS, rtol=1e-6)
    np.testing.assert_allclose(found.after.calibration.matrix, MATRIX, atol=1e-6)
    assert np.all(np.diag(found.after.covariance) > 0)


def test_held_out_logs_judge_with_a_field_of_their_own():
    found = look(log(110), holdout=[log(111, name="held", field=1.2 * FIELD)])
    assert found.outcome == FOUND and set(found.by_log) == {"held"}
    np.testing.assert_allclose(found.held[0].after.field, 1.2 * FIELD, atol=2e-7)


def test_a_declared_calibration_is_what_it_is_compared_with():
    values = as_values(MagnetometerCalibration(BIAS, MATRIX))
    known = undeclared(RATE).with_sensor(Sensor("mag", values))
    found = look(log(120), part=known)
    assert found.outcome == NOTHING
    np.testing.assert_allclose(found.errors.before.total, NOISE, rtol=0.05)


def test_weakest_is_one_of_a_body_that_turns_every_way():
    rows = field_rows(log(130, rows=3000), np.eye(3), None)
    every = Rotation.random(4000, np.random.default_rng(1)).inv()
    axes = every.as_matrix()
    still = rows.white, rows.turned
    full = type(rows)("full", np.arange(4000.0), axes @ FIELD, axes, 0 * axes, *still)
    assert weakest([full]) == pytest.approx(1.0, abs=0.15)
    level = field_rows(log(130, rows=3000, axes=(0, 0, 1)), np.eye(3), None)
    assert weakest([level]) < 1e-6 and 0.1 < weakest([rows]) < 1.0


def test_the_mounting_of_the_reference_is_not_the_magnetometers():
    """A reference in other axes, undone by the mounting that the gyro shows."""
    turn = Rotation.from_rotvec([0.1, -0.2, 0.3])
    plain = log(140, bias=0, matrix=np.eye(3))
    q = (Rotation.from_quat(plain.ref_q, scalar_first=True) * turn).as_quat(scalar_first=True)
    turned = Recording.from_arrays(
        time=plain.time, gyro=plain.gyro, accel=plain.accel, mag=plain.mag, ref_q=q
    )
    found = fit([field_rows(turned, turn.as_matrix(), None)], MagnetometerCalibration())
    np.testing.assert_allclose(found.calibration.matrix, np.eye(3), atol=2e-3)


def test_the_noise_of_the_reference_is_none_of_the_magnetometers():
    """Attitudes off by 0.6 deg from sample to sample turn the field by twice the sensor's noise.

    The floor is from a quarter of 80 s at least, 3,000 numbers, of whose third differences a fifth
    are independent: their RMS is known to 0.03, and 0.15 are five of these.
    """
    plain = log(150, bias=0, matrix=np.eye(3))
    off = Rotation.from_rotvec(0.01 * np.random.default_rng(2).standard_normal((4000, 3)))
    q = (Rotation.from_quat(plain.ref_q, scalar_first=True) * off).as_quat(scalar_first=True)
    found = look(replace(plain, ref_q=q))
    assert of_magnetometer(found, declared=True) is None
    assert found.times_noise == pytest.approx(1.0, abs=0.15)
    np.testing.assert_allclose(found.white, NOISE, rtol=0.1)


WHY = {
    "no reference": ({"reference": False}, "no reference attitude (ref_q)"),
    "one axis": ({"mag": np.tile([1e-5, 0.0, 0.0], (4000, 1))}, "axis y, z shows zeros alone"),
    "zeros": ({"mag": np.zeros((4000, 3))}, "it shows zeros alone"),
    "gauss": ({"mag": np.full((4000, 3), 0.3)}, "the Earth has 22 to 67 uT"),
    "level": ({"axes": (0.0, 0.0, 1.0)}, "do not tell hard iron, soft iron and field"),
    "still": ({"axes": (0.0, 0.0, 0.0)}, "attitudes, at least 120 are needed"),
}


@pytest.mark.parametrize("case", WHY)
def test_why_it_was_not_examined(case):
    more, said = WHY[case]
    found = look(log(150, **more))
    assert isinstance(found, str) and found.startswith("the magnetometer was not examined: ")
    assert said in found


# The whole of close


@pytest.fixture(scope="module")
def closed():
    return pyimu.close(log(200, rows=6000))


def test_close_says_what_it_found_and_its_model_has_it(closed, tmp_path):
    assert closed.magnetometer.outcome == FOUND
    assert "the magnetometer: hard iron of up to 12.0" in closed.report()
    assert "turn_on_bias b0" in closed.report() and "magnetic field residual on" in closed.report()
    closed.write(tmp_path, units=False)
    data = json.loads((tmp_path / "report.json").read_text())
    assert data["magnetometer"]["outcome"] == "found" and data["magnetometer"]["in_model"]
    field = data["error"]["magnetic_field"]
    assert field["unit"] == "T" and field["after"] < 1.1 * NOISE < field["before"]
    entries = {v["effect"]: v for v in data["estimated"] if v["sensor"] == "mag"}
    np.testing.assert_allclose(entries["turn_on_bias"]["value"], BIAS, atol=1e-7)
    part = pyimu.part(tmp_path / "model.toml")
    np.testing.assert_allclose(of_sensor(part.mag).bias, BIAS, atol=1e-7)
    np.testing.assert_allclose(of_sensor(part.mag).matrix, MATRIX, atol=5e-3)
    page = (tmp_path / "report.html").read_text()
    assert "Magnetometer" in page and "field of each log" in page


def test_the_magnetometer_counts_in_the_verdict():
    """Where gyro and accelerometer lack nothing: iron that a part does not declare is named."""
    seen = look(log(204))
    word = {declared: of_magnetometer(seen, declared) for declared in (True, False)}
    assert word[True].word == "named" and word[False] is None
    outcomes = {NOTHING: None, UNCONFIRMED: "not_confirmed", UNEVEN: "undecidable"}
    for outcome, expected in outcomes.items():
        said = of_magnetometer(replace(seen, outcome=outcome), True)
        assert (said and said.word) == expected
    loud = replace(seen.errors, floor=replace(seen.errors.floor, squares=np.full(3, 1e-20)))
    said = of_magnetometer(replace(seen, outcome=NOTHING, errors=loud), True)
    assert said.word == "unexplained" and "times its noise" in said.reason
    assert of_magnetometer("no field", True).word == "undecidable"
    assert of_magnetometer("", True) is None


def test_the_filter_takes_the_model_of_close(closed):
    """The heading is off by what hard iron bends, and less with it undone."""
    from pyimu.attitude import run

    recording = log(201, rows=4000)
    true = Rotation.from_quat(recording.ref_q, scalar_first=True)
    # The reference's north is the true one, the field's is turned by its east part.
    declination = float(np.arctan2(FIELD[0], FIELD[1]))
    off = []
    for part in (closed.before, closed.after):
        found = run(recording, part, settings={"declination": declination})
        error = true * Rotation.from_quat(found.q, scalar_first=True).inv()
        off.append(np.sqrt(np.mean(error.as_rotvec()[1000:, 2] ** 2)))
    assert off[1] < 0.3 * off[0]


@pytest.mark.long
def test_a_log_without_one_says_nothing_of_it():
    plain = log(202, rows=3000)
    bare = Recording.from_arrays(
        time=plain.time, gyro=plain.gyro, accel=plain.accel, ref_q=plain.ref_q
    )
    found = pyimu.close(bare)
    assert "magnet" not in found.report() and "magnet" not in json.dumps(
        [found.as_dict()[k] for k in ("remarks", "error", "recordings", "not_examined")]
    )


def test_a_magnetometer_without_a_reference_of_its_own_is_said(tmp_path):
    world = log(203, rows=3000, reference=False)
    rate, _ = attitudes(203, 3000)
    known = Recording.from_arrays(
        time=world.time, gyro=world.gyro, mag=world.mag, ref_rate=rate, accel=world.accel
    )
    found = pyimu.close(known)
    assert "the magnetometer was not examined: no reference attitude" in found.report()
    assert found.verdict == "undecidable" and "nothing is missing of the" in found.reason
    found.write(tmp_path, units=False)
    page = (tmp_path / "report.html").read_text()
    assert "magnetometer was not examined" in page
