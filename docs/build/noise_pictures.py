"""The pictures of ``docs/noise.md``: density and Allan deviation of each noise, theory and FMU.

One FMU holds every noise, all switched off; a run switches one on by the FMU's own parameters. A
picture carries a digest of what it shows and is drawn only where that has changed: the same bits
come much faster from the block in Python.
"""

from __future__ import annotations

import hashlib
import json
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from noise_page import AXIS, ENTRIES, SAMPLE_PERIOD, SAMPLES, Entry
from PIL import Image
from scipy.stats import chi2

from pyimu import units
from pyimu.characterization.allan import log_clusters, octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_band
from pyimu.files import whole
from pyimu.fmu import build_fmu, simulate
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.shaping import (
    flicker_floor,
    gauss_markov_deviation,
    psd_two_sided,
    random_walk_deviation,
)

SEED = 2012
PANELS = 2 * len(ENTRIES) - 2
PROBABILITY = 1 - 0.01 / PANELS
"""That all points of a panel are inside its band; then with 99 % those of all panels are
(Bonferroni). A ramp has no band."""

FIRST_BIN, LEAST, RATIO = 8, 4, 2 ** (1 / 3)
"""A density is drawn from this bin of the periodogram on, in means over thirds of an octave but of
four bins at the least: at lower frequencies there are too few to say anything."""

BLUE, GREY = "#0072b2", "#808487"
SIZE, RESOLUTION = (8.2, 3.3), 110
"""Inches, dots an inch."""

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": GREY,
    "grid.alpha": 0.25,
    "grid.linewidth": 0.5,
    "legend.frameon": False,
    "legend.fontsize": 8,
}

UNIT = "deg/h"
DEG_PER_HOUR = units.parse(UNIT).factor

DIGEST, DIGITS = "Digest", 6
"""The key in a picture's metadata, and the digits of a number that count."""

Run = Callable[[Sensor, np.ndarray], np.ndarray]
"""Gyro output (n, 3) of a sensor at rest but for a rate (n, 3), from its second sample on."""

QUIET = Sensor("gyro", {name: {} for name in ("angle_random_walk", *(e.effect for e in ENTRIES))})
"""Every noise, all of them off."""


def draw(folder: Path) -> list[Path]:
    """Write ``EFFECT.png`` for each entry of the page to a folder; gives the paths of those that
    show something new. The same bytes at every run.
    """
    changed = [e for e in ENTRIES if not is_fresh(e, folder / f"{e.effect}.png")]
    if not changed:
        return []
    with tempfile.TemporaryDirectory() as work:
        run = _by_fmu(build_fmu(_block(QUIET), work))
        return [_save(picture(e, run), folder / f"{e.effect}.png") for e in changed]


def is_fresh(entry: Entry, path: Path) -> bool:
    """Whether the picture at ``path`` is there and shows what the definitions give."""
    if not path.is_file():
        return False
    with Image.open(path) as image:
        return image.info.get(DIGEST) == digest(picture(entry, in_python))


def in_python(sensor: Sensor, rate: np.ndarray) -> np.ndarray:
    """A ``Run`` by the sensor's block."""
    block = _block(sensor)
    return block.run(_inputs(sensor, rate), seed=SEED)[0][1:, :3]


def _by_fmu(path: Path) -> Run:
    """A ``Run`` by the FMU of ``QUIET``."""

    def run(sensor: Sensor, rate: np.ndarray) -> np.ndarray:
        start = {"seed": SEED, **{v.name: float(v.start) for v in sensor.variables}}
        y = simulate(path, _inputs(sensor, rate), sample_period=SAMPLE_PERIOD, start_values=start)
        return y[2:, :3]

    return run


def _block(sensor: Sensor):
    return Part("noise", 1 / SAMPLE_PERIOD, gyro=sensor).block


def _inputs(sensor: Sensor, rate: np.ndarray) -> np.ndarray:
    u = np.tile([v.start for v in _block(sensor).inputs], (len(rate), 1))
    u[:, :3] = rate
    return u


