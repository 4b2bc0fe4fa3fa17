"""Logs as people have them: each layout, raw, comes to the samples that were put in, and through
``pyimu characterize`` by one command, or by two where ``pyimu inspect`` has to write the map.
"""

import json
import re
import tomllib

import numpy as np
import pytest
import raw_logs
from scipy.spatial.transform import Rotation
from turns import turned as attitudes

from pyimu import Recording, inspect, read_recording
from pyimu.errors import UserError
from pyimu.recording.formats.suffix import open_reader
from pyimu.recording.formats.told import told_from
from pyimu.recording.guess.numbers import force_unit, rate_unit, sensitivities, time_unit
from pyimu.recording.guess.proposal import proposed
from pyimu.recording.log import read_reference
from pyimu.recording.naming.name import named
from pyimu.recording.naming.triads import triads
from pyimu.recording.quality.inspect import rate_of_part

ROUNDED = {"german", "xio", "iphone"}
"""Layouts in other units: numbers are multiplied, and come back to some roundings."""


@pytest.fixture(scope="module")
def log():
    return raw_logs.still()


def written(make, folder, log):
    """The file, and the options that it needs."""
    pytest.importorskip(raw_logs.NEEDS.get(make.__name__, "numpy"))
    path = make(folder, log)
    return path, (folder / raw_logs.MAP if make in raw_logs.MAPPED else None)


@pytest.mark.parametrize("make", [*raw_logs.ALONE, *raw_logs.MAPPED], ids=lambda m: m.__name__)
def test_samples_come_back(make, tmp_path, log):
    time, gyro, accel = log
    found = read_recording(*written(make, tmp_path, log))
    bits = 4e-16 if make.__name__ in ROUNDED else 0.0
    np.testing.assert_allclose(found.gyro, gyro, rtol=bits, atol=0)
    if make is raw_logs.apart:
        # between two samples lies their mean; the last is past the other file's end by a step
        half = accel[:-2:2] / 2 + accel[2::2] / 2
        # a share of 15 s / 20 ms is known to 15 / 0.02 roundings of 1e-16, of steps of 0.1 m/s^2
        np.testing.assert_allclose(found.accel[1:-2:2], half, rtol=4e-16, atol=1e-14)
        np.testing.assert_allclose(found.accel[::2], accel[::2], rtol=4e-16, atol=1e-14)
    else:
        np.testing.assert_allclose(found.accel, accel, rtol=bits, atol=0)
    # ns at 1e15 and microseconds are exact; the others are decimal fractions of a second
    np.testing.assert_allclose(found.time - found.time[0], time * 1e-9, rtol=0, atol=2e-14)


@pytest.mark.parametrize("make", [*raw_logs.ALONE, *raw_logs.MAPPED], ids=lambda m: m.__name__)
def test_raw_to_result_by_one_command(make, pyimu, tmp_path, log, undrawn):
    path, column_map = written(make, tmp_path, log)
    options = [] if column_map is None else ["--columns", column_map]
    code, out, err = pyimu("characterize", path, *options, "--out", "out")
    assert (code, err) == (0, "") and "gyro" in out
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["logs"][0]["rows"] == len(log[0])


UNSTATED = ["t,gx,gy,gz,ax,ay,az", "", "stamp;Gyro X;Gyro Y;Gyro Z;Acc X;Acc Y;Acc Z"]


