"""The five static tests of the IMT30 gyros again, simulated and characterised.

    python examples/imt30_static.py        five tests of four hours, 70 million samples
    python examples/imt30_static.py --hours 0.2 --tests 2 --out look

It prints Tables 2, 4 and 5 of Hidalgo 2012 beside what came back. The sensor is the FMU of the part
``imt30`` (the paper's Tables 1, 2 and 4; no flicker) in its block form, at rest and at its
reference temperature; test k has the seed k. One test is in memory at a time. N and K come from a
weighted fit of all five terms to the Allan deviation, so that what is printed has an interval; B
comes from the floor of the deviation, as the paper reads it.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import matplotlib
import numpy as np
import typer
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn
from rich.table import Table
from scipy.stats import t as student

from pyimu import units
from pyimu.characterization.allan import log_clusters, octave_clusters, overlapping_deviation
from pyimu.characterization.allan.readings import Reading, crossing, read_coefficients
from pyimu.characterization.noise.coefficients import (
    Coefficient,
    NoiseFit,
    fit_coefficients,
    mean_coefficient,
)
from pyimu.errors import UserError
from pyimu.files import whole
from pyimu.fmu import build_fmu, stream_blocks
from pyimu.model.part import AXES, Part
from pyimu.model.part_file import part
from pyimu.shaping import flicker_floor, random_walk_deviation, white_deviation

PAPER = {
    "N": ((0.20764, 0.23858, 0.20489), "deg/sqrt(h)", "Table 2, angle random walk"),
    "K": ((32.8, 49.6, 64.2), "deg/h/sqrt(h)", "Table 4, rate random walk"),
    "B": ((3.8, 5.9, 5.3), "deg/h", "Table 5, bias instability"),
}
"""Hidalgo et al., Sensors 12 (2012), 2219-2235: mean values of five tests of gyros x, y, z."""

SI = {"N": "rad/sqrt(s)", "K": "rad/s/sqrt(s)", "B": "rad/s"}
LEVEL = 0.95
CHUNK = 97_600
"""Samples that the FMU is asked for at a time."""

SHORTEST = 60.0
"""Seconds of a test in which there is something to see."""

POINTS = 100
"""Cluster times of the curves that are read and drawn."""

BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#808487"


@dataclass(frozen=True)
class Test:
    """What one static test says: Allan deviations (t, 3) rad/s at cluster times ``tau`` (t,) s.

    Each axis has a fit and a reading.
    """

    tau: np.ndarray
    deviation: np.ndarray
    fits: tuple[NoiseFit, ...]
    readings: tuple[Reading, ...]


def paper(term: str) -> np.ndarray:
    """The paper's coefficients of the three axes (3,), SI."""
    values, unit, _ = PAPER[term]
    return units.convert(values, unit, SI[term])


def static_log(
    fmu: Path, imt30: Part, samples: int, seed: int, made: Callable[[int], None]
) -> np.ndarray:
    """Gyro rates (samples, 3) rad/s of the sensor at rest, from the block form of its FMU.

    ``made`` hears how many samples each chunk has.
    """
    rest = np.tile([v.start for v in imt30.block.inputs], (min(CHUNK, samples), 1))
    chunks = (rest[: min(CHUNK, samples - first)] for first in range(0, samples, CHUNK))
    rates, row = np.empty((samples, 3)), 0
    for answer in stream_blocks(fmu, chunks, start_values={"seed": seed}):
        rates[row : row + len(answer)] = answer[:, :3]
        row += len(answer)
        made(len(answer))
    return rates


def characterise(rates: np.ndarray, h: float) -> Test:
    """Allan deviations, fits and readings of a log (n, 3) of rates every ``h`` s."""
    n = len(rates)
    octaves = octave_clusters(n)
    m = np.union1d(octaves, log_clusters(n, POINTS))
    deviation = overlapping_deviation(rates, m)
    at_octaves = deviation[np.isin(m, octaves)]
    return Test(
        m * h,
        deviation,
        tuple(fit_coefficients(octaves, column, n, h, level=LEVEL) for column in at_octaves.T),
        tuple(read_coefficients(m * h, column) for column in deviation.T),
    )


