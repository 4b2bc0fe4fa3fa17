"""The pictures of ``docs/noise.md``: density and Allan deviation of each noise, theory and FMU.

One FMU holds every noise, all switched off; a run switches one on by the FMU's own parameters. A
picture carries a digest of what it shows and is drawn only where that has changed: the same bits
come much faster from the block in Python.
"""

from __future__ import annotations

import hashlib
import json
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from noise_page import AXIS, SAMPLE_PERIOD, SAMPLES, Entry, entries
from PIL import Image
from scipy.stats import chi2

from pyimu import units
from pyimu.block.block import Block
from pyimu.characterization.allan import log_clusters, octave_clusters, overlapping_deviation
from pyimu.characterization.allan.law import allan_band
from pyimu.files import whole
from pyimu.fmu import build_fmu, simulate
from pyimu.model.catalogue import WHITE
from pyimu.model.kinds import KINDS
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.shaping import (
    gauss_markov_deviation,
    psd_two_sided,
    random_walk_deviation,
    white_deviation,
)

SEED = 2012
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

UNITS = {"gyro": "deg/h", "accel": "ug"}
"""Of the axes of a picture."""

DIGEST, DIGITS = "Digest", 6
"""The key in a picture's metadata, and the digits of a number that count."""

Run = Callable[[Sensor, np.ndarray], np.ndarray]
"""Output (n, 3) of a sensor at rest but for its own signal (n, 3), from its second sample on."""


def quiet(kind: str) -> Sensor:
    """Every noise of the page that such a sensor has, all of them off."""
    return Sensor(kind, {e.name: {} for e in entries() if kind in e.effect.sensors})


def draw(folder: Path, chosen: Sequence[Entry]) -> list[Path]:
    """Write ``EFFECT.png`` for each of these noises to a folder, where it shows something new.

    Gives the paths of those that were written. The same bytes at every run.
    """
    changed = [e for e in chosen if not is_fresh(e, folder / f"{e.name}.png")]
    if not changed:
        return []
    sensors = [quiet(kind) for kind in dict.fromkeys(e.kind for e in changed)]
    with tempfile.TemporaryDirectory() as work:
        run = _by_fmu(build_fmu(_block(*sensors), work))
        return [_save(picture(e, run), folder / f"{e.name}.png") for e in changed]


def is_fresh(entry: Entry, path: Path) -> bool:
    """Whether the picture at ``path`` is there and shows what the definitions give."""
    if not path.is_file():
        return False
    with Image.open(path) as image:
        return image.info.get(DIGEST) == digest(picture(entry, in_python))


def in_python(sensor: Sensor, signal: np.ndarray) -> np.ndarray:
    """A ``Run`` by the sensor's block."""
    y = _block(sensor).run(_inputs(sensor, signal), seed=SEED)[0]
    return y[1:, _columns(sensor)]


def _by_fmu(path: Path) -> Run:
    """A ``Run`` by an FMU of sensors that are ``quiet``."""

    def run(sensor: Sensor, signal: np.ndarray) -> np.ndarray:
        start = {"seed": SEED, **{v.name: float(v.start) for v in sensor.variables}}
        u = _inputs(sensor, signal)
        y = simulate(path, u, sample_period=SAMPLE_PERIOD, start_values=start)
        return y[2:, _columns(sensor)]

    return run


def _block(*sensors: Sensor) -> Block:
    return Part("noise", 1 / SAMPLE_PERIOD, **{s.kind: s for s in sensors}).block


def _columns(sensor: Sensor) -> slice:
    """Where a sensor stands among the inputs and the outputs of a part."""
    first = 3 * list(KINDS).index(sensor.kind)
    return slice(first, first + 3)


def _inputs(sensor: Sensor, signal: np.ndarray) -> np.ndarray:
    u = np.tile([v.start for v in _block(sensor).inputs], (len(signal), 1))
    u[:, _columns(sensor)] = signal
    return u


def noise(entry: Entry, run: Run) -> np.ndarray:
    """What the noise adds to the output, in SI, shape (SAMPLES,).

    That is the output with the noise on less the output with it off. White noise of one step, under
    which rounding makes noise, is in both, from the same draws. Sample 1, which knows no slope yet,
    is left out.
    """
    signal = np.zeros((SAMPLES + 1, 3))
    signal[:, AXIS] = entry.at + entry.slope * SAMPLE_PERIOD * np.arange(SAMPLES + 1)
    off, before = quiet(entry.kind), signal[1:]
    if entry.rounds:
        white, root = WHITE
        off = off.with_values(white, **{root: _step(entry) * np.sqrt(SAMPLE_PERIOD)})
        before = run(off, signal)
    on = off.with_values(entry.name, **entry.sensor.values[entry.name])
    return (run(on, signal) - before)[:, AXIS]


