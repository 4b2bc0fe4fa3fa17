"""How well is a scale factor known after a known motion: heading fit, rate fit, and whitened?

``python benchmarks/heading.py [--runs N] [--minutes M]`` simulates logs of 5 min at 50 Hz with
turns of 5 to 40 deg/s either way, and prints the RMS error of s in percent of Hong and Park's two
least squares (``self_calibrate``) and of the loop's regression (``fit``), which is to be better
than the rate fit by a factor of 2 and than the heading fit by 10, its bias as a share of its spread
(below 0.2), and how often its 95 % interval holds the truth (93 to 97 %). N and K are in SI, of the
size of a tactical and of a consumer gyro.

``--loop`` prints instead what ``pyimu close`` says of logs of 10 min with errors that least squares
takes for scale factor: a heading whose samples stand at the ends of the periods, an asymmetry of
the scale factor, a temperature that goes up and down, and the paper's own motion (section 3.1) with
a late reference. It is told the gyro's noise and nothing else.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from scipy.ndimage import gaussian_filter1d

from pyimu.heading import fit, self_calibrate
from pyimu.identification.close import close
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
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
    parser.add_argument("--loop", action="store_true", help="what pyimu close says, instead")
    told = parser.parse_args()
    if told.loop:
        by_the_loop()
        return
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


def random_turns(rng: np.random.Generator, count: int) -> np.ndarray:
    """Rate (count,) rad/s of turns of 2 to 6 s with rests of 2 to 8 s between."""
    rate, at = np.zeros(count), round(1 / H)
    while at < count:
        length = round(rng.uniform(2, 6) / H)
        rate[at : at + length] = rng.choice([-1, 1]) * rng.uniform(SLOWEST, FASTEST)
        at += length + round(rng.uniform(2, 8) / H)
    return gaussian_filter1d(rate, 0.1 / H)


def one_log(rng: np.random.Generator, seconds: float, n: float, k: float):
    """The scale factor and a log with it."""
    count = round(seconds / H)
    rate = random_turns(rng, count)
    s, bias = 0.03 * rng.standard_normal(), 0.01 * rng.standard_normal()
    walk = k * np.sqrt(H) * np.cumsum(rng.standard_normal(count))
    gyro, true = np.zeros((2, count, 3))
    gyro[:, 2] = (1 + s) * rate + bias + walk + n / np.sqrt(H) * rng.standard_normal(count)
    true[:, 2] = rate
    heading = H * np.cumsum(rate)
    time_ = H * np.arange(count)
    return s, Recording.from_arrays(time=time_, gyro=gyro, ref_rate=true, ref_heading=heading)


# What the loop says


def by_the_loop() -> None:
    cases = {
        "heading at the ends of the periods": (turning, "heading", {}),
        "asymmetry 1 %, by rate": (turning, "rate", {"asymmetry": 0.01}),
        "asymmetry 1 %, by heading": (turning, "heading", {"asymmetry": 0.01}),
        "0.02 deg/s/K on the axis that turns": (turning, "rate", {"thermal": np.radians(0.02)}),
        "0.1 deg/s/K on the axis that turns": (turning, "rate", {"thermal": np.radians(0.1)}),
        "the paper's motion, 12.9 ms late, by rate": (swinging, "rate", {}),
        "the paper's motion, 12.9 ms late, by heading": (swinging, "heading", {}),
    }
    for name, (motion, kind, errors) in cases.items():
        log = loop_log(motion, kind, **errors)
        plain, found = self_calibrate(log), fit(log)
        closed = close(log, its_noise(motion))
        print(f"{name}: true s -10 %, b 0.1 rad/s")
        print(f"  least squares     s {100 * plain.s:.3f} %, b {plain.b0:.4f} rad/s")
        late = "" if found.late is None else f", reference late by {1e3 * found.late:.2f} ms"
        print(f"  whitened          s {100 * found.s:.3f} %, b {found.b0:.4f} rad/s{late}")
        for line in closed.report().splitlines():
            if line.startswith(("verdict", "rate residual", "  added", "  the sensor shows")):
                print(f"  close  {line.strip()[:150]}")
        s = closed.after.gyro.values.get("scale_factor", {}).get("s", np.full(3, np.nan))
        print(f"  close  s {100 * s[2]:.3f} %")


def its_noise(motion) -> Part:
    """A part that has the noise of the gyro in this motion, and nothing else."""
    n, k = motion(H * np.arange(100), np.random.default_rng(0))[-1]
    noise = {"angle_random_walk": {"N": n}, "rate_random_walk": {"K": k}}
    return Part("its noise alone", 1 / H, Sensor("gyro", noise))


def turning(time: np.ndarray, rng: np.random.Generator):
    """Turns either way: the mean rate (n,) of each period, and the heading at its end."""
    rate = random_turns(rng, len(time))
    return rate, rate, H * np.cumsum(rate), (6.2e-4, 2e-5)


def swinging(time: np.ndarray, rng: np.random.Generator):
    """Mean rate (n,) of each period, and rate and heading 12.9 ms late."""
    size, w, late = 4.266, 2 * np.pi / 10, 12.9e-3

    def heading(t: np.ndarray) -> np.ndarray:
        return size * (t + (1 - np.cos(w * t)) / w)

    rate = (heading(time) - heading(time - H)) / H
    shown = (heading(time - late) - heading(time - late - H)) / H
    return rate, shown, heading(time - late), (5e-4 * np.sqrt(H), 0.0)


def loop_log(motion, kind: str, asymmetry: float = 0.0, thermal: float = 0.0) -> Recording:
    """A log of 10 min with s = -10 %, b = 0.1 rad/s; the temperature goes by +-8 K in 240 s."""
    rng, time_ = np.random.default_rng(16), H * np.arange(30_000)
    rate, shown, heading, (n, k) = motion(time_, rng)
    warm = 8.0 * np.sin(2 * np.pi * time_ / 240.0)
    gyro, true = np.zeros((2, len(time_), 3))
    gyro[:, 2] = 0.9 * (rate + asymmetry * np.abs(rate)) + 0.1 + thermal * warm
    gyro += n / np.sqrt(H) * rng.standard_normal(gyro.shape)
    gyro += k * np.sqrt(H) * np.cumsum(rng.standard_normal(gyro.shape), axis=0)
    true[:, 2] = shown
    given = {"ref_rate": true} if kind == "rate" else {"ref_heading": heading}
    more = {"temperature": 25.0 + warm} if thermal else {}
    return Recording.from_arrays("log", time=time_, gyro=gyro, **given, **more)


if __name__ == "__main__":
    main()
