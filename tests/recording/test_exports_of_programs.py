"""Tables as the programs of sensors, phones and laboratories export them: what is proposed of a
short piece in each layout comes to the samples that were put in.
"""

import numpy as np
import pytest
from rolling import rolls
from scipy.io import savemat

from pyimu import inspect, read_recording
from pyimu.recording.formats.told import told_from
from pyimu.recording.guess.numbers import force_unit, warmth_unit
from pyimu.recording.naming.name import named
from pyimu.recording.naming.triads import surest, triads
from pyimu.units import STANDARD_GRAVITY

AXES = "XYZ"


@pytest.fixture(scope="module")
def log():
    """Times s, gyro rad/s, accelerometer m/s^2 and the up of the body (n, 3): it is turned by hand,
    and shaken.
    """
    rng = np.random.default_rng(5)
    time = np.arange(3000) * 0.01
    rate, up = rolls(time)
    gyro = rate + 1e-3 * rng.standard_normal((3000, 3))
    accel = STANDARD_GRAVITY * up + 0.02 * rng.standard_normal((3000, 3))
    return time, gyro, accel + np.outer(0.5 * np.sin(7 * time), [1, 0, 0]), up


def texts(columns, digits=6):
    return [c if isinstance(c, list) else [f"{v:.{digits}f}" for v in c] for c in columns]


def table(path, head, columns, separator=",", end=""):
    rows = [separator.join(row) + end for row in zip(*texts(columns), strict=True)]
    path.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8")
    return path


def agrees(found, log, digits=2e-6):
    time, gyro, accel, _ = log
    np.testing.assert_allclose(found.gyro, gyro, rtol=0, atol=digits)
    np.testing.assert_allclose(found.accel, accel, rtol=0, atol=STANDARD_GRAVITY * digits)
    # of times that count from a midnight 1e5 s are known to 1e-11 s
    np.testing.assert_allclose(found.time - found.time[0], time, rtol=0, atol=1e-9)


def days(time, form):
    """Dates, or times of day, of times [s] from half past ten."""
    start = np.datetime64("2024-03-01T10:30:00")
    stamps = start + (1000 * time).round().astype("timedelta64[ms]")
    return [form(str(s)) for s in stamps]


def test_shimmer_the_row_of_units_has_some_that_are_none(log, tmp_path):
    time, gyro, accel, up = log
    names = ["Timestamp_Unix_CAL"] + [f"Accel_LN_{a}_CAL" for a in AXES]
    names += [f"Gyro_{a}_CAL" for a in AXES] + [f"Mag_{a}_CAL" for a in AXES]
    units = ["ms", *["m/(s^2)*"] * 3, *["deg/s*"] * 3, *["local_flux*"] * 3]
    head = ['"sep=\t"', "\t".join(f"Shimmer_5E3B_{n}" for n in names) + "\t"]
    columns = [1.6e12 + 1000 * time, *accel.T, *np.degrees(gyro).T, *up.T]
    path = table(tmp_path / "s.csv", [*head, "\t".join(units) + "\t"], columns, "\t", "\t")
    agrees(inspect(path).recording, log)


def test_fields_of_a_message_behind_the_empty_column_that_names_them(log, tmp_path):
    time, gyro, accel, _ = log
    head = "stamp,frame_id,angular_velocity,x,y,z,covariance,linear_acceleration,x,y,z,covariance"
    none, cov = [""] * len(time), ['"[0.0, 0.0]"'] * len(time)
    columns = [1e9 * time, ['"imu"'] * len(time), none, *gyro.T, cov, none, *accel.T, cov]
    agrees(inspect(table(tmp_path / "bag.csv", [head], columns)).recording, log)


def test_a_time_beside_each_column(log, tmp_path):
    """Delsys: ``X[s]`` before each, and a number of the sensor behind the axis."""
    time, gyro, accel, _ = log
    vectors = [(f"ACC.{a}", "g", v) for a, v in zip(AXES, accel.T / STANDARD_GRAVITY, strict=True)]
    vectors += [(f"GYRO.{a}", "deg/s", np.degrees(v)) for a, v in zip(AXES, gyro.T, strict=True)]
    head = [f'"X[s]","IM sensor 1: {name} 1[{unit}]"' for name, unit, _ in vectors]
    columns = [column for _, _, values in vectors for column in (time, values)]
    agrees(inspect(table(tmp_path / "d.csv", [",".join(head)], columns)).recording, log)


