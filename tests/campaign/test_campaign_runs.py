"""A run of a campaign: a function of its number, right in its errors, honest in its statistics."""

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

import pyimu
from pyimu.rover.campaign.faults import STUCK_FOR, Fault
from pyimu.rover.campaign.one_run import driven
from pyimu.rover.campaign.repeat import repeat
from pyimu.rover.campaign.score import row, row_of
from pyimu.rover.campaign.settings import Settings

CHANCE = 1e-4
"""With this probability a right campaign fails one of these tests."""


def settings(part="imt30", **more):
    """Of a part by name, or as it is."""
    return Settings(pyimu.part(part), **{"rate": 25.0, "terrains": 2, **more})


def noisy():
    """A part with white noise and a random walk on all axes and no other error."""
    part = pyimu.part("imt30")
    gyro = pyimu.Sensor("gyro").with_values("angle_random_walk", N=1e-4)
    accel = pyimu.Sensor("accel").with_values("angle_random_walk", N=1e-3)
    return pyimu.Part(
        "noisy", part.sample_rate, gyro.with_values("rate_random_walk", K=1e-6), accel
    )


def same(a, b):
    """Equal rows; a NaN equals a NaN."""
    return a.keys() == b.keys() and all(
        x == b[k] or (x != x and b[k] != b[k]) for k, x in a.items()
    )


def test_a_run_follows_from_its_number_alone():
    campaign = settings()
    forwards = [row_of(campaign, i) for i in range(4)]
    backwards = [row_of(campaign, i) for i in reversed(range(4))][::-1]
    assert all(same(a, b) for a, b in zip(forwards, backwards, strict=True))
    assert len({r["heading_error_end [rad]"] for r in forwards}) == 4
    assert not same(forwards[0], row_of(settings(seed=1), 0))


def test_errors_are_the_angles_between_estimate_and_truth():
    drive = driven(settings(), 3, keep=True)
    found, first = row(drive), drive.truth.first
    truth = Rotation.from_quat(drive.truth.q[first:], scalar_first=True).as_euler("ZYX")
    estimate = Rotation.from_quat(drive.output("q[1]", 4)[first:], scalar_first=True)
    error = np.unwrap(estimate.as_euler("ZYX"), axis=0) - np.unwrap(truth, axis=0)
    error -= 2 * np.pi * np.round(error[0] / (2 * np.pi))
    for i, name in enumerate(("heading", "pitch", "roll")):
        # Both go through sines and cosines: some rounding of numbers up to pi.
        assert found[f"{name}_error_max [rad]"] == pytest.approx(
            np.abs(error[:, i]).max(), abs=1e-12
        )
        assert found[f"{name}_error_end [rad]"] == pytest.approx(error[-1, i], abs=1e-12)
        rms = np.linalg.norm(error[:, i]) / np.sqrt(len(error))
        assert found[f"{name}_error_rms [rad]"] == pytest.approx(rms, abs=1e-12)


def test_the_drive_begins_and_ends_where_it_should():
    drive = driven(settings(), 0)
    assert not drive.truth.standing[drive.truth.first]
    assert drive.truth.standing[: drive.truth.first].all()
    assert drive.instants[-1] == len(drive.errors)
    # 0 to 180 deg and back
    assert np.rad2deg(np.abs(drive.truth.euler[:, 2]).max()) == pytest.approx(180, abs=0.5)


def test_of_a_matched_part_the_normalised_errors_of_the_bias_are_chi_square():
    """The sum over independent runs of 3 degrees of freedom each (Bar-Shalom and others, 5.4)."""
    campaign, runs = Settings(noisy(), rate=25.0, terrains=1), 40
    bias = sum(row_of(campaign, i)["nees_bias_end [1]"] for i in range(runs))
    low, high = chi2.ppf([CHANCE / 2, 1 - CHANCE / 2], 3 * runs)
    assert low < bias < high


def test_a_declared_error_is_no_bias_and_an_undeclared_one_is():
    """The bias that the filter is judged by is what remains where the nominal part is undone."""
    drive = driven(settings(), 5)
    # The thermal bias of the part is 0.05 deg/s/K over tens of K; the random walk's, by Table 4 of
    # Hidalgo 2012, sqrt(380 s) 64 deg/h/sqrt(h) = 1.0e-4 rad/s; so 6 of that.
    assert np.abs(drive.bias).max() < 6.2e-4


