"""Time, processor time and peak memory of ``pyimu characterize`` on a log of 14 million rows.

``python benchmarks/characterize_speed.py [rows] [.parquet|.csv]``. The log has six channels and a
temperature, for four hours at 976 Hz, and is made in a temporary folder. The Allan deviation alone,
against allantools, is in ``allan_speed.py``. Peak memory is that of the process' own pages (RssAnon
of Linux); the temporary files that hold the samples are mapped, and their pages go back to the
system when it needs them: they are in the second figure.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
from pyarrow import csv, parquet

ROWS, RATE, PIECE = 14_000_000, 976.0, 1_000_000
COLUMNS = [
    "time [s]",
    *(f"{s}_{a} [{u}]" for s, u in (("gyro", "rad/s"), ("accel", "m/s^2")) for a in "xyz"),
    "temperature [degC]",
]
POLL = 0.05


def main(rows: int = ROWS, suffix: str = ".parquet") -> None:
    with tempfile.TemporaryDirectory(
        dir="/var/tmp" if Path("/var/tmp").is_dir() else None
    ) as folder:
        log = write_log(Path(folder), rows, suffix)
        size = rows * len(COLUMNS) * 8
        seconds, own, all_pages = timed(
            [
                sys.executable,
                "-m",
                "pyimu",
                "characterize",
                str(log),
                "--out",
                str(Path(folder) / "out"),
            ]
        )
        print(
            f"{rows} rows of {len(COLUMNS)} columns, {log.stat().st_size / 2**20:.0f} MiB as "
            f"{suffix}, {size / 2**20:.0f} MiB as numbers"
        )
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        print(
            f"pyimu characterize: {seconds:.1f} s, {rows / seconds / 1e6:.2f} million rows a "
            f"second; {used.ru_utime + used.ru_stime:.1f} s of processor"
        )
        print(
            f"peak memory: {own / 2**20:.0f} MiB of its own, {own / size:.2f} of the numbers; with "
            f"mapped files {all_pages / 2**20:.0f} MiB"
        )


def write_log(folder: Path, rows: int, suffix: str) -> Path:
    """White noise and a random walk in each channel, the temperature a slow wave."""
    path, rng, last = folder / f"log{suffix}", np.random.default_rng(1), np.zeros(6)
    schema = pa.schema([(name, pa.float64()) for name in COLUMNS])
    with (parquet.ParquetWriter if suffix == ".parquet" else csv.CSVWriter)(path, schema) as writer:
        for first in range(0, rows, PIECE):
            count = min(PIECE, rows - first)
            time_s = (first + np.arange(count)) / RATE
            walk = last + np.cumsum(1e-7 * rng.standard_normal((count, 6)), axis=0)
            last = walk[-1]
            values = (
                walk
                + np.repeat([1e-3, 1e-2], 3) * rng.standard_normal((count, 6))
                + [0, 0, 0, 0, 0, 9.80665]
            )
            columns = [time_s, *values.T, 25 + 5 * np.sin(2 * np.pi * time_s / 7200)]
            writer.write(pa.table(dict(zip(COLUMNS, map(pa.array, columns), strict=True))))
    return path


def timed(command: list[str]) -> tuple[float, int, int]:
    """Seconds, and the largest RssAnon and RSS in bytes while the command ran."""
    started, own, whole = time.perf_counter(), 0, 0
    run = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    while run.poll() is None:
        fields = status(run.pid)
        own, whole = max(own, fields.get("RssAnon", 0)), max(whole, fields.get("VmHWM", 0))
        time.sleep(POLL)
    if run.returncode:
        sys.exit(f"pyimu characterize ended with {run.returncode}")
    return time.perf_counter() - started, own, whole


def status(pid: int) -> dict[str, int]:
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:
        return {}
    pairs = (line.split(":", 1) for line in lines if ":" in line)
    return {k: 1024 * int(v.split()[0]) for k, v in pairs if v.strip().endswith("kB")}


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:2]), *sys.argv[2:3])
