"""Layouts of logs as people publish them, in short pieces with numbers of our own: what had been
read in the wrong unit, of two sensors at once, or at the wrong rate, without a word.
"""

import log_lines
import numpy as np
import pytest
from turned_logs import G, N, agrees, by_its_map, rows, turned, written

from pyimu import inspect, read_recording

NAMES = "ax,ay,az,gx,gy,gz"


@pytest.fixture(scope="module")
def log():
    return turned()


# A gyro's unit that is an angle's


@pytest.mark.parametrize(
    ("rate", "numbers", "unit"),
    [(100, 1.0, "rad/s"), (100, 180 / np.pi, "deg/s"), (55, 1.0, None)],
)
def test_a_gyro_in_degrees_is_judged_by_gravity(rate, numbers, unit, log, tmp_path):
    """``gyr_x_deg`` in rad/s: at 55 Hz the angle from row to row would be about the same number,
    and neither is taken.
    """
    gyro = numbers * log[1] * rate / 100  # the same turn in other times
    head = "time [s],gyr_x_deg,gyr_y_deg,gyr_z_deg,acc_x_mps2,acc_y_mps2,acc_z_mps2"
    lines = [head, *rows(log[0] * 100 / rate, gyro, log[2])]
    found = inspect(written(tmp_path / "log.csv", lines)).proposals[0]
    assert found.units.get("gyro") == unit
    assert next(g for g in found.guesses if g.group == "gyro").value is None
    if unit is None:
        assert '"gyro_x [rad/s]"' in inspect(tmp_path / "log.csv").column_map


# Rows of several sensors


def test_rows_of_two_devices_are_not_those_of_one(log, tmp_path):
    """A wireless logger's table: each row says by its device's address whose it is."""
    other = (log[0] + 0.003, log[2][:, [1, 2, 0]] / G, np.degrees(log[1])[:, [1, 2, 0]])
    each = [(log[0], log[2] / G, np.degrees(log[1])), other]
    names = ["unit(eb:33)", "unit(aa:01)"]
    head = "Time (s),Device name,Acc X(g),Acc Y(g),Acc Z(g),Gyro X(°/s),Gyro Y(°/s),Gyro Z(°/s)"
    two = [rows(t, [name] * N, f, w) for name, (t, f, w) in zip(names, each, strict=True)]
    path = written(tmp_path / "log.csv", [head, *(line for pair in zip(*two) for line in pair)])
    found = read_recording(path)
    agrees(found, log)
    assert any(names[1] in str(f.detail.get("read_as")) for f in found.findings)
    (tmp_path / "map.toml").write_text(f'[topics]\nimu = "{names[1]}"\n')
    np.testing.assert_allclose(
        read_recording(path, tmp_path / "map.toml").gyro, log[1][:, [1, 2, 0]], atol=1e-6
    )


def test_a_state_of_the_device_is_no_device(log, tmp_path):
    """Words that come once each, or whose column has another name, take no rows away."""
    words = ["warm"] * 60 + ["ready"] * (N - 60)
    for name in ("device", "device state"):
        head = f"time [s],{name},accel_x [g],accel_y [g],accel_z [g],gyro_x [rad/s],gyro_y [rad/s],"
        lines = [f"{head}gyro_z [rad/s]", *rows(log[0], words, log[2] / G, log[1])]
        assert len(read_recording(written(tmp_path / "log.csv", lines))) == N