def noise(entry: Entry, run: Run) -> np.ndarray:
    """What the noise adds to the output, rad/s, shape (SAMPLES,): the output with the noise on less
    that with it off.

    A dither is in both, from the same draws. Sample 1, which knows no slope yet, is left out.
    """
    rate = np.zeros((SAMPLES + 1, 3))
    rate[:, AXIS] = entry.at + entry.slope * SAMPLE_PERIOD * np.arange(SAMPLES + 1)
    dither = entry.dither and entry.dither * _step(entry) * np.sqrt(SAMPLE_PERIOD)
    off = QUIET.with_values("angle_random_walk", N=dither) if dither else QUIET
    on = off.with_values(entry.effect, **entry.coefficients)
    before = run(off, rate) if dither else rate[1:]
    return (run(on, rate) - before)[:, AXIS]


def _step(entry: Entry) -> float:
    """The step of the rate, rad/s, that rounding makes."""
    period = SAMPLE_PERIOD if entry.effect == "angle_quantization" else 1.0
    return entry.coefficients["q"] / period


def picture(entry: Entry, run: Run) -> Figure:
    """The picture of an entry, not yet rendered."""
    x = noise(entry, run)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=SIZE, layout="constrained")
        left, right = figure.subplots(1, 2)
        _density(left, entry, x)
        _allan(right, entry, x)
        figure.suptitle(CATALOGUE[entry.effect].term, fontsize=10)
    return figure


def _save(figure: Figure, path: Path) -> Path:
    metadata = {"Software": None, DIGEST: digest(figure)}
    with matplotlib.rc_context(STYLE), whole(path) as unfinished:
        figure.savefig(unfinished, format="png", dpi=RESOLUTION, metadata=metadata)
    return path


def digest(figure: Figure) -> str:
    """What a picture shows, as a name: its numbers, to ``DIGITS`` digits, its texts and its style.

    Neither the place of anything in the picture nor how it is rendered, which change with the
    version of the library that draws.
    """
    panels = [_shown(panel) for panel in figure.axes]
    shown = [SIZE, RESOLUTION, STYLE, figure.get_suptitle(), panels]
    return hashlib.sha256(json.dumps(shown).encode()).hexdigest()[:32]


def _shown(panel: Axes) -> list:
    """Texts, scales, lines and bands of a panel."""
    lines = [
        [_style(line, "label", "color", "linestyle", "linewidth", "marker", "markersize")]
        + _rounded(line.get_xydata())
        for line in panel.lines
    ]
    bands = [
        [_style(band, "label", "alpha"), band.get_facecolor().tolist()]
        + [_rounded(path.vertices) for path in band.get_paths()]
        for band in panel.collections
    ]
    return [_style(panel, "xlabel", "ylabel", "xscale", "yscale"), lines, bands]


def _style(artist, *names: str) -> list[str]:
    return [str(getattr(artist, f"get_{name}")()) for name in names]


def _rounded(numbers: np.ndarray) -> list[str]:
    return [f"{x:.{DIGITS}g}" for x in np.ravel(numbers)]


def _density(panel: Axes, entry: Entry, x: np.ndarray) -> None:
    model, scale = entry.model, DEG_PER_HOUR**2
    line = np.geomspace(FIRST_BIN / (len(x) * SAMPLE_PERIOD), 0.5 / SAMPLE_PERIOD, 300)
    if model.sampled is None:
        panel.plot(
            line,
            model.psd_two_sided(line) / scale,
            color="black",
            ls="--",
            lw=1.2,
            label="formal label, no density",
        )
    else:
        f, ratio, freedom = spectrum(x, model.psd_two_sided)
        side = (1 - PROBABILITY) / (2 * len(f))
        centre = model.psd_two_sided(f) / scale
        panel.fill_between(
            f,
            centre * chi2.ppf(side, freedom) / freedom,
            centre * chi2.isf(side, freedom) / freedom,
            color=BLUE,
            alpha=0.18,
            lw=0,
            label="99 % band",
        )
        samples, continuous = (
            model.psd_two_sided(line),
            psd_two_sided(model.transfer_function, line),
        )
        if not np.allclose(samples, continuous, rtol=1e-6, atol=0):
            panel.plot(
                line, continuous / scale, color=GREY, lw=1.2, ls="--", label="continuous theory"
            )
        panel.plot(line, samples / scale, color="black", lw=1.2, label="theory of the samples")
        panel.plot(f, ratio * centre, "o", color=BLUE, ms=3.2, label="FMU")
    _logarithmic(panel, "frequency [Hz]", f"two-sided PSD [({UNIT})²/Hz]")


