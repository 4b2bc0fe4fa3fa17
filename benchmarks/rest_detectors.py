"""How well rests are told from motion, by detector: ``python benchmarks/rest_detectors.py [runs]``.

The square drive of ``benchmarks/navigation.py``, other specimens and noise in each run, with the
vibration of a rough floor (0.3 m/s^2), a smooth one (0.03) and none. Windows of 0.3 s that lie
wholly in a rest or in a motion count. Printed is which share of the windows in motion each
statistic takes for rest where it takes one in 100, and one in 1,000, of the windows at rest for
motion: the likelihood ratio of gyro and accelerometer, which ``pyimu navigate`` uses and follows by
a test of the mean rate, the accelerometer's moving variance, the gyro's energy, and the magnitude
of the force.
"""

import sys
from pathlib import Path

import numpy as np

import pyimu
from pyimu.ins.detector import WINDOW, magnitude, ratio, variance
from pyimu.ins.noise import Noise
from pyimu.rover.trajectory import square

PART = Path(__file__).parents[1] / "examples" / "sparkfun6dof_assumed.toml"
SHARES = (0.01, 0.001)


def statistics(log, rows):
    """Each detector's statistic (n,), larger in motion."""
    rest = log.time < 9.0
    noise = Noise(
        log.gyro[rest].std(axis=0),
        log.accel[rest].std(axis=0),
        np.zeros(3),
        log.gyro[rest].mean(axis=0),
    )
    off = (log.gyro - noise.bias) / noise.rate
    gravity = float(np.linalg.norm(log.accel[rest].mean(axis=0)))
    both = ratio(log.gyro, log.accel, noise, rows)
    energy = np.convolve((off**2).sum(axis=1), np.ones(rows), "same")
    return {
        "likelihood ratio": both,
        "ratio and rate's bias": both + energy,
        "variance of the force": sum(variance(c, rows) for c in (log.accel / noise.force).T),
        "energy of the rate": energy,
        "magnitude of the force": magnitude(log.accel, noise, gravity, rows),
    }


def windows(moving, rows):
    """Centres of the windows that lie wholly in a rest, and wholly in a motion."""
    share = np.convolve(moving, np.ones(rows + 1) / (rows + 1), "same")
    inner = slice(rows, len(moving) - rows)
    at = np.arange(len(moving))[inner]
    return at[share[inner] < 1e-9], at[share[inner] > 1 - 1e-9]


def main(runs):
    part = pyimu.part(PART)
    for vibration in (0.3, 0.03, 0.0):
        truth = square(vibration=vibration)
        rows = round(WINDOW * 100)
        rest, motion = windows(truth.moving, rows)
        found = {}
        for seed in range(runs):
            log = part.specimen(seed).simulate(truth, seed=seed)
            for name, values in statistics(log, rows).items():
                pair = found.setdefault(name, ([], []))
                pair[0].append(values[rest])
                pair[1].append(values[motion])
        print(f"vibration {vibration:g} m/s^2: motion taken for rest at false alarms of 1 %, 0.1 %")
        for name, pair in found.items():
            still, moved = (np.concatenate(p) for p in pair)
            missed = [np.mean(moved <= np.quantile(still, 1 - share)) for share in SHARES]
            print(f"  {name:24} {missed[0]:8.2%} {missed[1]:8.2%}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