def simulate_tests(hours: float, count: int) -> Iterator[Test]:
    """The static tests, one after the other, with a progress bar on a terminal."""
    imt30 = part("imt30")
    samples = round(hours * 3600 * imt30.sample_rate)
    with tempfile.TemporaryDirectory() as folder, progress(count * samples) as say:
        say(0, "building the FMU")
        fmu = build_fmu(imt30.block, folder, "block")
        for k in range(1, count + 1):
            # The log has no name here, or the next one would be made beside it.
            yield characterise(
                static_log(fmu, imt30, samples, k, partial(say, now=f"test {k} of {count}")),
                imt30.sample_period,
            )


@contextmanager
def progress(total: int) -> Iterator[Callable[..., None]]:
    """A bar of samples on a terminal, nothing elsewhere.

    It gives the function that is told of samples made and what is being done.
    """
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    with Progress(
        *columns, console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()
    ) as bar:
        task = bar.add_task("", total=total)
        yield lambda made, now: bar.update(task, advance=made, description=now)


# Tables


def fitted_table(term: str, tests: list[Test]) -> Table:
    """Table 2 or 4 of the paper beside mean, interval and spread of the fits.

    The last column is the mean of what is read off the plots.
    """
    values, unit, title = PAPER[term]
    table = Table(title=f"{title}, {term} in {unit}", title_justify="left")
    for heading in (
        "axis",
        "paper",
        f"mean of {len(tests)}",
        "95 % interval",
        "holds paper's",
        "spread of tests",
        "spread by the fits",
        "read by eye",
    ):
        table.add_column(heading, justify="left" if heading == "axis" else "right")
    for axis, value in enumerate(values):
        per_test = [t.fits[axis][term] for t in tests]
        mean, spread = mean_coefficient(per_test, LEVEL)
        predicted = np.sqrt(np.mean([c.std**2 for c in per_test]))
        read = np.mean([getattr(t.readings[axis], term) for t in tests])
        table.add_row(
            AXES[axis],
            f"{value:g}",
            *shown(mean, term),
            says(mean.holds(paper(term)[axis])),
            *(number(x, term) for x in (spread, predicted, read)),
        )
    return table


def floor_table(tests: list[Test]) -> Table:
    """Table 5: the floor over 0.664 as the paper has it.

    Beside it stand the floor that N and K of Tables 2 and 4 make, and that of the simulated plots.
    """
    values, unit, title = PAPER["B"]
    table = Table(
        title=f"{title}, B in {unit}: floor / {flicker_floor(1.0):.3f}", title_justify="left"
    )
    for heading in (
        "axis",
        "paper",
        "crossing of N and K",
        f"read, mean of {len(tests)}",
        "95 % interval",
        "holds paper's",
        "holds the crossing",
        "spread of tests",
        "B of the joint fit",
    ):
        table.add_column(heading, justify="left" if heading == "axis" else "right")
    theory = crossing(paper("N"), paper("K"))
    for axis, value in enumerate(values):
        mean, spread = read_floor([t.readings[axis].B for t in tests])
        joint, _ = mean_coefficient([t.fits[axis]["B"] for t in tests], LEVEL)
        table.add_row(
            AXES[axis],
            f"{value:g}",
            number(theory[axis], "B"),
            *shown(mean, "B"),
            says(mean.holds(paper("B")[axis])),
            says(mean.holds(theory[axis])),
            number(spread, "B"),
            shown(joint, "B")[0],
        )
    return table


def read_floor(values: list[float]) -> tuple[Coefficient, float]:
    """Mean, Student's interval and standard deviation of readings; nan from a single one.

    Only the tests themselves tell the errors of readings.
    """
    count, mean = len(values), float(np.mean(values))
    spread = float(np.std(values, ddof=1)) if count > 1 else np.nan
    half = (
        student.isf((1 - LEVEL) / 2, count - 1) * spread / np.sqrt(count) if count > 1 else np.nan
    )
    return Coefficient(mean, spread / np.sqrt(count), mean - half, mean + half), spread


def shown(c: Coefficient, term: str) -> tuple[str, str]:
    """A coefficient and its interval in the paper's unit, or its bound."""
    if not c.needed:
        return f"< {number(c.high, term)}", "not needed"
    interval = f"{number(c.low, term)} to {number(c.high, term)}" if np.isfinite(c.low) else "-"
    return number(c.value, term), interval