@pytest.mark.parametrize("units", [True, False])
@pytest.mark.parametrize("word", [True, False])
def test_each_sensor_in_rows_of_its_own(units, word, log, tmp_path):
    """Gyro and accelerometer in one table, one row a sample of either, empty cells beside it."""
    none = ",,"
    first = rows(log[0] - 0.004, ["acceleration"] * N, log[2], [none] * N)
    second = rows(log[0], ["gyroscope"] * N, [none] * N, log[1])
    head = f"time,sensor,{NAMES}"
    if units:
        named = [f"{n} [{'m/s^2' if n[0] == 'a' else 'rad/s'}]" for n in NAMES.split(",")]
        head = ",".join(["time [s]", "sensor", *named])
    lines = [head, *(line for pair in zip(first, second, strict=True) for line in pair)]
    if not word:
        lines = [",".join(c for k, c in enumerate(line.split(",")) if k != 1) for line in lines]
    path = written(tmp_path / "log.csv", lines)
    found = read_recording(path) if units else by_its_map(path, tmp_path)
    assert len(found) == N and found.sample_rate == pytest.approx(100)
    np.testing.assert_allclose(found.gyro, log[1], atol=1e-6)
    np.testing.assert_allclose(found.accel, log[2], atol=1e-5)
    assert not any("other rows" in str(f) for f in found.findings)
    named = zip(lines[0].split(",")[1 + word :], TARGETS, strict=True)
    first = f'[columns]\n"{lines[0].split(",")[0]}" = "time [s]"\n'
    by_hand = "".join(f'"{cell}" = "{target}"\n' for cell, target in named)
    by_hand = by_hand.replace("[g]", "[m/s^2]").replace("[deg/s]", "[rad/s]")
    (tmp_path / "map.toml").write_text(first + by_hand)
    np.testing.assert_array_equal(read_recording(path, tmp_path / "map.toml").accel, found.accel)


def test_a_gyro_in_each_fourth_row_has_its_own_rate(log, tmp_path):
    """The accelerometer is sampled four times as fast: a gyro at its rate would be missing mostly,
    and turn too little to tell its unit.
    """
    force = rows(log[0], log[2])
    slow = rows(log[1])
    lines = [f"{f},{slow[k]}" if k % 4 == 0 else f"{f},,," for k, f in enumerate(force)]
    path = written(tmp_path / "log.csv", [f"time,{NAMES}", *lines])
    found = by_its_map(path, tmp_path)
    assert found.sample_rate == pytest.approx(25)
    np.testing.assert_allclose(found.gyro, log[1][::4], atol=1e-6)
    np.testing.assert_allclose(found.accel, log[2][::4], atol=1e-5)


def test_a_number_of_the_sensor_is_heeded_under_more_names(log, tmp_path):
    both = zip(rows([0] * N, *log), rows([1] * N, log[0], -log[1], -log[2]), strict=True)
    lines = ["sensor_no,time,gx,gy,gz,ax,ay,az", *(line for pair in both for line in pair)]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


def test_flysight_s_lines_of_each_sensor(log, tmp_path):
    """The magnetometer's lines, which come more seldom, are further columns."""
    field = np.outer(1 + 0.1 * np.sin(log[0]), [0.2, -0.1, 0.4])
    imu = rows(["$IMU"] * N, log[0], np.degrees(log[1]), log[2] / G, np.full(N, 28.5))
    mag = rows(["$MAG"] * N, log[0], field, np.full(N, 27.0))
    head = [
        *("$FLYS,1", "$VAR,FIRMWARE_VER,v1", "$COL,BARO,time,pressure", "$UNIT,BARO,s,Pa"),
        *("$COL,MAG,time,x,y,z,temperature", "$UNIT,MAG,s,gauss,gauss,gauss,deg C"),
        "$COL,IMU,time,wx,wy,wz,ax,ay,az,temperature",
        *("$UNIT,IMU,s,deg/s,deg/s,deg/s,g,g,g,deg C", "$DATA", "$BARO,0.001,101325"),
    ]
    lines = [line for k in range(N) for line in ((imu[k], mag[k]) if k % 5 == 0 else (imu[k],))]
    found = read_recording(written(tmp_path / "log.csv", [*head, *lines]))
    agrees(found, log)
    np.testing.assert_allclose(found.mag[::5], field[::5] * 1e-4, rtol=1e-5)
    assert found.temperature[0] == pytest.approx(28.5)


