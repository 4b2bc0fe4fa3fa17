"""Formats: the same log, written by each format's own library, reads to the same bits; what does
not fit is said in one line.
"""

import gzip
import importlib
import re

import log_files
import numpy as np
import pandas as pd
import pytest
from scipy.io import savemat

from pyimu.errors import UserError
from pyimu.recording.counts import read_scales
from pyimu.recording.formats.suffix import write_table
from pyimu.recording.log import open_log, read_recording

LIBRARY = {
    "mat73": "h5py",
    "hdf5": "h5py",
    "folder": "rosbags",
    "db3": "rosbags",
    "mcap": "rosbags",
    "bag": "rosbags",
}
KINDS = ("csv.gz", "parquet", "mat", "mat73", "hdf5", "folder", "db3", "mcap", "bag")


def kinds(recording):
    return {(f.kind, f.column): f.count for f in recording.findings}


@pytest.fixture
def refused(tmp_path):
    """Asserts that reading is refused in one line that begins with the path and holds a text."""

    def check(path, says, columns=None, starts=None):
        with pytest.raises(UserError, match=re.escape(says)) as caught:
            read_recording(path, columns)
        assert "\n" not in str(caught.value) and str(caught.value).startswith(str(starts or path))

    return check


def put(path, text):
    path.write_text(text)
    return path


@pytest.mark.parametrize("kind", KINDS)
def test_every_format_gives_the_bits_of_csv(kind, tmp_path):
    pytest.importorskip(LIBRARY.get(kind, "numpy"))
    log = log_files.arrays()
    log_files.csv(tmp_path / "plain.csv", log)
    plain, other = (
        read_recording(tmp_path / "plain.csv"),
        read_recording(*log_files.written(tmp_path, kind, log)),
    )
    assert other.name == "log" if kind not in ("db3", "mcap") else other.name.startswith("log")
    assert list(other.groups) == list(plain.groups) == ["gyro", "accel", "temperature"]
    assert np.array_equal(other.time, plain.time)
    assert all(np.array_equal(other.groups[g], plain.groups[g]) for g in plain.groups)
    assert np.array_equal(plain.gyro, log[1]) and np.array_equal(plain.temperature, log[3])


@pytest.mark.parametrize("kind", KINDS)
def test_clock_in_ns_is_not_rounded(kind, tmp_path):
    """The steps are whole ns below 2^53, so that what is left of them in s is right to half an
    ulp.
    """
    pytest.importorskip(LIBRARY.get(kind, "numpy"))
    log = log_files.arrays()
    recording = read_recording(*log_files.written(tmp_path, kind, log))
    assert np.array_equal(recording.time, (log[0] - log[0][0]) * 1e-9)
    assert recording.findings[-1 if LIBRARY.get(kind) == "rosbags" else 0].kind == "time_origin"


