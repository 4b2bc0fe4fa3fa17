"""What ``close`` shows: the whole model with its intervals, what was not examined, what became of
each candidate, what to measure next, and what it was made with.
"""

from __future__ import annotations

import hashlib
import html
import json
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import world
from markupsafe import escape
from numpy.testing import assert_allclose, assert_array_equal

from pyimu.identification.close import close
from pyimu.identification.fit.trial import Trial
from pyimu.identification.found.exhibits import Trace
from pyimu.identification.report import pictures
from pyimu.identification.report.page import page as page_of
from pyimu.identification.rivals.confounds import what_no_log_tells_apart
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part_file import part
from pyimu.model.sensor import Sensor
from pyimu.recording.log import read_recording
from pyimu.recording.recording import Recording
from pyimu.report.numbers import with_limits
from pyimu.units import convert

SCALE = 0.02 * np.array([1.0, -0.7, 0.5])
"""What ``world.changes`` makes of the size 0.02."""


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """A gyro with a scale factor against a reference rate, an accelerometer without reference."""
    motion = world.drive(minutes=2.5, rate_hz=25)
    seen = world.recording(motion, world.changes(motion, "gyro")["scale_factor"](0.02))
    folder = tmp_path_factory.mktemp("private")
    return read_recording(replace(seen, ref_force=None).write(folder / "drive.csv"))


@pytest.fixture(scope="module")
def closed(log):
    return close(log)


@pytest.fixture(scope="module")
def folder(closed, tmp_path_factory):
    out = tmp_path_factory.mktemp("contents")
    closed.write(out, units=False)
    return out


@pytest.fixture(scope="module")
def said(folder):
    return json.loads((folder / "report.json").read_text())


@pytest.fixture(scope="module")
def page(folder):
    return (folder / "report.html").read_text()


@pytest.fixture(scope="module")
def still():
    """Two minutes at rest, white noise of 1e-3 rad/s a sample at 10 Hz."""
    rng = np.random.default_rng(2)
    time = np.arange(0, 120, 0.1)
    gyro = 1e-3 * rng.standard_normal((len(time), 3))
    return close(Recording.from_arrays(name="rest", time=time, gyro=gyro))


def entry(said, effect, parameter):
    (found,) = (
        v for v in said["estimated"] if (v["effect"], v["parameter"]) == (effect, parameter)
    )
    return found


# The model


def test_truth_lies_within_five_standard_errors(said):
    # A normal variate is further off once in two million.
    s = entry(said, "scale_factor", "s")
    assert np.all(np.abs(s["value"] - SCALE) < 5 * np.array(s["std"]))
    assert_allclose(np.subtract(s["high"], s["low"]), 2 * 1.959964 * np.array(s["std"]), rtol=1e-6)


def test_every_coefficient_of_the_model_is_said(closed, said):
    sensor = closed.after.gyro
    there = {(v["effect"], v["parameter"]) for v in said["estimated"]}
    assert {(e.name, n) for e in sensor.effects for n in e.parameters} <= there
    for v in said["estimated"]:
        if v["effect"] in sensor.values:
            known = np.array(v["shown"])
            value = np.array(v["value"], dtype=float)[known]
            held = sensor.values[v["effect"]][v["parameter"]][known]
            # The part holds the same to a thousandth of the interval's half, as its file is read.
            half = np.array(v["high"], dtype=float)[known] - value
            assert np.all(np.abs(held - value) <= np.nan_to_num(1e-2 * half, nan=1e-9))


def test_intervals_on_the_page_and_the_terminal_are_those_of_the_json(closed, said, page):
    s = entry(said, "scale_factor", "s")
    for i in range(3):
        text = with_limits(*(100 * s[k][i] for k in ("value", "low", "high")))
        value, _, bracket = text.partition(" ")
        assert f"{value}<small>{bracket}</small>" in page and text in closed.report()


def test_model_file_reads_back_to_the_same_part(closed, folder):
    again = part(folder / "model.toml")
    assert again == closed.after
    source = again.notes["gyro", "scale_factor", "s"]["source"]
    assert (
        re.match(r"estimated by pyimu close: x [\d.]+ \([\d.]+ to", source)
        and "95 % intervals in %" in source
    )


