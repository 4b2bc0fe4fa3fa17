"""Hong and Park 2008 again: the calibration of their evaluation, and the table of their experiment.

    python examples/hong2008_heading.py            300 simulated runs, some minutes
    python examples/hong2008_heading.py --runs 30

S. K. Hong, S. Park, "Minimal-Drift Heading Measurement using a MEMS Gyro for Indoor Mobile Robots",
Sensors 8 (2008), 7287-7299. It prints

1. the evaluation (s = -10 %, b = 0.1 rad/s): the errors of the heading fit, 4.8 % and 20.26 %, are
   those of a reference that is late by some milliseconds, and go when that is estimated;
2. the heading errors of the experiment beside those of simulated runs, with the assumptions;
3. what the threshold costs where the robot steers slowly;
4. the same runs with a real reference in place of a motion that is repeated and slips.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from scipy.stats import f

from pyimu.errors import UserError
from pyimu.heading import fit, self_calibrate
from pyimu.heading.statistics import Statistics, nees_bounds, paired
from pyimu.recording.recording import Recording
from pyimu.rover.indoor_runs import Assumptions, Errors, errors

S, B = -0.10, 0.1
"""The scale factor error and the bias [rad/s] of the evaluation (section 3.1)."""

PUBLISHED = (4.80, -20.26)
"""Percent by which the paper's heading fit is off in s (-9.52 %) and in b (0.08 rad/s)."""

TABLE = {
    "integrate": (1.6675, 1.5075),
    "self-calibration": (1.1511, 1.1675),
    "threshold": (0.7768, 1.2653),
    "paper": (0.5985, 1.2998),
}
"""Mean and standard deviation of the heading error of the experiment; degrees, by their size."""

RATE, DURATION = 1000.0, 10.0
"""Hz and s of the evaluation's motion."""

PROFILES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "1 + sin(2 pi t/10 s)": lambda x: x - (np.cos(2 * np.pi * x) - 1) / (2 * np.pi),
    "1 + cos(2 pi t/10 s)": lambda x: x + np.sin(2 * np.pi * x) / (2 * np.pi),
    "sin(2 pi t/10 s)": lambda x: (1 - np.cos(2 * np.pi * x)) / (2 * np.pi),
    "1 + cos(pi t/10 s)": lambda x: x + np.sin(np.pi * x) / np.pi,
    "1 + sin(4 pi t/10 s)": lambda x: x - (np.cos(4 * np.pi * x) - 1) / (4 * np.pi),
}
"""Profiles of a rate, as its integral over time in units of the duration."""

PAPERS_OWN = "1 + sin(2 pi t/10 s)"
"""The profile whose size and lateness are given, 4.266 rad/s and 12.9 ms; those of the others are
solved for."""

SLOW = np.radians(0.3)
"""rad/s RMS of slow steering."""

FEWER = 2
"""The runs with slow steering are so many times fewer."""


# 1. The evaluation


def known_motion(turned: Callable, size: float, late: float, kind: str) -> Recording:
    """The evaluation's motion as a log, of rates of ``size`` rad/s, with a reference of ``kind``
    that is ``late`` by so many s; the heading begins at zero.
    """
    time = np.arange(round(DURATION * RATE) + 1) / RATE

    def heading(t: np.ndarray) -> np.ndarray:
        return size * DURATION * turned(t / DURATION)

    rate = np.diff(heading(time), prepend=heading(-1 / RATE)) * RATE
    gyro, true = np.zeros((2, len(time), 3))
    gyro[:, 2], true[:, 2] = (1 + S) * rate + B, rate
    shown = heading(time - late)
    shown[0] = 0.0
    given = {"ref_heading": shown} if kind == "heading" else {"ref_rate": true}
    return Recording.from_arrays("evaluation", time=time, gyro=gyro, **given)


def off(found) -> np.ndarray:
    """Percent by which a calibration is off in s and in b."""
    return 100.0 * np.array([(found.s - S) / abs(S), (found.b0 - B) / B])