@pytest.mark.parametrize("names", [[f"ACC {a} 1" for a in AXES], ["one", "two", "three"]])
def test_what_rises_as_a_time_is_no_axis(names, log, tmp_path):
    """Whatever the columns are called: the times between them made vectors with them."""
    time, _, accel, _ = log
    head = [cell for name in names for cell in ("X[s]", name)]
    columns = [column for values in accel.T for column in (time, values)]
    found = inspect(table(tmp_path / "d.csv", [",".join(head)], columns))
    (proposal,) = found.proposals
    assert not any("X[s]" in g.cell for g in proposal.guesses if g.group != "time")


def test_the_direction_of_gravity_is_no_accelerometer(log, tmp_path):
    time, gyro, _, up = log
    columns = [time, *(gyro + 0.4).T, *up.T]
    found = inspect(table(tmp_path / "phone.csv", [], columns))
    (proposal,) = found.proposals
    assert "accel" not in proposal.groups
    assert any("column 5, column 6, column 7 are left out: they turn" in n for n in proposal.notes)


def test_of_several_arrays_the_vectors_are_from_that_of_the_time(log, tmp_path):
    time, gyro, accel, _ = log
    one = np.column_stack([time, accel, gyro])
    calmer = np.column_stack([time, 0.999 * accel + 0.001 * accel.mean(axis=0), gyro + 0.1])
    savemat(tmp_path / "three.mat", {"XS1": one, "XS2": calmer})
    agrees(inspect(tmp_path / "three.mat").recording, log, 1e-12)


CLOCKS = {
    "month first": lambda s: f"3/1/2024 {s[11:]}",
    "day first": lambda s: f"01.03.2024 {s[11:]}",
    "a third colon": lambda s: s[11:].replace(".", ":"),
}


@pytest.mark.parametrize("form", CLOCKS.values(), ids=CLOCKS)
def test_times_of_day_as_programs_write_them(form, log, tmp_path):
    time, gyro, accel, _ = log
    columns = [days(time, form), *accel.T, *gyro.T]
    head = "Timestamp," + ",".join(f"{n} {a}" for n in ("Accelerometer", "Gyroscope") for a in AXES)
    agrees(inspect(table(tmp_path / "day.csv", [head], columns)).recording, log)


def test_a_date_with_its_year_behind_goes_over_midnight(tmp_path, log):
    time, gyro, _, _ = log
    stamps = [f"2/{28 + (k > 1)}/2024 {h}" for k, h in enumerate(["23:59:58", "23:59:59"])]
    stamps += ["2/29/2024 00:00:00", "2/29/2024 00:00:01"]
    head = "Time,GyroX (rad/s),GyroY (rad/s),GyroZ (rad/s)"
    path = table(tmp_path / "night.csv", [head], [stamps, *gyro[:4].T])
    found = read_recording(path)
    np.testing.assert_array_equal(np.diff(found.time), 1.0)


def test_the_rate_in_the_first_line_of_actigraph():
    first = "---- Data File Created By ActiGraph GT3X+ date format M/d/yyyy at 30 Hz  Filter Normal"
    rows = ["0.1,0.2,0.9"] * 9
    lines = [first, "Serial Number: NEO1", "Accelerometer X,Accelerometer Y,Accelerometer Z", *rows]
    assert told_from(lines).rate == 30.0


RATES = {
    "# Config: data_rate = 2000.0 Hz, filter = 488 Hz, acc_range = 4 g": 2000.0,
    "# ODR: 104 Hz": 104.0,
    "# fs=1.6 kHz": 1600.0,
    "# Sampling frequency (Hz): 51.2": 51.2,
    "# sample_rate_hz = 400": 400.0,
    "# Output Data Rate [kHz]: 6.4": 6400.0,
    "# filter = 488 Hz": None,
    "# offs = 12 Hz": None,
}


@pytest.mark.parametrize("line", RATES)
def test_a_rate_in_a_line_of_comment(line):
    assert told_from([line, "a_x,a_y,a_z", *["0.1,0.2,0.9"] * 9]).rate == RATES[line]