@pytest.mark.parametrize(
    "kind", ["csv", "csv.gz", "parquet", "mat", "mat73", "hdf5", "mcap", "db3", "bag"]
)
@pytest.mark.parametrize("damage", ["cut", "noise"])
def test_damaged_file_is_refused_in_one_line(kind, damage, tmp_path, refused):
    pytest.importorskip(LIBRARY.get(kind, "numpy"))
    path, columns = log_files.written(tmp_path, kind, log_files.arrays())
    whole = path.read_bytes()
    path.write_bytes(
        whole[: len(whole) // 2] if damage == "cut" else np.random.default_rng(0).bytes(len(whole))
    )
    if (kind, damage) == ("csv", "cut"):  # of text alone a part is whole
        assert "end_left_out" in {f.kind for f in read_recording(path).findings}
        return
    refused(path, ": ", columns)


@pytest.mark.parametrize(
    "name, library, extra",
    [
        ("log.h5", "h5py", "hdf5"),
        ("log.bag", "rosbags", "ros"),
        ("log.mcap", "rosbags", "ros"),
        ("log.db3", "rosbags", "ros"),
    ],
)
def test_missing_library_is_named_with_its_extra(
    name, library, extra, tmp_path, monkeypatch, refused
):
    def importing(module):
        raise ImportError(module)

    monkeypatch.setattr("pyimu.recording.formats.reader.import_module", importing)
    refused(
        put(tmp_path / name, "x"),
        f"needs {library}, which is not installed; install the extra: pip install 'pyimu[{extra}]'",
    )


def test_mat_73_names_its_extra(tmp_path, monkeypatch, refused):
    monkeypatch.setattr(
        "pyimu.recording.formats.reader.import_module",
        lambda module: importlib.import_module("no_such_" + module),
    )
    (tmp_path / "log.mat").write_bytes(b"MATLAB 7.3".ljust(512) + b"\x89HDF\r\n\x1a\n")
    refused(tmp_path / "log.mat", "pip install 'pyimu[mat]'")


def test_folder_that_is_no_bag(tmp_path, refused):
    refused(tmp_path, "a folder, give the files in it")


# Parquet and CSV


@pytest.mark.parametrize("kind", ["int32", "uint64", "int64"])
def test_parquet_integers_of_any_width(kind, tmp_path):
    frame = pd.DataFrame(
        {"time [ms]": np.array([5, 15, 25], kind)}
        | {f"gyro_{a} [deg/s]": np.array([1, 2, 3], "int16") for a in "xyz"}
    )
    frame.to_parquet(tmp_path / "log.parquet")
    assert read_recording(tmp_path / "log.parquet").time == pytest.approx([0.005, 0.015, 0.025])


@pytest.mark.parametrize("rows", [0, 1, 8, 19])
def test_tables_as_another_library_reads_them(rows, tmp_path):
    """Of every kind of column that a result has: numbers one behind another or apart, NaN among
    them as what is missing, truths, and marks.
    """
    rng = np.random.default_rng(rows)
    pair = rng.standard_normal((rows, 2))
    gaps = np.where(rng.random(rows) < 0.3, np.nan, pair[:, 0])
    truths, marks = rng.random(rows) < 0.5, rng.integers(0, 2**16, rows).astype("uint16")
    columns = {"apart": pair[:, 1], "gaps": gaps, "truths": truths, "marks": marks}
    write_table(tmp_path / "table.parquet", columns)
    pd.testing.assert_frame_equal(
        pd.read_parquet(tmp_path / "table.parquet"), pd.DataFrame(columns)
    )


def test_unsigned_time_that_runs_backwards_is_seen(tmp_path, refused):
    frame = pd.DataFrame(
        {"time [ms]": np.array([5, 15, 10], "uint32")}
        | {f"gyro_{a} [deg/s]": [1.0, 2, 3] for a in "xyz"}
    )
    frame.to_parquet(tmp_path / "log.parquet")
    refused(tmp_path / "log.parquet", "row 4: the time runs backwards, 0.01 s follows 0.015 s")


@pytest.mark.parametrize("name", ["log.csv", "log.csv.gz"])
def test_csv_error_far_into_the_file_names_row_and_column(name, tmp_path, refused):
    rows = [f"{k},1,2,3" for k in range(200_000)]
    rows[150_000] = "150000,1,oops,3"
    text = (
        "time [ms],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]\n" + "\n".join(rows) + "\n"
    ).encode()
    (tmp_path / name).write_bytes(gzip.compress(text, 1) if name.endswith("gz") else text)
    refused(tmp_path / name, "row 150002, column gyro_y [rad/s]: 'oops' is not a number")


@pytest.mark.parametrize(
    "bits, unit, span",
    [
        (32, "us", "4294.9673"),
        (16, "ms", "65.536"),
        (24, "us", "16.777216"),
        (32, "ns", "4.2949673"),
    ],
)
def test_counter_of_time_that_wraps_runs_on(bits, unit, span, tmp_path, refused):
    steps = np.arange(400) * 2**bits // 200
    ticks = (steps + 2**bits - 2**bits // 10) % 2**bits
    head = f"time [{unit}],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]\n"
    log = put(tmp_path / "log.csv", head + "".join(f"{t},1,2,3\n" for t in ticks))
    found = read_recording(log)
    (said,) = (f for f in found.findings if f.kind == "counter_wrapped")
    assert (said.count, said.detail) == (2, {"after": f"{bits} bits"})
    # the sums are whole numbers, and a second is a factor of them
    size = float(span) / 2**bits
    np.testing.assert_allclose(found.time - found.time[0], steps * size, rtol=1e-6, atol=0)
    joined = [piece.time for piece, _ in open_log(log).pieces(7)]
    np.testing.assert_array_equal(np.concatenate(joined), found.time)
    ticks = np.delete(ticks, np.s_[15:28])  # a second log, or more is missing than can be told
    put(log, head + "".join(f"{t},1,2,3\n" for t in ticks))
    refused(log, f"; a counter of {bits} bits begins anew after {span} s, but here more is missing")


# MAT and HDF5


def test_arrays_that_no_map_names_are_listed(tmp_path, refused):
    log_files.mat(tmp_path / "log.mat", log_files.arrays())
    refused(
        tmp_path / "log.mat",
        "it has imu/t, imu/gyro[0], imu/gyro[1], imu/gyro[2], imu/acc[0]",
    )


def test_unit_must_be_told(tmp_path, refused):
    log_files.mat(tmp_path / "log.mat", log_files.arrays())
    refused(
        tmp_path / "log.mat",
        "column gyro_x has no unit",
        put(tmp_path / "m.toml", log_files.MAP.replace("gyro_x [rad/s]", "gyro_x")),
    )


def test_name_in_the_map_that_the_file_lacks(tmp_path, refused):
    log_files.mat(tmp_path / "log.mat", log_files.arrays())
    column_map = put(tmp_path / "m.toml", log_files.MAP.replace("imu/gyro[0]", "imu/gyr[0]"))
    refused(
        tmp_path / "log.mat",
        "has no such column, did you mean imu/gyro[0]?",
        column_map,
        column_map,
    )


def test_arrays_of_another_rate_are_refused(tmp_path, refused):
    tree = {
        "t": np.arange(50) * 1_000_000,
        "gyro": np.zeros((50, 3)),
        "acc": np.zeros((50, 3)),
        "temp": np.zeros(5),
    }
    savemat(tmp_path / "log.mat", {"imu": tree})
    refused(
        tmp_path / "log.mat",
        "imu/temp has 5 samples and imu/t has 50: columns of another rate cannot be read together",
        put(tmp_path / "m.toml", log_files.MAP),
    )


def test_hdf5_records_and_recording_names(tmp_path):
    """Fields of records by their names; and arrays that are called as in a CSV header need no
    map.
    """
    h5py = pytest.importorskip("h5py")
    table = np.zeros(
        20, dtype=[("t", "u8"), ("g", "f4", (3,)), ("gx", "f4"), ("gy", "f8"), ("gz", "i2")]
    )
    table["t"], table["gx"], table["gz"] = np.arange(20) * 10, np.arange(20) / 4, np.arange(20)
    names = {"t": "time [ms]"} | {f"g{a}": f"gyro_{a} [deg/s]" for a in "xyz"}
    with h5py.File(tmp_path / "log.h5", "w") as file:
        file["run/table"] = table
    with h5py.File(tmp_path / "named.h5", "w") as file:
        for name, title in names.items():
            file[title] = table[name]
    column_map = put(
        tmp_path / "m.toml",
        "[columns]\n" + "".join(f'"run/table[{k}]" = "{v}"\n' for k, v in names.items()),
    )
    recording = read_recording(tmp_path / "log.h5", column_map)
    assert recording.time == pytest.approx(np.arange(20) * 0.01) and recording.gyro[
        :, 0
    ] == pytest.approx(np.radians(np.arange(20) / 4))
    assert recording.gyro[:, 2] == pytest.approx(np.radians(np.arange(20)))
    assert np.array_equal(read_recording(tmp_path / "named.h5").gyro, recording.gyro)


def test_fields_of_several_numbers_are_columns(tmp_path):
    h5py = pytest.importorskip("h5py")
    table = np.zeros(20, dtype=[("t", "u8"), ("gyr", "f4", (3,))])
    table["t"], table["gyr"] = np.arange(20) * 10, np.arange(60).reshape(20, 3)
    with h5py.File(tmp_path / "log.h5", "w") as file:
        file["imu"] = table
    lines = [
        '"imu[t]" = "time [ms]"',
        *(f'"imu[gyr][{k}]" = "gyro_{a} [rad/s]"' for k, a in enumerate("xyz")),
    ]
    recording = read_recording(
        tmp_path / "log.h5", put(tmp_path / "m.toml", "[columns]\n" + "\n".join(lines))
    )
    assert np.array_equal(recording.gyro, table["gyr"])


def test_arrays_without_columns_are_named_with_the_reason(tmp_path, refused):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "log.h5", "w") as file:
        file["table"] = np.zeros(20, dtype=[("t", "f8"), ("name", "S4"), ("cov", "f8", (3, 3))])
        file["frames"], file["word"] = np.zeros((20, 4, 4)), "left"
        file["words"] = np.array([b"a", b"b"])
    refused(
        tmp_path / "log.h5",
        "it has table[t]; without columns of numbers are frames (3 axes), table[name] (texts), "
        "table[cov] (3 axes), words (",
    )


@pytest.mark.parametrize(
    "value, says",
    [
        (
            np.array([("a", "b")] * 20, dtype=[("t", "O"), ("gx", "O")]),
            "log (20 structures without numbers, save arrays)",
        ),
        (np.array([np.zeros(3), np.zeros(4)], dtype=object), "log (cells, save arrays)"),
    ],
)
def test_mat_of_structures_or_cells_says_so(value, says, tmp_path, refused):
    savemat(tmp_path / "log.mat", {"log": value})
    refused(
        tmp_path / "log.mat",
        f"the header has no 'time [s]' column; without columns of numbers are {says}",
    )


def test_foreign_csv_is_shown_the_way_to_a_map(tmp_path, refused):
    path = put(tmp_path / "log.csv", "gx,gy,gz,t\n0,0,0,0\n")
    refused(
        path,
        "it has gx, gy, gz, t; name its columns in a column map (TOML) and give that as --columns: "
        f"pyimu inspect {path} --write-map map.toml writes one to look over",
    )


# Bags


IMU = (np.zeros(3), np.zeros(3))


def imu_topics(*names):
    return lambda messages, _: {
        name: [(k * 10**7, messages.imu(k * 10**7 + 1, [k, 0, 0], [0, 0, 9.8])) for k in range(10)]
        for name in names
    }


@pytest.mark.parametrize("write, name", [(log_files.bag1, "a.bag"), (log_files.bag2, "a")])
def test_topics_are_picked_by_the_map(write, name, tmp_path, refused):
    pytest.importorskip("rosbags")
    write(tmp_path / name, topics=imu_topics("/left", "/right"))
    refused(tmp_path / name, 'name one in a column map: [topics] imu = "/left"')
    assert (
        len(read_recording(tmp_path / name, put(tmp_path / "m.toml", '[topics]\nimu = "/right"\n')))
        == 10
    )
    refused(
        tmp_path / name,
        "no topic /middle of type sensor_msgs/msg/Imu; there are /left, /right",
        put(tmp_path / "m.toml", '[topics]\nimu = "/middle"\n'),
    )


def test_topics_of_a_file_that_has_none(tmp_path, refused):
    log_files.csv(tmp_path / "log.csv", log_files.arrays())
    refused(
        tmp_path / "log.csv", "has no topics", put(tmp_path / "m.toml", '[topics]\nimu = "/imu"\n')
    )


def test_bag_without_imu_says_what_is_in_it(tmp_path, refused):
    pytest.importorskip("rosbags")
    log_files.bag2(
        tmp_path / "a", topics=lambda messages, _: {"/t": [(1, messages.temperature(1, 20.0))]}
    )
    refused(
        tmp_path / "a",
        "no topic of type sensor_msgs/msg/Imu; there are /t (sensor_msgs/msg/Temperature)",
    )


@pytest.mark.parametrize("lacks, has", [("gyro", "accel"), ("accel", "gyro")])
def test_quantity_marked_unknown_is_left_out(lacks, has, tmp_path):
    """sensor_msgs/Imu: the first element of a covariance is -1 where the sensor does not measure
    the quantity.
    """
    pytest.importorskip("rosbags")
    log_files.bag2(
        tmp_path / "a",
        topics=lambda messages, _: {
            "/imu": [
                (k, messages.imu(k, *IMU, unknown=[lacks])) for k in range(10**6, 10**7, 10**6)
            ]
        },
    )
    assert list(read_recording(tmp_path / "a").groups) == [has]


def test_time_of_logging_where_stamps_are_not_set(tmp_path):
    pytest.importorskip("rosbags")
    log_files.bag1(
        tmp_path / "a.bag",
        topics=lambda messages, _: {
            "/imu": [(k * 10**7, messages.imu(0, *IMU)) for k in range(1, 30)]
        },
    )
    recording = read_recording(tmp_path / "a.bag")
    assert (
        recording.time == pytest.approx(np.arange(1, 30) * 0.01)
        and kinds(recording)[("log_time", "time")] == 29
    )


def test_slow_temperature_is_interpolated_at_the_samples(tmp_path):
    pytest.importorskip("rosbags")

    def topics(messages, _):
        return {
            "/imu": [(k * 10**7, messages.imu(k * 10**7, *IMU)) for k in range(1, 102)],
            "/temp": [
                (k * 10**7, messages.temperature(k * 10**7, 20 + k / 4)) for k in range(1, 102, 50)
            ],
        }

    log_files.bag2(tmp_path / "a", topics=topics)
    recording = read_recording(tmp_path / "a")
    assert (
        recording.temperature == pytest.approx(20 + np.arange(1, 102) / 4)
        and kinds(recording)[("interpolated", "temperature")] == 3
    )


# Counts


COUNTS = "time [ms],gyro_x [count],gyro_y [LSB],gyro_z [deg/s],temperature [raw]\n"
SCALE = (
    '[scale]\ngyro_x = {value = 0.5, unit = "deg/s"}\ngyro_y = {value = -0.25, unit = "rad/s"}\n'
)
CELSIUS = 'temperature = {value = 0.002941176470588235, offset = 36.53, unit = "degC"}\n'


def counts_log(tmp_path):
    return put(
        tmp_path / "log.csv", COUNTS + "".join(f"{10 * k},{k},{k},{k},340\n" for k in range(5))
    )


def test_counts_are_scaled_by_the_map(tmp_path):
    """The thermometer's line is that of the MPU-6050: one degree is 340 counts, and zero is 36.53
    degC.
    """
    recording = read_recording(counts_log(tmp_path), put(tmp_path / "m.toml", SCALE + CELSIUS))
    assert recording.gyro[4] == pytest.approx(
        [np.radians(2), -1, np.radians(4)]
    ) and recording.temperature[0] == pytest.approx(37.53)


def test_scale_of_a_group_and_of_one_of_its_columns(tmp_path):
    log = put(
        tmp_path / "log.csv",
        "time [count],"
        + ",".join(f"gyro_{a} [count]" for a in "xyz")
        + "\n"
        + "".join(f"{k},1,1,1\n" for k in range(5)),
    )
    text = (
        '[scale]\ngyro_y = {value = 3, unit = "rad/s"}\ngyro = {value = 2, unit = "rad/s"}\ntime = '
        '{value = 4, unit = "ms"}\n'
    )
    recording = read_recording(log, put(tmp_path / "m.toml", text))
    assert recording.gyro[0].tolist() == [2, 3, 2] and recording.time == pytest.approx(
        np.arange(5) * 0.004
    )


def test_counts_of_unknown_size_are_refused(tmp_path, refused):
    log = counts_log(tmp_path)
    refused(
        log,
        "column gyro_x is in counts, and nobody said how large one is; say it in a column map "
        "(TOML) as [scale] gyro = {value = ..., "
        'unit = "rad/s"}',
    )
    refused(log, "column temperature is in counts", put(tmp_path / "m.toml", SCALE))


@pytest.mark.parametrize(
    "text, says",
    [
        (
            'gyro_z = {value = 1, unit = "deg/s"}',
            "column gyro_z is in 'deg/s', but [scale] in the column map is for columns in counts",
        ),
        ('gyr = {value = 1, unit = "deg/s"}', "unknown key scale.gyr, did you mean gyro?"),
        ('gyro_x = {value = 1, unit = "m"}', "key scale.gyro_x.unit cannot be in 'm'"),
        ("gyro_x = {value = 1}", "key scale.gyro_x must be such as"),
        ("gyro_x = 1", "key scale.gyro_x must be such as"),
        ('gyro_x = {value = 0, unit = "deg/s"}', "a count cannot be of size 0"),
        ('gyro_x = {value = "1", unit = "deg/s"}', "key scale.gyro_x.value must be a number"),
        ('time = {value = 1, unit = "s", offset = 1}', "a time needs no offset"),
        ('gyro_x = {value = 1, unit = "LSB/g"}', "expected a unit like 'rad/s' or 'LSB/(rad/s)'"),
        ('gyro_x = {value = 1, unit = "LSB/dps", offset = 1}', "an offset cannot be in 'LSB/dps'"),
    ],
)
def test_scale_that_is_wrong(text, says, tmp_path):
    with pytest.raises(UserError, match=re.escape(says)):
        read_recording(
            counts_log(tmp_path),
            put(
                tmp_path / "m.toml",
                f"{SCALE if 'gyro_z' in text else '[scale]'}{chr(10)}{text}\n{CELSIUS}",
            ),
        )


@pytest.mark.parametrize(
    "value, unit, size",
    [
        (131, "LSB/(deg/s)", np.radians(1 / 131)),
        (131, "LSB/dps", np.radians(1 / 131)),
        (131, "LSB/°/s", np.radians(1 / 131)),
        (8.75, "mdps/LSB", np.radians(8.75e-3)),
        (8.75, "mdps", np.radians(8.75e-3)),
    ],
)
def test_the_size_of_a_count_as_data_sheets_have_it(value, unit, size, tmp_path):
    gyro = {"gyro": {"value": value, "unit": unit}}
    scale = read_scales(tmp_path / "m.toml", gyro)["gyro_y"]
    assert scale.value * scale.unit.factor == pytest.approx(size, rel=1e-15)


@pytest.mark.parametrize("value, unit", [(16384, "LSB/g"), (1000 / 16384, "mg/LSB")])
def test_the_size_of_a_count_of_an_accelerometer(value, unit, tmp_path):
    accel = {"accel": {"value": value, "unit": unit}}
    scale = read_scales(tmp_path / "m.toml", accel)["accel_z"]
    assert scale.value * scale.unit.factor == pytest.approx(9.80665 / 16384, rel=1e-15)


def readings(tmp_path, unit, values):
    rows = "".join(f"{10 * k},{v},0.5,0.5\n" for k, v in enumerate(values))
    return open_log(
        put(
            tmp_path / "log.csv",
            f"time [ms],accel_x [{unit}],accel_y [{unit}],accel_z [{unit}]\n" + rows,
        )
    ).read()


@pytest.mark.parametrize(
    "unit, values, found",
    [
        ("m/s^2", range(16_000, 16_200), True),
        ("g", [0, 1] * 100, True),
        ("mg", [980, 981] * 100, False),
        ("mg", [0, 10**9] * 100, True),
        ("m/s^2", [9] * 200, False),
        ("m/s^2", [1, 2.5] * 100, False),
        ("m/s^2", range(20), False),
    ],
)
def test_whole_numbers_that_claim_a_unit_are_reported(unit, values, found, tmp_path):
    assert (("counts", "accel_x") in kinds(readings(tmp_path, unit, values))) == found


def test_counts_are_reported_in_si(tmp_path):
    (found,) = (f for f in readings(tmp_path, "g", range(-100, 100)).findings if f.kind == "counts")
    assert found.as_dict() == {
        "kind": "counts",
        "column": "accel_x",
        "count": 200,
        "detail": {"unit": "g", "least": -100 * 9.80665, "largest": 99 * 9.80665},
    }
