"""The pictures of the report, as inline SVG: clouds rasterised, colours by CSS variable so that one
page serves day and night.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.signal import welch

from pyimu.identification.fit.attenuation import floor_noise
from pyimu.identification.fit.columns import (
    LogState,
    band_segments,
    band_time,
    in_band,
    reference_input,
    residual,
)
from pyimu.identification.fit.fit import Fit
from pyimu.identification.fit.score import held_state
from pyimu.identification.fit.trial import Trial
from pyimu.identification.fit.whiten import RandomWalk
from pyimu.identification.outcome import Added
from pyimu.identification.search.forward import Investigation
from pyimu.identification.search.screen import Screening
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import KINDS
from pyimu.model.part import AXES
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, SIGNALS
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    INK,
    STYLE,
    envelope,
    legend,
    new_figure,
    plain_logarithm,
    svg_of,
)
from pyimu.report.numbers import in_unit, number, pretty, unit_for

CLOUD = 3000
"""Points of a cloud, evenly picked."""

LEVELS = 22
"""Bins of the input in which a residual's median and quartiles are drawn."""

LEAST_IN_BIN = 5


@dataclass(frozen=True)
class Trace:
    """One log's residual (m, 3) under two models, in its band, and the inputs (m, 7) in the
    sensor's axes.
    """

    trial: Trial
    state: LogState
    time: np.ndarray
    segments: list[tuple[int, int]]
    before: np.ndarray
    after: np.ndarray


def traces(inv: Investigation) -> list[Trace]:
    """Residuals of the held-out logs before and after; of the fitted ones where nothing is held
    out.
    """
    return [trace(inv.before, inv.after, t) for t in inv.held or inv.after.trials]


def trace(before: Fit, after: Fit, trial: Trial) -> Trace:
    """Residual of one log under two models, each with the log's own bias and mounting found under
    it.
    """
    (state_before, rest), (state, _) = _state(before, trial), _state(after, trial)
    pair = [
        in_band(rest, residual(f.sensor, rest, s))
        for f, s in ((before, state_before), (after, state))
    ]
    return Trace(rest, state, band_time(rest), band_segments(rest), *pair)


def _state(fit: Fit, trial: Trial) -> tuple[LogState, Trial]:
    """State of a log under a model and the rows to look at; a fitted log's bias is found anew, the
    model may be another.
    """
    if trial.parent is not None or trial.name not in fit.states:
        return held_state(fit, trial)
    whole = replace(trial, left_out=None)
    state = replace(fit.states[trial.name], bias=np.zeros(3))
    return replace(
        state, bias=in_band(whole, residual(fit.sensor, whole, state)).mean(axis=0)
    ), whole


# Residual over time


def over_time(found: Sequence[Trace], floor: np.ndarray | None, si: str) -> str:
    """Residual before and after on the held-out rows, both on one scale, one panel an axis."""
    with matplotlib.rc_context(STYLE):
        axes_shown = sorted({i for t in found for i in t.trial.axes})
        unit = unit_for(_scale([t.before for t in found]), si)
        figure, panels = new_figure(5.4, 0.9 + 1.35 * len(axes_shown), len(axes_shown))
        clock, ends = _running_time(found)
        factor, label = _time_unit(clock[-1][-1] if len(clock) and len(clock[-1]) else 1.0)
        for i, panel in zip(axes_shown, panels, strict=True):
            _time_panel(panel, found, [c / factor for c in clock], i, si, unit)
            if floor is not None and np.isfinite(floor[i]):
                limit = 2 * float(in_unit(floor[i], si, unit))
                panel.axhspan(
                    -limit,
                    limit,
                    color=FLOOR,
                    alpha=0.25,
                    lw=0,
                    zorder=1,
                    label="±2σ of the noise alone",
                )
                for edge in (-limit, limit):
                    panel.axhline(edge, color=FLOOR, lw=0.8, zorder=3)
            for edge in ends:
                panel.axvline(edge / factor, color=GREY, lw=0.8, ls=(0, (2, 2)))
            panel.set_ylabel(f"{'xyz'[i]} [{pretty(unit)}]")
            limit = max(map(abs, panel.get_ylim()))
            panel.set_ylim(-limit, limit)
        panels[-1].set_xlabel(f"time on the held-out rows [{label}]")
        legend(figure, panels[0], 3)
        return svg_of(figure)