def _step(entry: Entry) -> float:
    """The step by which a noise rounds the output.

    The error of one sample is even within a step: its root mean square is step / sqrt(12).
    """
    return np.sqrt(12) * np.linalg.norm(entry.model.sampled.D)


MOST_PANELS = 40
"""Panels on the page, at most; a fixed number, so that a new noise redraws no other's picture."""


def probability() -> float:
    """The probability that all points of one panel are inside its band.

    Those of all panels then are with 99 % (Bonferroni).
    """
    return 1 - 0.01 / MOST_PANELS


def picture(entry: Entry, run: Run) -> Figure:
    """The picture of an entry, not yet rendered."""
    x = noise(entry, run)
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=SIZE, layout="constrained")
        left, right = figure.subplots(1, 2)
        _density(left, entry, x)
        _allan(right, entry, x)
        figure.suptitle(entry.effect.term, fontsize=10)
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
    model, scale = entry.model, _scale(entry) ** 2
    line = np.geomspace(FIRST_BIN / (len(x) * SAMPLE_PERIOD), 0.5 / SAMPLE_PERIOD, 300)
    theory = model.psd_two_sided(line)
    if model.sampled is None:
        _theory(panel, line, theory / scale, "formal label, no density", color="black", ls="--")
    else:
        f, ratio, freedom = spectrum(x, model.psd_two_sided)
        side = (1 - probability()) / (2 * len(f))
        centre = model.psd_two_sided(f) / scale
        low, high = (quantile(side, freedom) / freedom for quantile in (chi2.ppf, chi2.isf))
        _band(panel, f, centre * low, centre * high)
        continuous = psd_two_sided(model.transfer_function, line)
        if not np.allclose(theory, continuous, rtol=1e-6, atol=0):
            _theory(panel, line, continuous / scale, "continuous theory", color=GREY, ls="--")
        _theory(panel, line, theory / scale, "theory of the samples", color="black")
        _points(panel, f, ratio * centre)
    _logarithmic(panel, "frequency [Hz]", f"two-sided PSD [({UNITS[entry.kind]})²/Hz]")


def _scale(entry: Entry) -> float:
    return units.parse(UNITS[entry.kind]).factor


def _band(panel: Axes, x: np.ndarray, low: np.ndarray, high: np.ndarray) -> None:
    panel.fill_between(x, low, high, color=BLUE, alpha=0.18, lw=0, label="99 % band")


def _theory(panel: Axes, x: np.ndarray, y: np.ndarray, label: str, **style: str) -> None:
    panel.plot(x, y, lw=1.2, label=label, **style)


def _points(panel: Axes, x: np.ndarray, y: np.ndarray) -> None:
    panel.plot(x, y, "o", color=BLUE, ms=3.2, label="FMU")


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
    model, n, h, scale = entry.model, len(x), SAMPLE_PERIOD, _scale(entry)
    octaves = octave_clusters(n // 2)  # the longest has but one difference, which says nothing
    line = log_clusters(n // 2, 60) * h
    if model.sampled is not None:
        low, high = allan_band(model.psd_two_sided, octaves * h, n, h, probability())
        _band(panel, octaves * h, low / scale, high / scale)
    theory = model.allan_deviation(line)
    for name, reference in _references(entry, line):
        if not np.allclose(theory, reference, rtol=1e-6, atol=0):
            _theory(panel, line, reference / scale, name, color=GREY, ls="--")
    _theory(panel, line, theory / scale, "theory of the samples", color="black")
    _points(panel, octaves * h, overlapping_deviation(x, octaves) / scale)
    _logarithmic(panel, "cluster time τ [s]", f"Allan deviation [{UNITS[entry.kind]}]")


def _references(entry: Entry, tau: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """The field's form of the Allan deviation, with its name.

    That is the floor where the law has one, else the closed form in continuous time; none for what
    belongs to the samples alone.
    """
    law, c = entry.law, entry.coefficients
    floor, walk = (law.value(part, c) for part in ("floor", "walk"))
    if floor is not None:
        return [("floor", np.full_like(tau, floor))]
    if law.sampled or law.ramp is not None:
        return []
    white, markov = law.value("white", c, x=entry.at, slope=entry.slope), law.value("markov", c)
    parts = [gauss_markov_deviation(np.sqrt(2 * v / t), t, tau) for v, t in markov or ()]
    parts += [] if white is None else [white_deviation(np.sqrt(white), tau)]
    parts += [] if walk is None else [random_walk_deviation(np.sqrt(walk), tau)]
    return [("continuous theory", np.linalg.norm(parts, axis=0))]


def _logarithmic(panel: Axes, x: str, y: str) -> None:
    panel.set(xscale="log", yscale="log", xlabel=x, ylabel=y)
    low, high = panel.get_ylim()
    if high < 30 * low:
        panel.set_ylim(low / 6, high * 6)
    panel.legend()