def test_devices_without_names_of_columns(log, tmp_path):
    """Two sensors on one bus, by their addresses: the rows of the second by a map."""
    one, two = (np.hstack([log[2] / G, np.degrees(log[1])])[:, order] for order in ORDERS)
    both = zip(rows(["IMU"] * N, ["0x69"] * N, two), rows(["IMU"] * N, ["0x68"] * N, one))
    path = written(tmp_path / "log.txt", [line for pair in both for line in pair])
    assert "[topics] imu names others" in inspect(path).report()
    columns = "".join(f'"column {k + 3}" = "{name}"\n' for k, name in enumerate(TARGETS))
    given = 'sample_rate = {value = 100, unit = "Hz"}\n[columns]\n' + columns
    for word, order in (("0x69", ORDERS[1]), ("0x68", ORDERS[0])):
        (tmp_path / "map.toml").write_text(f'{given}[topics]\nimu = "{word}"\n')
        found = read_recording(path, tmp_path / "map.toml")
        np.testing.assert_allclose(found.accel, log[2][:, order[:3]], atol=1e-6)


ORDERS = ([0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3])
TARGETS = [f"{n}_{a} [{u}]" for n, u in (("accel", "g"), ("gyro", "deg/s")) for a in "xyz"]


# Messages


@pytest.mark.parametrize("two", [False, True])
def test_messages_as_ros_prints_them(two, log, tmp_path):
    """A number on a line: ``rostopic echo`` and ``ros2 topic echo`` of an Imu message."""
    seconds, parts = ("sec", "nanosec") if two else ("secs", "nsecs")
    none = ["- 0.0"] * 9
    lines = []
    for t, rate, force in zip(*log, strict=True):
        ns = round(1e9 * t) + 1_600_000_000 * 10**9
        lines += ["header:", "  seq: 3", "  stamp:", f"    {seconds}: {ns // 10**9}"]
        lines += [f"    {parts}: {ns % 10**9}", '  frame_id: "imu"', "orientation:", "  x: 0.5"]
        for name, vector in (("angular_velocity", rate), ("linear_acceleration", force)):
            lines += [f"{name}: ", *(f"  {a}: {v!r}" for a, v in zip("xyz", vector.tolist()))]
            lines += [f"{name}_covariance:", *none] if two else [f"{name}_covariance: [0.0, 0.0]"]
        lines.append("---")
    agrees(read_recording(written(tmp_path / "log.txt", lines)), log)


# Times


def test_the_sensor_s_own_clock_goes_before_the_computer_s(log, tmp_path):
    """WitMotion's table: a wireless sensor's samples arrive five at a time."""
    ns = np.rint(1e9 * log[0]).astype(int)
    found = read_recording(log_lines.witmotion(tmp_path, (ns, *log[1:])))
    agrees(found, log)
    assert not any(f.kind == "coarse_stamps" for f in found.findings)
    np.testing.assert_allclose(found.mag, np.tile([1e-5, -2e-5, 3e-5], (N, 1)))