def _scale(residuals: Sequence[np.ndarray]) -> float:
    return (
        float(np.sqrt(np.mean(np.concatenate(residuals) ** 2)))
        if residuals and sum(map(len, residuals))
        else 0.0
    )


def _running_time(found: Sequence[Trace]) -> tuple[list[np.ndarray], list[float]]:
    """Times of the logs one after another from zero, and where one ends and the next begins."""
    clock, edges, at = [], [], 0.0
    for t in found:
        if len(t.time):
            clock.append(t.time - t.time[0] + at)
            at = float(clock[-1][-1])
            edges.append(at)
        else:
            clock.append(t.time)
    return clock, edges[:-1]


def _time_unit(span: float) -> tuple[float, str]:
    return (3600.0, "h") if span > 3 * 3600 else (60.0, "min") if span > 600 else (1.0, "s")


def _time_panel(
    panel: Axes, found: Sequence[Trace], clock: list[np.ndarray], i: int, si: str, unit: str
) -> None:
    for name, colour in (("before", BEFORE), ("after", AFTER)):
        times = np.concatenate(clock)
        values = in_unit(np.concatenate([getattr(t, name)[:, i] for t in found]), si, unit)
        at, low, high = envelope(times, values)
        panel.fill_between(at, low, high, color=colour, lw=0.6, label=name, zorder=2)


# Residual against what drives it


@dataclass(frozen=True)
class Driver:
    """What an effect answers to on one axis of the sensor: values (m,) in the log's band, and how
    to name them.
    """

    values: np.ndarray
    label: str


def against_input(
    a: Added, inv: Investigation, found: Sequence[Trace], most: int = 3
) -> list[tuple[str, str]]:
    """Pictures ``(axis, svg)``, at most ``most``, of the residual without and with an added effect
    against its input.

    All rows are shown, fitted and held out: what drives an effect may not move enough in the last
    part of a log.
    """
    if a.effect == "quantization":
        return comb(a, found)
    if CATALOGUE[a.effect].stochastic or a.effect not in inv.after.sensor.values:
        return []
    bare = replace(inv.after, sensor=inv.after.sensor.without(a.effect))
    both = [trace(bare, inv.after, t) for t in (*inv.after.trials, *inv.held)]
    weight = np.sqrt(sum(np.sum((t.before - t.after) ** 2, axis=0) for t in both))
    axes = [int(i) for i in np.argsort(-weight)[:most] if weight[i] > 0.1 * weight.max() > 0.0]
    pictures = []
    for i in sorted(axes):
        source = _source(a, i, both)
        drivers = [_driver(source, i, inv.after.sensor, t) for t in both]
        pictures.append(
            ("xyz"[i], _cloud(drivers, both, i, inv.after.sensor.output.unit, a.effect))
        )
    return pictures


def _source(a: Added, i: int, both: Sequence[Trace]) -> tuple[str, int]:
    """Which signal drives an effect on axis ``i``, and which component of it."""
    e, kind = CATALOGUE[a.effect], both[0].trial.kind
    signal = next(iter(sorted(e.signals(kind))), None)
    matrix = next((v for v, _, _ in a.parameters.values() if np.ndim(v) == 2), None)
    if e.stage == "dynamics":
        return "change", i
    if signal and (e.stage in ("motion", "gain") or len(e.signals(kind)) > 1):
        return "contribution", i
    width = SIGNALS[signal or KINDS[kind].own].size
    if matrix is not None and matrix.shape[1] == width:
        spread = np.std(
            np.concatenate([t.trial.u[:, COLUMNS[signal or KINDS[kind].own]] for t in both]), axis=0
        )
        return signal or "own", int(np.argmax(np.abs(matrix[i]) * spread))
    if signal:
        return signal, i if width == 3 else 0
    return ("time", 0) if e.stage == "bias" else ("own", i)


