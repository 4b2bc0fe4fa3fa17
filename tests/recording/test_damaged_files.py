"""Files that break readers: each is refused in one line, in bounded time and memory."""

import gzip
import os
import re
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest
from places import CHECKOUT
from scipy.io import savemat

from pyimu import inspect
from pyimu.errors import UserError
from pyimu.model.part_file import load_part
from pyimu.model.part_reader import parse_part
from pyimu.recording.formats import mat_tags
from pyimu.recording.formats.mat import MatReader
from pyimu.recording.log import open_log, read_recording

HEAD = "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]\n"


def refused(read, *given, says=""):
    with pytest.raises(UserError, match=re.escape(says)) as caught:
        read(*given)
    assert str(caught.value).isprintable() and len(str(caught.value)) < 3000
    return str(caught.value)


# Tables in text


def test_a_line_without_an_end_takes_no_memory(tmp_path):
    """64 MiB in one line are 64 KiB packed. The reader holds a quarter of a MiB of it."""
    resource = pytest.importorskip("resource", reason="the system says no peak of memory so")
    unit = 1 if sys.platform == "darwin" else 1 << 10  # B of ru_maxrss, by getrusage(2) of each
    path = tmp_path / "log.csv.gz"
    with gzip.open(path, "wb", compresslevel=1) as stream:
        for _ in range(64):
            stream.write(b"1" * (1 << 20))
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    refused(read_recording, path, says="row 1 is longer than 256 KiB")
    path.write_bytes(gzip.compress(HEAD.encode()) + path.read_bytes())
    refused(read_recording, path, says="row 2 is longer than 256 KiB")
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown * unit < 16 << 20  # the line as text alone would be 64 << 20


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no such pipes")
@pytest.mark.parametrize("suffix", ["csv", "mat", "parquet", "toml"])
def test_pipes_and_devices_are_no_files(suffix, tmp_path):
    os.mkfifo(tmp_path / f"pipe.{suffix}")
    (tmp_path / f"zero.{suffix}").symlink_to("/dev/zero")
    read = load_part if suffix == "toml" else read_recording
    for name in ("pipe", "zero"):
        refused(read, tmp_path / f"{name}.{suffix}", says="no regular file (a pipe or a device)")


def test_names_that_no_system_takes(tmp_path):
    for name, says in (("a" * 5000, "cannot be read"), ("a\0b", "a?b")):
        refused(read_recording, tmp_path / f"{name}.csv", says=says)
        refused(load_part, tmp_path / f"{name}.toml", says=says)


@pytest.mark.parametrize(
    ("row", "line"),
    [(1, HEAD.replace("gyro_x", '"gyro_x').strip()), (4, '0.02,"0,0,0'), (4, '"0.02,0,0,0')],
)
def test_a_quotation_mark_that_is_left_open_is_the_reason(row, line, tmp_path):
    """What stands behind it is one cell: neither are columns missing nor is the row short."""
    rows = [HEAD.strip(), *(f"{0.01 * k:.2f},0.1,0.2,0.3" for k in range(200))]
    rows[row - 1] = line
    path = tmp_path / "log.csv"
    path.write_text("\n".join(rows) + "\n")
    refused(read_recording, path, says=f"row {row}: a quotation mark is not closed")


def test_quotation_marks_that_are_closed_are_none(tmp_path):
    path = tmp_path / "log.csv"
    names = ",".join(f'"{name}"' for name in HEAD.strip().split(","))
    rows = [f'"{0.01 * k:.2f}",0.1,0.2,0.3' for k in range(200)]
    path.write_text("\n".join([names, *rows]) + "\n")
    assert len(read_recording(path).time) == 200


def test_absurd_numbers_count_as_missing(tmp_path):
    (tmp_path / "log.csv").write_text(HEAD + "0,1,2,3\n1,1e308,-1e300,3\n2,1,2,3\n")
    found = read_recording(tmp_path / "log.csv")
    assert np.isnan(found.gyro[1]).tolist() == [True, True, False]
    (tmp_path / "log.csv").write_text(HEAD + "0,1,2,3\n1e308,1,2,3\n2,1,2,3\n")
    refused(read_recording, tmp_path / "log.csv", says="row 3: the time is missing")


