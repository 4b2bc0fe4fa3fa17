"""The test drives: the contract of report.json, and what is refused."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.errors import UserError
from pyimu.recording.integration import integrated
from pyimu.rover import table6
from pyimu.rover.paper import ANGLES, PAPER_DRIVES
from pyimu.rover.table6 import METHODS, Rover, rover_tests

SPOT = PAPER_DRIVES[-1:]


@pytest.fixture(scope="module")
def slow_part():
    """The paper's gyros at a tenth of their rate, which the drives are ten times as fast with."""
    return replace(pyimu.part("imt30"), sample_rate=97.6)


@pytest.fixture(scope="module")
def tests_of(slow_part):
    """The turn on the spot; the loop is taken as closed with the truth, as ``close`` has tests of
    its own and takes longer than all drives.
    """

    def closed(rover, say=None):
        return SimpleNamespace(
            after=rover.true.with_sensor(
                rover.known.gyro.with_values("scale_factor", s=table6.UNDECLARED)
            ),
            verdict="named",
            reason="gyro scale_factor",
            added=(),
        )

    def run(seeds):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(table6, "loop_closed", closed)
            return rover_tests(slow_part, seeds, SPOT)

    return run


@pytest.fixture(scope="module")
def found(tests_of):
    return tests_of((1, 2))


@pytest.mark.long
def test_report_json_has_a_row_a_drive_and_method(found, tmp_path):
    page = found.write(tmp_path)
    report = json.loads((tmp_path / "report.json").read_text())
    rows = report["table6"]
    assert [(r["drive"], r["method"]) for r in rows] == [("turn_on_spot", m) for m in METHODS]
    for r in rows:
        assert r["paper"] == {"heading": 6.5, "pitch": 0.2, "roll": 0.4} and r["unit"] == "deg"
        for a in ANGLES:
            assert len(r["each"][a]) == 2
            assert r[a] == pytest.approx(np.median(r["each"][a]), rel=1e-12)
            assert r["least"][a] <= r[a] <= r["most"][a]
    assert rows[-1]["target"] == {"heading": 0.5, "pitch": 0.2, "roll": 0.2}
    assert report["scale_factor"]["put_in"] == pytest.approx(-6.5 / 180)
    assert report["simulated"] is True and page.read_text().startswith("<!")


def test_the_published_filter_turns_less_far_by_the_scale_factor(found):
    """180 deg times the scale factor, to within four standard deviations of noise and reference."""
    run = found.runs[0]
    spread = 4 * np.hypot(np.rad2deg(run.noise.std(run.noise.duration / 2)), 0.2)
    assert np.all(np.abs(run.largest[:, 1, 0] - 6.5) < spread)
    assert np.all(run.largest[:, 2, 0] < run.largest[:, 1, 0])


def test_the_same_seed_gives_the_same_figures(found, tests_of):
    again = tests_of((2,))
    assert np.array_equal(again.runs[0].largest[0], found.runs[0].largest[1])


def test_terminal_and_page_say_what_the_noise_allows(found):
    text = found.report()
    assert "Allowed by the declared noise: median" in text and "is simulated" in text


def test_a_part_without_gyro_noise_is_refused():
    part = replace(pyimu.part("imt30"), gyro=pyimu.part("imt30").gyro.without("angle_random_walk"))
    with pytest.raises(UserError, match=r"imt30: its gyro has no noise \(angle_random_walk.N\)"):
        Rover.of(part)


def test_a_part_too_slow_for_the_low_pass_is_refused():
    with pytest.raises(UserError, match="20 Hz, the low-pass of 10 Hz needs more than 20 Hz"):
        Rover.of(replace(pyimu.part("imt30"), sample_rate=20.0))


def test_an_unknown_part_is_one_line(capsys, monkeypatch, tmp_path):
    from pyimu.cli import main

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", ["pyimu", "rover", "--part", "imt31"])
    with pytest.raises(SystemExit) as left:
        main()
    err = capsys.readouterr().err
    assert left.value.code == 2 and "imt31" in err and err.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_integration_is_the_product_of_all_turns():
    rng = np.random.default_rng(3)
    rate, h, start = rng.standard_normal((50, 3)), 0.01, Rotation.from_rotvec([0.1, 0.2, 0.3])
    found, q = integrated(rate, h, start), start
    for k in range(50):
        q = q * Rotation.from_rotvec(h * rate[k]) if k else q
        assert (found[k].inv() * q).magnitude() < 1e-13
