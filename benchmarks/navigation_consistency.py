"""Whether the position filter is honest about itself: ``python benchmarks/navigation_consistency.py
[runs] [FILE] [first seed]``.

The drive of ``benchmarks/navigation.py`` by another specimen and other noise in each of 300 runs.
Printed are, case by case, the error at the end and along the path, the yaw at the end, the mean
normalised innovation squared of the first zero velocity of each stop and of the zero turn rates (3
is right), and that of the error of the position at the end (2 is right), with its 95 % bounds over
the runs; of the vehicle's constraint also by how much it lowers the error of the path. "Calibrated"
is a part of which a calibration took out everything but the turn-on bias, whose tolerance is known.
What a run shows is a line of FILE as soon as it is made, and no case that has one is made again: it
may be stopped at any time, and a case of ``CASES`` that is taken out of FILE is made anew.
"""

import json
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from navigation import MORE, PART, nees
from scipy.stats import chi2

import pyimu
from pyimu.attitude.columns import wandering
from pyimu.block.parameters import with_values
from pyimu.ins import run
from pyimu.rover.trajectory import square

RUNS = 300
BIAS = "turn_on_bias"


@cache
def known(name, calibrated):
    """A part at 100 Hz, and calibrated; where it is silent of its gyro's wander with that which the
    filter then takes.
    """
    part = wandering(replace(pyimu.part(name), sample_rate=100.0))
    kept = tuple(t for t in part.tolerances if t.key[1] == BIAS or not calibrated)
    return replace(part, tolerances=kept)


def logged(part, truth, seed):
    """What a specimen measures, by the unit of its part."""
    unit = part.nominal.block
    u = np.column_stack([truth.ref_rate, truth.ref_force, np.full(len(truth.time), 25.0)])
    p = with_values(unit, part.specimen(seed).start_values)
    y, _ = unit.run(u, p=p, seed=seed, sample_period=part.sample_period)
    return replace(truth, gyro=y[:, :3], accel=y[:, 3:6])


CASES = {
    "assumed part": (PART, False, {}),
    "assumed part, NHC": (PART, False, {"nhc": True}),
    "assumed part, live": (PART, False, {"zupt": "live"}),
    "assumed part, calibrated": (PART, True, {}),
    "assumed part, calibrated, NHC": (PART, True, {"nhc": True}),
    "sparkfun6dof_v2": ("sparkfun6dof_v2", False, {}),
    "sparkfun6dof_v2, NHC": ("sparkfun6dof_v2", False, {"nhc": True}),
    "sparkfun6dof_v2, calibrated": ("sparkfun6dof_v2", True, {}),
    "sparkfun6dof_v2, calibrated, NHC": ("sparkfun6dof_v2", True, {"nhc": True}),
    "stim300": ("stim300", False, {}),
    "stim300, NHC": ("stim300", False, {"nhc": True}),
}


def made(seed, truth, name):
    """The figures of a case for one seed."""
    source, calibrated, how = CASES[name]
    part = known(source, calibrated)
    r = run(logged(part, truth, seed), part, method="filter", **how)
    e = r.errors["filter"]
    return {
        "end": e.end,
        "rms": e.rms,
        "yaw": float(np.degrees(e.yaw)),
        "first": [float(v) for v in r.first_zupts],
        "zaru": r.mean_nis("zaru_nis"),
        "nees": float(nees(r)),
    }


def rows_of(file):
    """The runs that the file has, by seed."""
    rows = {}
    for line in file.read_text().splitlines() if file.exists() else ():
        row = json.loads(line)
        rows.setdefault(row["seed"], {}).update(row)
    return rows


def main(runs, file, first):
    truth, kept = square(**MORE), rows_of(file)
    rows = {seed: kept.get(seed, {"seed": seed}) for seed in range(first, first + runs)}
    for name in CASES:
        # case by case, as each has filters of its own to build
        for seed, row in rows.items():
            if name not in row:
                row[name] = made(seed, truth, name)
                with file.open("a") as out:
                    out.write(json.dumps({"seed": seed, name: row[name]}) + "\n")
    shown(rows)


def shown(rows):
    n = len(rows)
    low, high = chi2.ppf([0.025, 0.975], 2 * n) / n
    print(f"{n} runs; NEES within {low:.2f} to {high:.2f} in 95 % of cases")
    heads = ("end, m", "95 %", "path", "yaw deg", "RMS", "first", "ZARU", "NEES", "less")
    print(f"{'':34}" + "".join(f"{h:>9}" for h in heads))
    for name in CASES:
        found = [row[name] for row in rows.values()]
        end, rms, yaw, over = (
            np.array([f[k] for f in found]) for k in ("end", "rms", "yaw", "nees")
        )
        first = np.concatenate([f["first"] for f in found])
        zaru = np.mean([f["zaru"] for f in found if f["zaru"] is not None])
        figures = [
            *(np.median(end), np.quantile(end, 0.95), np.median(rms)),
            *(np.median(np.abs(yaw)), np.sqrt(np.mean(yaw**2))),
            *(first.mean(), zaru, over.mean()),
        ]
        text = "".join(f"{v:9.3g}" for v in figures)
        if name.endswith(", NHC"):
            free = np.array([row[name.removesuffix(", NHC")]["rms"] for row in rows.values()])
            text += f"{np.median(rms) / np.median(free):9.2f}"
        print(f"{name:34}{text}", flush=True)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else RUNS
    where = Path(sys.argv[2] if len(sys.argv) > 2 else "navigation_consistency.jsonl")
    main(count, where, int(sys.argv[3]) if len(sys.argv) > 3 else 0)
