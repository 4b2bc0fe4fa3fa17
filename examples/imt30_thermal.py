"""The IMT30's thermal drift and noise from logs in which the temperature goes up and down.

    python examples/imt30_thermal.py            two tests of four hours at 976 Hz
    python examples/imt30_thermal.py --hours 0.2 --tests 1 --out look

It prints Tables 1, 2 and 4 of Hidalgo 2012 beside what comes back. The sensor is the FMU of the
part ``imt30`` in its block form, at rest, in a chamber that goes from 15 to 35 degC and back; test
k has the seed k. Each log goes through ``pyimu.characterize``, which finds the temperature effect
in noise that it takes for a random walk, removes it, and fits the noise; report, data and part of
all tests are under ``--out``. Table 5 is in ``imt30_static.py``.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

import pyimu
from pyimu import Characterization, Recording, units
from pyimu.characterization.noise.coefficients import Coefficient
from pyimu.errors import UserError
from pyimu.fmu import build_fmu, stream_blocks
from pyimu.model.part import AXES, Part

PAPER = {
    "kT": ((0.02, 0.056, 0.050), "deg/s/K", "rad/s/K", "Table 1, thermal drift"),
    "N": ((0.20764, 0.23858, 0.20489), "deg/sqrt(h)", "rad/sqrt(s)", "Table 2, angle random walk"),
    "K": ((32.8, 49.6, 64.2), "deg/h/sqrt(h)", "rad/s/sqrt(s)", "Table 4, rate random walk"),
}
"""Hidalgo et al., Sensors 12 (2012), 2219-2235: gyros x, y, z."""

MIDDLE, SWING, CYCLES = 25.0, 10.0, 2.0
"""Temperature [degC], how far it goes to either side [K], and how often in a test."""

CHUNK = 97_600
"""Samples that the FMU is asked for at a time."""

SHORTEST = 300.0
"""Seconds of a test in which there is something to see."""


def chamber(k: np.ndarray, samples: int) -> np.ndarray:
    """Temperature (n,) degC at samples k (n,) of a test."""
    return MIDDLE + SWING * np.sin(2 * np.pi * CYCLES * k / samples)


def thermal_log(fmu: Path, imt30: Part, samples: int, seed: int) -> Recording:
    """A test at rest, from the block form of the part's FMU."""
    names = [v.name for v in imt30.block.inputs]
    rest = np.array([v.start for v in imt30.block.inputs], dtype=float)
    temperature = chamber(np.arange(samples), samples)

    def chunks():
        for first in range(0, samples, CHUNK):
            u = np.tile(rest, (min(CHUNK, samples - first), 1))
            u[:, names.index("temperature")] = temperature[first : first + len(u)]
            yield u

    rates = np.concatenate(
        [answer[:, :3] for answer in stream_blocks(fmu, chunks(), start_values={"seed": seed})]
    )
    return Recording.from_arrays(
        f"imt30_test_{seed}",
        time=imt30.sample_period * np.arange(samples),
        gyro=rates,
        temperature=temperature,
    )


def characterise(hours: float, tests: int) -> Characterization:
    """The tests, made and characterised."""
    imt30 = pyimu.part("imt30")
    samples = round(hours * 3600 * imt30.sample_rate)
    with tempfile.TemporaryDirectory() as folder:
        fmu = build_fmu(imt30.block, folder, "block")
        return pyimu.characterize(
            [thermal_log(fmu, imt30, samples, k) for k in range(1, tests + 1)]
        )


def table(found: Characterization, name: str) -> Table:
    """A table of the paper beside means and intervals over the tests."""
    values, unit, si, title = PAPER[name]
    out = Table(title=f"{title}, {name} in {unit}", title_justify="left")
    for heading in ("axis", "paper", "found", "95 % interval", "holds paper's"):
        out.add_column(heading, justify="left" if heading == "axis" else "right")
    for axis, value in zip(AXES, values, strict=True):
        c = drift(found, axis) if name == "kT" else found.coefficients[f"gyro_{axis}", name].mean
        shown = [f"{units.convert(v, si, unit):#.4g}" for v in (c.value, c.low, c.high)]
        holds = c.holds(units.convert(value, unit, si))
        out.add_row(
            axis,
            f"{value:g}",
            shown[0] if c.needed else f"< {shown[2]}",
            f"{shown[1]} to {shown[2]}",
            "yes" if holds else "no",
        )
    return out


def drift(found: Characterization, axis: str) -> Coefficient:
    """Mean of k_T over the tests, with the interval of the mean of independent normal estimates."""
    each = [ch.thermal.coefficients["kT"] for ch in found.channel(f"gyro_{axis}")]
    mean, std = (
        np.mean([k.value for k in each]),
        np.sqrt(np.sum([k.std**2 for k in each])) / len(each),
    )
    half = np.mean([(k.high - k.low) / 2 for k in each]) / np.sqrt(len(each))
    return Coefficient(float(mean), float(std), float(mean - half), float(mean + half))


def main(
    hours: Annotated[float, typer.Option(help="Length of a test.")] = 4.0,
    tests: Annotated[int, typer.Option(min=1, help="Number of tests.")] = 2,
    out: Annotated[Path, typer.Option(help="Folder for report, data and part.")] = Path(
        "out/imt30_thermal"
    ),
) -> None:
    """Simulate the IMT30 in a changing temperature and print the paper's Tables 1, 2 and 4.

    What came back stands beside the paper's figures.
    """
    started = time.perf_counter()
    if hours * 3600 < SHORTEST:
        raise UserError(
            f"--hours {hours:g} is {hours * 3600:g} s; a test takes at least {SHORTEST:g} s"
        )
    found = characterise(hours, tests)
    page = found.write(out)
    console = Console(width=None if sys.stdout.isatty() else 120)
    for name in PAPER:
        console.print(table(found, name))
    console.print(
        f"{tests} x {hours:g} h: {time.perf_counter() - started:.0f} s.  Report: {page}",
        highlight=False,
    )


if __name__ == "__main__":
    try:
        typer.run(main)
    except UserError as error:
        sys.exit(f"imt30_thermal: {error}")