@pytest.mark.parametrize(
    "unit, step, asked",
    [("s", 10_000_000, "are they in ns, at 100 Hz?"), ("ns", 0.01, "are they in s, at 100 Hz?")],
)
def test_a_rate_that_no_sensor_has_is_asked_about(unit, step, asked, tmp_path):
    rows = "".join(f"{k * step},1,2,{k}\n" for k in range(50))
    (tmp_path / "log.csv").write_text(HEAD.replace("time [s]", f"time [{unit}]") + rows)
    for read in (read_recording, open_log):
        refused(read, tmp_path / "log.csv", says=asked)


def test_the_map_of_such_a_log_has_the_unit_that_the_times_have(tmp_path):
    """Stamps in ns under ``time [s]``, and that gyro under a unit that is none."""
    log, made = tmp_path / "log.csv", tmp_path / "map.toml"
    rows = "".join(f"{17 * 10**17 + k * 10**7},1,2,{k}\n" for k in range(50))
    log.write_text(HEAD + rows)
    found = inspect(log)
    assert "are they in ns, at 100 Hz?" in found.problem and found.kind == "guessed"
    assert f"pyimu inspect {log} --columns {made}" in found.report(made)
    assert inspect(log, found.write_map(made)).recording.sample_rate == pytest.approx(100.0)
    log.write_text(HEAD.replace("rad/s", "furlong/s") + rows)
    assert inspect(log).proposals[0].open_questions == ["gyro"]


# MAT files

ITEMS = {
    "t": np.arange(60.0),
    "gyro": np.zeros((60, 3)),
    "note": "abc",
    "cells": np.array([1, "a", np.ones(3)], dtype=object),
    "s": {"x": 1.5, "deep": {"w": np.arange(3, dtype="int8")}},
    "empty": np.zeros((0, 3)),
    "flags": np.array([True, False]),
    "both": np.array([1 + 2j, 3]),
}


@pytest.mark.filterwarnings("ignore:Casting complex values")
@pytest.mark.parametrize("packed", [False, True])
def test_tags_of_good_files_are_good(packed, tmp_path):
    from scipy.sparse import csc_matrix

    items = ITEMS | {"thin": csc_matrix(np.eye(4))}
    savemat(tmp_path / "log.mat", items, do_compression=packed)
    found = MatReader.open(tmp_path / "log.mat")
    assert {"t", "gyro[0]", "s/deep/w"} <= set(found.header)
    savemat(tmp_path / "old.mat", {"t": np.arange(9.0), "note": "abc"}, format="4")
    assert MatReader.open(tmp_path / "old.mat").header == ["t"]


def damaged_mat(path, find, put, packed):
    """A file in which the first tag ``find`` of an array's inside is another."""
    savemat(path, {"gyro": np.arange(9.0).reshape(3, 3)}, do_compression=packed)
    data = path.read_bytes()
    if packed:
        inside = zlib.decompress(data[136:])
        inside = zlib.compress(inside.replace(find, put, 1))
        data = data[:128] + struct.pack("<II", 15, len(inside)) + inside
    else:
        data = data[:128] + data[128:].replace(find, put, 1)
    path.write_bytes(data)
    return path


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize(
    "find, put",
    [
        (struct.pack("<II", 6, 8), struct.pack("<II", 6, 4)),  # one flag
        (struct.pack("<II", 5, 8), struct.pack("<II", 5, 2**31 - 1)),  # dimensions without end
        (struct.pack("<ii", 3, 3), struct.pack("<ii", 3, 2**30)),  # more numbers than there are
        (struct.pack("<ii", 3, 3), struct.pack("<ii", -3, 3)),
        (struct.pack("<II", 9, 72), struct.pack("<II", 99, 72)),  # numbers of no type
        (struct.pack("<II", 9, 72), struct.pack("<II", 9, 80)),
        (struct.pack("<B", 6) + bytes(7), struct.pack("<B", 1) + bytes(7)),  # doubles as cells
    ],
)
def test_damaged_tags_of_mat_files(find, put, packed, tmp_path):
    path = damaged_mat(tmp_path / "log.mat", find, put, packed)
    refused(read_recording, path, says="cannot be read as MAT")


