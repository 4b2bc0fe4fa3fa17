"""How well is a scale factor known after a known motion: heading fit, rate fit, and whitened?

``python benchmarks/heading.py [--runs N] [--minutes M]`` simulates logs of 5 min at 50 Hz with
turns of 5 to 40 deg/s either way, and prints the RMS error of s in percent of Hong and Park's two
least squares (``self_calibrate``) and of the loop's regression (``fit``), which is to be better
than the rate fit by a factor of 2 and than the heading fit by 10, its bias as a share of its spread
(below 0.2), and how often its 95 % interval holds the truth (93 to 97 %). N and K are in SI, of the
size of a tactical and of a consumer gyro.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from scipy.ndimage import gaussian_filter1d

from pyimu.heading import fit, self_calibrate
from pyimu.recording.recording import Recording

H = 0.02
CASES = ((6.2e-4, 2e-5), (6.2e-4, 1e-4), (3.7e-3, 1e-4))
"""N rad/sqrt(s) and K rad/s/sqrt(s)."""

SLOWEST, FASTEST = np.radians([5.0, 40.0])
WAYS = ("heading fit", "rate fit", "whitened")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=300)
    parser.add_argument("--minutes", type=float, default=5.0)
    told = parser.parse_args()
    print(f"RMS error of s in percent, {told.runs} logs of {told.minutes:g} min at {1 / H:g} Hz")
    head = [*WAYS, "rate/whitened", "heading/whitened", "bias/spread", "coverage", "rate bias"]
    print(f"{'N':>8}{'K':>8}" + "".join(f"{name:>18}" for name in head) + "      s")
    for n, k in CASES:
        start = time.perf_counter()
        errors, inside = runs(told.runs, 60.0 * told.minutes, n, k)
        rms = np.sqrt(np.mean(errors**2, axis=0))
        cells = [*(f"{100 * v:.4f}" for v in rms), f"{rms[1] / rms[2]:.2f}"]
        cells += [f"{rms[0] / rms[2]:.1f}", f"{_share(errors[:, 2]):.3f}", f"{100 * inside:.1f} %"]
        cells += [f"{100 * errors[:, 1].mean():+.3f} %"]
        took = (time.perf_counter() - start) / told.runs
        print(f"{n:8.1e}{k:8.0e}" + "".join(f"{c:>18}" for c in cells) + f"{took:7.2f}")


def _share(errors: np.ndarray) -> float:
    return abs(float(np.mean(errors))) / float(np.std(errors))


def runs(count: int, seconds: float, n: float, k: float) -> tuple[np.ndarray, float]:
    """Errors (count, 3) of s, and how often the whitened fit's 95 % interval holds the truth."""
    errors, inside = [], 0
    for i in range(count):
        rng = np.random.default_rng([i, round(1e6 * n), round(1e6 * k)])
        true, log = one_log(rng, seconds, n, k)
        found = [self_calibrate(log, "heading"), self_calibrate(log, "rate"), fit(log, "heading")]
        errors.append([c.s - true for c in found])
        inside += abs(found[2].s - true) < 1.96 * found[2].s_std
    return np.array(errors), inside / count


def one_log(rng: np.random.Generator, seconds: float, n: float, k: float):
    """The scale factor and a log with it: rests of 2 to 8 s, turns of 2 to 6 s."""
    count, at = round(seconds / H), round(1 / H)
    rate = np.zeros(count)
    while at < count:
        length = round(rng.uniform(2, 6) / H)
        rate[at : at + length] = rng.choice([-1, 1]) * rng.uniform(SLOWEST, FASTEST)
        at += length + round(rng.uniform(2, 8) / H)
    rate = gaussian_filter1d(rate, 0.1 / H)
    s, bias = 0.03 * rng.standard_normal(), 0.01 * rng.standard_normal()
    walk = k * np.sqrt(H) * np.cumsum(rng.standard_normal(count))
    gyro, true = np.zeros((2, count, 3))
    gyro[:, 2] = (1 + s) * rate + bias + walk + n / np.sqrt(H) * rng.standard_normal(count)
    true[:, 2] = rate
    heading = H * np.cumsum(rate)
    time_ = H * np.arange(count)
    return s, Recording.from_arrays(time=time_, gyro=gyro, ref_rate=true, ref_heading=heading)


if __name__ == "__main__":
    main()
