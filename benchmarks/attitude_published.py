"""The attitude filter of Hidalgo 2012 as published, beside the package's own.

``python benchmarks/attitude_published.py [--data FOLDER] [--rover] [--broad]``; without either
option, both tables.

The first table is the paper's table 6: the largest errors of pitch, roll and yaw over its test
drives (``pyimu.rover.trajectory``), simulated at 976 Hz with the gyros of its tables 2 and 4 after
a minute at rest, and an accelerometer of which it gives nothing: that of ``pyimu.rover.demo``, with
the shaking of that rover. Each drive is simulated with the scale factor that makes 6.5 deg of 180,
of which the filter does not know, as the paper's did not, and without. The truth here is exact; the
paper's reference was right to 0.1 to 0.2 deg.
With the K of table 4 the yaw of any filter without a heading wanders by K sqrt(t^3/3), 1.9 deg
after the 500 s of the straight line: the paper's 0.35 deg are less than its own K lets expect.

The second is the root mean square of the inclination error over measured recordings (BROAD, Laidig,
Caruso, Cereatti and Seel 2021), hands in motion, for which the paper's filter was not made: as
published, without its low-pass filter, and our own. Nothing was chosen on them for the paper's
filter: what the paper does not give is derived or our own filter's
(``pyimu.attitude.filter.hidalgo2012``).
"""

import sys
from dataclasses import replace
from itertools import product

import numpy as np
from attitude_real import SCORED, folder, inclination, moving_rows
from scipy.spatial.transform import Rotation

import pyimu
from pyimu.attitude import run
from pyimu.attitude.error import root_mean_square
from pyimu.model.part import Part
from pyimu.model.simulate import simulate
from pyimu.recording.recording import Recording
from pyimu.rover.demo import LATITUDE, UNDECLARED, true_part
from pyimu.rover.trajectory import Manoeuvre, Motion, ackermann, drive, stop, straight, turn_on_spot

SAMPLE_RATE = 976.0
"""Hz; Hidalgo 2012, section 2.2."""

SHAKE = 0.03
"""m/s^2; of the driving rover, as in ``pyimu.rover.demo``."""

SEEDS = (1, 2, 3)
"""Of the drives; of their largest errors the mean is shown."""

DRIVES = {
    "straight line": (straight(roughness=0.0), (0.2, 0.1, 0.35)),
    "straight line, boulders": (straight(), (0.2, 0.1, 0.35)),
    "Ackermann steering": (ackermann(), (0.3, 0.3, 1.4)),
    "turn on spot": (turn_on_spot(), (0.2, 0.4, 6.5)),
}
"""Section 6.1's four drives, with pitch, roll and yaw in deg of table 6, which has one column for
both straight lines."""

FILTERS = {"as published": "hidalgo2012", "ours": "ukf"}

WAYS = {
    "ours": "ukf",
    "as published": "hidalgo2012",
    "no low-pass": {"filter": "hidalgo2012", "low_pass": 0.0},
}


def main() -> None:
    both = "--rover" not in sys.argv and "--broad" not in sys.argv
    if both or "--rover" in sys.argv:
        table_6()
    if both or "--broad" in sys.argv:
        recordings()


# Table 6


def table_6() -> None:
    """The largest errors of the four drives, beside the paper's."""
    columns = ["paper, table 6", *(f"{name}{more}" for more in (", s", "") for name in FILTERS)]
    print(
        "largest error of pitch, roll, yaw [deg]; s: with the scale factor that nobody knows of\n"
        f"{'':26s}" + "".join(f"{c:>20s}" for c in columns)
    )
    for name, (manoeuvres, paper) in DRIVES.items():
        cells = [paper, *np.mean([largest(manoeuvres, seed) for seed in SEEDS], axis=0)]
        texts = ["{:.2f} {:.2f} {:.2f}".format(*cell) for cell in cells]
        print(f"{name:26s}" + "".join(f"{text:>20s}" for text in texts), flush=True)


def largest(manoeuvres: list[Manoeuvre], seed: int) -> list[np.ndarray]:
    """The largest errors (3,) in deg of pitch, roll and yaw of each filter in a drive.

    First with the scale factor, then without.
    """
    motion = drive([stop(60.0), *manoeuvres, stop(10.0)], SAMPLE_RATE, LATITUDE, seed)
    true = Rotation.from_quat(motion.q, scalar_first=True).as_euler("ZYX")
    logs = [seen(motion, scale, seed) for scale in (UNDECLARED, np.zeros(3))]
    out = []
    for (log, known), settings in product(logs, FILTERS.values()):
        found = run(log, known, latitude=LATITUDE, heading0=true[0, 0], settings=settings)
        off = found.euler[:, ::-1] - true
        off = (off + np.pi) % (2 * np.pi) - np.pi
        worst = np.degrees(np.abs(off[motion.standing == 0]).max(axis=0))
        out.append(worst[[1, 2, 0]])
    return out


def seen(motion: Motion, scale: np.ndarray, seed: int) -> tuple[Recording, Part]:
    """The drive as the sensors measure it, and what the filter knows of them."""
    known, true = pyimu.part("imt30"), true_part()
    gyro = true.gyro.with_values("scale_factor", s=scale)
    sensors = Part("rover", SAMPLE_RATE, gyro, true.accel)
    rng = np.random.default_rng(seed + 100)
    shake = SHAKE * rng.standard_normal(motion.force.shape) * (motion.standing[:, None] == 0)
    temperature = np.full(len(motion.time), 25.0)
    rate, force = simulate(sensors, motion.rate, motion.force + shake, temperature, seed=seed)
    white = true.accel.values["angle_random_walk"]["N"]
    accel = known.accel.with_values("angle_random_walk", N=white)
    log = Recording.from_arrays(
        name="rover", time=motion.time, gyro=rate, accel=force, temperature=temperature
    )
    return log, replace(known, accel=accel)


# Measured recordings


def recordings() -> None:
    """The inclination errors over measured recordings."""
    paths = [folder() / f"{name}.csv.gz" for name in SCORED]
    if not all(path.exists() for path in paths):
        print(f"\nno recordings in {folder()}: --data FOLDER says where they are")
        return
    print(
        f"\n{'inclination error, RMS [deg]':50s}"
        + "".join(f"{name:>14s}" for name in WAYS)
        + f"{'quasi-static':>14s}"
    )
    sizes = []
    for path in paths:
        log = pyimu.read_recording(path)
        rows = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
        found = [run(log, settings=settings) for settings in WAYS.values()]
        rms = [root_mean_square(inclination(f.q[rows], log.ref_q[rows])) for f in found]
        sizes.append(rms)
        share = np.mean(found[1].quasi_static[rows])
        print(
            f"{path.name.split('.')[0]:50s}"
            + "".join(f"{v:14.3f}" for v in rms)
            + f"{share:14.0%}",
            flush=True,
        )
    print(f"{'mean':50s}" + "".join(f"{v:14.3f}" for v in np.mean(sizes, axis=0)))


if __name__ == "__main__":
    main()