@pytest.mark.parametrize("order", [slice(None, None, -1), np.r_[N // 2 : N, 0 : N // 2]])
def test_rows_out_of_order_are_told_of(order, log, tmp_path):
    """The newest first, as of a database; two halves exchanged. Nobody is asked for a rate."""
    lines = ["timestamp,ax,ay,az", *rows(1.6e9 + log[0][order], log[2][order], form="{:.13g}")]
    said = inspect(written(tmp_path / "log.csv", lines, "utf-8")).report()
    assert "the time runs backwards" in said and "sort the rows by time" in said
    assert "no column is a time" not in said


def test_a_temperature_called_t_is_no_time(log, tmp_path):
    warmth = 25 + np.random.default_rng(2).normal(0, 0.1, N)
    lines = [f"{NAMES},t", *rows(log[2], log[1], warmth)]
    assert "no column is a time" in inspect(written(tmp_path / "log.csv", lines)).report()


def test_milliseconds_go_before_whole_seconds_of_the_day(log, tmp_path):
    """A board's clock in seconds, and beside it a column called ``ms``."""
    clock = [f"2024/01/05 10:20:{int(t):02d}" for t in log[0]]
    lines = [f"JST,ms,num,{NAMES}", *rows(clock, 5000 + 1000 * log[0], range(N), log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


def test_the_time_from_row_to_row_tells_the_rate(log, tmp_path):
    steps = 0.01 * (1 + 0.1 * np.sin(np.arange(N)))
    lines = [f"dt,{NAMES}", *rows(steps, log[2], log[1])]
    found = by_its_map(written(tmp_path / "log.csv", lines), tmp_path)
    assert found.sample_rate == pytest.approx(1 / steps.mean(), rel=1e-5)
    np.testing.assert_allclose(found.gyro, log[1], atol=1e-6)


# What stands before and around the numbers


def _esp(k, force, rate):
    pairs = zip(NAMES.split(","), [*force, *rate], strict=True)
    return f"\x1b[0;32mI ({10 * k}) imu: {' '.join(f'{n}={v:.7f}' for n, v in pairs)}\x1b[0m"


def _stamped(k, force, rate):
    return f"[2024-02-01 10:00:{0.01 * k:06.3f}] {','.join(f'{v:.7f}' for v in (*force, *rate))}"


def _arrow(k, force, rate):
    return f"10:00:{0.01 * k:06.3f} -> {','.join(f'{v:.7f}' for v in (*force, *rate))}"


def _lists(k, force, rate):
    three = [f'"[{", ".join(f"{v:.7f}" for v in vector)}]"' for vector in (force, rate)]
    return ",".join([f"{0.01 * k:.2f}", *three])


def _tuples(k, force, rate):
    three = [f"({','.join(f'{v:.7f}' for v in vector)})" for vector in (force, rate)]
    return ";".join([f"{10 * k}", *three])


def _printed(k, force, rate):
    return repr((0.01 * k, np.round(force, 7).tolist(), np.round(rate, 7).tolist()))


def _dictionary(k, force, rate):
    pairs = zip(NAMES.split(","), np.round([*force, *rate], 7).tolist(), strict=True)
    return repr({"time": 0.01 * k, **dict(pairs)})


@pytest.mark.parametrize(
    ("head", "line"),
    [
        *((None, f) for f in (_esp, _stamped, _arrow, _printed, _dictionary)),
        *(("time,accel,gyro", _lists), ("ms;accel;gyro", _tuples)),
    ],
)
def test_rows_within_what_programs_print_around_them(head, line, log, tmp_path):
    """ESP-IDF's log in colours, times that terminals write in front, lists in cells, tuples, what
    Python prints of a list and of a dictionary.
    """
    lines = [line(k, log[2][k], log[1][k]) for k in range(N)]
    path = written(tmp_path / "log.txt", [*([] if head is None else [head]), *lines])
    agrees(by_its_map(path, tmp_path), log)


@pytest.mark.parametrize("zone", ["PM", "-0500", "+01:00", "UTC"])
def test_what_belongs_to_a_time_is_no_number_behind_it(zone, log, tmp_path):
    stamps = [f"2024-02-01 10:00:{t:06.3f} {zone}" for t in log[0]]
    lines = [f"time,{NAMES}", *rows(stamps, log[2], log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


# Increments


@pytest.mark.parametrize(
    "names",
    [
        "dtheta_x,dtheta_y,dtheta_z,dv_x,dv_y,dv_z",
        ",".join(f"delta_{n}[{k}]" for n in ("angle", "velocity") for k in range(3)),
        "dAngX [deg],dAngY [deg],dAngZ [deg],dVelX [m/s],dVelY [m/s],dVelZ [m/s]",
    ],
)
@pytest.mark.parametrize("degrees", [False, True])
def test_increments_are_rates_and_forces_times_the_sample_rate(names, degrees, log, tmp_path):
    """Times 100 Hz; neither is taken for the rate or the force itself."""
    degrees = degrees or "[deg]" in names
    angles = (np.degrees(log[1]) if degrees else log[1]) / 100
    lines = [f"time [s],{names}", *rows(log[0], angles, log[2] / 100, form="{:.12g}")]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


@pytest.mark.parametrize("last", [False, True])
def test_increments_without_names(last, log, tmp_path):
    """The inputs of navigation programs: a time before or behind the six numbers."""
    columns = [log[1] / 100, log[2] / 100]
    columns = [*columns, log[0]] if last else [456000 + log[0], *columns]
    lines = rows(*columns, by=" ", form="{:.12g}")
    agrees(by_its_map(written(tmp_path / "log.txt", lines), tmp_path), log)


# Numbers that are written otherwise


def _units(cells):
    units = ["s", *["m/s2"] * 3, *["rad/s"] * 3]
    return ",".join(f"{c} {u}" for c, u in zip(cells, units, strict=True))


def _hexadecimal(cells):
    numbers = [float(cells[0]) * 1e3, *(float(c) / G * 2048 for c in cells[1:4])]
    numbers += [np.degrees(float(c)) * 131 for c in cells[4:]]
    return ",".join(f"0x{round(n) & 0xFFFF:04X}" for n in numbers)


WRITTEN = {
    "units": (f"time,{NAMES}", _units),
    "minus": (f"time [s],{NAMES}", lambda cells: ",".join(cells).replace("-", "\u2212")),
    "fortran": (f"t {NAMES.replace(',', ' ')}", lambda cells: " ".join(f"{c}D+00" for c in cells)),
    "commas": (f"time,{NAMES}", lambda cells: ",".join(c.replace(".", ",") for c in cells)),
    "hexadecimal": (f"t_ms,{NAMES}", _hexadecimal),
}


@pytest.mark.parametrize("way", WRITTEN)
def test_numbers_that_are_written_otherwise(way, log, tmp_path):
    """A unit in each cell, the minus of printers, Fortran's exponent, decimal commas between
    commas, hexadecimal digits.
    """
    head, write = WRITTEN[way]
    cells = [line.split(",") for line in rows(log[0], log[2], log[1], form="{:.6f}")]
    path = written(tmp_path / "log.csv", [head, *map(write, cells)])
    coarse = way == "hexadecimal"
    found = by_its_map(path, tmp_path)
    agrees(found, log, gyro=1e-4 if coarse else 1e-6, accel=3e-3 if coarse else 1e-5)


def test_words_with_digits_are_no_numbers_with_units(log, tmp_path):
    """A device called ``3V`` and an address in hexadecimal digits beside usual numbers."""
    named = (f"{n} [{'m/s^2' if n[0] == 'a' else 'rad/s'}]" for n in NAMES.split(","))
    head = f"time [s],name,at,{','.join(named)}"
    lines = [head, *rows(log[0], ["3V"] * N, ["0x1F"] * N, log[2], log[1])]
    agrees(read_recording(written(tmp_path / "log.csv", lines)), log)


# Names


def test_an_accelerometer_that_only_its_unit_tells_is_not_lost(log, tmp_path):
    """Beside a gyro whose header states its unit, and a force without gravity."""
    head = "Tiempo(ms);AcelX(m/s²);AcelY(m/s²);AcelZ(m/s²);GiroX(rad/s);GiroY(rad/s);GiroZ(rad/s)"
    head += ";LinX(m/s²);LinY(m/s²);LinZ(m/s²)"
    lines = [head, *rows(1000 * log[0], log[2], log[1], 0 * log[2], by=";")]
    agrees(read_recording(written(tmp_path / "log.csv", lines)), log)


def test_rates_called_r_are_told_by_gravity(log, tmp_path):
    """RX, RY and RZ, as watches' programs call them."""
    lines = ["time,AX,AY,AZ,RX,RY,RZ", *rows(log[0], log[2] / G, log[1])]
    agrees(by_its_map(written(tmp_path / "log.csv", lines), tmp_path), log)


def test_counts_of_a_thermometer_have_no_unit_of_temperatures(log, tmp_path):
    lines = ["time [s]," + NAMES + ",temp", *rows(*log[:1], log[2], log[1], np.full(N, -2876))]
    found = inspect(written(tmp_path / "log.csv", lines)).proposals[0]
    assert "temperature" not in found.groups
    assert any("temp may be the temperature: counts" in note for note in found.notes)
