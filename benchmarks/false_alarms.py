"""How often an effect is blamed on logs with nothing missing.

``python benchmarks/false_alarms.py [logs]``.

Each log has a gyro and an accelerometer, so each has two chances; the gate allows each one in a
hundred.
"""

import argparse
import sys
from pathlib import Path

from scipy.stats import binomtest

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from world import drive, recording

import pyimu


def main(count: int) -> None:
    blamed = refused = 0
    for seed in range(count):
        closed = pyimu.close(recording(drive(minutes=4, rate_hz=25, seed=seed), seed=10_000 + seed))
        blamed += len({a.sensor for a in closed.added})
        refused += len({kind for kind, _ in closed.refused})
    for what, n in (("blamed", blamed), ("past the gate, refused by the held-out data", refused)):
        low, high = binomtest(n, 2 * count).proportion_ci(0.95)
        print(
            f"{what}: {n} of {2 * count} clean sensors, {n / 2 / count:.2%} (95 %: {low:.2%} to "
            f"{high:.2%})"
        )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("logs", type=int, nargs="?", default=200, help="how many (200)")
    main(parser.parse_args().logs)
