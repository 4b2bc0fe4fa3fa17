"""Damaged recordings of every format and layout, folders among them, and damaged column maps: a
UserError, or a recording.

python fuzz/recordings.py --seconds 60
"""

from __future__ import annotations

import gzip
import random
import shutil
import sys
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path

import harness
import log_arrays
import log_files
import log_folders
import log_lines
import log_sheets
import log_tables
import raw_logs
import turned_logs

from pyimu.errors import UserError
from pyimu.inspection.run import inspect
from pyimu.recording.formats.suffix import READERS
from pyimu.recording.log import read_recording

NAME = "recordings"

LOADED = (
    "scipy.io",
    "scipy.signal",
    "h5py",
    "rosbags.highlevel",
    "pyulog.core",
    "pymavlink.DFReader",
)

WORDS = [
    "",
    "1e308",
    "-1e308",
    "nan",
    "inf",
    '"',
    "'",
    ",",
    ";",
    "\t",
    "#",
    "//",
    "\x00",
    "\x1b[2J",
] + [
    "9" * 5000,
    "9223372036854775808",
    "(" * 900,
    "time [s]",
    "gyro_x [deg/s]",
    "[" * 200,
    "é",
    "\ufeff",
    "-",
    "0x10",
    "1_0",
    "\r",
    "23:59:59.999",
    "2024-02-30T24:61:61+99:99",
]

ROWS = 80

TEXTS = (".csv", ".txt", ".log", ".toml", ".dat", ".yaml")

ARRAYS = (*log_arrays.ARRAYS, *log_arrays.JSONS)
GUESSED = tuple(f"{make.__name__}-" for make in ARRAYS if make not in log_arrays.ALONE)
"""How the names of files begin that are read by the map alone that their numbers tell."""

MAPPED = "mapped-"
"""How the names of folders begin that hold a log and its column map."""

FIRST_FILES = ("imu.dat", "ouster_imu.csv", "gyr.csv", "serial.txt", "vn.txt", "log.mat")
FIRST_FILES += ("log.h5", "log.raw")
"""The file in them that is read by it."""

ENDINGS = sorted(READERS)


def seeds(folder: Path) -> None:
    """A valid log of each layout and format: a file, or a folder."""
    log, still = log_files.arrays(ROWS), raw_logs.still(ROWS)
    for kind in ("csv", "csv.gz", "parquet", "mcap", "db3", "bag", "mat", "mat73", "hdf5"):
        _take(folder, kind.replace(".", "_"), lambda place, k=kind: _of_kind(place, k, log))
    _take(folder, "bag_of_ros2", lambda place: _of_kind(place, "folder", log))
    folders = (*log_folders.FILES, *log_folders.FOLDERS, *log_folders.OTHERS)
    tables = (*log_lines.ALONE, *log_tables.ALONE, *log_sheets.ALONE)
    for make in (*raw_logs.ALONE, *folders, *tables):
        _take(folder, make.__name__, lambda place, make=make: make(place, still))
    for make in (*raw_logs.MAPPED, *log_lines.MAPPED, *log_sheets.MAPPED):
        make(_mapped(folder, make.__name__), still)
    for kind in ("mat", "mat73", "hdf5"):
        log_files.written(_mapped(folder, kind), kind, log)
    for make in ARRAYS:
        of_turned = [part[:ROWS] for part in turned_logs.turned()]
        _take(folder, make.__name__, lambda place, make=make: make(place, of_turned))
    (folder / "map.toml").write_text(log_files.MAP)


def _mapped(folder: Path, name: str) -> Path:
    place = folder / f"{MAPPED}{name}"
    place.mkdir()
    return place


def _of_kind(place: Path, kind: str, log: tuple) -> Path:
    return log_files.written(place, kind, log)[0]


def _take(folder: Path, name: str, make: Callable[[Path], Path]) -> None:
    """Put what ``make`` writes, by a name of its own, into ``folder``."""
    with tempfile.TemporaryDirectory() as place:
        made = make(Path(place))
        shutil.move(made, folder / f"{name}-{made.name}")


def mutate(seed: Path, folder: Path, rng: random.Random) -> Path:
    """A damaged copy: a file, under another ending now and then, or a folder with a damaged file,
    or without it.
    """
    path = folder / seed.name
    if not seed.is_dir():
        if rng.random() < 0.02:
            path = path.with_name(path.name.partition(".")[0] + rng.choice(ENDINGS))
        path.write_bytes(_damaged(seed, rng))
        return path
    shutil.rmtree(path, ignore_errors=True)
    files = sorted(p for p in seed.rglob("*") if p.is_file())
    hit, lost = rng.choice(files), rng.random() < 0.03
    path.mkdir()
    for file in files:
        to = path / file.relative_to(seed)
        to.parent.mkdir(parents=True, exist_ok=True)
        if file != hit:
            to.write_bytes(file.read_bytes())
        elif not lost:
            to.write_bytes(_damaged(file, rng))
    return path


def _damaged(file: Path, rng: random.Random) -> bytes:
    """Its bytes, of a compressed text its text, of a MAT file's arrays what is inside."""
    data = file.read_bytes()
    if file.suffix == ".gz" and rng.random() < 0.7:
        return gzip.compress(_text(gzip.decompress(data), rng), 1)
    if file.suffix in TEXTS and rng.random() < 0.8:
        return _text(data, rng)
    if file.suffix == ".mat" and data[124:128] == b"\x00\x01IM" and rng.random() < 0.6:
        return _repacked(data, rng)
    return harness.mutated(data, rng)


def _text(data: bytes, rng: random.Random) -> bytes:
    return harness.mutated_text(data.decode(), rng, WORDS).encode()


def _repacked(data: bytes, rng: random.Random) -> bytes:
    """A MAT file with faults inside of its compressed arrays."""
    out, at = bytearray(data[:128]), 128
    while at + 8 <= len(data):
        kind, size = (int.from_bytes(data[at + k : at + k + 4], "little") for k in (0, 4))
        body = data[at + 8 : at + 8 + size]
        if kind == 15 and rng.random() < 0.5:
            body = zlib.compress(harness.mutated(zlib.decompress(body), rng))
        out += kind.to_bytes(4, "little") + len(body).to_bytes(4, "little") + body
        at += 8 + size
    return bytes(out)


def try_one(path: Path) -> str:
    """What became of the log: read, or refused."""
    said = "read"
    for use in (read_recording, inspect):
        try:
            use(*_given(path))
        except UserError as error:
            said = "refused"
            if "\n" in str(error) or not str(error).isprintable():
                raise AssertionError(f"a message of several lines: {error!r}") from None
    return said


def _given(path: Path) -> tuple[Path, Path | None]:
    """What is read, and its column map."""
    if path.suffix == ".toml":
        log = path.with_name("log.csv")
        log.write_text("t,a\n0,1\n1,1\n2,1\n3,1\n")
        return log, path
    if path.name.startswith(MAPPED):
        first = next((path / name for name in FIRST_FILES if (path / name).exists()), path)
        return first, path / raw_logs.MAP
    return path, None


if __name__ == "__main__":
    harness.main(sys.modules[__name__])
