"""Time of ``pyimu close`` on a 20-minute log at 100 Hz, report and FMUs included, as a share of its
15 s: ``python benchmarks/close_speed.py``.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from world import changes, drive, recording

BUDGET = 15.0
RUNS = 3


def main() -> None:
    world = drive(minutes=20, rate_hz=100, seed=4)
    log = recording(
        world, gyro_change=changes(world, "gyro")["scale_factor_asymmetry"](6e-4), seed=9
    )
    with tempfile.TemporaryDirectory() as folder:
        path = log.write(Path(folder) / "log.csv")
        times = [_run(path, Path(folder) / "out") for _ in range(RUNS)]
    print(
        f"{len(world.time)} rows, gyro and accelerometer: {median(times):.1f} s (median of "
        f"{RUNS}), "
        f"{median(times) / BUDGET:.2f} of the budget of {BUDGET:.0f} s"
    )


def _run(log: Path, out: Path) -> float:
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "pyimu.cli", "close", str(log), "--out", str(out)],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