def test_what_no_log_shows_is_no_zero(still, tmp_path):
    shown = {v.effect: v for v in still.estimated}
    assert not shown["scale_factor"].shown.any()
    assert shown["scale_factor"].as_dict()["value"] == [None] * 3
    still.write(tmp_path, units=False)
    written = (tmp_path / "model.toml").read_text()
    assert "[gyro.scale_factor]" not in written and "[gyro.turn_on_bias]" in written
    assert "scale_factor" in still.after.description and "not shown" in still.report()


def test_prior_that_outweighs_the_logs_shows_nothing():
    # About z alone: of the scale factors and misalignments those of the other columns are the
    # prior's.
    rng = np.random.default_rng(5)
    time = np.arange(0, 60, 0.04)
    rate = np.column_stack([0 * time, 0 * time, np.sin(0.9 * time) + 0.7 * np.sin(2.3 * time)])
    gyro = rate + 1e-3 * rng.standard_normal(rate.shape)
    found = close(Recording.from_arrays(name="table", time=time, gyro=gyro, ref_rate=rate))
    shown = {v.effect: v.shown for v in found.estimated}
    assert_array_equal(shown["scale_factor"], [False, False, True])
    assert_array_equal(shown["misalignment"], [[0, 0, 1], [0, 0, 1], [0, 0, 0]])


# What was not examined


def test_unexamined_sensor_is_said_and_left_out(closed, said, page, folder):
    (one,) = said["not_examined"]
    assert one["sensor"] == "accel" and "no reference of its force" in one["reason"]
    assert one["reason"] in closed.report() and one["reason"][1:] in html.unescape(page)
    assert "[accel" not in (folder / "model.toml").read_text()
    assert "passes the accelerometer on unchanged" in page_of(closed, ("ImuSensor.fmi3.fmu",))


def test_part_passes_an_unexamined_sensor_on_unchanged(closed):
    motion = world.drive(minutes=0.2, rate_hz=25)
    clean = world.recording(motion)
    out = replace(closed.after, sample_rate=25.0).simulate(clean)
    assert_array_equal(out.accel, clean.ref_force)


# Candidates and proposals


def test_each_candidate_above_the_gate_has_one_fate(closed, said, page):
    first, last = closed.exhibits["gyro"].first, closed.exhibits["gyro"].last
    names = {c.effect for s in (first, last) for c in s.above()}
    told = [c["effect"] for c in said["candidates"] if c["sensor"] == "gyro"]
    assert names <= set(told) and len(told) == len(set(told))
    refused = {c["effect"] for c in said["candidates"] if c["outcome"] == "refused"}
    assert refused == {r["effect"] for r in said["refused"]}
    for c in said["candidates"]:
        assert str(escape(c["reason"])) in page


def test_proposed_turn_shows_what_white_noise_lets_it(still):
    """N over rms and the root of the time, Kay 1993, example 4.1; the noise itself was estimated
    from 840 rows, to 1 / sqrt(2 * 840) of it.
    """
    (turn,) = (a for a in still.next if a.measure.startswith("turn about"))
    gain = next(g for g in turn.gains if g.effect == "scale_factor")
    rms, white = np.radians(90.0) / np.sqrt(2), 1e-3 * np.sqrt(0.1)
    assert gain.now is None
    assert gain.then == pytest.approx(1.96 * white / (rms * np.sqrt(60.0)), rel=5 / np.sqrt(1680))


def test_proposals_are_few_and_on_the_page(closed, said, page):
    assert 0 < len(said["next"]) <= 5
    assert said["next"][0]["sensor"] == "accel" and "six faces" in said["next"][0]["measure"]
    assert "six faces" in page and "six faces" in closed.report()
    assert any("--holdout" in a["measure"] for a in said["next"])