def lateness(turned: Callable) -> tuple[float, float]:
    """Size [rad/s] and lateness [s] with which the heading fit has the published errors.

    A heading that is late by d lacks d times the rate, nearly: of that, s takes a share that does
    not depend on the size, and b one that grows with it.
    """
    size, late = 4.0, 0.01
    for _ in range(20):
        found = off(self_calibrate(known_motion(turned, size, late, "heading")))
        ratio = np.array(PUBLISHED) / found
        late, size = late * ratio[0], size * ratio[1] / ratio[0]
        if np.max(np.abs(ratio - 1)) < 1e-6:
            break
    return size, late


def print_evaluation(console: Console) -> None:
    console.print("\n1. Evaluation: s = -10 %, b = 0.1 rad/s, no noise; error of s and of b\n")
    table = Table("rate", "size", "reference late", box=None)
    for head in ("heading fit", "rate fit", "late, found", "with it estimated"):
        table.add_column(head, no_wrap=True)
    for name, turned in PROFILES.items():
        size, late = (4.266, 12.9e-3) if name == PAPERS_OWN else lateness(turned)
        log, by_rate = (known_motion(turned, size, late, kind) for kind in ("heading", "rate"))
        # That the robot began at zero is no sample of the reference.
        found = fit(log.slice(1))
        table.add_row(
            name,
            f"{size:.3f} rad/s",
            f"{1e3 * late:.1f} ms",
            _percent(off(self_calibrate(log))),
            _percent(off(self_calibrate(by_rate))),
            f"{1e3 * found.late:.3f} ms",
            _percent(off(found)),
        )
    console.print(table)
    console.print(
        f"published: {_percent(np.array(PUBLISHED))}, rate fit 0 %. The errors are those of the "
        "reference's timing,\nnot of the method: any profile has them, each with some lateness."
    )


def _percent(values: np.ndarray) -> str:
    return ", ".join(f"{v + 0.0:+.2f} %" for v in np.round(values, 2) + 0.0)


# 2. to 4. The experiment


def print_experiment(console: Console, found: Errors, given: Assumptions) -> None:
    runs = len(found.claimed)
    console.print(
        f"\n2. Experiment: heading error of {runs} simulated runs, published beside [deg]\n"
    )
    table = Table("method", "mean", "published", "std", "published", "RMS", box=None)
    for name, errors_ in found.by_method.items():
        s, paper = Statistics.of(errors_), TABLE.get(name)
        mean, std = (f"{v:.2f}" for v in paper) if paper else ("–", "–")
        table.add_row(
            name,
            _with(s.mean, s.mean_interval),
            mean,
            _with(s.std, s.std_interval),
            std,
            _deg(s.rms),
        )
    console.print(table)
    inside = sum(
        abs(np.degrees(s.mean) - mean) <= np.degrees(s.std) / np.sqrt(10)
        and abs(np.degrees(s.std) - std) <= np.degrees(s.std) / np.sqrt(2 * 9)
        for s, (mean, std) in ((Statistics.of(found[n]), v) for n, v in TABLE.items())
    )
    console.print(
        f"of the four methods {inside} have both figures within one standard error of ten runs"
    )
    console.print(_assumed(given))
    both = paired(found["threshold"], found["paper"])
    console.print(
        f"threshold less both, paired: {_with(both.mean, both.mean_interval)} deg, std "
        f"{_deg(both.std)} deg\npublished spreads: the largest ratio of two variances is "
        f"{_largest_ratio():.2f}, which is no difference below {_runs_for(_ends_ratio())} runs "
        f"(first against last: F = {_ends_ratio():.2f})"
    )


