"""Wongwirat 2010 once more: the paper's figures 4 to 9 by its own method, and by the filter.

``python examples/wongwirat2010_square.py [FOLDER]`` simulates a robot that drives along a square
with the paper's unit by its data sheets (``sparkfun6dof_v2``), runs the paper's equations and the
filter over the same log, and writes ``wongwirat2010_square.png``; it takes some 20 s. The paper
has no sample rate, no cut-off, no side, no speed and no reference, so that there is no number to
reproduce but the ends of its axes.
"""

import sys
from dataclasses import replace
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib import pyplot

import pyimu
from pyimu.ins import run, strapdown_wongwirat
from pyimu.ins.strapdown import CUTOFF
from pyimu.plant.low_pass import low_pass
from pyimu.rover.trajectory import square
from pyimu.units import STANDARD_GRAVITY

SEED = 3
NULLS = 9.0  # s of the rest at the start


def simulated():
    """The truth, the log of a specimen, and the part whose tolerances it was drawn from."""
    part = pyimu.part("sparkfun6dof_v2")
    truth = square(vibration=0.3, tilt=(0.0175, 0.01))
    return truth, part.specimen(SEED).simulate(truth, seed=SEED), part


def paths(log):
    """The paper's method in its variants, by name."""
    in_g = replace(log, accel=log.accel / STANDARD_GRAVITY)
    return {
        "as printed": strapdown_wongwirat(log),
        "nulls of the rest": strapdown_wongwirat(log, nulls=NULLS),
        "nulls, g taken for m/s^2": strapdown_wongwirat(in_g, nulls=NULLS, gravity=1.0),
    }


def largest(path):
    """Largest speed m/s, distance and height m."""
    return [
        np.abs(path.velocity[:, :2]).max(),
        np.abs(path.position[:, :2]).max(),
        np.abs(path.position[:, 2]).max(),
    ]


def draw(truth, log, found, by_paper, target):
    """Figures 4 to 9, the paper's method left, the filter right."""
    track = found.tracks["smoother"]
    raw = np.column_stack([log.gyro, log.accel])
    clean, _ = low_pass(log.sample_period, CUTOFF).run(raw)
    t, euler = log.time, np.degrees(np.unwrap(by_paper.euler, axis=0))
    figure, axes = pyplot.subplots(6, 2, figsize=(11, 17), layout="constrained")
    rows = [
        ("Fig. 4: acceleration [m/s$^2$]", t, clean[:, 3:5], raw[:, 3:5]),
        ("Fig. 5: rate [deg/s]", t, np.degrees(clean[:, :3]), np.degrees(raw[:, :3])),
        ("Fig. 6: roll, pitch, yaw [deg]", t, euler, angles(track.q)),
        ("Fig. 7: velocity [m/s]", t, by_paper.velocity, track.velocity),
        ("Fig. 8: position [m]", t, by_paper.position, track.position),
    ]
    for pair, (title, time, left, right) in zip(axes, rows, strict=False):
        for panel, values in zip(pair, (left, right), strict=True):
            panel.plot(time, values, lw=0.9)
            panel.set_ylabel(title)
            panel.grid(alpha=0.3)
    axes[0, 0].set_title(f"Wongwirat 2010, nulls of the rest\nlow-pass of {CUTOFF:g} Hz")
    axes[0, 1].set_title("filter and smoother, same log\nunfiltered samples")
    for panel, place in zip(axes[5], (by_paper.position, track.position), strict=True):
        panel.plot(truth.ref_east, truth.ref_north, color="0.6", lw=4, label="true")
        panel.plot(place[:, 0], place[:, 1], color="C0", lw=1.2, label="estimate")
        panel.set_aspect("equal", adjustable="datalim")
        panel.set_ylabel("Fig. 9: north [m]")
        panel.set_xlabel("east [m]")
        panel.legend()
        panel.grid(alpha=0.3)
    for panel in axes[4]:
        panel.set_xlabel("time [s]")
    figure.savefig(target, dpi=90)


def angles(q):
    """Roll, pitch, yaw (n, 3) in deg without jumps."""
    w, x, y, z = q.T
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - x * z), -1, 1))
    yaw = np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    return np.degrees(np.column_stack([roll, pitch, yaw]))


def main(folder):
    truth, log, part = simulated()
    made = paths(log)
    print(f"{'the paper':26} largest speed m/s   distance m   height m")
    print(f"{'  axes of Figs. 7 and 8':26} {1.0:17.3g} {4.0:12.3g} {1.0:10.3g}")
    for name, path in made.items():
        speed, distance, height = largest(path)
        print(f"  {name:24} {speed:17.3g} {distance:12.3g} {height:10.3g}")
    well = square(vibration=0.3)
    aligned = replace(well, gyro=well.ref_rate, accel=well.ref_force)
    for name, path in paths(aligned).items():
        speed, distance, height = largest(path)
        print(f"  {'perfect, ' + name:33} {speed:10.3g} {distance:12.3g} {height:10.3g}")
    found = run(log, part, method="all")
    print(found.report())
    target = Path(folder) / "wongwirat2010_square.png"
    draw(truth, log, found, made["nulls of the rest"], target)
    print(f"picture: {target}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
