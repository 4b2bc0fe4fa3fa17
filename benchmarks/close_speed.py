"""Processor time and memory of ``pyimu close`` on logs at 100 Hz, report and FMUs included, beside
what is wanted: ``python benchmarks/close_speed.py [MINUTES ...] [--runs N]``.

The logs are of 20 and of 60 minutes, from a part that nobody declared, whose gyro has an asymmetric
scale factor. Each is run once before it is timed, so that the caches are full, Python's own among
them, which an installed package comes with; one thread is used.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from world import changes, drive, recording

WANTED = {20: (3.0, 0.4), 60: (8.0, 0.6)}
"""By minutes: s of processor time and GB of memory that are wanted."""

RUNS = 3
ONE_THREAD = {n: "1" for n in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("minutes", type=int, nargs="*", default=list(WANTED))
    parser.add_argument("--runs", type=int, default=RUNS)
    given = parser.parse_args(arguments)
    for minutes in given.minutes:
        world = drive(minutes=minutes, rate_hz=100, seed=4)
        change = changes(world, "gyro")["scale_factor_asymmetry"](6e-4)
        log = recording(world, gyro_change=change, seed=9)
        with tempfile.TemporaryDirectory() as folder:
            path = log.write(Path(folder) / "log.csv")
            found = [_run(path, Path(folder) / "out") for _ in range(1 + given.runs)][1:]
        seconds, memory = (median(one) for one in zip(*found, strict=True))
        text = f"{minutes} min, {len(world.time)} rows: {seconds:.1f} s, {memory:.2f} GB"
        if minutes in WANTED:
            text += ", wanted {:g} s, {:g} GB".format(*WANTED[minutes])
        print(f"{text} (median of {given.runs})", flush=True)


def _run(log: Path, out: Path) -> tuple[float, float]:
    """Processor time [s] and largest memory [GB] of the command, in a process of its own."""
    command = [sys.executable, "-m", "pyimu", "close", str(log), "--out", str(out)]
    kept = {"PYTHONPYCACHEPREFIX": str(out.parent / "bytecode"), "PYTHONDONTWRITEBYTECODE": ""}
    environment = os.environ | ONE_THREAD | kept
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, env=environment) as run:
        _, status, used = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode:
        raise subprocess.CalledProcessError(run.returncode, command)
    return used.ru_utime + used.ru_stime, used.ru_maxrss * RSS_UNIT / 1e9


RSS_UNIT = 1 if sys.platform == "darwin" else 1024
"""Bytes in which a process's memory is told (getrusage)."""


if __name__ == "__main__":
    main(sys.argv[1:])
