"""A real sensor at rest: does the fitted noise describe the log?

    python examples/adis16405_static.py static.csv    any log at rest; written for one of 2.8 h

The log goes through ``pyimu.characterize``, and its Allan deviation is compared with a simulated
band of the fit. For each gyro axis logs of the fitted noise are simulated in means over a second,
and the band is laid so that 99 % of them are inside it at all cluster times at once. The table says
whether the measured deviation is, and the root mean square of the logarithm of the ratio of
measured to fitted.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.table import Table
from scipy.fft import next_fast_len
from scipy.signal import fftconvolve

import pyimu
from pyimu import units
from pyimu.characterization.allan import overlapping_deviation
from pyimu.characterization.noise.fit import ChannelFit
from pyimu.errors import UserError

SECOND = 1.0
"""s; what is simulated are means over so long."""

POINTS = 20
"""Cluster times, evenly in the logarithm."""

PAST = 4
"""Records that flicker remembers."""


def simulated(
    rng: np.random.Generator, fit: ChannelFit, n: int, response: np.ndarray
) -> np.ndarray:
    """Means over a second (n,) of noise with the fitted N, B and K.

    Flicker is half an integration of white noise (Kasdin, Proc. IEEE 83 (1995), 802-827), of which
    ``response`` is the impulse response.
    """
    N, B, K = (fit[t].value for t in "NBK")
    x = N / np.sqrt(SECOND) * rng.standard_normal(n) + K * np.sqrt(SECOND) * np.cumsum(
        rng.standard_normal(n)
    )
    if not B:
        return x
    flicker = fftconvolve(rng.standard_normal(len(response)), response)
    return x + B * flicker[len(response) - n : len(response)]


def half_integral(n: int) -> np.ndarray:
    """Impulse response (n,) of (1 - z^-1)^(-1/2)."""
    k = np.arange(1, n)
    return np.cumprod(np.append(1.0, (k - 0.5) / k))


def band(deviations: np.ndarray, probability: float) -> tuple[np.ndarray, np.ndarray]:
    """Limits (t,) at equal ranks of simulated ``deviations`` (s, t).

    They are the narrowest that hold whole rows with the probability.
    """
    ranks = np.argsort(np.argsort(deviations, axis=0), axis=0)
    outermost = np.minimum(ranks, len(ranks) - 1 - ranks).min(axis=1)
    rank = int(np.quantile(outermost, 1 - probability))
    ordered = np.sort(deviations, axis=0)
    return ordered[rank], ordered[len(ordered) - 1 - rank]


def compare(log: Path, shortest: float, longest: float, logs: int) -> Table:
    """The table, an axis a row."""
    result = pyimu.characterize(log).logs[0]
    if "gyro" not in result.sensors:
        raise UserError(f"{log}: no gyro in it")
    n = int(result.duration / SECOND)
    m = np.unique(np.geomspace(shortest, min(longest, n / 4), POINTS).astype(int))
    out = Table(
        title=(
            f"{result.name}: gyro, {m[0]:g} to {m[-1]:g} s, 99 % simultaneous band of {logs} "
            "simulated logs"
        ),
        title_justify="left",
    )
    for heading in (
        "axis",
        "N [deg/s/√Hz]",
        "B [deg/h]",
        "K [deg/s/√s]",
        "inside",
        "nearest edge",
        "RMS log ratio",
    ):
        out.add_column(heading, justify="left" if heading == "axis" else "right")
    rng, response = np.random.default_rng(405), half_integral(next_fast_len((PAST + 1) * n))
    for channel in result.sensors["gyro"].channels:
        fit, curve = channel.noise.fit, channel.noise.allan
        draws = np.array(
            [overlapping_deviation(simulated(rng, fit, n, response), m) for _ in range(logs)]
        )
        low, high = band(draws, 0.99)
        measured = np.exp(np.interp(np.log(m * SECOND), np.log(curve.tau), np.log(curve.deviation)))
        fitted = np.sqrt(fit.variance(m * SECOND))
        margin = min(np.min(measured / low), np.min(high / measured))
        ratio = np.exp(np.sqrt(np.mean(np.log(measured / fitted) ** 2)))
        out.add_row(
            channel.name[-1],
            *(
                shown(fit, t, u)
                for t, u in (("N", "deg/s/sqrt(Hz)"), ("B", "deg/h"), ("K", "deg/s/sqrt(s)"))
            ),
            "yes" if margin >= 1 else "no",
            f"{margin:.2f} times",
            f"{ratio:.3f}",
        )
    return out


def shown(fit: ChannelFit, term: str, unit: str) -> str:
    """A coefficient with its interval, or its bound."""
    si = {"N": "rad/sqrt(s)", "B": "rad/s", "K": "rad/s/sqrt(s)"}[term]
    value, low, high = (
        f"{float(units.convert(v, si, unit)):.3g}"
        for v in (fit[term].value, fit[term].low, fit[term].high)
    )
    return f"{value} ({low} to {high})" if fit[term].needed else f"< {high}"


def main(
    log: Annotated[Path, typer.Argument(help="A log at rest.")],
    shortest: Annotated[float, typer.Option(help="Shortest cluster time, s.")] = 30.0,
    longest: Annotated[float, typer.Option(help="Longest cluster time, s.")] = 1500.0,
    logs: Annotated[int, typer.Option(min=200, help="Simulated logs.")] = 2000,
) -> None:
    """Compare the Allan deviation of a log at rest with a simulated band of the fitted noise."""
    Console(width=None if sys.stdout.isatty() else 150).print(compare(log, shortest, longest, logs))


if __name__ == "__main__":
    try:
        typer.run(main)
    except UserError as error:
        sys.exit(f"adis16405_static: {error}")