def _assumed(given: Assumptions) -> str:
    d = np.degrees
    return (
        "assumed, as the paper says none of it: 3 min with 20 s of known motion, turns at 30 "
        f"deg/s, 30 % at rest,\nN = {d(given.n):.3g} deg/s/sqrt(Hz), K = {d(given.k):.3g} "
        f"deg/s/sqrt(s), threshold {d(given.threshold):.3g} deg/s; bias {d(given.bias[0]):.4f} +- "
        f"{d(given.bias[1]):.4f} deg/s,\nwarm-up by {d(given.warm_up[0]):.4f} +- "
        f"{d(given.warm_up[1]):.4f} deg/s in {given.warm_up_time:g} s after the calibration, scale "
        f"factor +- {100 * given.scale_factor:.2f} %,\nknown motion off by +- "
        f"{100 * given.slip:.2f} %, heading wandering by {d(given.wander):.3f} deg/s RMS"
    )


def _largest_ratio() -> float:
    spreads = [std for _, std in TABLE.values()]
    return (max(spreads) / min(spreads)) ** 2


def _ends_ratio() -> float:
    return (TABLE["integrate"][1] / TABLE["paper"][1]) ** 2


def _runs_for(ratio: float) -> int:
    """Runs from which on a ratio of variances is significant at 5 %, to one side."""
    return next(n for n in range(3, 10_000) if f.sf(ratio, n - 1, n - 1) < 0.05)


def print_slow(console: Console, usual: Errors, slow: Errors) -> None:
    n = len(slow.claimed)
    console.print(
        f"\n3. Slow steering of 0.3 deg/s RMS while driving, {n} runs: RMS heading error [deg]\n"
    )
    table = Table("method", "usual", "slow steering", "change", box=None)
    for name in usual.by_method:
        before, after = _rms(usual[name][:n]), _rms(slow[name])
        table.add_row(name, _deg(before), _deg(after), f"{100 * (after / before - 1):+.1f} %")
    console.print(table)


def print_real(console: Console, found: Errors, sensed: Errors) -> None:
    runs = len(found.claimed)
    low, high = nees_bounds(runs)
    filter_, paper = _rms(found["filter"]), _rms(found["paper"])
    console.print(
        f"\n4. A real reference in the start-up motion, not one that slips, {runs} runs: RMS\n\n"
        f"filter {_deg(filter_)} deg, {filter_ / paper:.2f} of the paper's method on the same runs "
        f"({_deg(paper)} deg; published {np.hypot(*TABLE['paper']):.2f})\n"
        f"mean NEES of the filter's heading {found.nees:.3f}, 95 % bounds {low:.3f} to {high:.3f}\n"
        f"with rests found by gyro and accelerometer: filter {_deg(_rms(sensed['filter']))} deg, "
        f"NEES {sensed.nees:.3f}, {len(sensed.claimed)} runs"
    )


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _deg(value: float) -> str:
    return f"{np.degrees(value):.2f}"


def _with(value: float, interval: tuple[float, float]) -> str:
    return f"{_deg(value)} ({_deg(interval[0])} to {_deg(interval[1])})"


@contextmanager
def progress() -> Iterator[Callable[..., None]]:
    """A progress bar on a terminal."""
    with Progress(
        TextColumn("{task.description}"),
        BarColumn(bar_width=20),
        TimeElapsedColumn(),
        console=Console(stderr=True),
        transient=True,
        disable=not sys.stderr.isatty(),
    ) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda text, share=0.0: bar.update(task, description=text, completed=share)


def main(
    runs: Annotated[int, typer.Option("--runs", help="Simulated runs of the experiment.")] = 300,
) -> None:
    if runs < 2 * FEWER:
        raise UserError(f"--runs {runs}: a spread needs {2 * FEWER} runs or more")
    console = Console(width=max(Console().width, 120), highlight=False, markup=False)
    print_evaluation(console)
    given = Assumptions()
    with progress() as say:
        usual = errors(runs, given, say=say)
        slow = errors(runs // FEWER, replace(given, wander=SLOW), say=say)
        real = errors(runs, replace(given, slip=0.0), say=say)
        sensed = errors(runs // FEWER, replace(given, slip=0.0), declared=False, say=say)
    print_experiment(console, usual, given)
    print_slow(console, usual, slow)
    print_real(console, real, sensed)


if __name__ == "__main__":
    try:
        typer.run(main)
    except UserError as error:
        sys.exit(f"hong2008_heading: {error}")
