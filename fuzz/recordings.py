"""Damaged recordings of every format, and damaged column maps: a UserError, or a recording.

python fuzz/recordings.py --seconds 60
"""

from __future__ import annotations

import gzip
import random
import sys
import zlib
from pathlib import Path

import harness
import log_files
import raw_logs

from pyimu.errors import UserError
from pyimu.inspection.run import inspect
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


def seeds(folder: Path) -> None:
    """A valid file of each layout and format."""
    log, still = log_files.arrays(ROWS), raw_logs.still(ROWS)
    for kind in ("csv", "csv.gz", "parquet", "mat", "mat73", "hdf5", "mcap", "db3", "bag"):
        place = folder / kind
        place.mkdir()
        path, _ = log_files.written(place, kind, log)
        path.rename(folder / f"{kind.replace('.', '_')}-{path.name}")
    for make in raw_logs.ALONE:
        if make not in (raw_logs.phone, raw_logs.iphone, raw_logs.phyphox):
            path = make(folder, still)
            path.rename(folder / f"{make.__name__}-{path.name}")
    for place in [p for p in folder.iterdir() if p.is_dir()]:
        (place / "map.toml").replace(folder / "map.toml")
    for place in [p for p in folder.iterdir() if p.is_dir()]:
        for path in sorted(place.rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() else path.unlink()
        place.rmdir()


def mutate(seed: Path, folder: Path, rng: random.Random) -> Path:
    """A damaged copy; of a compressed text its text, of a MAT file's arrays what is inside."""
    data = seed.read_bytes()
    path = folder / seed.name
    if seed.name.endswith(".gz") and rng.random() < 0.7:
        path.write_bytes(gzip.compress(_text(gzip.decompress(data), rng), 1))
    elif seed.suffix in (".csv", ".txt", ".log", ".toml", ".dat") and rng.random() < 0.8:
        path.write_bytes(_text(data, rng))
    elif seed.suffix == ".mat" and data[124:128] == b"\x00\x01IM" and rng.random() < 0.6:
        path.write_bytes(_repacked(data, rng))
    else:
        path.write_bytes(harness.mutated(data, rng))
    return path


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
    """What became of the file: read, or refused."""
    said = "read"
    for use in (_read, inspect):
        try:
            use(path)
        except UserError as error:
            said = "refused"
            if "\n" in str(error) or not str(error).isprintable():
                raise AssertionError(f"a message of several lines: {error!r}") from None
    return said


def _read(path: Path) -> None:
    if path.suffix == ".toml":
        log = path.with_name("log.csv")
        log.write_text("t,a\n0,1\n1,1\n2,1\n3,1\n")
        read_recording(log, path)
        return
    read_recording(path)


if __name__ == "__main__":
    harness.main(sys.modules[__name__])
