"""How far off the position is, by method and part: ``python benchmarks/navigation.py [runs] [first
seed]``.

A robot drives along a square of 2 m at 0.3 m/s, turns on the spot at 45 deg/s, and stops 3 s before
and after each turn, 73 s at 100 Hz; its motors shake it by 0.3 m/s^2, its sensor lies askew by a
degree. Each run is another specimen of ``examples/sparkfun6dof_assumed.toml`` and other noise. The
filter knows the part and its tolerances ("uncalibrated") or the specimen ("calibrated"). Then the
same with ``sparkfun6dof_v2``, whose figures are those of data sheets, with a tactical part, and the
time of a step beside the attitude filter's, in a C loop and in the unit that takes blocks. With 0
runs only the times.
"""

import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from statistics import median

import numpy as np

import pyimu
from pyimu.attitude import attitude_ukf
from pyimu.fmu import build_fmus, simulate_blocks
from pyimu.ins import run, strapdown_ins, strapdown_wongwirat
from pyimu.ins.filter.ins_block import ins_of_log
from pyimu.ins.filter.layout import Layout
from pyimu.ins.track import Track, error_of, reference_of
from pyimu.rover.trajectory import square

PART = Path(__file__).parents[1] / "examples" / "sparkfun6dof_assumed.toml"
MORE = {"vibration": 0.3, "tilt": (0.0175, 0.01)}
RUNS = 30


def by_paper(log, nulls=None):
    """The error of the paper's method, with the start attitude level."""
    path = strapdown_wongwirat(log, nulls=nulls)
    track = Track("paper", log.time, path.q, path.velocity, path.position)
    return error_of(track, reference_of(log))


def line(name, errors, found=()):
    ends, rms = [e.end for e in errors], [e.rms for e in errors]
    text = f"{name:34} {median(ends):9.3g} {np.quantile(ends, 0.95):9.3g} {median(rms):9.3g}"
    yaws = np.degrees([e.yaw for e in errors])
    if np.isfinite(yaws).all():
        text += f" {np.sqrt(np.mean(yaws**2)):8.2f}"
    if found:
        first = np.concatenate([r.first_zupts for r in found])
        zaru = np.mean([r.mean_nis("zaru_nis") for r in found])
        text += f" {first.mean():6.2f} {zaru:6.2f} {np.mean([nees(r) for r in found]):6.2f}"
    print(text, flush=True)


def nees(r):
    """Of the last position in the plane, by the filter; 2 is right."""
    track, e = r.filter.track("filter"), r.errors[next(iter(r.errors))].east_north[-1]
    std, c = track.position_std[-1], track.correlation[-1]
    both = c * std[0] * std[1]
    return e @ np.linalg.solve([[std[0] ** 2, both], [both, std[1] ** 2]], e)


def filtered(name, logs, parts, **how):
    method = how.pop("method", "filter")
    found = [run(log, p, method=method, **how) for log, p in zip(logs, parts, strict=True)]
    line(name, [r.errors[method] for r in found], () if method == "strapdown" else found)


def main(runs: int, first: int) -> None:
    if runs:
        errors(range(first, first + runs))
    speed()


def errors(seeds: range) -> None:
    part, truth = pyimu.part(PART), square(**MORE)
    ins_of_log(Layout(part)).run(np.tile(ins_of_log(Layout(part)).start_inputs, (60_000, 1)))
    runs = len(seeds)
    specimens = [part.specimen(seed) for seed in seeds]
    logs = [s.simulate(truth, seed=seed) for seed, s in zip(seeds, specimens, strict=True)]
    print(f"{runs} runs{'':28}   end, m      95 %  RMS path  yaw deg   NIS   ZARU   NEES")
    print(f"{'':34}   median                median      RMS  3 is right    2 is right")
    line("paper, nothing compensated", [by_paper(log) for log in logs])
    line("paper, nulls of the rest", [by_paper(log, nulls=9.0) for log in logs])
    filtered("strapdown, nulls, calibrated", logs, specimens, method="strapdown")
    all_parts = [part] * runs
    filtered("filter, uncalibrated", logs, all_parts)
    filtered("filter, uncalibrated, NHC", logs, all_parts, nhc=True)
    filtered("filter, calibrated", logs, specimens)
    filtered("filter, calibrated, NHC", logs, specimens, nhc=True)
    filtered("smoother, calibrated, NHC", logs, specimens, nhc=True, method="smoother")
    by_data_sheets(truth, seeds)
    tactical(seeds)


def by_data_sheets(truth, seeds):
    part = pyimu.part("sparkfun6dof_v2")
    specimens = [part.specimen(seed) for seed in seeds]
    logs = [s.simulate(truth, seed=seed) for seed, s in zip(seeds, specimens, strict=True)]
    all_parts = [part] * len(seeds)
    filtered("sparkfun6dof_v2, uncalibrated", logs, all_parts)
    filtered("sparkfun6dof_v2, uncalibrated, NHC", logs, all_parts, nhc=True)
    filtered("sparkfun6dof_v2, its own detector", logs, all_parts, zupt="live")
    filtered("sparkfun6dof_v2, calibrated, NHC", logs, specimens, nhc=True)


def tactical(seeds):
    """The STIM300 by its data sheet, with its own noise alone."""
    part = pyimu.part("stim300")
    rate = 100.0
    slow = replace(part, sample_rate=rate, tolerances=())
    truth = square(sample_rate=rate, **MORE)
    logs = [slow.simulate(truth, seed=seed) for seed in seeds[:12]]
    filtered("filter, stim300 at 100 Hz", logs, [slow] * len(logs))


def speed():
    """Microseconds of processor time of a step, in motion and at rest, and an hour at 100 Hz of
    which half is rest, beside the attitude filter's.
    """
    part, n = pyimu.part("imt30"), 200_000
    blocks = {
        "15 states": ins_of_log(Layout(part)),
        "22 states, its own rests": strapdown_ins(part),
        "attitude filter": attitude_ukf(part),
    }
    for name, block in blocks.items():
        u = np.tile(block.start_inputs, (n, 1))
        block.run(u)
        times = []
        for still in (0.0, 1.0):
            names = [v.name for v in block.inputs]
            u[:, names.index("stationary")] = still
            # a steady turn in motion, so that no detector calls it a rest
            u[:, names.index("gyro[3]")] = 0.0 if still else 0.5
            rounds = []
            for _ in range(5):
                begin = time.process_time()
                block.run(u)
                rounds.append(time.process_time() - begin)
            times.append(1e6 * median(rounds) / n)
        hour = 360_000e-6 * sum(times) / 2
        print(
            f"{name:24} {times[0]:6.2f} us a step in motion, {times[1]:6.2f} at rest, "
            f"{hour:.2f} s an hour{of_a_unit(block, u)}"
        )


def of_a_unit(block, u) -> str:
    """How much longer the block form of the unit takes than its own C in a loop."""
    with tempfile.TemporaryDirectory() as folder:
        (path,) = build_fmus(block, folder, ["block"])
        ratios = []
        for _ in range(6):
            times = []
            for run_it in (lambda: simulate_blocks(path, u), lambda: block.run(u)):
                begin = time.process_time()
                run_it()
                times.append(time.process_time() - begin)
            ratios.append(times[0] / times[1])
    return f"; the unit takes {median(ratios[1:]):.2f} of the loop's time"


if __name__ == "__main__":
    main(
        int(sys.argv[1]) if len(sys.argv) > 1 else RUNS,
        int(sys.argv[2]) if len(sys.argv) > 2 else 0,
    )
