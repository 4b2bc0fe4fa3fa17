"""Arrays as libraries write them: several numbers in a row of Parquet, arrays of structures of
MATLAB, units as attributes of HDF5.
"""

import h5py
import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from rolling import rolls
from scipy.io import savemat

from pyimu import inspect, read_recording
from pyimu.errors import UserError
from pyimu.units import STANDARD_GRAVITY

N = 2000
TIME = 0.01 * np.arange(N)


@pytest.fixture(scope="module")
def vectors():
    """Gyro rad/s and accelerometer m/s^2 (n, 3) of a body that rolls."""
    rng = np.random.default_rng(31)
    gyro, up = rolls(TIME)
    noise = rng.standard_normal((2, N, 3))
    return gyro + 1e-3 * noise[0], STANDARD_GRAVITY * up + 0.02 * noise[1]


def same(found, gyro, accel):
    np.testing.assert_allclose(found.gyro, gyro, rtol=1e-12)
    np.testing.assert_allclose(found.accel, accel, rtol=1e-12)
    np.testing.assert_allclose(found.time - found.time[0], TIME, atol=1e-9)


@pytest.mark.parametrize("kind", [pa.list_(pa.float64()), pa.list_(pa.float64(), 3)])
def test_lists_of_parquet(kind, vectors, tmp_path):
    columns = {n: pa.array(v.tolist(), kind) for n, v in zip(("gyro", "accel"), vectors)}
    parquet.write_table(
        pa.table({"t": TIME, "note": ["x"] * N, **columns}), tmp_path / "log.parquet"
    )
    same(inspect(tmp_path / "log.parquet").recording, *vectors)


def test_a_list_that_is_too_short_or_missing_has_missing_values(vectors, tmp_path):
    lists = [v.tolist() for v in vectors]
    lists[0][500], lists[0][700] = None, lists[0][700][:2]
    columns = dict(zip(("gyro", "accel"), lists))
    parquet.write_table(pa.table({"t": TIME, **columns}), tmp_path / "log.parquet")
    found = inspect(tmp_path / "log.parquet").recording
    assert np.argwhere(np.isnan(found.gyro)).tolist() == [[500, 0], [500, 1], [500, 2], [700, 2]]
    np.testing.assert_array_equal(found.accel, vectors[1])


def test_structures_of_parquet(vectors, tmp_path):
    """A message of ROS with what is in it."""
    sec = 1_700_000_000 + np.floor(TIME).astype(int)
    nanosec = (1e7 * (np.arange(N) % 100)).astype(int)
    stamps = [{"stamp": {"sec": s, "nanosec": n}} for s, n in zip(sec.tolist(), nanosec.tolist())]
    of = {"angular_velocity": vectors[0], "linear_acceleration": vectors[1]}
    columns = {n: [dict(zip("xyz", row)) for row in v.tolist()] for n, v in of.items()}
    parquet.write_table(pa.table({"header": stamps, **columns}), tmp_path / "log.parquet")
    same(read_recording(tmp_path / "log.parquet"), *vectors)


def test_long_lists_are_no_samples(tmp_path):
    lists = np.zeros((20, 100)).tolist()
    columns = {"t": TIME[:20], "gyro_x": lists, "gyro_y": lists, "gyro_z": lists}
    parquet.write_table(pa.table(columns), tmp_path / "log.parquet")
    (tmp_path / "map.toml").write_text(
        '[columns]\n"t" = "time [s]"\n'
        + "".join(f'"gyro_{a}" = "gyro_{a} [rad/s]"\n' for a in "xyz")
    )
    with pytest.raises(UserError, match="column gyro_x holds list<element: double>, expected num"):
        read_recording(tmp_path / "log.parquet", tmp_path / "map.toml")


def test_an_array_of_structures_has_a_sample_in_each(vectors, tmp_path):
    samples = np.zeros((1, N), dtype=[("t", object), ("gyro", object), ("acc", object)])
    for k, row in enumerate(zip(TIME, *vectors)):
        samples[0, k] = row
    savemat(tmp_path / "log.mat", {"imu": samples, "note": "of a robot"})
    same(inspect(tmp_path / "log.mat").recording, *vectors)


def test_a_few_structures_have_a_sensor_in_each(vectors, tmp_path):
    units = np.zeros((1, 2), dtype=[("t", object), ("gyro", object), ("acc", object)])
    units[0, 0], units[0, 1] = (TIME, *vectors), (TIME, *(2 * v for v in vectors))
    savemat(tmp_path / "log.mat", {"imu": units})
    (tmp_path / "map.toml").write_text(
        '[columns]\n"imu(2)/t" = "time [s]"\n'
        + "".join(f'"imu(2)/gyro[{k}]" = "gyro_{a} [rad/s]"\n' for k, a in enumerate("xyz"))
    )
    found = read_recording(tmp_path / "log.mat", tmp_path / "map.toml")
    np.testing.assert_array_equal(found.gyro, 2 * vectors[0])


def stated(path, gyro, accel, attribute="units"):
    with h5py.File(path, "w") as file:
        for name, values, unit in (
            ("imu/time", 1000 * TIME, "ms"),
            ("imu/gyro", np.degrees(gyro), np.bytes_(b"deg/s")),
            ("imu/accel", accel / STANDARD_GRAVITY, "g"),
            ("imu/flags", np.zeros(N), "none of any"),
        ):
            file[name] = values
            file[name].attrs[attribute] = unit


@pytest.mark.parametrize("attribute", ["units", "unit"])
def test_units_are_attributes_of_hdf5(attribute, vectors, tmp_path):
    """With them the log needs no map, and a map may name the arrays with or without them."""
    stated(tmp_path / "log.h5", *vectors, attribute)
    same(read_recording(tmp_path / "log.h5"), *vectors)
    for end in ("", " (deg/s)"):
        (tmp_path / "map.toml").write_text(
            '[columns]\n"imu/time" = "time [ms]"\n'
            + "".join(f'"imu/gyro[{k}]{end}" = "gyro_{a} [deg/s]"\n' for k, a in enumerate("xyz"))
        )
        found = inspect(tmp_path / "log.h5", tmp_path / "map.toml")
        np.testing.assert_allclose(found.recording.gyro, vectors[0], rtol=1e-12)
        assert [row[1] for row in found.columns] == ["time", "gyro"]