@pytest.mark.parametrize("stated", [True, False])
def test_xsens_a_fine_time_without_numbers(stated, log, tmp_path):
    """As wireless trackers have it: the rate of the comments counts, or is asked for."""
    _, gyro, accel, _ = log
    names = ["PacketCounter", "SampleTimeFine", *(f"{n}_{a}" for n in ("Acc", "Gyr") for a in AXES)]
    counter = [str(k) for k in range(len(gyro))]
    columns = [counter, ["NaN"] * len(gyro), *accel.T, *gyro.T]
    rate = ["//  Update Rate: 100.0Hz"] if stated else []
    path = table(tmp_path / "MT.txt", [*rate, "\t".join(names)], columns, "\t")
    if stated:
        return agrees(read_recording(path), log)
    found = inspect(path)
    assert "sample_rate" in found.column_map and found.proposals[0].timeless
    assert any("PacketCounter counts the rows" in note for note in found.proposals[0].notes)


def test_movella_dot_of_its_rates_alone(log, tmp_path):
    """Its names are MT Manager's then, of which it has neither units nor the time's."""
    time, gyro, accel, _ = log
    names = ["PacketCounter", "SampleTimeFine", *(f"{n}_{a}" for n in ("Acc", "Gyr") for a in AXES)]
    fine = [str(4_000_000_000 + int(round(1e6 * t))) for t in time]
    columns = [[str(k) for k in range(len(gyro))], fine, *accel.T, *np.degrees(gyro).T]
    for rate in ([], ["OutputRate:,100Hz"]):
        head = ["DeviceTag:,foo", *rate, ",".join(names)]
        agrees(read_recording(table(tmp_path / "dot.csv", head, columns)), log)


WITMOTION = {
    "Time(s)\tax(g)\tay(g)\taz(g)\twx(deg/s)\twy(deg/s)\twz(deg/s)\tAngleX(deg)\tAngleY(deg)"
    "\tAngleZ(deg)\tT(°)": False,
    "time\tAccX(g)\tAccY(g)\tAccZ(g)\tAsX(°/s)\tAsY(°/s)\tAsZ(°/s)\tAngleX(°)\tAngleY(°)\tAngleZ(°)"
    "\tHX(uT)\tHY(uT)\tHZ(uT)": True,
}


@pytest.mark.parametrize("head", WITMOTION)
def test_witmotion_is_read_as_it_is(head, log, tmp_path):
    """A letter with its unit is as good as a word, and so is the unit of a rate."""
    time, gyro, accel, up = log
    stamps = days(time, lambda s: s.replace("T", " "))
    rest = [*(45 * up).T] if WITMOTION[head] else [time]
    columns = [stamps, *(accel / STANDARD_GRAVITY).T, *np.degrees(gyro).T, *up.T, *rest]
    found = read_recording(table(tmp_path / "data.txt", [head], columns, "\t"))
    agrees(found, log)
    if WITMOTION[head]:
        np.testing.assert_allclose(found.mag, 45e-6 * up, atol=1e-11)


def test_a_vector_by_its_unit_is_none_beside_one_by_its_name():
    header = [f"{n} {a} (deg/s)" for n in ("Wanted", "Gyro") for a in AXES]
    best, rivals = surest(triads(header), "gyro")
    assert best.positions == (3, 4, 5) and not rivals


def test_columns_of_a_recording_without_unit_in_a_foreign_table(log, tmp_path):
    """A map of the rest reads it, and they are among what was left out."""
    time, gyro, accel, _ = log
    head = "Timestamp,x,y,z,temperature,temperature_raw,latitude,altitude"
    columns = [1e6 * time, *accel.T, 20 + time, time, 0 * time + 47.0, 0 * time]
    path = table(tmp_path / "RawAccel.csv", [head], columns)
    map_file = tmp_path / "map.toml"
    map_file.write_text(inspect(path).column_map)
    found = read_recording(path, map_file)
    np.testing.assert_allclose(found.accel, accel, rtol=0, atol=1e-6)
    left = [f for f in found.findings if f.kind in ("columns_left_out", "unused_column")]
    assert "altitude" in str(left)


