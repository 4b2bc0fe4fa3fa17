"""Logs of data sets of people, of satellite receivers and of HyperIMU, in their own layouts."""

import zlib

import numpy as np
import pytest
import raw_logs
from log_tables import (
    FIELD,
    cells,
    crc,
    hyper_imu,
    pamap2,
    put,
    receiver,
    total_capture,
    wisdm,
)

from pyimu import UserError, inspect, read_recording
from pyimu.units import STANDARD_GRAVITY

TIME, GYRO, ACCEL = raw_logs.still(300)
TIME = TIME * 1e-9
LOG = TIME, GYRO, ACCEL
DEG = np.pi / 180


def agrees(found, digits=1e-8):
    if found.gyro is not None:
        np.testing.assert_allclose(found.gyro, GYRO, rtol=0, atol=digits)
    if found.accel is not None:
        np.testing.assert_allclose(found.accel, ACCEL, rtol=0, atol=100 * digits)


# NovAtel: counts of increments along z, -y, x, and a checksum


@pytest.mark.parametrize(
    "kind, rad, metres, rate",
    [
        (11, 2.0**-33, 0.3048 * 2.0**-27, 100),
        (13, 0.1 * 2.0**-8 * DEG / 3600, 0.05 * 2.0**-15, 200),
        (56, DEG * 2.0**-21, 2.0**-22, 125),
        (62, DEG * 0.008 * 2.0**-16, 2e-4 * STANDARD_GRAVITY * 2.0**-16, 1),
    ],
)
def test_raw_samples_of_novatel_are_counts_of_their_units_type(kind, rad, metres, rate, tmp_path):
    path = receiver(tmp_path / "log.ASC", LOG, kind, rate * rad, rate * metres)
    found = read_recording(path)
    assert np.max(np.abs(found.gyro - GYRO)) < 0.51 * rate * rad
    assert np.max(np.abs(found.accel - ACCEL)) < 0.51 * rate * metres
    np.testing.assert_allclose(np.diff(found.time), np.diff(TIME), atol=2e-9)
    assert inspect(path).readable


def test_a_line_of_novatel_that_is_spoilt_is_no_row(tmp_path):
    path = receiver(tmp_path / "log.txt", LOG, 11, 100 * 2.0**-33, 100 * 0.3048 * 2.0**-27)
    lines = path.read_text().splitlines()
    lines[50] = lines[50].replace(",00000000,", ",00000000,1")
    found = read_recording(put(path, lines))
    assert len(found.time) == len(TIME) - 1
    assert [f.count for f in found.findings if f.kind == "rows_left_out"] == [1]


@pytest.mark.parametrize("form", [{"typed": False}, {"typed": False, "short": False}, {}])
def test_counts_of_a_unit_that_is_not_known_have_a_size_that_the_user_says(form, tmp_path):
    path = receiver(tmp_path / "log.txt", LOG, 64, 1e-7, 1e-6, **form)
    with pytest.raises(UserError, match="in counts, and nobody said how large one is"):
        read_recording(path)
    scale = 'gyro = {value = 1e-7, unit = "rad/s"}', 'accel = {value = 1e-6, unit = "m/s^2"}'
    columns = put(tmp_path / "map.toml", ["[scale]", *scale])
    agrees(read_recording(path, columns=columns), 6e-8)


def test_checksum_is_that_of_the_manuals_example():
    """The example of RAWIMUSX in the OEM7 manual; zlib's function from 0 and not inverted."""
    body = (
        "RAWIMUSXA,1692,484620.664;00,11,1692,484620.664389000,00801503,43110635,-817242,-202184,"
        "-215194,-41188,-9895"
    )
    assert crc(body) == f"{zlib.crc32(body.encode(), 0xFFFFFFFF) ^ 0xFFFFFFFF:08x}" == "a5db8c7b"


# People


def test_wisdm_has_a_semicolon_behind_each_row(tmp_path):
    for name in ("WISDM_ar_v1.1_raw.txt", "data_1600_gyro_phone.txt"):
        found = read_recording(wisdm(tmp_path, LOG, name))
        assert (found.gyro is None) == ("gyro" not in name)
        agrees(found)
        np.testing.assert_allclose(np.diff(found.time), np.diff(TIME), atol=1e-8)


def test_a_semicolon_behind_each_row_of_a_table_with_names(tmp_path):
    rows = zip(TIME, GYRO, ACCEL, strict=True)
    head = (
        "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s],accel_x [g],accel_y [g],accel_z [g];"
    )
    lines = [",".join(cells(t, g, a / STANDARD_GRAVITY)) + ";" for t, g, a in rows]
    agrees(read_recording(put(tmp_path / "log.csv", [head, *lines])))


def test_pamap2_is_read_by_its_54_columns(tmp_path):
    path = pamap2(tmp_path, LOG)
    found = read_recording(path)
    agrees(found)
    np.testing.assert_allclose(found.mag, np.tile(1e-6 * FIELD, (len(TIME), 1)))
    np.testing.assert_allclose(found.temperature, 30.5)
    left = [f.detail["columns"] for f in found.findings if f.kind == "vector_left_out"]
    assert "ankle gyro x, ankle gyro y, ankle gyro z" in left and len(left) == 4
    more = [f"{line} 1" for line in path.read_text().splitlines()]
    assert inspect(put(tmp_path / "other.dat", more)).readable is False


def test_total_capture_is_read_a_sensor_at_a_time(tmp_path):
    path = total_capture(tmp_path, LOG)
    found = read_recording(path)
    agrees(found)
    np.testing.assert_allclose(np.diff(found.time), 1 / 60, atol=1e-12)
    assert any("Head of Head, L_LowArm" in str(f.detail) for f in found.findings)
    columns = put(tmp_path / "map.toml", ["[topics]", 'imu = "L_LowArm"'])
    np.testing.assert_allclose(read_recording(path, columns=columns).accel, 2 * ACCEL, atol=1e-6)
    put(columns, ["[topics]", 'imu = "Foot"'])
    with pytest.raises(UserError, match="has no topic Foot; .* Head, L_LowArm"):
        read_recording(path, columns=columns)


# HyperIMU


@pytest.mark.parametrize("stamped", [True, False])
def test_hyper_imu_is_in_the_units_of_android(stamped, tmp_path):
    found = read_recording(hyper_imu(tmp_path, LOG, stamped))
    agrees(found)
    np.testing.assert_allclose(found.mag, np.tile(1e-6 * FIELD, (len(TIME), 1)))
    period = 0.05 if not stamped else TIME[1] - TIME[0]
    np.testing.assert_allclose(np.diff(found.time), period, atol=1e-6)
