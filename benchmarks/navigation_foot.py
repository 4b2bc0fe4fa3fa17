"""The path of a sensor on a foot: ``python benchmarks/navigation_foot.py [runs] [first seed]``.

Walks of 180 s with stances of 0.4 s, and a gyro and an accelerometer with noise, biases and scale
factors and misalignments of half a percent that nobody knows. In a stance the foot stands still, or
turns by up to 0.2 rad/s, as feet do that roll over it. Printed are the way, and by where the rests
are from the share of the log that rests and the median and the largest error at the end.
"""

import sys
from pathlib import Path

import numpy as np

from pyimu import Recording
from pyimu.ins import run

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from walks import walk

RUNS, ROLL = 10, 0.2


def logged(own, seed):
    """What the sensors measure of a walk."""
    rng = np.random.default_rng(seed)
    columns = {}
    for name, values, noise, bias in (
        ("gyro", own.rate, 1.4e-3, 9e-3),
        ("accel", own.force, 0.03, 0.03),
    ):
        gain = np.eye(3) + 0.005 * rng.standard_normal((3, 3))
        white = noise * rng.standard_normal(values.shape)
        columns[name] = values @ gain.T + bias * rng.standard_normal(3) + white
    return Recording.from_arrays(time=own.time, **columns)


def heading(own):
    """rad; of the first step."""
    first = own.place[np.argmax(np.linalg.norm(own.place[:, :2], axis=1) > 0.5)]
    return float(np.arctan2(first[1], first[0]))


def main(runs, first):
    for roll in (0.0, ROLL):
        walks = [walk(seed, seconds=180.0, roll=roll) for seed in range(first, first + runs)]
        way = np.median(
            [np.linalg.norm(np.diff(w.place[::20], axis=0), axis=1).sum() for w in walks]
        )
        print(f"{runs} walks of {way:.0f} m, {roll:g} rad/s in a stance  rests  end, m   largest")
        for zupt in ("auto", "live", "foot"):
            ends, shares = [], []
            for seed, own in enumerate(walks, first):
                log = logged(own, seed)
                found = run(log, method="filter", zupt=zupt, heading0=heading(own))
                off = found.tracks["filter"].position[-1] - own.place[-1]
                ends.append(float(np.linalg.norm(off[:2])))
                shares.append(found.still.mean())
            print(f"{zupt:38} {np.mean(shares):10.0%} {np.median(ends):7.2f} {max(ends):9.2f}")


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
