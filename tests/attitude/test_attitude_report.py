"""What a run of the attitude filter tells of itself: error, standard deviations, events, findings,
the page, the figure and the files.
"""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from attitude_cases import GRAVITY, WHITE, Drive, H, drive, measured, part, rover_rate
from report_pages import alone
from scipy.spatial.transform import Rotation
from scipy.stats import norm

from pyimu.attitude import STATUS, run
from pyimu.attitude.error import error_against
from pyimu.attitude.filter.status import STATUS_NAMES
from pyimu.attitude.outcome import NIS_BOUNDS
from pyimu.attitude.report.pictures import euler_std
from pyimu.errors import UserError
from pyimu.recording.recording import Recording

OUTSIDE = norm.isf(1e-5)
"""Standard deviations on either side of a tolerance."""


def recorded(world: Drive, seed: int = 0, **more) -> Recording:
    gyro, accel, _ = measured(world, np.random.default_rng(seed), np.array([0.01, -0.02, 0.015]))
    return Recording.from_arrays(time=H * np.arange(len(gyro)), gyro=gyro, accel=accel, **more)


@pytest.fixture(scope="module")
def world():
    return drive(rover_rate(3000, still=1500))


@pytest.fixture(scope="module")
def result(world):
    """Of a log with a reference from its row 100 on, missing cells, and a gap."""
    reference = world.attitude.as_quat(scalar_first=True)
    reference[:100] = np.nan
    log = recorded(world, ref_q=reference)
    log.gyro[2000:2003, 0] = np.nan
    log.accel[1600:1700] = np.nan
    return run(replace(log, time=log.time + 0.5 * (np.arange(3000) >= 2500)), part())


# The error against a reference


def test_error_is_made_of_a_tilt_and_a_heading():
    """A tilt of 0.02 rad and a heading that grows to 0.3 rad, made as rotations of the world."""
    n = 50
    reference = Rotation.random(n, rng=np.random.default_rng(0))
    heading = np.linspace(0, 0.3, n)
    turn = Rotation.from_rotvec(heading[:, None] * [0, 0, 1]) * Rotation.from_rotvec([0.02, 0, 0])
    set_off = Rotation.from_rotvec([0, 0, 1.0])
    q = (set_off * turn * reference).as_quat(scalar_first=True)
    found = error_against(np.arange(n), q, reference)
    np.testing.assert_allclose(found.inclination, 0.02, rtol=1e-9)
    np.testing.assert_allclose(found.heading, heading, atol=1e-9)
    # The half angle of two turns at a right angle (Euler's rotation theorem).
    half = np.arccos(np.cos(heading / 2) * np.cos(0.01))
    np.testing.assert_allclose(found.total, 2 * half, rtol=1e-9)


def test_report_says_the_error_over_the_rows_with_a_reference(result, world):
    rows = np.arange(100, 3000)
    up, true_up = (
        v[rows].apply([0, 0, 1], inverse=True)
        for v in (Rotation.from_quat(result.q, scalar_first=True), world.attitude)
    )
    inclination = np.degrees(np.arccos(np.clip(np.sum(up * true_up, axis=1), -1, 1)))
    said = re.search(
        r"inclination ([\d.]+) deg RMS \(([\d.]+) claimed\), 95 % below ([\d.]+) deg; total .* "
        r"\(2,900 rows; (.*)\)",
        result.report(),
    )
    assert float(said[1]) == pytest.approx(np.sqrt(np.mean(inclination**2)), rel=6e-3)
    assert float(said[3]) == pytest.approx(np.percentile(inclination, 95), rel=6e-3)
    assert "axes are assumed to be the sensor's" in said[4]
    claimed = np.sqrt(np.mean(2 * result.tilt_std[rows] ** 2))
    assert float(said[2]) == pytest.approx(np.degrees(claimed), rel=6e-3)
    assert result.as_dict()["error"]["inclination"]["claimed"] == pytest.approx(claimed)


@pytest.mark.parametrize("reference", [None, np.full((3000, 4), np.nan)])
def test_without_a_reference_there_is_no_error(world, reference):
    found = run(recorded(world, ref_q=reference), part())
    assert found.error is None and "error" not in found.report()
    assert found.as_dict()["error"] is None


# Standard deviations and innovations


@pytest.mark.parametrize("angles", [[0.4, 0.0, 0.0], [1.0, -1.2, 0.3], [-2.0, 0.9, 2.5]])
def test_std_of_the_angles_is_that_of_draws(world, angles):
    """Small errors about the world's axes, added to an attitude: their roll, pitch and yaw."""
    tilt, heading, n, rng = 1e-3, 2e-3, 20_000, np.random.default_rng(1)
    attitude = Rotation.from_euler("ZYX", angles)
    std = np.sqrt(attitude.inv().as_matrix() ** 2 @ np.array([tilt, tilt, heading]) ** 2)
    one = run(recorded(world), part())
    one = replace(
        one,
        q=attitude.as_quat(scalar_first=True)[None],
        std=np.append(std, [0, 0, 0])[None],
        heading_std=np.array([heading]),
    )
    assert one.tilt_std[0] == pytest.approx(tilt, rel=1e-9)
    errors = rng.standard_normal((n, 3)) * [tilt, tilt, heading]
    drawn = (Rotation.from_rotvec(errors) * attitude).as_euler("ZYX")[:, ::-1]
    # The standard deviation of n draws is right to 1/sqrt(2 n) of itself.
    np.testing.assert_allclose(euler_std(one)[0], drawn.std(axis=0), rtol=OUTSIDE / np.sqrt(2 * n))


