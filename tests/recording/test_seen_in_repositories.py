"""Layouts as public repositories have them, with numbers of our own: what was read wrongly, lost,
or refused without a word that helps.
"""

import numpy as np
import pytest
from log_tables import ardupilot, mavlink, px4, table, vectornav, whole
from rolling import rolls

from pyimu import inspect, read_recording
from pyimu.errors import UserError
from pyimu.recording.folders import log_in
from pyimu.recording.formats.clock_times import is_clock_time
from pyimu.recording.guess.numbers import angle_unit
from pyimu.recording.log import read_reference
from pyimu.recording.naming.name import named
from pyimu.recording.naming.triads import are_alike, triads
from pyimu.units import STANDARD_GRAVITY

AXES = "XYZ"


@pytest.fixture(scope="module")
def log():
    """Times s, gyro rad/s and accelerometer m/s^2 (n, 3) of a body that is turned and shaken."""
    rng = np.random.default_rng(7)
    time = np.arange(2000) * 0.01
    gyro, up = rolls(time)
    shaken = np.outer(0.5 * np.sin(7 * time), [1, 0, 0])
    noise = rng.standard_normal((2, 2000, 3))
    return time, gyro + 1e-3 * noise[0], STANDARD_GRAVITY * up + shaken + 0.02 * noise[1]


def agrees(found, log, digits=1e-5):
    """To the rounding of the numbers in the file."""
    _, gyro, accel = log
    np.testing.assert_allclose(found.gyro, gyro, rtol=0, atol=digits)
    np.testing.assert_allclose(found.accel, accel, rtol=0, atol=20 * digits)


# Programs whose axes point forward, right and down


@pytest.mark.parametrize("write", [px4, ardupilot, mavlink, vectornav])
def test_axes_that_point_down_are_turned(write, log, tmp_path):
    found = read_recording(write(tmp_path, log))
    agrees(found, log)
    if write is not px4:
        np.testing.assert_allclose(found.temperature, 41.5)
    if found.mag is not None:
        np.testing.assert_allclose(found.mag[0], [2e-5, 0, -4e-5], atol=1e-9)


def test_scaled_messages_of_mavlink_are_in_thousandths(log, tmp_path):
    """Of a gyro whose counts were 17.45 a deg/s another size, of 16.4, had been proposed."""
    found = read_recording(mavlink(tmp_path, log, scaled=True))
    agrees(found, log, digits=6e-4)
    np.testing.assert_allclose(found.temperature, 41.5)


