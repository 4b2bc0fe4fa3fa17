"""The path of a sensor on a foot: ``python benchmarks/navigation_foot.py [runs] [first seed]
[clipped]``.

Walks of 180 s with stances of 0.4 s, and a gyro and an accelerometer with noise, biases and scale
factors and misalignments of half a percent that nobody knows. In a stance the foot stands still, or
turns by up to 0.2 rad/s, as feet do that roll over it. Printed are the way, and by where the rests
are from the share of the log that rests, the median and the largest error at the end, the median of
what is claimed of it (2 std), and the mean square of the error over its variance per axis (1 is
right). ``clipped``: 60 s of a foot that lands at 1 m/s, by sensors that end at some limits;
"calibrated" are logs whose axes were corrected by each other after that.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from pyimu import Recording
from pyimu.ins import run

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from walks import G, walk

RUNS, ROLL = 10, 0.2

STRIKE = 1.0
"""m/s."""

LIMITS = {
    "no limit": (np.inf, np.inf),
    "8 g": (np.inf, 8.0),
    "8 g, calibrated": (np.inf, 8.0),
    "6 g, calibrated": (np.inf, 6.0),
    "4 g": (np.inf, 4.0),
    "250 deg/s": (250.0, np.inf),
    "250 deg/s, 4 g": (250.0, 4.0),
}
"""deg/s and standard gravities at which gyro and accelerometer end."""

CORRECTION = np.eye(3) + 0.01 * np.array([[0.2, -1.1, 0.7], [0.9, -0.4, -0.8], [-0.6, 1.0, 0.5]])
"""What a calibration made of an accelerometer's axes; a hundredth of each is in the others."""


def logged(own, seed, limits=(np.inf, np.inf)):
    """What the sensors measure of a walk, up to their ``limits`` in deg/s and g."""
    rng = np.random.default_rng(seed)
    columns = {}
    for name, values, noise, bias in (
        ("gyro", own.rate, 1.4e-3, 9e-3),
        ("accel", own.force, 0.03, 0.03),
    ):
        gain = np.eye(3) + 0.005 * rng.standard_normal((3, 3))
        white = noise * rng.standard_normal(values.shape)
        columns[name] = values @ gain.T + bias * rng.standard_normal(3) + white
    for name, limit in zip(columns, (np.radians(limits[0]), G * limits[1]), strict=True):
        columns[name] = np.clip(columns[name], -limit, limit)
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
        shown(f"{runs} walks of {way:.0f} m, {roll:g} rad/s in a stance", HEADS)
        for zupt in ("auto", "live", "foot"):
            compared(zupt, walks, first, zupt)


def clipped(runs, first):
    """By sensors that end at limits."""
    walks = [walk(seed, seconds=60.0, strike=STRIKE) for seed in range(first, first + runs)]
    shown(f"{runs} walks that land at {STRIKE:g} m/s", HEADS)
    for name, limits in LIMITS.items():
        compared(name, walks, first, "auto", limits)


HEADS = ("rests", "end, m", "largest", "claimed", "square")


def shown(name, figures):
    text = (f if isinstance(f, str) else f"{f:.3g}" for f in figures)
    print(f"{name:42}" + "".join(f"{t:>9}" for t in text), flush=True)


def compared(name, walks, first, zupt, limits=(np.inf, np.inf)):
    """A line of what is found of the walks."""
    rows = []
    for seed, own in enumerate(walks, first):
        log = logged(own, seed, limits)
        if "calibrated" in name:
            log = replace(log, accel=log.accel @ CORRECTION.T)
        found = run(log, method="filter", zupt=zupt, heading0=heading(own))
        track = found.tracks["filter"]
        off, std = (track.position[-1] - own.place[-1])[:2], track.position_std[-1, :2]
        both = track.correlation[-1] * std[0] * std[1]
        spread = np.array([[std[0] ** 2, both], [both, std[1] ** 2]])
        square = off @ np.linalg.solve(spread, off) / 2
        rows.append((found.still.mean(), np.linalg.norm(off), 2 * np.linalg.norm(std), square))
    rests, ends, claims, squares = np.transpose(rows)
    figures = np.median(ends), ends.max(), np.median(claims), squares.mean()
    shown(name, (f"{rests.mean():.0%}", *figures))


if __name__ == "__main__":
    (clipped if "clipped" in sys.argv else main)(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
