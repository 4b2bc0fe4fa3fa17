"""How the error of the position grows with the time between two stops: ``python
benchmarks/navigation_growth.py [runs] [first seed] [PICTURE]``.

One leg of 1 to 8 m and a turn of the drive of ``benchmarks/navigation.py``, by a part without other
errors than its noise. Beside it the theory: white noise N of the gyro tips the attitude, that tips
gravity, and what position, velocity and tilt come to after T are the integrals of a Wiener process.
The stop tells the velocity and the change of the tilt; of the position's g^2 N^2 T^5/20 per axis
g^2 N^2 T^5/720 is left (the determinants of the covariances of three and of two of them). N has the
gyro's rounding in it. A PICTURE is drawn where one is named.
"""

import sys
from dataclasses import replace
from statistics import median

import matplotlib

matplotlib.use("Agg")

import casadi as ca
import numpy as np
from matplotlib import pyplot
from navigation import MORE, PART, RUNS

import pyimu
from pyimu.attitude.filter.compensation import noise_of
from pyimu.ins import run
from pyimu.ins.filter.prediction import LASTS
from pyimu.rover.trajectory import square
from pyimu.units import STANDARD_GRAVITY

SIDES = (1.0, 2.0, 4.0, 8.0)
MEDIAN = float(np.sqrt(2 * np.log(2)))
"""Of the length of a vector with two normal components of standard deviation 1."""


def theory(part, seconds):
    """Median horizontal error in m after a leg of so many seconds and the stop."""
    noise = noise_of(part.gyro, ca.SX(ca.DM(part.gyro.p)), part.sample_period, LASTS)
    n = np.array(ca.evalf(noise.white))
    return MEDIAN * STANDARD_GRAVITY * n.ravel()[0] * np.sqrt(np.asarray(seconds) ** 5 / 720)


def measured(part, runs, first):
    """Durations s of the legs, and the errors (legs, runs) m at the end."""
    times, errors = [], []
    for side in SIDES:
        truth = square(side, legs=1, **MORE)
        logs = (part.simulate(truth, seed=seed) for seed in range(first, first + runs))
        errors.append([run(log, part, method="filter").errors["filter"].end for log in logs])
        times.append(side / 0.3 + 0.5)
        print(
            f"one leg of {times[-1]:5.1f} s: {median(errors[-1]):8.3g} m, theory "
            f"{theory(part, times[-1]):8.3g} m",
            flush=True,
        )
    power = np.polyfit(np.log(times), np.log(np.median(errors, axis=1)), 1)[0]
    print(f"grows with the {power:.2f}th power of the time (theory: 2.5)")
    return np.array(times), np.array(errors)


def drawn(part, times, errors, target):
    figure, panel = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
    for column in errors.T:
        panel.plot(times, column, ".", color="0.75", ms=4)
    panel.plot(times, np.median(errors, axis=1), "o-", color="C0", label="median of the runs")
    line = np.geomspace(times[0] * 0.8, times[-1] * 1.2, 50)
    panel.plot(line, theory(part, line), "k--", lw=1, label=r"theory, $1.18\,g N \sqrt{T^5/720}$")
    panel.set(xscale="log", yscale="log", xlabel="time between two stops T [s]")
    panel.set_ylabel("horizontal error [m]")
    panel.set_xticks(times, [f"{t:.3g}" for t in times])
    panel.set_xticks([], minor=True)
    panel.grid(alpha=0.3, which="both")
    panel.legend()
    figure.savefig(target, dpi=110)


if __name__ == "__main__":
    noise_alone = replace(pyimu.part(PART), tolerances=())
    runs, first = [int(a) for a in sys.argv[1:3]] + [RUNS, 0][len(sys.argv[1:3]) :]
    found = measured(noise_alone, runs, first)
    if len(sys.argv) > 3:
        drawn(noise_alone, *found, sys.argv[3])