def test_a_temperature_with_its_unit_makes_no_recording_of_a_foreign_table(log, tmp_path):
    time, gyro, accel, _ = log
    head = ",".join(["cts", *(f"{n} {a}" for n in ("gyro", "accel") for a in "xyz")])
    columns = [1000 * time, *gyro.T, *accel.T, 0 * time + 30]
    found = inspect(table(tmp_path / "c.csv", [head + ",temperature [°C]"], columns))
    agrees(found.recording, log)


NAMES = {
    "x-axis (deg/s)": ((), "x", "deg/s"),
    "X_ACCL (mg)": (("accl",), "x", "mg"),
    "acce_y": (("acce",), "y", None),
    "IM sensor: ACC.Z 1[g]": (("1", "im", "sensor", "acc"), "z", "g"),
}


@pytest.mark.parametrize("cell", NAMES)
def test_what_a_name_says(cell):
    name = named(cell)
    assert (name.words, name.axis, name.unit) == NAMES[cell]


@pytest.mark.parametrize("cell", ["epoc (ms)", "elapsed (s)", "GPS TOW", "cts", "ChipTime"])
def test_a_time_by_its_name(cell):
    assert named(cell).is_time and not named("T(°)").is_time


def test_a_linear_acceleration_is_no_rival_of_a_whole_one():
    forces = ("LINEAR ACCELERATION", "ACCELEROMETER")
    header = [f"{n} {a} (m/s²)" for n in forces for a in AXES]
    best, rivals = surest(triads(header), "accel")
    assert best.positions == (3, 4, 5) and not rivals
    alone, _ = surest(triads([f"linear_acceleration.{a}" for a in "xyz"]), "accel")
    assert alone.positions == (0, 1, 2)


def test_mg_of_which_a_g_is_near_1024_are_no_counts():
    rest = np.tile([10.25, -3.5, 1012.75], (400, 1))
    assert force_unit(rest).unit == "mg"
    rng = np.random.default_rng(3)
    whole = np.rint(rest + rng.normal(0, 2, rest.shape))
    assert force_unit(whole).value == 1 / 1024


def test_the_unit_of_a_temperature():
    assert warmth_unit(np.linspace(21.5, 36.25, 500)).unit == "degC"
    assert warmth_unit(np.linspace(291.5, 309.25, 500)).unit == "K"
    assert warmth_unit(np.arange(20.0, 120.0)).unit is None


PLACES = {
    "tx ty tz qx qy qz qw": "tx",
    "x y z qx qy qz qw": "x",
    "p_x p_y p_z q_x q_y q_z q_w": "p_x",
    "translation.x translation.y translation.z rotation.x rotation.y rotation.z rotation.w": (
        "translation.x"
    ),
}


@pytest.mark.parametrize("names", PLACES)
def test_the_places_of_a_table_of_poses(names, log, tmp_path):
    """As TUM's format has them, which data sets and estimators of cameras write."""
    time, _, _, up = log
    half = 0.5 * np.arctan2(up[:, 1], up[:, 2])
    columns = [time, time, 0.1 * time, -time, np.sin(half), 0 * time, 0 * time, np.cos(half)]
    path = table(tmp_path / "pose.txt", [f"# timestamp {names}"], columns, " ")
    found = inspect(path)
    (proposal,) = found.proposals
    assert [g.target for g in proposal.guesses if g.cell == PLACES[names]] == ["ref_east"]
    np.testing.assert_allclose(found.recording.ref_up, -time, atol=1e-6)
    assert "is z up?" in found.column_map and not proposal.notes


def test_an_attitude_beside_a_sensor_is_named(log, tmp_path):
    """It may be a reference, and may be the sensor's own estimate."""
    time, gyro, accel, _ = log
    head = ["time", *(f"{n}_{a}" for n in ("gyro", "acce") for a in "xyz")]
    head += [f"ori_{a}" for a in "wxyz"]
    columns = [time, *gyro.T, *accel.T, 1 + 0 * time, *np.zeros((3, len(time)))]
    (proposal,) = inspect(table(tmp_path / "r.csv", [",".join(head)], columns)).proposals
    assert any("ori_w, ori_x, ori_y, ori_z are left out" in note for note in proposal.notes)
