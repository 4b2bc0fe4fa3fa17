"""What a gyro without numbers, or at its limit, costs the position: ``python
benchmarks/navigation_lost.py [runs] [first seed]``.

The square of ``navigation.py``, whose filter knows the part and its tolerances; between 14 and 16 s
and from 30 s on the robot drives straight. The median of the error at the end, the largest, and
the same of the yaw.
"""

import sys
from dataclasses import replace
from statistics import median

import numpy as np
from navigation import MORE, PART

import pyimu
from pyimu.ins import run
from pyimu.model.sensor import Sensor
from pyimu.rover.trajectory import square

RUNS = 8
LIMIT = np.radians(40.0)
"""rad/s; the robot turns at 45 deg/s."""

CASES = {
    "nothing lost": ([], 0.0, 0.0),
    "x, 3 s": ([0], 30.0, 33.0),
    "z, 0.5 s": ([2], 14.0, 14.5),
    "z, 2 s": ([2], 14.0, 16.0),
    "z, 3 s": ([2], 30.0, 33.0),
    "all, 1 s": ([0, 1, 2], 30.0, 31.0),
    "all, 3 s": ([0, 1, 2], 30.0, 33.0),
}
"""Axes of the gyro that have no numbers, from when to when [s]."""


def main(runs: int, first: int) -> None:
    part, truth = pyimu.part(PART), square(**MORE)
    logs = [part.specimen(s).simulate(truth, seed=s) for s in range(first, first + runs)]
    print(f"{runs} runs{'':10}  end, m      max  yaw, deg      max")
    for name, (axes, start, end) in CASES.items():
        line(name, [without(log, axes, start, end) for log in logs], part)
    clipped = [replace(log, gyro=np.clip(log.gyro, -LIMIT, LIMIT)) for log in logs]
    line("a limit of 40 deg/s", clipped, limited(part))


def without(log, axes, start, end):
    """The log with no numbers of the gyro's ``axes`` from ``start`` to ``end`` s."""
    gyro = log.gyro.copy()
    gyro[np.ix_((log.time >= start) & (log.time < end), axes)] = np.nan
    return replace(log, gyro=gyro)


def limited(part):
    """The part with that limit declared."""
    values = part.gyro.values | {"saturation": {"limit": np.full(3, LIMIT)}}
    return part.with_sensor(Sensor("gyro", values))


def line(name, logs, part):
    errors = [run(log, part, method="filter").errors["filter"] for log in logs]
    ends, yaws = [e.end for e in errors], np.abs(np.degrees([e.yaw for e in errors]))
    largest = f"{max(ends):6.2f}    {median(yaws):6.1f}   {max(yaws):6.1f}"
    print(f"{name:20} {median(ends):6.2f}   {largest}")


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
