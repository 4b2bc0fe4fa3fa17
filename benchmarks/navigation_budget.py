"""What throws the paper's integration off, one cause at a time: ``python
benchmarks/navigation_budget.py [runs] [first seed]``.

The drive of ``benchmarks/navigation.py`` by the method of Wongwirat 2010 less the nulls of the rest
at the start, with sensors that have one error of ``examples/sparkfun6dof_assumed.toml`` and no
other, another specimen in each run; level but for the row that says otherwise, and shaken. Printed
is the horizontal error at the end, its median and 95 % quantile, and the median error of the yaw.
"""

import sys
from dataclasses import replace
from statistics import median

import numpy as np
from navigation import MORE, PART, RUNS, by_paper

import pyimu
from pyimu.rover.trajectory import square

REST = 9.0
"""s of the rest at the start whose means are the nulls."""

TILT = "tilt of the mounting, 1 and 0.6 deg"
"""The start is taken to be level, so that the nulls take the tilt for an accelerometer's bias, and
the first turn about an upright axis is one about a tilted one."""

CAUSES = {
    "none": {},
    TILT: {},
    "gyro misalignment, 1 deg": {"gyro": ["misalignment"]},
    "gyro noise": {"gyro": ["angle_random_walk"]},
    "gyro noise and rounding": {"gyro": ["angle_random_walk", "quantization"]},
    "gyro random walk": {"gyro": ["rate_random_walk"]},
    "gyro scale factor, 2 %": {"gyro": ["scale_factor"]},
    "gyro g-sensitivity": {"gyro": ["g_sensitivity"]},
    "gyro turn-on bias": {"gyro": ["turn_on_bias"]},
    "accelerometer noise": {"accel": ["angle_random_walk"]},
    "accelerometer scale factor, 2 %": {"accel": ["scale_factor"]},
    "accelerometer turn-on bias": {"accel": ["turn_on_bias"]},
}


def alone(part, kept):
    """The part with the effects ``kept`` by sensor, and no other."""
    for kind in ("gyro", "accel"):
        sensor = part.sensor(kind)
        gone = [name for name in sensor.values if name not in kept.get(kind, ())]
        part = part.with_sensor(sensor.without(*gone))
    return part


def main(runs, first):
    part = pyimu.part(PART)
    print(f"{runs} runs{'':31} end, m      95 %   yaw deg")
    for name, kept in {"every error at once": None, **CAUSES}.items():
        level = {} if kept is None or name == TILT else {"tilt": (0.0, 0.0)}
        truth = square(**MORE | level)
        ends, yaws = [], []
        for seed in range(first, first + (runs if kept != {} else 1)):
            one = part.specimen(seed)
            one = one if kept is None else alone(one, kept)
            error = by_paper(replace(one, sample_rate=100.0).simulate(truth, seed=seed), REST)
            ends.append(error.end)
            yaws.append(abs(np.degrees(error.yaw)))
        print(
            f"{name:36} {median(ends):9.3g} {np.quantile(ends, 0.95):9.3g} {median(yaws):9.3g}",
            flush=True,
        )


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