def number(value: float, term: str) -> str:
    """Four digits in the paper's unit; a dash for what there is none of."""
    return f"{units.convert(value, SI[term], PAPER[term][1]):#.4g}" if np.isfinite(value) else "-"


def says(yes: bool) -> str:
    return "yes" if yes else "no"


# The picture


def draw(tests: list[Test], path: Path) -> None:
    """Draw the Allan deviation of every test, axis by axis.

    With it are drawn the paper's N and K, the mean fit and the paper's floor.
    """
    with matplotlib.rc_context(
        {"font.size": 9, "axes.grid": True, "grid.alpha": 0.25, "legend.frameon": False}
    ):
        figure = Figure(figsize=(11, 4), layout="constrained")
        panels = figure.subplots(1, 3, sharex=True, sharey=True)
        for axis, panel in enumerate(panels):
            _draw_axis(panel, axis, tests)
        panels[0].set_ylabel("Allan deviation [deg/h]")
        panels[0].legend(loc="upper right")
        with whole(path) as unfinished:
            figure.savefig(unfinished, format="png", dpi=130)


def _draw_axis(panel: Axes, axis: int, tests: list[Test]) -> None:
    per_hour = units.parse("deg/h").factor
    tau = tests[0].tau
    for k, test in enumerate(tests):
        panel.plot(
            tau,
            test.deviation[:, axis] / per_hour,
            color=BLUE,
            lw=0.8,
            alpha=0.6,
            label=None if k else "simulated tests",
        )
    theory = np.hypot(
        white_deviation(paper("N")[axis], tau), random_walk_deviation(paper("K")[axis], tau)
    )
    fitted = np.sqrt(np.mean([t.fits[axis].deviation(tau) ** 2 for t in tests], axis=0))
    panel.plot(tau, theory / per_hour, color="black", lw=1.3, label="N and K of the paper")
    panel.plot(
        tau, fitted / per_hour, color=ORANGE, lw=1.3, ls="--", label="fit, mean of the tests"
    )
    panel.axhline(
        flicker_floor(PAPER["B"][0][axis]), color=GREY, lw=1, ls=":", label="0.664 B of the paper"
    )
    panel.set(xscale="log", yscale="log", xlabel="cluster time τ [s]", title=f"gyro {AXES[axis]}")


def main(
    hours: Annotated[float, typer.Option(help="Length of a test.")] = 4.0,
    tests: Annotated[int, typer.Option(min=1, help="Number of tests.")] = 5,
    out: Annotated[Path, typer.Option(help="Folder for the picture.")] = Path("out/imt30"),
) -> None:
    """Simulate the paper's static tests of the IMT30 and print its Tables 2, 4 and 5.

    What came back stands beside the paper's figures.
    """
    started = time.perf_counter()
    if hours * 3600 < SHORTEST:
        raise UserError(
            f"--hours {hours:g} is {hours * 3600:g} s; a test takes at least {SHORTEST:g} s"
        )
    done = list(simulate_tests(hours, tests))
    out.mkdir(parents=True, exist_ok=True)
    picture = out / "imt30_allan.png"
    draw(done, picture)
    console = Console(width=None if sys.stdout.isatty() else 150)
    for table in (fitted_table("N", done), fitted_table("K", done), floor_table(done)):
        console.print(table)
    needed = sorted({t for test in done for fit in test.fits for t in fit.needed})
    samples = tests * round(hours * 3600 * part("imt30").sample_rate)
    console.print(
        f"One {LEVEL:.0%} interval in twenty misses what it is of.  B of the joint fit is a bound: "
        "these logs have no flicker.",
        highlight=False,
    )
    console.print(
        f"Terms that a log needs: {', '.join(needed)}.  {tests} x {hours:g} h, {samples / 1e6:.1f} "
        "million samples of three axes: "
        f"{time.perf_counter() - started:.0f} s.  Picture: {picture}",
        highlight=False,
    )


if __name__ == "__main__":
    try:
        typer.run(main)
    except UserError as error:
        sys.exit(f"imt30_static: {error}")