def _driver(source: tuple[str, int], axis: int, sensor: Sensor, t: Trace) -> Driver:
    """The values of a signal in a log's band, in the unit that people use."""
    signal, component = source
    rest, own = t.trial, sensor.output.own
    if signal == "time":
        return Driver((t.time - rest.time[0]) / 60, "time [min]")
    if signal == "contribution":
        unit = "deg/s" if rest.kind == "gyro" else "mg"
        return Driver(
            in_unit((t.before - t.after)[:, axis], sensor.output.unit, unit),
            f"what the effect adds [{unit}]",
        )
    u = reference_input(rest, t.state)
    name = own if signal in ("own", "change") else signal
    values, si = u[:, COLUMNS[name]][:, component : component + 1], SIGNALS[name].unit
    unit = UNITS.get(name) or unit_for(values, si)
    values = values if unit == si else in_unit(values, si, unit)
    label = f"{name.replace('_', ' ')}{f' {AXES[component]}' if SIGNALS[name].size == 3 else ''}"
    if signal == "change":
        values, unit, label = (
            np.gradient(values, rest.h, axis=0),
            f"{unit}/s".replace("deg/s/s", "deg/s^2"),
            f"change of {label}",
        )
    return Driver(in_band(rest, values)[:, 0], f"{label} [{pretty(unit)}]")


UNITS = {"rate": "deg/s", "specific_force": "g", "temperature": "degC"}
"""Units that people expect on the axis of a signal, whatever its size."""


def _cloud(drivers: Sequence[Driver], both: Sequence[Trace], i: int, si: str, effect: str) -> str:
    """Residual of one axis against its driver: a light cloud, binned medians with quartiles on
    it.
    """
    x = np.concatenate([d.values for d in drivers])
    # A limit acts on the outermost samples, which are what a picture of anything else leaves out.
    span = np.quantile(x, [0.0, 1.0] if CATALOGUE[effect].stage == "output" else [0.001, 0.999])
    unit = unit_for(_scale([t.before[:, i : i + 1] for t in both]), si)
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(4.4, 2.9)
        seen = []
        for name, colour, label in (
            ("before", BEFORE, f"without {effect}"),
            ("after", AFTER, f"with {effect}"),
        ):
            y = in_unit(np.concatenate([getattr(t, name)[:, i] for t in both]), si, unit)
            _points(panel, x, y, colour)
            quartiles = _medians(
                panel,
                x,
                y,
                np.linspace(*span, LEVELS + 1),
                colour,
                label,
                0.0 if name == "before" else 0.2,
            )
            seen += [np.quantile(y, [0.002, 0.998]), quartiles.ravel()]
        _limits(panel.set_xlim, span)
        _limits(panel.set_ylim, np.concatenate(seen))
        panel.locator_params(axis="x", nbins=6)
        panel.set(xlabel=drivers[0].label, ylabel=f"residual {'xyz'[i]} [{pretty(unit)}]")
        legend(figure, panel, 2)
        return svg_of(figure)


def _points(panel: Axes, x: np.ndarray, y: np.ndarray, colour: str) -> None:
    pick = np.linspace(0, len(x) - 1, min(CLOUD, len(x))).astype(int)
    alpha = 0.5 if len(x) < 1000 else 0.38
    panel.plot(
        x[pick], y[pick], ".", ms=2.8, mew=0, color=colour, alpha=alpha, rasterized=True, zorder=2
    )