def test_of_innovations_of_white_noise_95_percent_are_within_the_bounds():
    found = run(recorded(drive(rover_rate(6000, still=1000))), part(), settings=WHITE)
    updates = np.count_nonzero(found.updates)
    assert updates > 5000
    inside = found.as_dict()["nis"]["inside"]
    assert abs(inside - 0.95) < OUTSIDE * np.sqrt(0.95 * 0.05 / updates)
    assert f"{inside:.1%} within their 95 % bounds 0.216 to 9.35" in found.report()
    np.testing.assert_allclose(NIS_BOUNDS, [0.2158, 9.3484], rtol=1e-4)  # a printed table


# Events and findings


def test_events_say_what_how_often_and_when(result):
    (event,) = [e for e in result.events if e.bit == 1]
    assert event.samples == 104  # 3 and 100 rows with missing cells, and the row after the gap
    assert (event.first, event.last) == (16.0, 25.5)
    assert event.text == STATUS[1]
    assert "104 samples, 16.00 to 25.50 s" in result.report()


def test_each_bit_of_the_status_has_a_name():
    assert STATUS_NAMES.keys() == STATUS.keys()


def test_findings_are_those_of_the_log(result):
    kinds = {f.kind: f for f in result.findings}
    assert kinds["gaps"].count == 1
    assert "gaps: 1 (longest 0.5100 s, total 0.5000 s)" in result.report()


def test_clean_log_has_no_findings(world):
    assert run(recorded(world), part()).findings == ()


def test_what_is_left_in_is_said_before_the_figures(world):
    found = run(recorded(world), part(quantization={"q": 1e-4}))
    first = found.report().splitlines()[1]
    assert "left in" in first and "quantization of the gyro" in first
    assert found.as_dict()["left_in"] == ["quantization of the gyro"]
    assert "left in" not in run(recorded(world), part()).report()


def test_gravity_in_g_under_another_unit_is_refused(world):
    log = recorded(world)
    in_g = replace(log, accel=log.accel / GRAVITY)
    with pytest.raises(
        UserError, match=r"a gravity of (1|1\.0\d|0\.99\d) m/s\^2.* are in g: write"
    ):
        run(in_g, part())
    # Where gravity is of that size it is no other unit.
    assert run(in_g, part(), settings={"gravity": 1.0}).findings == run(log, part()).findings


# Page, figure and files


@pytest.fixture(scope="module")
def folder(result, tmp_path_factory):
    return result.write(tmp_path_factory.mktemp("out") / "new").parent


def test_page_stands_alone_and_shows_each_thing(folder):
    page = (folder / "report.html").read_text()
    page = alone(page)
    for title in ("Error against the reference", "Attitude", "Gyro bias", "Gravity", "Status"):
        assert f"<h2>{title}</h2>" in page
    for label in ("roll [deg]", "pitch [deg]", "yaw [deg]", "bias z [deg/s]", "NIS [1]"):
        assert label in page
    for text in ("time [s]", "error [deg]", "input missing", "its last good value was held"):
        assert text in page
    assert "gaps" in page and "longest 0.5100 s" in page


def test_data_are_those_of_the_result(folder, result):
    data = json.loads((folder / "report.json").read_text())
    assert data == json.loads(json.dumps(result.as_dict()))
    assert data["last"]["heading_std"] == result.heading_std[-1]
    assert data["error"]["inclination"]["rms"] == pytest.approx(
        np.sqrt(np.mean(result.error.inclination**2))
    )
    assert {"bit": 1, "samples": 104} == {k: data["status"][0][k] for k in ("bit", "samples")}


def test_files_are_written_together_or_not_at_all(result, tmp_path, monkeypatch):
    (tmp_path / "report.html").write_text("earlier")

    def fail(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pyimu.attitude.result.write_table", fail)
    with pytest.raises(KeyboardInterrupt):
        result.write(tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["report.html"]
    assert (tmp_path / "report.html").read_text() == "earlier"


def test_figure_has_axes_with_units(result):
    labels = [panel.get_ylabel() for panel in result.plot().axes]
    assert labels[:3] == ["roll [deg]", "pitch [deg]", "yaw [deg]"] and labels[-1] == "NIS [1]"
    assert all(re.search(r"\[.+\]$", text) for text in labels)


@pytest.mark.parametrize("rows", [2, 150, 3000])
def test_any_log_has_a_page(world, rows, tmp_path):
    """Also one of two samples, and one without accelerometer, in which gravity is never used."""
    log = recorded(world).slice(0, rows)
    for given in (log, replace(log, accel=None)):
        page = run(given, part()).write(tmp_path).read_text()
        assert "nan" not in re.sub(r"<[^>]*>", "", page).lower().split()


def test_a_log_without_accelerometer_says_so_once_and_of_the_gyro_what_is_missing(world):
    """Bit 1 of its status is of the gyro's samples, not of those that it has none of."""
    log = replace(recorded(world).slice(0, 1000), accel=None)
    gyro = log.gyro.copy()
    gyro[400:600] = np.nan
    found = run(replace(log, gyro=gyro), part())
    assert np.flatnonzero(found.status & 1).tolist() == list(range(400, 600))
    assert "no accelerometer (accel_x, accel_y, accel_z)" in found.report()
    assert not np.any(run(log, part()).status & 1)
    keep = np.r_[0:300, 500:1000]
    cut = Recording.from_arrays(time=log.time[keep], gyro=log.gyro[keep])
    assert np.flatnonzero(run(cut, part()).status & 1).tolist() == [300]