def spectrum(
    x: np.ndarray, psd: Callable[[np.ndarray], np.ndarray]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequencies [Hz], ratio of the density of ``x`` (n,) to ``psd(f)``, degrees of freedom, each
    (b,), in thirds of octaves.

    A Hann-windowed periodogram over the density at each of its bins, so that the slope of the
    density does not matter. Under a Hann window the powers of neighbouring bins are correlated by
    4/9, of the next ones by 1/36, so a mean over m of them has the variance
    S^2 (m + 8/9 (m - 1) + (m - 2) / 18) / m^2 and 36 m^2 / (35 m - 18) degrees of freedom.
    """
    window = np.hanning(len(x) + 1)[:-1]
    mean = np.sum(window * x) / np.sum(window)
    power = np.abs(np.fft.rfft(window * (x - mean))) ** 2 * SAMPLE_PERIOD / np.sum(window**2)
    bins = np.fft.rfftfreq(len(x), SAMPLE_PERIOD)
    edges = [FIRST_BIN]
    while edges[-1] * RATIO < len(power) - 1:
        edges.append(max(edges[-1] + LEAST, round(edges[-1] * RATIO)))
    edges = np.array([e for e in edges if e < len(power)])
    count = np.diff(edges)
    ratio = (
        np.add.reduceat(power[FIRST_BIN:] / psd(bins[FIRST_BIN:]), edges - FIRST_BIN)[:-1] / count
    )
    return (
        np.sqrt(bins[edges[:-1]] * bins[edges[1:] - 1]),
        ratio,
        36.0 * count**2 / (35 * count - 18),
    )


def _allan(panel: Axes, entry: Entry, x: np.ndarray) -> None:
    model, n, h = entry.model, len(x), SAMPLE_PERIOD
    octaves = octave_clusters(n // 2)  # the longest has but one difference, which says nothing
    line = log_clusters(n // 2, 60) * h
    if model.sampled is not None:
        low, high = allan_band(model.psd_two_sided, octaves * h, n, h, PROBABILITY)
        panel.fill_between(
            octaves * h,
            low / DEG_PER_HOUR,
            high / DEG_PER_HOUR,
            color=BLUE,
            alpha=0.18,
            lw=0,
            label="99 % band",
        )
    for name, values in _references(entry, line):
        panel.plot(line, values / DEG_PER_HOUR, color=GREY, ls="--", lw=1.2, label=name)
    panel.plot(
        line,
        model.allan_deviation(line) / DEG_PER_HOUR,
        color="black",
        lw=1.2,
        label="theory of the samples",
    )
    panel.plot(
        octaves * h,
        overlapping_deviation(x, octaves) / DEG_PER_HOUR,
        "o",
        color=BLUE,
        ms=3.2,
        label="FMU",
    )
    _logarithmic(panel, "cluster time τ [s]", f"Allan deviation [{UNIT}]")


def _references(entry: Entry, tau: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Closed forms of the field that differ from the line of the samples, each with its name."""
    c = entry.coefficients
    if entry.effect == "rate_random_walk":
        yield "continuous theory", random_walk_deviation(c["K"], tau)
    if entry.effect == "gauss_markov":
        yield "continuous theory", gauss_markov_deviation(c["q"], c["tau"], tau)
    if entry.effect == "bias_instability":
        yield "floor, 0.664 B", np.full_like(tau, flicker_floor(c["B"]))


def _logarithmic(panel: Axes, x: str, y: str) -> None:
    panel.set(xscale="log", yscale="log", xlabel=x, ylabel=y)
    low, high = panel.get_ylim()
    if high < 30 * low:
        panel.set_ylim(low / 6, high * 6)
    panel.legend()