def test_a_stuck_gyro_gives_one_sample_for_its_time():
    rng = np.random.default_rng(0)
    gyro, time = rng.normal(size=(4000, 3)), np.arange(4000) * 0.01
    fault, want = Fault("stuck", 12.345, 0), gyro.copy()
    want[1235 : 1235 + round(STUCK_FOR / 0.01)] = gyro[1235]
    for first in range(0, 4000, 512):
        rows = slice(first, first + 512)
        fault.in_gyro(gyro[rows], time[rows])
    assert np.array_equal(gyro, want)


@pytest.mark.long
def test_each_run_has_the_specimen_of_its_seed():
    part = pyimu.part("stim300")
    drive = driven(settings("stim300"), 4)
    found, want = row(drive), part.specimen(drive.draws.specimen_seed).start_values
    drawn = {
        k.partition(" [")[0]: v for k, v in found.items() if k.startswith(("gyro_e", "accel_e"))
    }
    assert len(drawn) >= 40 and all(want[name] == value for name, value in drawn.items())
    # What the specimen's gyro is off by at rest is its bias to the filter: b0 and the walk since.
    b0 = [want[f"gyro_error.turn_on_bias.b0[{i}]"] for i in (1, 2, 3)]
    assert np.linalg.norm(drive.bias[0] - b0) < 0.5 * np.linalg.norm(b0)
    nominal = row_of(settings("stim300", specimens=False), 4)
    assert nominal["noise_seed"] == found["noise_seed"]
    assert nominal["heading_error_end [rad]"] != found["heading_error_end [rad]"]


def test_on_mars_the_ground_turns_and_the_filter_takes_that_for_bias():
    """The rate of Mars is 350.892 deg a day (Archinal and others 2018), the latitude 52.22 deg."""
    earth, mars = (driven(settings(noisy(), body=b), 1) for b in ("Earth", "Mars"))
    up = (mars.bias - earth.bias)[-1, 2]  # at the end it is level but for the ground's waves
    assert up == pytest.approx(np.deg2rad(350.892 / 86400) * np.sin(np.deg2rad(52.22)), rel=0.02)
    assert np.linalg.norm(mars.truth.force[0]) == pytest.approx(3.728, rel=1e-3)
    assert row(mars)["heading_error_max [rad]"] < 0.05


@pytest.mark.parametrize(
    ("fault", "bit"),
    [
        ("lost-axis", 1),
        pytest.param("saturating", 2, marks=pytest.mark.long),
        ("heading-wrong", 64),
    ],
)
def test_the_status_says_what_failed(fault, bit):
    campaign = settings(faults=(fault,), heading_every=5.0)
    rows = [row_of(campaign, i) for i in range(12)]
    assert {r["fault"] for r in rows} == {"none", fault}
    for r in rows:
        assert bool(r["status"] & bit) == (r["fault"] == fault), r["run"]


def test_a_heading_sensor_that_fails_says_nothing_any_more():
    campaign = settings(faults=("heading-lost",), heading_every=5.0)
    drives = [driven(campaign, i, keep=True) for i in range(6)]
    valid = [v.name for v in drives[0].system.filter.inputs].index("heading_valid")
    for drive in drives:
        times = drive.truth.time[drive.inputs[:, valid] > 0]
        end = drive.fault.time if drive.fault.name != "none" else np.inf
        assert np.diff(times) == pytest.approx(5.0)
        assert end - 5 <= times[-1] < end if np.isfinite(end) else times[-1] > 374


def test_a_run_once_more_has_its_row_and_a_log_that_the_filter_takes(tmp_path):
    campaign = settings(heading_every=30.0)
    folder = repeat(campaign, 3, tmp_path)
    log = pyimu.read_recording(folder / "log.parquet")
    drive = driven(campaign, 3, keep=True)
    assert np.array_equal(log.gyro, drive.inputs[:, :3])
    # A reader brings quaternions to length one.
    assert np.abs(log.ref_q - drive.truth.q).max() < 1e-15
    found = pyimu.attitude.run(log, drive.system.part)
    assert np.rad2deg(np.abs(found.error.heading).max()) < 5
    assert (folder / "errors.png").stat().st_size > 10_000
    assert json.loads((folder / "run.json").read_text())["noise_seed"] == drive.draws.noise_seed