def _medians(
    panel: Axes,
    x: np.ndarray,
    y: np.ndarray,
    edges: np.ndarray,
    colour: str,
    label: str,
    shift: float,
) -> np.ndarray:
    """Draw, and give, median and quartiles (k, 3) of ``y`` in bins of ``x``; ``shift`` [bins] parts
    two series.
    """
    place = np.searchsorted(edges, x) - 1
    rows = [
        (k, np.quantile(y[place == k], [0.25, 0.5, 0.75]))
        for k in range(LEVELS)
        if np.sum(place == k) >= LEAST_IN_BIN
    ]
    if not rows:
        return np.empty((0, 3))
    at = np.array([edges[k] + (0.4 + shift) * (edges[1] - edges[0]) for k, _ in rows])
    q = np.array([v for _, v in rows])
    panel.errorbar(
        at,
        q[:, 1],
        yerr=[q[:, 1] - q[:, 0], q[:, 2] - q[:, 1]],
        fmt="o-",
        ms=3.2,
        lw=1.2,
        elinewidth=1.0,
        color=colour,
        label=label,
        zorder=4,
    )
    return q


def _limits(set_limits: Callable, values: np.ndarray) -> None:
    """A twentieth of margin around what must be seen; outliers beyond it are cut."""
    low, high = float(np.min(values)), float(np.max(values))
    margin = 0.05 * (high - low) or 1.0
    set_limits(low - margin, high + margin)


def comb(a: Added, found: Sequence[Trace]) -> list[tuple[str, str]]:
    """Where the raw samples lie between two multiples of the step found: on the multiples, if they
    are rounded.
    """
    q = next(iter(a.parameters.values()))[0]
    pictures = []
    for i in np.flatnonzero(q):
        y = np.concatenate([t.trial.y[s:e, i] for t in found for s, e in t.trial.segments])
        share = (y - y[0]) / q[i] + 0.5
        with matplotlib.rc_context(STYLE):
            figure, (panel,) = new_figure(4.4, 2.4)
            panel.hist(
                share % 1.0 - 0.5,
                bins=41,
                range=(-0.5, 0.5),
                color=AFTER,
                weights=np.full(len(y), 100.0 / len(y)),
            )
            panel.set(
                xlabel=f"sample {'xyz'[i]}, distance to the nearest multiple [steps]",
                ylabel="samples [%]",
            )
            pictures.append(("xyz"[i], svg_of(figure)))
    return pictures


# Screening


def screening(first: Screening, last: Screening, added: Sequence[str]) -> str:
    """Gain of each candidate at the first look (bars) and at the last (diamonds), with the gate."""
    rows = sorted(first.candidates, key=lambda c: c.gain)
    remaining = {c.effect: c.gain for c in last.candidates}
    gate = first.gate if np.isfinite(first.gate) else 1.0
    left = 0.3 * min(1.0, gate)
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(5.4, 1.0 + 0.27 * len(rows))
        for k, c in enumerate(rows):
            colour = AFTER if c.effect in added else BEFORE if c.gain > gate else GREY
            panel.barh(k, max(c.gain, left) - left, left=left, height=0.62, color=colour)
            clear = max(c.gain, gate, remaining.get(c.effect, 0.0))
            panel.annotate(
                number(c.gain) if c.gain > left else "nothing",
                (clear, k),
                xytext=(7, 0),
                color=INK,
                textcoords="offset points",
                va="center",
                fontsize=8.5,
            )
            if c.effect in remaining and last is not first:
                panel.plot(
                    max(remaining[c.effect], left),
                    k,
                    "D",
                    ms=4.5,
                    mfc="none",
                    mec=INK,
                    mew=1.0,
                    clip_on=False,
                    zorder=5,
                )
        panel.axvline(gate, color=INK, lw=1.0, ls=(0, (4, 2)))
        panel.set_yticks(range(len(rows)), [c.effect for c in rows])
        panel.set(
            xscale="log",
            xlim=(left, 6 * max([gate, *(c.gain for c in rows)])),
            xlabel="gain in log-likelihood [nat]",
        )
        plain_logarithm(panel.xaxis)
        panel.grid(axis="y", visible=False)
        _screening_legend(figure, panel, last is not first)
        return svg_of(figure)


