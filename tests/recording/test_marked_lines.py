"""Lines that say what their values are: a label each, or a word before the rows of one kind."""

import log_lines
import numpy as np
import pytest
import raw_logs
from log_lines import FIELD, LABELS, MESSAGES, NAMED, RATE, labelled, lines_of, sentence
from raw_logs import MAP

from pyimu import UserError, inspect, read_recording
from pyimu.recording.formats.suffix import open_reader

LOG = raw_logs.still(300)
TIME, GYRO, ACCEL = LOG


def put(path, text):
    path.write_text(text)
    return path


def agrees(found, digits=0.0):
    np.testing.assert_allclose(found.gyro, GYRO, rtol=0, atol=digits)
    np.testing.assert_allclose(found.accel, ACCEL, rtol=0, atol=digits)
    np.testing.assert_allclose(np.diff(found.time), 0.01, rtol=0, atol=1e-9)


def stamped():
    rows = zip(TIME, labelled(LOG), strict=True)
    return [f"10:30:{t * 1e-9:06.3f} -> {row}" for t, row in rows]


STAMPED = '[columns]\n"time of day" = "time [s]"\n' + NAMED
LINES = {
    "gx:1,gy:2": (labelled(LOG), RATE + "[columns]\n" + NAMED),
    "gx: 1 gy: 2": (labelled(LOG, "{}: {!r}", " "), RATE + "[columns]\n" + NAMED),
    "gx = 1; gy = 2": (labelled(LOG, "{} = {!r}", "; "), RATE + "[columns]\n" + NAMED),
    "gx=1 tab gy=2": (labelled(LOG, "{}={!r}", "\t"), RATE + "[columns]\n" + NAMED),
    "json": (
        ["{" + line + "}" for line in labelled(LOG, '"{}": {!r}', ", ")],
        RATE + "[columns]\n" + NAMED,
    ),
    "stamped": (stamped(), STAMPED),
}


@pytest.mark.parametrize("kind", LINES)
def test_a_label_before_each_number(kind, tmp_path):
    """As sketches print them for a serial monitor and a plotter; every line is a sample."""
    lines, columns = LINES[kind]
    path = lines_of(tmp_path / "serial.txt", lines)
    assert open_reader(path).header[-6:] == LABELS
    agrees(read_recording(path, put(tmp_path / MAP, columns)))


def test_units_behind_the_numbers_and_an_axis_that_goes_on(tmp_path):
    """``Acceleration X: 1, Y: 2, Z: 3 m/s^2``: the unit is that of all three."""
    lines = [
        f"t: {10 * k} ms, Acceleration X: {a[0]!r}, Y: {a[1]!r}, Z: {a[2]!r} m/s^2, "
        f"Rotation rate X: {w[0]!r}, Y: {w[1]!r}, Z: {w[2]!r} rad/s"
        for k, (w, a) in enumerate(zip(GYRO.tolist(), ACCEL.tolist(), strict=True))
    ]
    agrees(read_recording(lines_of(tmp_path / "serial.txt", ["MPU6050 Found!", *lines])))


def test_a_line_that_lost_letters_is_no_sample(tmp_path):
    lines = stamped()
    lines[100] = "10:30:01.0 -> gx:0.1,gyaz:9"
    found = read_recording(lines_of(tmp_path / "serial.txt", lines), put(tmp_path / MAP, STAMPED))
    assert len(found) == 299
    (left,) = [f for f in found.findings if f.kind == "rows_left_out"]
    assert left.detail["first_row"] == 101
    without = [line.partition("-> ")[2] for line in lines]
    columns = put(tmp_path / MAP, RATE + "[columns]\n" + NAMED)
    with pytest.raises(UserError, match="row 101 is no whole row, and none can be left out"):
        read_recording(lines_of(tmp_path / "serial.txt", without), columns)


def test_a_table_with_a_colon_in_it_stays_one(tmp_path):
    path = lines_of(tmp_path / "t.csv", ["note: x", "time [s],gyro_x [rad/s]", "0,1", "1,2"])
    assert open_reader(path).header == ["time [s]", "gyro_x [rad/s]"]


@pytest.mark.parametrize("tag", MESSAGES)
def test_vectornav_forward_right_down_at_the_rate_that_a_map_says(tag, tmp_path):
    path = log_lines.vectornav(tmp_path, LOG, tag)
    with pytest.raises(UserError, match="say the rate in a column map .*alone in it"):
        read_recording(path)
    found = read_recording(path, tmp_path / MAP)
    agrees(found, digits=6e-7)
    field = np.tile(1e-4 * FIELD * [1, 1, 1], (300, 1))
    np.testing.assert_allclose(found.mag, field, rtol=0, atol=1e-10)
    lines = path.read_text().splitlines()
    lines[50] = lines[50].replace("9.", "8.")
    with pytest.raises(UserError, match="row 51 is no whole row"):
        read_recording(lines_of(path, lines), tmp_path / MAP)


def test_the_checksum_is_that_of_a_published_message():
    """The example of a VN-200 that its users quote."""
    vectors = "-00.0350,+00.4222,-00.6643,-00.015,+00.019,+09.948,+00.002066,-00.008442,-00.044656"
    assert sentence(f"VNIMU,{vectors},+20.7,+084.322").endswith("*66")


def test_gnss_logger_has_each_sensor_in_rows_of_its_own(tmp_path):
    path = log_lines.gnss_logger(tmp_path, LOG)
    found = read_recording(path)
    agrees(found)
    # where it has no sample of its own it is between two that are alike
    np.testing.assert_allclose(found.mag[:-1], 1e-4 * np.tile(FIELD, (299, 1)), rtol=1e-12)
    (said,) = [f for f in found.findings if f.kind == "recognised"]
    assert "GnssLogger" in said.detail["as"]
    whole = inspect(path)
    assert not whole.problem
    again = read_recording(path, whole.write_map(tmp_path / MAP))
    agrees(again)
    np.testing.assert_array_equal(again.mag, found.mag)


def test_gnss_logger_of_a_phone_that_calibrates(tmp_path):
    agrees(read_recording(log_lines.gnss_logger(tmp_path, LOG, ("Gyro", "Accel", ""))))


def test_a_topic_that_gnss_logger_has_not(tmp_path):
    columns = put(tmp_path / MAP, '[topics]\nimu = "Gyros"\n')
    with pytest.raises(UserError, match="has no topic Gyros; .*UncalGyro, Gyro"):
        read_recording(log_lines.gnss_logger(tmp_path, LOG), columns)
