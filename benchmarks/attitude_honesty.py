"""Is the attitude filter honest, and as good as its peers, where attitude filters are bad?

``python benchmarks/attitude_honesty.py [--runs N] [--first I] [--only TEXT] [--seed S] [--jobs J]
[--results FILE]`` prints a row for each case of ``drives/cases.py``: the RMS error of inclination
and heading in degrees of the package's filter, of vqf (Laidig and Seel 2023, the peer; left out
where it is not installed) and of a plain extended Kalman filter that is told the size of the
motion, and the mean normalised estimation error squared (NEES) of tilt, heading and bias, 1 where
the filter is as good as it says. The filter is told the noise of its part and what a case says,
nothing of the motion; of the sensors of ``drives/bodies.py`` it is told nothing either.

NEES is the mean over runs and instants of the squared error over the claimed variance. ``loses``
marks an error above both peers', ``says too little`` a NEES above 1.3 (too sure) and ``too much``
one below 0.8. Of a case whose samples have errors that nobody declared only ``too little`` counts.
What the filter has for constants of a drive's pushes and of the least motion of a hand was chosen
on runs 100 to 109 (``--first 100 --runs 10``) of the cases of hands and vehicles, when a body that
looks still may drive on runs 100 to 129 of the vehicles, and over which times the size of a motion
and its density are estimated with ``--seed`` 11, 5, 902, 903 and 904, by how much and for how long
a speed may be off with ``--seed 85``, which pushes last with ``--seed 90`` of the aircraft and
drones, when an even turn is no rest with ``--seed 92`` of the camera, by how much the bias is
another in motion and when a body sways with ``--seed 95``.

With ``--smooth`` it is the smoothed attitude, each sample by the whole log, and vqf's
``offlineVQF`` is the peer; the extended Kalman filter stays one.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import numpy as np
from drives.cases import CASES, N_ACCEL, Case, K, N
from drives.log import Log
from drives.mekf import mekf
from generators import rotation
from generators.motion import GRAVITY
from runs.pool import digest, name, run_all

import pyimu
from pyimu.attitude import run
from pyimu.recording.recording import Recording

try:
    from vqf import VQF, offlineVQF
except ImportError:
    VQF = None

RESULTS = Path(tempfile.gettempdir()) / "pyimu_attitude_honesty.jsonl"
"""Where finished runs are kept, so that a table can go on where it was stopped."""

LOW, HIGH = 0.8, 1.3
"""Between which a NEES is right."""

SOURCES = [Path(pyimu.__file__).parent / "attitude", Path(__file__).parent / "drives"]
BY_NAME = {c.name: c for c in CASES}
EXACT = {"rate_noise": 0.0, "axes_std": 0.0}
"""Settings for sensors that have no errors but those of their part."""

SEES = {"vqf": "mag", "mekf": "heading"}
"""The column by which a peer knows the heading."""

DEFINED = {"undeclared clip", "an axis sticks", "the same, a gyro that warms up, undeclared"}
"""Cases with errors that nobody declared."""


def options(description: str, runs: int, results: Path) -> argparse.ArgumentParser:
    """Of a table of so many runs a body, finished ones of which are kept in ``results``."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--runs", type=int, default=runs)
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--smooth", action="store_true")
    parser.add_argument("--results", type=Path, default=results, help="file of finished runs")
    return parser


def main() -> None:
    parser = options(__doc__.splitlines()[0], 40, RESULTS)
    parser.add_argument("--first", type=int, default=0, help="number of the first run")
    told = parser.parse_args()
    cases = [c for c in CASES if told.only in c.name]
    how = "smoothed" if told.smooth else "filtered"
    numbers = range(told.first, told.first + told.runs)
    keys = [(c.name.replace(" ", "_"), told.seed, i, how) for c in cases for i in numbers]
    code = "-".join(digest(s) for s in SOURCES)
    found = run_all(one, keys, told.results, code, told.jobs)
    print(
        f"{'':36s}{'inclination [deg]':>24s}{'heading [deg]':>24s}{'NEES':>24s}\n"
        f"{'case':36s}" + f"{'pyimu':>8s}{'vqf':>8s}{'EKF':>8s}" * 2 + "    tilt heading    bias"
    )
    for case in cases:
        print(row(case, [found[name(k)] for k in keys if k[0] == case.name.replace(" ", "_")]))


def row(case: Case, runs: list[dict]) -> str:
    """A line of the table."""
    rms = {
        what: [_rms([r[who][what] for r in runs if who in r]) for who in ("pyimu", "vqf", "mekf")]
        for what in ("tilt", "heading")
    }
    nees = [float(np.mean([r["nees"][k] for r in runs])) for k in ("tilt", "heading", "bias")]
    text = "".join(f"{v:8.3f}" for values in rms.values() for v in values)
    said = [f"{k} loses" for k, v in rms.items() if v[0] > np.nanmin(v[1:])]
    said += ["says too little"] * (max(nees) > HIGH)
    said += ["too much"] * (min(nees) < LOW and case.name not in DEFINED)
    return f"{case.name:36s}{text}{''.join(f'{v:8.2f}' for v in nees)}  {', '.join(said)}"


