"""What is taken for a rest on a smooth floor: ``python benchmarks/navigation_gentle.py [runs]
[first seed]``.

Squares without vibration, each with its own speed of 0.1 to 0.6 m/s, that comes and goes within 0.5
to 4 s and lasts for 0 to 4 s in between, stops of 2 to 5 s, and another specimen of the part of
``benchmarks/navigation.py``. Printed are, of the log's detector and of the unit's own, the median
error at the end and along the path, the largest of these, the mean of the squared error at the end
over its variance (2 is right), and of how many drives more than 0.3 s at above 3 cm/s counts as
rest.
"""

import sys

import numpy as np
from navigation import PART, nees

import pyimu
from pyimu.ins import run
from pyimu.rover.trajectory import square

RUNS = 30
CRAWL, SHORT = 0.03, 0.3
"""m/s and s; less is not counted."""


def driven(seed):
    """The true motion."""
    rng = np.random.default_rng(seed)
    speed, ramp, cruise = rng.uniform(0.1, 0.6), rng.uniform(0.5, 4.0), rng.uniform(0.0, 4.0)
    turn_rate = np.radians(rng.uniform(15.0, 90.0 / ramp if ramp > 1.5 else 60.0))
    stops, tilt = rng.uniform(2.0, 5.0), tuple(0.02 * rng.standard_normal(2))
    return square(speed * (ramp + cruise), speed, turn_rate, stops, ramp=ramp, tilt=tilt)


def main(runs, first):
    part = pyimu.part(PART)
    logs = [part.specimen(s).simulate(driven(s), seed=s) for s in range(first, first + runs)]
    print(f"{runs} drives    end, m  RMS path   largest    NEES   with false rest")
    for zupt in ("auto", "live"):
        found = [run(log, part, method="filter", zupt=zupt) for log in logs]
        errors = [r.errors["filter"] for r in found]
        rms = [e.rms for e in errors]
        false = [
            np.sum(r.still & (np.linalg.norm(r.recording.ref_velocity, axis=1) > CRAWL))
            * r.recording.sample_period
            for r in found
        ]
        wrong = int(np.sum(np.array(false) > SHORT))
        off = np.mean([nees(r) for r in found])
        end = np.median([e.end for e in errors])
        print(f"{zupt:8} {end:11.2f} {np.median(rms):9.2f} {max(rms):9.2f} {off:7.1f} {wrong:8}")


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