def test_of_several_units_in_one_table_the_first_is_read(log, tmp_path):
    path = ardupilot(tmp_path, log, several=True)
    found = read_recording(path)
    agrees(found, [column[::2] for column in log])
    (said,) = [f for f in found.findings if f.kind == "other_units"]
    assert (said.count, said.detail) == (len(log[0]) // 2, {"unit": 0, "column": "I"})
    text = path.read_text().splitlines()
    text[5] = ",".join(["1.7e9", "", *text[5].split(",")[2:]])  # the third sample of unit 0
    path.write_text("\n".join(text))
    with pytest.raises(UserError, match="row 6: the time is missing"):
        read_recording(path)


def test_mavlink_numbers_its_units_too(log, tmp_path):
    rows = mavlink(tmp_path, log).read_text().splitlines()
    both = [f"{row},{unit}" for row in rows[1:] for unit in (2, 3)]
    path = tmp_path / "several.csv"
    path.write_text("\n".join([f"{rows[0]},id", *both]))
    agrees(read_recording(path), log)


@pytest.mark.parametrize("unit, size", [("mG", 1e-3), ("G", 1.0)])
def test_a_capital_g_is_gauss_of_a_field_and_g_of_a_force(unit, size, tmp_path):
    """In a recording's own header, where the column says which of the two it is."""
    names = [f"{group}_{a} [{unit}]" for group in ("accel", "mag") for a in "xyz"]
    path = tmp_path / "own.csv"
    rows = [f"{k * 0.01},0,0,{1 / size},{0.2 / size},0,{-0.4 / size}" for k in range(50)]
    path.write_text("\n".join([",".join(["time [s]", *names]), *rows]))
    found = read_recording(path)
    np.testing.assert_allclose(found.accel, [[0, 0, STANDARD_GRAVITY]] * 50, rtol=1e-12)
    np.testing.assert_allclose(found.mag, [[2e-5, 0, -4e-5]] * 50, rtol=1e-12)
    path.write_text(path.read_text().replace("time [s]", f"time [{unit}]"))
    with pytest.raises(UserError, match="column time: .* is not a unit"):
        read_recording(path)


# Units


@pytest.mark.parametrize(
    "cell, unit",
    [
        ("Magnetometer X (G)", "gauss"),
        ("mx [mG]", "mgauss"),
        ("ax [mG]", "mg"),
        ("Accelerometer X (G)", "g"),
        ("x [mG]", None),
    ],
)
def test_what_a_capital_g_means_is_in_the_name(cell, unit):
    assert named(cell).unit == unit


def test_a_magnetometer_in_gauss_is_not_lost(log, tmp_path):
    time, gyro, accel = log
    names = [f"Gyroscope {a} (deg/s)" for a in AXES] + [f"Accelerometer {a} (g)" for a in AXES]
    head = ",".join(["Timestamp (us)", *names, *(f"Magnetometer {a} (G)" for a in AXES)])
    columns = [whole(1e6 * time), *np.degrees(gyro).T, *(accel / STANDARD_GRAVITY).T]
    columns += [0 * time + v for v in (0.2, 0.0, -0.4)]
    found = read_recording(table(tmp_path / "log.csv", [head], columns))
    np.testing.assert_allclose(found.mag[0], [2e-5, 0, -4e-5], rtol=1e-6)


def test_an_angle_s_unit_of_a_gyro_is_a_second(log, tmp_path):
    """Bosch's program: thousandths of a degree."""
    time, gyro, accel = log
    names = [f"bmi160_{n}_{a}[{u}]" for n, u in (("a", "mg"), ("g", "mDeg")) for a in "xyz"]
    columns = [*map(whole, (1000 * accel / STANDARD_GRAVITY).T)]
    columns += [*map(whole, (1000 * np.degrees(gyro)).T)]
    head = ",".join(["timestamp[ms]", *names])
    found = inspect(table(tmp_path / "log_0000.csv", [head], [whole(1000 * time), *columns]))
    agrees(found.recording, log, digits=1e-3)


def test_angles_that_no_degrees_are_have_no_unit():
    """A heading of 142.23 degrees in hundredths; one that runs on behind whole turns has a unit."""
    steps = np.linspace(0, 1, 50)
    still = np.column_stack([0 * steps, 0 * steps, 14223 + steps])
    assert angle_unit(still).unit is None
    assert angle_unit(np.column_stack([0 * steps, 0 * steps, 5000 * steps])).unit == "deg"


# Names


def test_a_track_a_speed_and_a_climb_are_no_vector():
    assert not are_alike([named(c) for c in ("track", "speed", "climb")])
    assert are_alike([named(c) for c in ("column 2", "column 3", "column 4")])
    assert are_alike([named(c) for c in ("a", "b", "c")])


def test_no_accelerometer_is_found_in_a_receiver_s_log(tmp_path):
    """Its track was about as large as gravity."""
    time = [f"2005-06-08T10:34:{k // 10:02d}.{k % 10}00Z" for k in range(300)]
    names = "class,time,lat,lon,alt,track,speed,climb"
    numbers = [46.5, 7.57, 1343.1, 10.38, 0.09, -0.08]
    columns = [["TPV"] * 300, time, *(np.full(300, v) for v in numbers)]
    found = inspect(table(tmp_path / "LOG.csv", [names], columns))
    assert found.proposals[0].groups == ["time", "ref_north", "ref_east", "ref_up"]
    assert found.recording.groups.keys().isdisjoint({"gyro", "accel"})


def test_elements_behind_the_name_of_a_vector(log, tmp_path):
    """Old tables of GoPro's: the name stands above the first of three columns."""
    time, gyro, accel = log
    for name, unit, values in (("Gyroscope", "rad/s", gyro), ("Accelerometer", "m/s2", accel)):
        head = f"cts,date,{name} [{unit}],1,2,temperature [°C]"
        date = [f"2022-12-20T13:12:{13 + t:09.6f}Z" for t in time]
        warm = ["31.2"] + [""] * (len(time) - 1)
        columns = [153.5 + 1000 * time, date, *values.T, warm]
        table(tmp_path / f"HERO9-{name}.csv", [head], columns)
    names = [tmp_path / f"HERO9-{name}.csv" for name in ("Gyroscope", "Accelerometer")]
    found = inspect(names)
    assert found.kind == "guessed" and not found.problem
    agrees(found.recording, log)
    assert not inspect(names[0]).readable  # the order of the axes is to be looked over


def test_a_gyro_s_file_of_three_columns(log, tmp_path):
    path = table(tmp_path / "gyro.csv", [], [*log[1].T])
    assert [t.group for t in triads(["column 1", "column 2", "column 3"], path.name)] == ["gyro"]
    text = inspect(path).column_map
    assert '"column 1" = "gyro_x [rad/s]"' in text and "sample_rate" in text


# Times


@pytest.mark.parametrize(
    "stamp",
    ["Wed Dec 22 21:09:46 2021", "Wed Dec  2 21:09:46 2021", "02/11/26 22:44:53.993751808"],
)
def test_dates_as_programs_print_them(stamp):
    assert is_clock_time(stamp)


def test_whole_seconds_are_divided_among_their_rows(log, tmp_path):
    """A program that prints the date to the second, 100 rows in each; as where units are stated."""
    time, gyro, accel = log
    stamps = [f"Wed Dec 22 21:09:{int(t) + 10:02d} 2021" for t in time]
    head = ",".join(["Time", *(f"Accel{a}" for a in AXES), *(f"Gyro{a}" for a in AXES)])
    columns = [stamps, *(accel / STANDARD_GRAVITY).T, *np.degrees(gyro).T]
    found = inspect(table(tmp_path / "imu.csv", [head], columns)).recording
    agrees(found, log)
    assert found.sample_rate == pytest.approx(100, rel=1e-6)


def test_times_that_may_count_samples_can_be_left_out(log, tmp_path):
    time, gyro, accel = log
    head = ",".join(["Timestamp", *(f"a{a} (g)" for a in "xyz"), *(f"g{a} (dps)" for a in "xyz")])
    columns = [whole(100 * time), *(accel / STANDARD_GRAVITY).T, *np.degrees(gyro).T]
    found = inspect(table(tmp_path / "imu.csv", [head], columns))
    assert found.problem and "# sample_rate = " in found.column_map


# Files and folders


def test_zeros_alone_are_said(tmp_path):
    names = [f"{n}_{a}" for n in ("acc", "gyro") for a in "xyz"]
    zeros = np.zeros((6, 400))
    path = table(tmp_path / "imu.csv", [",".join(["t_ns", *names])], [np.arange(400) * 1e7, *zeros])
    assert "every number is zero" in inspect(path).problem


def test_what_two_files_of_a_log_hold_is_taken_of_the_first(log, tmp_path):
    """GoPro's have the temperature in each."""
    time, gyro, accel = log
    for name, unit, values in (("Gyroscope", "rad/s", gyro), ("Accelerometer", "m/s2", accel)):
        names = [f'"{name} ({a}) [{unit}]"' for a in "xyz"]
        head = ",".join(['"cts"', *names, '"temperature [°C]"'])
        columns = [153.5 + 1000 * time, *values.T, 0 * time + (31 if name == "Gyroscope" else 33)]
        table(tmp_path / f"{name[:4]}.csv", [head], columns)
    found = inspect([tmp_path / "Gyro.csv", tmp_path / "Acce.csv"])
    agrees(found.recording, log)
    np.testing.assert_allclose(found.recording.temperature, 31)
    assert "--write-map map.toml" in found.report()  # one file alone would lose the other's
    found.write_map(tmp_path / "map.toml")
    again = read_recording(tmp_path / "Gyro.csv", columns=tmp_path / "map.toml")
    np.testing.assert_array_equal(again.accel, found.recording.accel)


def test_the_folder_of_an_ngimu(log, tmp_path):
    time, gyro, accel = log
    names = [f"Gyroscope {a} (deg/s)" for a in AXES] + [f"Accelerometer {a} (g)" for a in AXES]
    columns = [time, *np.degrees(gyro).T, *(accel / STANDARD_GRAVITY).T]
    table(tmp_path / "sensors.csv", [",".join(["Time (s)", *names])], columns)
    q = np.tile([1.0, 0, 0, 0], (len(time), 1))
    table(tmp_path / "quaternion.csv", ["Time (s),W,X,Y,Z"], [time, *q.T])
    assert log_in(tmp_path).path.name == "sensors.csv"
    agrees(read_recording(tmp_path), log)


def test_a_folder_of_folders_names_their_files(log, tmp_path):
    (tmp_path / "iphone").mkdir()
    table(tmp_path / "iphone" / "gyro.csv", [], [log[0], *log[1].T])
    with pytest.raises(UserError, match=r"iphone.gyro\.csv"):
        read_recording(tmp_path)


def test_a_log_of_a_serial_monitor_is_text(log, tmp_path):
    time, gyro, accel = log
    head = ",".join(["time [s]", *(f"gyro_{a} [rad/s]" for a in "xyz")])
    agreed = read_recording(table(tmp_path / "putty.log", ["hello", head], [time, *gyro.T]))
    np.testing.assert_allclose(agreed.gyro, gyro, atol=1e-8)


def test_a_name_without_a_suffix_that_is_known_says_what_helps(tmp_path):
    (tmp_path / "walk.readings").write_text("2 4000\n")
    with pytest.raises(UserError, match=r"rename text to \.txt"):
        read_recording(tmp_path / "walk.readings")


# What to do next


def test_the_next_command_is_said(log, tmp_path):
    time, gyro, accel = log
    own = ",".join(f"{n}_{a} [{u}]" for n, u in (("gyro", "rad/s"), ("accel", "g")) for a in "xyz")
    force = accel / STANDARD_GRAVITY
    path = table(tmp_path / "my log.csv", ["time [s]," + own], [time, *gyro.T, *force.T])
    assert f"pyimu attitude '{path}' --out out" in inspect(path).report()
    guessed = table(tmp_path / "b.csv", ["t_ns,ax,ay,az,gx,gy,gz"], [1e9 * time, *force.T, *gyro.T])
    said = inspect(guessed).report()
    assert f"pyimu inspect {guessed} --write-map map.toml" in said
    assert f"pyimu attitude {guessed} --columns map.toml --out out" in said
    written = inspect(guessed).report(tmp_path / "own.toml")
    assert "--write-map" not in written and f"--columns {tmp_path / 'own.toml'}" in written
    q = table(tmp_path / "q.csv", ["t [s],qw,qx,qy,qz"], [time, 1 + 0 * time, *(0 * gyro).T])
    assert f"pyimu close LOG --reference {q} --reference-columns map.toml" in inspect(q).report()
    assert read_reference(q, columns=_map(inspect(q), tmp_path)).ref_q is not None


def _map(found, folder):
    return found.write_map(folder / "q.toml")
