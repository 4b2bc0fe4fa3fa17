"""How good is the attitude of a log that begins in motion?

``python benchmarks/attitude_starts.py [--runs N] [--only TEXT] [--seed S] [--smooth] [--jobs J]
[--results FILE]`` prints a row for each body of ``drives/starts.py``, none of which ever rests: the
RMS error of inclination in degrees of the package's filter and of vqf (Laidig and Seel 2023, the
peer; left out where it is not installed), over the whole log and from the second minute on, each
without a setting on the same samples; and the mean normalised estimation error squared (NEES) of
tilt over all and later, and of the bias later, 1 where the filter is as good as it says. With
``--smooth`` it is the smoothed attitude, beside vqf's ``offlineVQF``.

Constants were chosen with other bodies than these, which are alike (``pyimu.attitude.underway``).
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from attitude_honesty import SOURCES, VQF, errors, options, peer
from drives.starts import STARTS
from runs.pool import digest, name, run_all

from pyimu.attitude import run
from pyimu.recording.recording import Recording

RESULTS = Path(tempfile.gettempdir()) / "pyimu_attitude_starts.jsonl"
"""Where finished runs are kept, so that a table can go on where it was stopped."""

LATER = 60.0
"""s; from which on the later error counts."""


def main() -> None:
    told = options(__doc__.splitlines()[0], 8, RESULTS).parse_args()
    how = "smoothed" if told.smooth else "filtered"
    keys = [
        (text.replace(" ", "_"), told.seed, i, how)
        for text in STARTS
        if told.only in text
        for i in range(told.runs)
    ]
    found = run_all(one, keys, told.results, "-".join(digest(s) for s in SOURCES), told.jobs)
    print(
        f"{'inclination [deg]':32s}{'all':>8s}{'vqf':>8s}{'later':>8s}{'vqf':>8s}"
        f"{'NEES: all':>12s}{'later':>8s}{'bias':>8s}"
    )
    for text in dict.fromkeys(key[0] for key in keys):
        print(row(text, [found[name(key)] for key in keys if key[0] == text]))


def row(text: str, runs: list[dict]) -> str:
    """A line of the table."""
    size, nees = (np.mean([r[what] for r in runs], axis=0) for what in ("square", "nees"))
    rms = "".join(f"{v:8.2f}" for v in np.degrees(np.sqrt(size)))
    return f"{text.replace('_', ' '):32s}{rms}{nees[0]:12.2f}{nees[1]:8.2f}{nees[2]:8.2f}"


def one(text: str, seed: int, index: int, how: str) -> dict:
    """Mean squares of the error of inclination in rad^2 of the filter and of vqf, over all and
    later, and the NEES of tilt over all and later, and of the bias.
    """
    kind = text.replace("_", " ")
    log = STARTS[kind](np.random.default_rng([seed, index, list(STARTS).index(kind)]))
    smooth, every = how == "smoothed", np.ones(len(log.time), dtype=bool)
    later = log.time >= log.time[0] + LATER
    recording = Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel)
    ours = run(recording, smooth=smooth)
    off = errors(ours.q, log, every, headed=True)[0] ** 2
    other = np.full(len(off), np.nan)
    if VQF is not None:
        q = peer(np.ascontiguousarray(log.gyro), log, recording.sample_period, smooth)
        other = errors(q, log, every, headed=True)[0] ** 2
    tilt = off / (2 * ours.tilt_std**2)
    bias = ((ours.gyro_bias - log.bias) / ours.std[:, 3:])[later] ** 2
    values = (off, other, off[later], other[later])
    return {
        "square": [float(np.mean(v)) for v in values],
        "nees": [float(np.mean(v)) for v in (tilt, tilt[later], bias)],
    }


if __name__ == "__main__":
    main()