def _screening_legend(figure: Figure, panel: Axes, looked_again: bool) -> None:
    for colour, label in (
        (AFTER, "added"),
        (BEFORE, "above the gate, not added"),
        (GREY, "below the gate"),
    ):
        panel.bar(0, 0, color=colour, label=label)
    panel.plot([], [], color=INK, lw=1.0, ls=(0, (4, 2)), label="gate (1 % by chance)")
    if looked_again:
        panel.plot([], [], "D", ms=4.5, mfc="none", mec=INK, label="at the last look")
    legend(figure, panel, 3)


# Spectrum


def spectrum(inv: Investigation, found: Sequence[Trace]) -> str | None:
    """One-sided amplitude density of the residual before and after, over all axes, and of the noise
    alone.
    """
    densities = [density(found, name) for name in ("before", "after")]
    if any(d is None for d in densities):
        return None
    kind = inv.after.sensor.kind
    si, unit = inv.after.sensor.output.unit, "deg/s" if kind == "gyro" else "mg"
    trial = found[0].trial
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(5.4, 3.0)
        for (f, p), colour, label in zip(
            densities, (BEFORE, AFTER), ("before", "after"), strict=True
        ):
            panel.loglog(f, in_unit(np.sqrt(p), si, unit), color=colour, lw=1.5, label=label)
        f = densities[0][0]
        noise = np.sqrt(noise_density(floor_noise(inv.after), trial, f))
        panel.loglog(
            f,
            in_unit(noise, si, unit),
            color=FLOOR,
            lw=1.5,
            ls=(0, (5, 2)),
            label="the noise alone",
        )
        if trial.band_hz is not None:
            panel.axvline(trial.band_hz, color=INK, lw=0.8, ls=(0, (1, 2)))
            panel.annotate(
                "band",
                (trial.band_hz, 0.02),
                xycoords=("data", "axes fraction"),
                xytext=(-3, 0),
                textcoords="offset points",
                ha="right",
                fontsize=8.5,
            )
        panel.set(xlabel="frequency [Hz]", ylabel=f"density, one-sided [{unit}/√Hz]")
        for axis in (panel.xaxis, panel.yaxis):
            plain_logarithm(axis)
        legend(figure, panel, 3)
        return svg_of(figure)


def density(found: Sequence[Trace], name: str) -> tuple[np.ndarray, np.ndarray] | None:
    """One-sided PSD, the mean of the axes, averaged over all stretches that are long enough."""
    pieces = [
        (t, getattr(t, name)[a:b][:, list(t.trial.axes)]) for t in found for a, b in t.segments
    ]
    longest = max((len(p) for _, p in pieces), default=0)
    length = min(1024, 2 ** int(np.log2(max(longest, 1) / 3 + 1)))
    if length < 16:
        return None
    total, weight = 0.0, 0
    for t, piece in pieces:
        if len(piece) >= length:
            f, p = welch(
                piece,
                1.0 / (t.trial.h * t.trial.band.stride),
                nperseg=length,
                axis=0,
                detrend="constant",
            )
            total, weight = total + len(piece) * p.mean(axis=1), weight + len(piece)
    return f[1:-1], (total / weight)[1:-1]


def noise_density(noise: dict[int, RandomWalk], trial: Trial, f: np.ndarray) -> np.ndarray:
    """One-sided PSD of white noise plus random walk through the trial's band, the mean of the
    axes.
    """
    weights = np.array(trial.band.weights)
    gain = (
        np.abs(np.exp(-2j * np.pi * np.outer(f * trial.h, np.arange(len(weights)))) @ weights) ** 2
    )
    walk = (2 * np.sin(np.pi * np.minimum(f * trial.h, 0.5)) / trial.h) ** 2
    return np.mean(
        [gain * (2 * n.r * trial.h + 2 * n.k2 / walk) for i, n in noise.items() if i in trial.axes],
        axis=0,
    )