@pytest.mark.parametrize("most, read", [(9 * 8, True), (9 * 8 - 1, False)])
def test_numbers_that_take_too_much_memory(most, read, tmp_path, monkeypatch):
    """A double array that is stored in bytes takes eight times as much."""
    monkeypatch.setattr(mat_tags, "MOST", most)
    path = tmp_path / "log.mat"
    doubles = struct.pack("<II", 9, 72) + np.arange(9.0).tobytes()
    savemat(path, {"gyro": np.arange(9.0)})
    small = struct.pack("<II", 2, 9) + bytes(range(9)) + bytes(7)
    data = path.read_bytes().replace(doubles, small)
    data = bytearray(data)
    data[132:136] = struct.pack("<I", len(data) - 136)
    path.write_bytes(data)
    if read:
        assert MatReader.open(path).arrays["gyro"].nbytes == 72
    else:
        refused(read_recording, path, says="save it with -v7.3")


def test_rows_that_were_never_written_are_not_waited_for(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "log.h5", "w") as file:
        for name in ("t", "w"):
            file.create_dataset(name, shape=(10**11,), chunks=(2**20,), dtype="f8")
    refused(read_recording, tmp_path / "log.h5", says="were they never written")


# Part files


PART = 'name = "p"\nsample_rate = {value = 100.0, unit = "Hz"}\n'


@pytest.mark.parametrize(
    "text, says",
    [
        (PART.replace('"Hz"', '["Hz"]'), "sample_rate.unit"),
        (PART.replace('"Hz"', '"' + "(" * 900 + '"'), "sample_rate.unit"),
        (PART.replace("100.0", "9" * 5000), "cannot be read as TOML"),
        (PART.replace("100.0", "1e9"), "sample rate must be"),
        (PART.replace("100.0", "1e-300"), "sample rate must be"),
        (PART.replace("100.0", "1e308"), "sample rate must be"),
        (PART + "x = " + "[" * 5000 + "]" * 5000, "cannot be read as TOML"),
        (PART + "[gyro.turn_on_bias]\nb0 = " + "[" * 90 + "]" * 90, "gyro.turn_on_bias.b0"),
        (PART.replace('"p"', '"' + "x" * 5000 + '"'), "name: has 5000 characters, may have 200"),
        (PART.replace('"p"', r'"p\u001b[31m"'), "name: 'p\\x1b[31m' has a character that no"),
        (PART + f"[gyro.{'x' * 5000}]", "unknown effect"),
        (PART + f"[gyro.turn_on_bias]\n{'x' * 5000} = 1", "unknown parameter"),
        (PART + "[gyro.turn_on_bias]\nb0 = {value = 1, unit = '" + "x" * 5000 + "'}", "unit"),
        (PART.replace('"p"', '"\\u001b[2J"') + "x = 1", "x: unknown key"),
    ],
)
def test_part_files_that_break_readers(text, says):
    refused(parse_part, text, says=says)


# Fuzzers


@pytest.mark.skipif(not hasattr(os, "fork"), reason="the fuzzers fork")
@pytest.mark.parametrize("name", ["recordings", "part_files", "command_line"])
def test_fuzzers_find_nothing(name, tmp_path):
    """A short run from a seed of its own each time; ``make fuzz`` runs them for long."""
    seed = int.from_bytes(os.urandom(4), "big")
    command = [sys.executable, CHECKOUT / "fuzz" / f"{name}.py", "--seconds", "1.5"]
    done = subprocess.run(
        [*command, "--seed", str(seed), "--keep", tmp_path],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
        env=os.environ | {"PYTHONPATH": str(CHECKOUT)},
    )
    assert done.returncode == 0, f"seed {seed}: {done.stdout[-3000:]}{done.stderr[-2000:]}"
    tried = re.search(rf"^{name}: ([\d,]+) tried: ", done.stdout, re.MULTILINE)
    assert tried and int(tried[1].replace(",", "")) > 0, done.stdout


def test_the_name_of_a_log_has_nothing_that_a_terminal_obeys(tmp_path):
    path = tmp_path / "drive\x1b[31m.csv"
    rows = [
        "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s]",
        "0,1,2,3",
        "1,2,3,4",
        "2,3,4,5",
    ]
    path.write_text("\n".join(rows))
    assert read_recording(path).name == "drive?[31m"