def _rms(values: list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values)))) if values else np.nan


def one(case_name: str, seed: int, index: int, how: str) -> dict:
    """Errors in degrees and NEES of a run, ``smoothed`` or ``filtered``."""
    case = BY_NAME[case_name.replace("_", " ")]
    log = case.make(np.random.default_rng([seed, index, list(BY_NAME).index(case.name)]))
    at = log.time >= log.time[0] + case.since
    smooth = how == "smoothed"
    ours, gravity = (
        estimated(log, smooth, case.default),
        log.told.get("settings", {}).get("gravity", GRAVITY),
    )
    others = {"mekf": mekf(log, N, K, N_ACCEL, case.pushed, gravity)}
    if VQF is not None:
        gyro = np.where(np.isfinite(log.gyro), log.gyro, 0.0)
        period = float(np.median(np.diff(log.time)))
        others["vqf"] = peer(np.ascontiguousarray(gyro), log, period, smooth)
    tilt, heading = errors(ours.q, log, at, case.headed)
    result = {"pyimu": {"tilt": _deg(tilt), "heading": _deg(heading)}}
    for who, q in others.items():
        off, headed = errors(q, log, at, case.headed and SEES[who] in log.heading)
        result[who] = {"tilt": _deg(off), "heading": _deg(headed)}
    off, headed = errors(ours.q, log, at, True)
    if not case.headed:
        # The first row's yaw is zero by definition; its true one is the frame's.
        headed = _wrapped(headed - _heading_error(ours.q, log)[0])
    bias = (ours.gyro_bias - log.bias)[at]
    result["nees"] = {
        "tilt": float(np.mean(off**2 / (2 * ours.tilt_std[at] ** 2))),
        "heading": float(np.mean(headed**2 / ours.heading_std[at] ** 2)),
        "bias": float(np.mean(bias**2 / ours.std[at, 3:] ** 2)),
    }
    return result


def peer(gyro: np.ndarray, log: Log, period: float, smooth: bool) -> np.ndarray:
    """Attitudes (n, 4) by vqf over a log, with its magnetometer if there is one, offline where they
    are to be smoothed.
    """
    accel, mag = (
        None if v is None else np.ascontiguousarray(v) for v in (log.accel, log.heading.get("mag"))
    )
    if smooth:
        found = offlineVQF(gyro, accel, mag, period)
    else:
        found = VQF(period).updateBatch(gyro, accel, mag)
    return found["quat6D" if mag is None else "quat9D"]


def estimated(log: Log, smooth: bool, default: bool = False):
    """The package's filter over a log, with the part's noise, and where asked its smoother.

    The simulated gyro has no error that grows with the rate, and the filter is told so, but for a
    run by ``default``.
    """
    recording = Recording.from_arrays(time=log.time, gyro=log.gyro, accel=log.accel, **log.heading)
    if default:
        return run(recording, smooth=smooth, **log.told)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.toml"
        path.write_text(
            'name = "simulated"\nsample_rate = {value = 100.0, unit = "Hz"}\n'
            f'[gyro.angle_random_walk]\nN = {{value = {N}, unit = "rad/sqrt(s)"}}\n'
            f'[gyro.rate_random_walk]\nK = {{value = {K}, unit = "rad/s/sqrt(s)"}}\n'
            f'[accel.angle_random_walk]\nN = {{value = {N_ACCEL}, unit = "m/s/sqrt(s)"}}\n'
        )
        told = log.told | {"settings": EXACT | log.told.get("settings", {})}
        return run(recording, path, smooth=smooth, **told)


def errors(q: np.ndarray, log: Log, at: np.ndarray, headed: bool):
    """Error in rad of the inclination and of the heading at the rows ``at``."""
    up = np.tile([0.0, 0.0, 1.0], (len(q), 1))
    a, b = rotation.in_body(q, up), rotation.in_body(log.q, up)
    tilt = 2 * np.arcsin(np.clip(np.linalg.norm(a - b, axis=1) / 2, 0, 1))[at]
    off = _heading_error(q, log)[at]
    return tilt, _wrapped(off if headed else off - off[0])


def _heading_error(q: np.ndarray, log: Log) -> np.ndarray:
    """The turn (n,) about the vertical that is between estimate and truth, rad."""
    left = rotation.to_vector(rotation.product(q, rotation.inverse(log.q)))
    return left[:, 2]


def _wrapped(angle: np.ndarray) -> np.ndarray:
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _deg(angle: np.ndarray) -> float:
    return float(np.degrees(np.sqrt(np.mean(angle**2))))


if __name__ == "__main__":
    main()