@pytest.mark.parametrize("head", UNSTATED, ids=["letters", "headerless", "words"])
def test_raw_to_result_by_two_commands(head, pyimu, tmp_path, undrawn):
    """A log that is turned by hand shows the unit of its rates; nothing states one."""
    time, gyro, accel = turned()
    separator = ";" if ";" in head else ","
    columns = [time // 1000, *np.degrees(gyro).T, *(accel / 9.80665).T]
    raw_logs.text(tmp_path / "log.csv", [head] if head else [], columns, separator)
    code, _, err = pyimu("characterize", "log.csv", "--out", "out")
    assert code == 2 and "pyimu inspect log.csv --write-map map.toml" in err
    code, out, err = pyimu("inspect", "log.csv", "--write-map", "map.toml")
    assert (code, err) == (1, "") and "map: map.toml" in out and "--columns" in out
    assert pyimu("inspect", "log.csv", "--columns", "map.toml")[0] == 0
    found = read_recording("log.csv", "map.toml")
    np.testing.assert_allclose(found.gyro, gyro, rtol=1e-14)
    np.testing.assert_allclose(found.accel, accel, rtol=1e-14)
    assert found.sample_rate == pytest.approx(100)
    code, _, err = pyimu("characterize", "log.csv", "--columns", "map.toml", "--out", "out")
    assert (code, err) == (0, "")


def turned(rows=3000):
    """A sensor that turns about y and x by 60 degrees and back, in the package's axes."""
    time = np.arange(rows, dtype=np.int64) * 10_000_000
    t = time * 1e-9
    angle, rate = 1.0 * np.sin(0.8 * t), 0.8 * np.cos(0.8 * t)
    gyro = np.column_stack([0 * t, rate, 0 * t])
    accel = 9.81 * np.column_stack([-np.sin(angle), 0 * t, np.cos(angle)])
    rng = np.random.default_rng(0)
    return (
        time,
        gyro + 1e-3 * rng.standard_normal(gyro.shape),
        accel + 0.01 * rng.standard_normal(accel.shape),
    )


def test_inspect_says_what_is_in_a_log(pyimu, tmp_path):
    """A rest of 10 s, 20 s of turning, a gap of 3 s in it, and a page."""
    time, gyro, accel = turned(2000)
    still = raw_logs.still(1000)
    late = time + 10_000_000_000 + 3_000_000_000 * (time >= 5_000_000_000)
    columns = [np.append(still[0], late), *np.vstack([still[1], gyro]).T]
    columns += list(np.vstack([still[2], accel]).T)
    names = [f"gyro_{a} [rad/s]" for a in "xyz"] + [f"accel_{a} [m/s^2]" for a in "xyz"]
    raw_logs.text(tmp_path / "log.csv", [",".join(["time [ns]", *names])], columns)
    code, out, err = pyimu("inspect", "log.csv", "--json", "--out", "page", "--write-map", "m.toml")
    assert (code, err) == (0, "")
    said = json.loads(out)
    assert (said["samples"], said["segments"], said["problem"]) == (3000, 2, None)
    assert said["sample_rate"] == pytest.approx(100) and not said["at_rest"]
    (first, last), *_ = said["rests"]
    # whole seconds, begun at any tenth of one; a second at whose end the motion begins is left out
    assert first == 0 and 8 <= last <= 10
    assert {f["kind"] for f in said["findings"]} >= {"gaps"}
    page = (tmp_path / "page" / "report.html").read_text()
    assert page.count("<svg") == 2 and "in 2 pieces without gap" in page
    assert page.count("Curves as CSV") == 1 and "uPlot" in page and "<h2>Words</h2>" in page
    again, plain = read_recording("log.csv", "m.toml"), read_recording("log.csv")
    np.testing.assert_array_equal(again.gyro, plain.gyro)


@pytest.mark.parametrize(
    "factor, flip, kind", [(1, 1, None), (180 / np.pi, 1, "gyro_unit"), (1, -1, "gyro_axes")]
)
def test_inspect_says_where_gravity_contradicts_the_gyro(factor, flip, kind, tmp_path):
    time, gyro, accel = turned()
    names = [f"gyro_{a} [rad/s]" for a in "xyz"] + [f"accel_{a} [m/s^2]" for a in "xyz"]
    columns = [time, *(factor * flip * gyro).T, *accel.T]
    found = inspect(raw_logs.text(tmp_path / "l.csv", [",".join(["time [ns]", *names])], columns))
    said = {f.kind for f in found.findings} & {"gyro_unit", "gyro_axes"}
    assert said == ({kind} if kind else set())


def test_inspect_of_several_files_writes_their_map(pyimu, tmp_path):
    where = raw_logs.phone(tmp_path, raw_logs.still(300))
    files = [where / f"{name}.csv" for name in ("TotalAcceleration", "Gyroscope")]
    code, out, _ = pyimu("inspect", *files, "--write-map", where / "map.toml")
    assert code == 0 and "gyro" in out
    found = read_recording(files[1], where / "map.toml")
    np.testing.assert_array_equal(found.accel, read_recording(where).accel)


@pytest.mark.parametrize("unit, size", [("rad/s", 1.0), ("deg/s", np.pi / 180)])
def test_the_forces_of_a_second_file_tell_the_gyro_s_unit(unit, size, tmp_path):
    """The two sample at other times, as sensors of their own do."""
    time, gyro, accel = turned()
    raw_logs.text(tmp_path / "gyro.csv", ["time,x,y,z"], [time, *(gyro / size).T])
    raw_logs.text(tmp_path / "accel.csv", ["time,x,y,z"], [time + 3_000_000, *accel.T])
    found = inspect([tmp_path / "gyro.csv", tmp_path / "accel.csv"])
    assert found.proposals[0].units["gyro"] == unit and not found.problem
    read = read_recording(tmp_path / "gyro.csv", found.write_map(tmp_path / "map.toml"))
    np.testing.assert_allclose(read.gyro, gyro, rtol=1e-14)


def test_of_two_files_at_rest_the_unit_is_asked_for(tmp_path):
    time, gyro, accel = raw_logs.still(400)
    for name, values in (("gyro", gyro), ("accel", accel)):
        raw_logs.text(tmp_path / f"{name}.csv", ["time,x,y,z"], [time, *values.T])
    said = inspect([tmp_path / "gyro.csv", tmp_path / "accel.csv"]).report()
    assert "it does not turn enough to tell" in said and "no accelerometer" not in said
    assert "nothing tells the unit of gyro: choose it in the map" in said
    assert "pyimu inspect" not in said.partition("next:")[0]


@pytest.mark.parametrize(
    "size, digits, unit",
    [(48, 3, "uT"), (0.48, 5, "gauss"), (480, 2, "mgauss"), (480, 0, None), (3000, 2, None)],
)
def test_a_field_without_unit_is_guessed_or_left_out(size, digits, unit, tmp_path):
    """What it is left out for, as counts of unknown size, keeps nothing else from being read."""
    time, gyro, accel = turned()
    field = np.round(size * accel / np.linalg.norm(accel, axis=1, keepdims=True), digits)
    names = [f"{kind}_{a}" for kind in ("gyro", "accel", "mag") for a in "xyz"]
    columns = [time / 1e9, *gyro.T, *accel.T, *field.T]
    path = raw_logs.text(tmp_path / "l.csv", [",".join(["time_s", *names])], columns)
    found = inspect(path)
    assert found.proposals[0].units.get("mag") == unit and not found.problem
    if unit is None:
        assert found.recording.mag is None and "mag_x, mag_y, mag_z may be" in found.report()
        with pytest.raises(UserError, match="column mag_x has no unit"):
            read_recording(raw_logs.text(tmp_path / "m.csv", [OWN], columns))
    else:
        np.testing.assert_allclose(np.linalg.norm(found.recording.mag, axis=1), 48e-6, rtol=0.01)


OWN = ",".join(
    ["time [s]", *(f"gyro_{a} [rad/s]" for a in "xyz"), *(f"accel_{a} [m/s^2]" for a in "xyz")]
    + [f"mag_{a}" for a in "xyz"]
)


def test_of_accelerations_without_gravity_it_is_said_that_they_tell_no_unit():
    _, gyro, accel = turned()
    pushed = np.random.default_rng(1).normal(size=accel.shape)
    pushed[:600] *= 0.01
    assert "no gravity in the accelerations" in rate_unit(gyro, pushed, 0.01).why
    assert "does not turn enough" in rate_unit(0 * gyro + 0.1, accel, 0.01).why


def test_a_phone_s_forces_without_gravity_are_left_out(tmp_path):
    where = raw_logs.phone(tmp_path, raw_logs.still(300))
    (where / "TotalAcceleration.csv").rename(where / "Accelerometer.csv")
    found = read_recording(where)
    (said,) = (f for f in found.findings if f.kind == "no_gravity")
    assert found.accel is None and said.detail == {"file": "Accelerometer.csv"}


def test_a_folder_of_a_gyro_that_no_program_wrote(tmp_path):
    (tmp_path / "Gyroscope.csv").write_text("a,b,c,d\n1,2,3,4\n2,3,4,5\n")
    with pytest.raises(UserError, match="neither Sensor Logger's .* nor phyphox's"):
        read_recording(tmp_path)


# Further files


def two_files(folder, late=0, rows=slice(None), more=""):
    time, gyro, accel = raw_logs.still(400)
    raw_logs.text(folder / "a.csv", ["t,x,y,z"], [(time + late)[rows] // 1000, *accel[rows].T])
    raw_logs.text(folder / "g.csv", ["t,x,y,z"], [time, *gyro.T])
    lines = ["[columns]", '"t" = "time [ns]"', *(f'"{a}" = "gyro_{a} [rad/s]"' for a in "xyz")]
    lines += ["[[file]]", 'name = "a.csv"', "[file.columns]", '"t" = "time [us]"']
    lines += [f'"{a}" = "accel_{a} [m/s^2]"' for a in "xyz"]
    (folder / "m.toml").write_text("\n".join([*lines, more]))
    return read_recording(folder / "g.csv", folder / "m.toml"), accel


def test_samples_half_a_period_apart_are_taken_as_they_are(tmp_path):
    for late in (-4_000_000, 4_000_000):
        found, accel = two_files(tmp_path, late)
        np.testing.assert_array_equal(found.accel, accel)
        (said,) = (f for f in found.findings if f.kind == "other_file")
        assert said.detail["how"] == "nearest sample"


def test_where_the_other_file_has_a_gap_nothing_is_known(tmp_path):
    rows = np.r_[0:100, 150:400]
    found, accel = two_files(tmp_path, rows=rows)
    assert np.isnan(found.accel).any(axis=1).nonzero()[0].tolist() == list(range(100, 150))
    np.testing.assert_array_equal(found.accel[rows], accel[rows])


def test_files_of_other_clocks_are_refused(tmp_path):
    with pytest.raises(UserError, match="do not overlap, or are on different clocks"):
        two_files(tmp_path, late=10**12)


@pytest.mark.parametrize(
    "more, says",
    [
        ("[[file]]\ncolumns = {}", "key file.name is missing"),
        ('[[file]]\nname = "none.csv"', "none.csv: no such file"),
        ('[[file]]\nname = "g.csv"\ncolumns = {t = "time [ns]", x = "gyro_x [rad/s]"}', "gyro_y"),
        ("[file.frame]", "file.frame"),
    ],
)
def test_maps_of_further_files(more, says, tmp_path):
    with pytest.raises(UserError, match=re.escape(says)):
        two_files(tmp_path, more=more)


@pytest.mark.parametrize(
    "entry, says",
    [
        ("100", "such as sample_rate = {value = 100.0"),
        ('{value = 100, unit = "s"}', "sample_rate.unit"),
        ('{value = "x", unit = "Hz"}', "sample_rate.value must be a number"),
        ('{value = 1e9, unit = "Hz"}', "must lie between 0.001 and 1e+06 Hz"),
        ('{value = 100, unit = "Hz"}', "leave one of the two out"),
    ],
)
def test_sample_rate_of_a_map(entry, says, tmp_path):
    (tmp_path / "m.toml").write_text(f"sample_rate = {entry}\n")
    raw_logs.xio(tmp_path, raw_logs.still(50))
    with pytest.raises(UserError, match=re.escape(says)):
        read_recording(tmp_path / "sensor_data.csv", tmp_path / "m.toml")


def test_rate_of_a_part_against_that_of_a_log():
    time, gyro, _ = raw_logs.still(100)
    log = Recording.from_arrays(time=time * 1e-9, gyro=gyro)
    assert rate_of_part(log, 104.0) == []
    (found,) = rate_of_part(log, 976.0)
    assert (found.kind, found.detail["other_rate"]) == ("rate_of_part", 976.0)


# What the numbers say


@pytest.mark.parametrize("unit, size", [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)])
@pytest.mark.parametrize("rate", [10, 100, 5000])
@pytest.mark.parametrize("first", [0.0, 1.7e9])
def test_unit_of_a_clock_is_told(unit, size, rate, first):
    """By its rate, or by its date: 1.7e9 s after 1970 is a day of 2023."""
    ticks = np.round((first + np.arange(200) / rate) / size, 3 if unit in "s" else 0)
    if np.any(np.diff(ticks) <= 0):
        pytest.skip("the clock is coarser than the samples")
    if np.all(np.diff(ticks) == 1):
        assert first or time_unit(ticks).unit is None  # may be a counter of samples
        return
    if rate == 5000 and not first:  # 5 Hz in the next larger unit
        assert time_unit(ticks).unit is None
        return
    assert time_unit(ticks).unit == unit


@pytest.mark.parametrize(
    "step, unit, why",
    [
        (0.1, "s", "10 Hz"),
        (0.2, None, "5 Hz in s or 5000 Hz in ms"),
        (125.0, None, "8 Hz in ms or 8000 Hz in us"),
        (10.0, "ms", "100 Hz then (0.1 Hz in s)"),
        (100.0, "ms", "10 Hz then (0.01 Hz in s)"),
        (1e7, "ns", "100 Hz then (0.1 Hz in us)"),
    ],
)
def test_what_else_a_clock_may_count_is_said(step, unit, why):
    found = time_unit(step * np.arange(200))
    assert (found.unit, why in found.why) == (unit, True)


@pytest.mark.parametrize("name", ["time [s]", "time_s", "Time (s)"])
def test_a_header_that_says_s_is_believed(name, tmp_path):
    _, gyro, _ = raw_logs.still(200)
    path = raw_logs.text(tmp_path / "l.csv", [f"{name},gx,gy,gz"], [10 * np.arange(200), *gyro.T])
    (found,) = (g for g in proposed(open_reader(path)).guesses if g.target == "time")
    assert (found.unit, "0.1 Hz" in found.why) == ("s", True)


def test_counter_of_samples_is_no_clock():
    assert time_unit(np.arange(100)).unit is None


@pytest.mark.parametrize("unit, size", [("m/s^2", 1.0), ("g", 9.80665), ("mg", 9.80665e-3)])
def test_unit_of_force_is_told_by_gravity(unit, size):
    assert force_unit(turned()[2] / size).unit == unit
    assert force_unit((turned()[2] - [0, 0, 9.81]) * 0.01).unit is None  # gravity taken out


@pytest.mark.parametrize("unit, size", [("rad/s", 1.0), ("deg/s", np.pi / 180)])
def test_unit_of_rate_is_told_by_how_gravity_turns(unit, size):
    _, gyro, accel = turned()
    assert rate_unit(gyro / size, accel, 0.01).unit == unit
    still = raw_logs.still()
    assert rate_unit(still[1] / size, still[2], 0.01).unit is None


def test_counts_are_sized_by_gravity_and_its_turning():
    """MPU-6050: 16384 counts a g, 131 a deg/s."""
    _, gyro, accel = turned()
    force = force_unit(np.round(accel / 9.80665 * 16384))
    assert (force.unit, force.value) == ("g", 1 / 16384)
    rate = rate_unit(np.round(np.degrees(gyro) * 131), accel, 0.01)
    assert (rate.unit, rate.value) == ("deg/s", 1 / 131)


@pytest.mark.parametrize("seed", range(5, 9))
def test_counts_of_a_gyro_that_is_turned_fast(seed):
    """By 1 rad within a mean: -w x f is no difference of two any more, and 131 looked like 105."""
    time, rng = np.arange(3000) * 0.01, np.random.default_rng(seed)
    rates, phases = rng.uniform(0.1, 0.8, (3, 3)), rng.uniform(0, 6, (3, 3))
    gyro = sum(
        np.sin(np.outer(time, 2 * np.pi * r) + p) for r, p in zip(rates, phases, strict=True)
    )
    gyro = gyro * np.clip(time - 2, 0, 1)[:, None]
    attitude = attitudes(Rotation.from_rotvec(0.005 * (gyro[1:] + gyro[:-1])))
    push = np.sin(np.outer(time, [7.0, 5.0, 9.0])) * [1.2, 0.7, 0.4]
    accel = attitude.inv().apply(push + [0, 0, 9.81])
    assert rate_unit(np.round(np.degrees(gyro) * 131), accel, 0.01).value == 1 / 131


ST = (4.375, 8.75, 17.5, 35.0, 70.0)
"""mdps/LSB, data sheet of LSM6DSO, table 2."""


@pytest.mark.parametrize("mdps", ST)
def test_counts_of_st_s_gyros_are_not_taken_for_others(mdps):
    """The other that fits is said."""
    _, gyro, accel = turned()
    guess = rate_unit(np.round(np.degrees(gyro) * 1000 / mdps), accel, 0.01)
    assert guess.unit == "deg/s" and guess.value == pytest.approx(mdps / 1000)
    assert f"{mdps:g} mdps/LSB" in guess.why and "not" in guess.why


def test_of_two_sizes_of_a_count_that_fit_the_user_chooses(tmp_path):
    """122 counts a deg/s may be 131 or 114.3: both stand in the map, and with one it is read."""
    guess = sensitivities(122.0)
    assert guess.unit is None and sorted(1 / s for s in guess.sizes) == pytest.approx(
        [114.286, 131.0], abs=1e-3
    )
    assert "114.3 (ST, 8.75 mdps/LSB)" in guess.why and "131 (InvenSense" in guess.why
    assert sensitivities(600.0) is None
    time, gyro, accel = turned()
    log = raw_logs.text(
        tmp_path / "raw.csv",
        ["time,gx,gy,gz,ax,ay,az"],
        [np.round(1e-6 * time).astype(int), *np.round(np.degrees(gyro) * 122).T, *accel.T],
    )
    found = inspect([log])
    assert "choose the unit of gyro" in found.report() and "114.3" in found.report()
    text = found.column_map.replace("# gyro = {value = 0.00875", "gyro = {value = 0.00875", 1)
    (tmp_path / "map.toml").write_text(text.replace('# "g', '"g'))
    read = read_recording(log, tmp_path / "map.toml")
    np.testing.assert_allclose(read.gyro, gyro * 122 * 0.00875, atol=2e-4)


FIXED = 'unit = "deg/s", value = 0.1, offset = 0.5'
KEPT = {
    "frame": """[frame]\nR = [[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]]\nworld = "ned"\nq = "bn"\n""",
    "scale": f"[scale]\ngyro_x = {{{FIXED}}}\ngyro = {{value = 131, unit = 'LSB/dps'}}\n",
}


@pytest.mark.parametrize("columns", ["", '[columns]\n"t" = "time [ms]"\n'])
def test_what_a_given_map_says_stands_in_the_one_that_is_written(columns, tmp_path):
    """Frame and sizes of counts, whether the map names the columns or they are guessed."""
    time, gyro, accel = turned()
    names = [f"gyro_{a}" for a in "xyz"] + [f"acc_{a}" for a in "xyz"]
    counts = [*np.rint(np.degrees(gyro) * 131).astype(int).T, *accel.T]
    log = raw_logs.text(tmp_path / "a.csv", [",".join(["t", *names])], [time // 1_000_000, *counts])
    if columns:
        columns += "".join(f'"gyro_{a}" = "gyro_{a} [count]"\n' for a in "xyz")
        columns += "".join(f'"acc_{a}" = "accel_{a} [m/s^2]"\n' for a in "xyz")
    (tmp_path / "given.toml").write_text(columns + KEPT["frame"] + KEPT["scale"])
    found = inspect(log, tmp_path / "given.toml")
    written = found.write_map(tmp_path / "map.toml")
    given, kept = (tomllib.loads(p.read_text()) for p in (tmp_path / "given.toml", written))
    assert kept["frame"] == given["frame"] and kept["scale"] == given["scale"]
    read = read_recording(log, written)
    east, north, up = np.rint(np.degrees(gyro) * 131).T
    want = [north / 131, -(east * 0.1 + 0.5), up / 131]
    np.testing.assert_allclose(np.degrees(read.gyro), np.transpose(want), rtol=1e-12)
    np.testing.assert_array_equal(found.recording.gyro, read.gyro)
    assert inspect(log, written).column_map.count("[frame]") == 1


def test_rate_and_further_files_of_a_given_map_are_kept(tmp_path):
    _, gyro, accel = turned()
    log = raw_logs.text(tmp_path / "a.csv", ["gx [rad/s],gy [rad/s],gz [rad/s]"], [*gyro.T])
    raw_logs.text(tmp_path / "b.csv", ["x,y,z"], [*accel.T])
    cells = "".join(f'"g{a} [rad/s]" = "gyro_{a} [rad/s]"\n' for a in "xyz")
    forces = "".join(f'"{a}" = "accel_{a} [count]"\n' for a in "xyz")
    rate = 'sample_rate = {value = 100, unit = "Hz"}\n'
    offset = 'time_offset = {value = -3.5, unit = "h"}\n'
    (tmp_path / "given.toml").write_text(
        f"{rate}{offset}[columns]\n{cells}[[file]]\nname = 'b.csv'\n"
        f'{rate}[file.columns]\n{forces}[file.scale]\naccel = {{value = 1.0, unit = "m/s^2"}}\n'
    )
    given = tomllib.loads((tmp_path / "given.toml").read_text())
    for files in ([log], [log, tmp_path / "b.csv"]):
        written = inspect(files, tmp_path / "given.toml").write_map(tmp_path / "map.toml")
        assert tomllib.loads(written.read_text()) == given
        np.testing.assert_array_equal(read_recording(log, written).accel, accel)


def test_the_topics_of_a_given_map_are_kept(tmp_path):
    pytest.importorskip("pymavlink")
    log = raw_logs.dataflash_text(tmp_path, turned())
    (tmp_path / "given.toml").write_text('[topics]\nimu = "IMU[0]"\n')
    written = inspect(log, tmp_path / "given.toml").write_map(tmp_path / "map.toml")
    assert tomllib.loads(written.read_text())["topics"] == {"imu": "IMU[0]"}
    np.testing.assert_array_equal(
        read_recording(log, written).gyro, read_recording(log, tmp_path / "given.toml").gyro
    )


def test_of_counts_of_a_gyro_at_rest_the_map_offers_the_common_sizes(tmp_path):
    """Neither rad/s nor deg/s, in which no gyro is as coarse."""
    time, gyro, accel = raw_logs.still(400)
    log = raw_logs.text(
        tmp_path / "raw.csv",
        ["millis,gx,gy,gz,ax,ay,az"],
        [
            time // 1_000_000,
            *np.rint(np.degrees(gyro) * 131).astype(int).T,
            *np.rint(accel / 9.80665 * 16384).astype(int).T,
        ],
    )
    text = inspect(log).column_map
    assert '# "gx" = "gyro_x [count]"' in text and "gyro_x [rad/s]" not in text
    assert "gyro_x [deg/s]" not in text
    for size in ("131 LSB", "65.5 LSB", "32.8 LSB", "16.4 LSB", *(f" {m:g} mdps" for m in ST)):
        assert size in text
    text = text.replace('# "g', '"g').replace(
        "# gyro = {value = 0.007633", "gyro = {value = 0.007633"
    )
    (tmp_path / "map.toml").write_text(text)
    read = read_recording(log, tmp_path / "map.toml")
    np.testing.assert_allclose(read.gyro, gyro, atol=0.5001 * np.radians(1 / 131))


# What the names say


@pytest.mark.parametrize(
    "cell, axis, unit",
    [
        ("GyrX", "x", None),
        ("Gyroscope X (deg/s)", "x", "deg/s"),
        ("w_RS_S_x [rad s^-1]", "x", "rad/s"),
        ("raw_angular_rate_z_deg_per_s", "z", "deg/s"),
        ("gyroRotationY(rad/s)", "y", "rad/s"),
        ("field.angular_velocity.y", "y", None),
        ("Gyro_X_dps", "x", "dps"),
        ("imu_gyr[0]", "x", None),
        ("gz", "z", None),
    ],
)
def test_names_of_a_gyro(cell, axis, unit):
    name = named(cell)
    assert (name.axis, name.unit, name.of("gyro") > 0, name.is_time) == (axis, unit, True, False)


def test_raw_samples_go_before_estimates():
    cells = [f"{kind}_acceleration_{a}_gs" for kind in ("est", "raw") for a in "xyz"]
    assert [t.names[0].cell for t in triads(cells)] == [
        "raw_acceleration_x_gs",
        "est_acceleration_x_gs",
    ]


@pytest.mark.parametrize(
    "header",
    [
        "stamp_ns,qx,qy,qz,qw,quality",
        "stamp_ns,x,y,z,w,quality",
        "stamp_ns,pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w,n",
        "stamp_ns,q1,q2,q3,q0,n",
    ],
)
def test_a_reference_in_a_file_of_its_own_is_no_accelerometer(header, tmp_path):
    """Four columns of length one are an attitude; three of them look like gravity of 1 g."""
    q = np.random.default_rng(3).standard_normal((200, 4))
    q = np.cumsum(q, axis=0)
    q /= np.linalg.norm(q, axis=1)[:, None]
    stamps = 1_700_000_000_000_000_000 + np.arange(200) * 16_666_667
    rows = [f"{t},{x:.9f},{y:.9f},{z:.9f},{w:.9f},1" for t, (w, x, y, z) in zip(stamps, q)]
    path, column_map = tmp_path / "cameras.csv", tmp_path / "map.toml"
    path.write_text("\n".join([header, *rows]) + "\n")
    found = inspect(path)
    assert set(found.recording.groups) == {"ref_q"} and not found.problem, found.report()
    assert "pyimu close as --reference-columns" in found.column_map
    assert "rests" not in found.report()
    found.write(tmp_path / "out")
    column_map.write_text(found.column_map)
    np.testing.assert_allclose(read_reference(path, column_map).ref_q, q, atol=1e-8)
    with pytest.raises(UserError, match="give that as --reference-columns"):
        read_reference(path)


def test_nothing_is_proposed_without_a_reason(tmp_path):
    """Not "time [s]" for a column in ns, nor for one of a gyro."""
    time, gyro, _ = raw_logs.still()
    path = raw_logs.text(tmp_path / "log.csv", ["gx,gy,gz,t"], [*gyro.T, time + raw_logs.FIRST])
    with pytest.raises(UserError) as refused:
        read_recording(path)
    assert "[s]" not in re.sub(r"'time \[s\]'", "", str(refused.value))
    guesses = {g.cell: (g.target, g.unit) for g in proposed(open_reader(path)).guesses}
    assert guesses == {"t": ("time", "ns")} | {f"g{a}": (f"gyro_{a}", None) for a in "xyz"}
    path = raw_logs.text(tmp_path / "two.csv", ["time,gx,gy,gz"], [time, *gyro.T])
    with pytest.raises(UserError, match="s, ms, us or ns"):
        read_recording(path)


# Layouts


@pytest.mark.parametrize(
    "head, separator, decimal, names, first",
    [
        ("a,b\n1,2\n", ",", ".", ("a", "b"), 2),
        ("a;b\n1,5;2\n2,5;3\n", ";", ",", ("a", "b"), 2),
        ("a;b\n1.5;2\n2.5;3\n", ";", ".", ("a", "b"), 2),
        ("a\tb\n1\t2\n", "\t", ".", ("a", "b"), 2),
        ("a  b\n1    2\n", " ", ".", ("a", "b"), 2),
        ("1 2\n3 4\n", " ", ".", ("column 1", "column 2"), 1),
        ("A log of mine\nof Tuesday\n\na,b\n1,2\n3,4\n", ",", ".", ("a", "b"), 5),
        ("# of Tuesday\n#a,b\n1,2\n3,4\n", ",", ".", ("a", "b"), 3),
        ("t,w,w\n,x,y\n1,2,3\n2,3,4\n", ",", ".", ("t", "w x", "w y"), 3),
        ("t,w\n[s],[deg/s]\n1,2\n2,3\n", ",", ".", ("t [s]", "w [deg/s]"), 3),
        ("% t w\n% s deg/s\n1 2\n2 3\n", " ", ".", ("t [s]", "w [deg/s]"), 3),
        ("% rad/s\n% s deg/s\n1 2\n2 3\n", " ", ".", ("s", "deg/s"), 3),
        ("t,x,x,\n1,2,3,4\n2,3,4,5\n", ",", ".", ("t", "x", "x column 3", ""), 2),
        ("sep=;\na;b\n1;2\n3;4\n", ";", ".", ("a", "b"), 3),
        ("sep=\t\na\tb\t\n1\t2\t\n3\t4\t\n", "\t", ".", ("a", "b", ""), 3),
        ("Tag:,x\nRate:,9\n\na,b,c,d\n1,2,3,4\n2,3,4,5\n", ",", ".", tuple("abcd"), 5),
        ("t,state,w\n1,idle,2\n2,idle,3\n", ",", ".", ("t", "state", "w"), 2),
        ("t;w\n1,2\n3,4\n", ",", ".", ("t", "w"), 2),
    ],
)
def test_layout_is_told(head, separator, decimal, names, first):
    found = told_from(head.splitlines(keepends=True))
    assert (found.separator, found.decimal, found.names, found.first) == (
        separator,
        decimal,
        names,
        first,
    )


def test_rate_that_a_comment_states():
    assert told_from(["// Update Rate: 0.4 kHz\n", "a,b\n", "1,2\n"]).rate == 400