@pytest.mark.parametrize("effect", ["misalignment", "temperature_rate", "clock_skew"])
def test_exact_confound_is_said(effect):
    nothing = np.zeros((9, 3)), np.zeros((9, 7)), [(0, 9)], frozenset(), "attitude"
    trial = Trial("log", "gyro", 0.1, np.arange(9) * 0.1, *nothing, free_rotation=True)
    e, sensor = CATALOGUE[effect], Sensor("gyro").with_values(effect)
    note = what_no_log_tells_apart(e, sensor, [trial])
    assert e.confound.of in note and e.confound.apart in note
    known = [replace(trial, free_rotation=False)]
    assert bool(what_no_log_tells_apart(e, sensor, known)) is (effect != "misalignment")


@pytest.mark.parametrize(
    "effect, said", [("scale_factor_nonlinearity", True), ("rate_ramp", False)]
)
def test_a_gain_beside_positions_may_be_their_size(effect, said):
    sensor = Sensor("accel").with_values(effect)
    for place in (SimpleNamespace(gravity_std=1e-3, scale_std=0.03), None):
        trial = SimpleNamespace(place=place, clock=None, free_rotation=True)
        note = what_no_log_tells_apart(CATALOGUE[effect], sensor, [trial])
        assert ("positions of another size" in note) is (said and place is not None)


# Logs, time and origin


def test_overview_is_what_numpy_says_of_the_log(log, said):
    seen = said["recordings"][0]["overview"]
    assert_allclose(seen["rate"]["rms"], np.sqrt(np.mean(log.gyro**2, axis=0)))
    assert_allclose(seen["rate"]["largest"], np.abs(log.gyro).max(axis=0))
    assert_allclose(seen["specific_force"]["rms_about_mean"], log.accel.std(axis=0))
    assert seen["duration"]["value"] == log.time[-1] - log.time[0]
    assert said["reference"][0]["kind"] == "rate"


def test_time_axis_is_that_of_the_log():
    values = np.random.default_rng(1).standard_normal((400, 3))
    time = [start + 0.05 * np.arange(400) for start in (1000.0, 7000.0)]
    names = ("morning", "evening")
    traces = [
        Trace(n, t, [(0, 400)], values, values, (0, 1, 2), 0.05)
        for n, t in zip(names, time, strict=True)
    ]
    svg = pictures.over_time(traces, None, "rad/s")
    for text in ("time [s] of morning", "time [s] of evening", "1010", "7010"):
        assert text in svg


def test_inputs_are_named_by_their_digests(log, said, page):
    digest = hashlib.sha256(log.path.read_bytes()).hexdigest()
    made = said["made_with"]
    assert made["files"] == [{"file": "drive.csv", "sha256": digest}]
    assert "drive.csv" in made["command"] and digest in page
    assert str(log.path.parent) not in page + json.dumps(said)


def test_command_line_is_kept_without_folders(closed, log, tmp_path):
    line = ["close", str(log.path), f"--out={tmp_path}/out", "--latitude", "52"]
    made = closed.by_command(line).made_with
    assert made.command == "pyimu close drive.csv --out=out --latitude 52"
    assert [name for name, _ in made.files] == ["drive.csv"]


def test_terminal_speaks_people_s_units(closed):
    last = closed.report().splitlines()
    (error,) = (line for line in last if line.startswith("rate residual"))
    before, after = (closed.errors["gyro"].before.total, closed.errors["gyro"].after.total)
    unit = next(u for u in ("deg/s", "deg/h") if f" {u}" in error)
    shown = [float(v) for v in error.split(": ")[1].split(f" {unit}")[0].split(" -> ")]
    assert_allclose(shown, convert(np.array([before, after]), "rad/s", unit), rtol=5e-3)
    assert "times the floor" in error and "rad/s" not in error


@pytest.mark.parametrize(
    "numbers, said",
    [
        ((1.0213, 0.981, 1.061), "1.021 (0.981 to 1.061)"),
        ((-0.0012, -0.05, 0.0476), "-0.001 (-0.050 to 0.048)"),
        ((331.2, 319.0, 343.0), "331 (319 to 343)"),
        ((7.45e-6, 6.6e-6, 8.3e-6), "7.5 (6.6 to 8.3) ×10⁻⁶"),
        ((3.33, np.nan, np.nan), "3.330"),
    ],
)
def test_interval_ends_at_two_figures_of_its_width(numbers, said):
    assert with_limits(*numbers) == said
