"""The pictures of the report of ``characterize``: Allan deviation, spectrum, temperature, the log
over time, and what shows a finding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from pyimu.characterization.allan.moments import TERMS, design
from pyimu.characterization.channel import Curve, Noise
from pyimu.characterization.evidence import LEVELS, STEPS, Comb, Evidence, Excerpt, Steps, Timeline
from pyimu.characterization.noise.fit import ChannelFit
from pyimu.characterization.result import SAMPLE, Channel, Characterization, LogResult, SensorResult
from pyimu.model.part import AXES
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    INK,
    STYLE,
    legend,
    new_figure,
    plain_logarithm,
    svg_of,
)
from pyimu.report.numbers import in_unit, number, pretty, unit_for

UNIT = {"gyro": "deg/h", "accel": "mg"}
DENSITY = {"gyro": "deg/s", "accel": "mg"}
PANEL = 2.15
"""Inches of height of a panel."""

WIDTH = 5.4

LOGS = (AFTER, FLOOR, "#cc79a7", "#d55e00", "#56b4e9", "#9467bd")
"""Colours of several logs, of Okabe-Ito as far as they go beside that of the fit."""

TERM_AT = {"Q": 0.0, "N": 0.12, "B": 0.5, "K": 0.85, "R": 1.0}
"""Where along its line a term's letter stands."""


def allan(c: Characterization, kind: str) -> str:
    """Measured deviation with its interval, the fitted noise and its terms, an axis a panel; all
    logs on it.
    """
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(WIDTH, 0.7 + PANEL * 3, 3)
        for axis, panel in zip(AXES, panels, strict=True):
            named = [
                (log.name, k, ch)
                for k, log in enumerate(c.logs)
                for ch in log.channels
                if ch.name == f"{kind}_{axis}" and ch.noise
            ]
            channels = [ch for _, _, ch in named]
            for name, k, ch in named:
                if len(c.logs) == 1:
                    _measured(panel, ch.noise, kind, f"its {100 * c.level:g} % interval")
                else:
                    _one_of(panel, ch.noise, kind, name, k, len(c.logs))
            if channels:
                _model(panel, channels[0].noise, kind, len(channels))
            panel.set(ylabel=f"{axis} [{pretty(UNIT[kind])}]")
            _legible(
                panel,
                [v for ch in channels for v in (ch.noise.allan, ch.noise.raw) if v is not None],
                kind,
            )
        panels[-1].set_xlabel("cluster time τ [s]")
        _decades(panels)
        legend(figure, max(panels, key=lambda p: len(p.lines)), 3)
        return svg_of(figure)


def _scaled(values: np.ndarray, kind: str) -> np.ndarray:
    return in_unit(values, SAMPLE[kind], UNIT[kind])


def _one_of(panel: Axes, noise: Noise, kind: str, name: str, k: int, logs: int) -> None:
    """One of several logs: in a colour and with a name of its own, as long as there are colours."""
    colour, label = (LOGS[k], name) if logs <= len(LOGS) else (AFTER, None if k else "measured")
    panel.plot(
        noise.allan.tau,
        _scaled(noise.allan.deviation, kind),
        color=colour,
        lw=1.1,
        alpha=0.85,
        label=label,
    )


def _measured(panel: Axes, noise: Noise, kind: str, interval: str) -> None:
    a = noise.allan
    if noise.raw is not None:
        panel.plot(
            noise.raw.tau,
            _scaled(noise.raw.deviation, kind),
            color=GREY,
            lw=1.0,
            label="as measured",
        )
    panel.fill_between(
        a.tau,
        _scaled(a.low, kind),
        _scaled(a.high, kind),
        color=AFTER,
        alpha=0.22,
        lw=0,
        label=interval,
    )
    name = "measured" if noise.raw is None else "compensated"
    panel.plot(a.tau, _scaled(a.deviation, kind), color=AFTER, lw=1.5, label=name)


def _model(panel: Axes, noise: Noise, kind: str, logs: int) -> None:
    fit, tau = noise.fit, noise.allan.tau
    panel.plot(
        tau,
        _scaled(np.sqrt(fit.variance(tau)), kind),
        color=BEFORE,
        lw=1.5,
        ls=(0, (5, 2)),
        label="fit" if logs == 1 else "fit of the first log",
    )
    for term, deviation in terms(fit, tau):
        shown = _scaled(deviation, kind)
        panel.plot(tau, shown, color=GREY, lw=0.8, ls=(0, (2, 2)), zorder=1)
        k = int(TERM_AT[term] * (len(tau) - 1))
        panel.annotate(
            term,
            (tau[k], shown[k]),
            xytext=(0, -9),
            textcoords="offset points",
            color=GREY,
            fontsize=8.5,
            annotation_clip=True,
        )


def terms(fit: ChannelFit, tau: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """The Allan deviation (t,) of each term of the fit by itself."""
    each = np.sqrt(design(tau / fit.fit.sample_period) * fit.squares)
    return ((t, each[:, i]) for i, t in enumerate(TERMS) if t in fit.fit.estimates)


def _legible(panel: Axes, curves: Sequence[Curve], kind: str) -> None:
    """Limits from what was measured: a term far below would else shrink it."""
    values = [
        _scaled(v, kind) for a in curves for v in (a.deviation, getattr(a, "low", a.deviation))
    ]
    if values:
        low, high = min(map(np.min, values)), max(_scaled(a.deviation, kind).max() for a in curves)
        panel.set_ylim(max(low / 1.5, high / 1e4), 1.5 * high)


def _decades(panels: Sequence[Axes]) -> None:
    """Logarithmic axes; a panel without a curve says so."""
    for panel in panels:
        panel.set_xscale("log")
        if panel.lines:
            panel.set_yscale("log")
            plain_logarithm(panel.yaxis)
        else:
            panel.set_yticks([])
            panel.annotate(
                "not characterised",
                (0.5, 0.5),
                xycoords="axes fraction",
                ha="center",
                va="center",
                color=GREY,
            )
    plain_logarithm(panels[-1].xaxis)


def other_deviations(c: Characterization, kind: str) -> str:
    """Overlapping, modified and Hadamard deviation of the first log."""
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(WIDTH, 0.7 + 1.7 * 3, 3)
        for axis, panel in zip(AXES, panels, strict=True):
            noise = next((ch.noise for ch in c.channel(f"{kind}_{axis}") if ch.noise), None)
            if noise is not None:
                for curve, colour, name in (
                    (noise.allan, AFTER, "Allan, overlapping"),
                    (noise.hadamard, BEFORE, "Hadamard"),
                    (noise.modified, FLOOR, "modified Allan"),
                ):
                    panel.plot(
                        curve.tau, _scaled(curve.deviation, kind), color=colour, lw=1.4, label=name
                    )
            panel.set(ylabel=f"{axis} [{pretty(UNIT[kind])}]")
        panels[-1].set_xlabel("cluster time τ [s]")
        _decades(panels)
        legend(figure, max(panels, key=lambda p: len(p.lines)), 3)
        return svg_of(figure)


# Spectrum


def spectrum(s: SensorResult) -> str | None:
    """Root of the one-sided density, the fitted noise over it, and the lines."""
    if not len(s.psd.frequency):
        return None
    unit, f = DENSITY[s.kind], s.psd.frequency
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(WIDTH, 0.7 + PANEL * 3, 3)
        for i, (ch, panel) in enumerate(zip(s.channels, panels, strict=True)):
            density = in_unit(np.sqrt(s.psd.density[:, i]), SAMPLE[s.kind], unit)
            if np.any(density > 0):
                panel.plot(f, density, color=AFTER, lw=1.2, label="measured, one-sided")
            if ch.noise is not None:
                model = in_unit(np.sqrt(2 * ch.noise.fit.psd_two_sided(f)), SAMPLE[s.kind], unit)
                panel.plot(f, model, color=BEFORE, lw=1.5, ls=(0, (5, 2)), label="fitted noise")
            _lines(panel, ch, f, density)
            panel.set_ylabel(f"{ch.name[-1]} [{pretty(unit)}/√Hz]")
        panels[-1].set_xlabel("frequency [Hz]")
        _decades(panels)
        legend(figure, max(panels, key=lambda p: len(p.get_legend_handles_labels()[0])), 3)
        return svg_of(figure)


def _lines(panel: Axes, ch: Channel, f: np.ndarray, density: np.ndarray) -> None:
    """A mark above each line, and the frequencies of the strongest."""
    panel.set(xscale="log", yscale="log" if panel.lines else "linear")
    if not ch.lines:
        return
    at = np.array([v.frequency for v in ch.lines])
    height = np.interp(np.log(at), np.log(f), density) * 1.35
    panel.plot(at, height, "v", ms=4.5, color=INK, mew=0, label="lines")
    for k in np.argsort([-v.amplitude for v in ch.lines])[:2]:
        panel.annotate(
            f"{number(at[k], 4)} Hz",
            (at[k], height[k]),
            xytext=(0, 5),
            textcoords="offset points",
            ha="center",
            fontsize=8.5,
        )
    low, high = panel.get_ylim()
    panel.set_ylim(low, max(high, 2.2 * height.max()))


# Temperature


def thermal(ch: Channel) -> str:
    """Bias against temperature with the fit, rising and falling apart, and what the fit leaves, as
    in Hidalgo's Figure 3.
    """
    t, unit = ch.thermal, unit_for(np.ptp(ch.thermal.bias), SAMPLE[ch.kind])
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(4.4, 3.9, 2)
        for panel, values in zip(panels, (t.bias, t.residual), strict=True):
            offset = np.mean(t.bias) if panel is panels[0] else 0.0
            for way, colour, name in (
                (1, BEFORE, "rising"),
                (-1, AFTER, "falling"),
                (0, GREY, "turning"),
            ):
                rows = t.branch == way
                if rows.any():
                    panel.plot(
                        t.temperature[rows],
                        in_unit(values[rows] - offset, SAMPLE[ch.kind], unit),
                        ".",
                        ms=3.5,
                        mew=0,
                        color=colour,
                        alpha=0.6,
                        rasterized=True,
                    )
                    panel.plot([], [], "o", ms=5, mew=0, color=colour, label=name)
            line = np.linspace(t.temperature.min(), t.temperature.max(), 100)
            # On the level of the whole log, about which the residual is drawn.
            fitted = t.at(line) + t.level - offset if panel is panels[0] else np.zeros(100)
            panel.plot(
                line,
                in_unit(fitted, SAMPLE[ch.kind], unit),
                color=INK,
                lw=1.3,
                label="fit" if t.order else "mean",
            )
        panels[0].set_ylabel(f"bias {ch.name[-1]} [{pretty(unit)}]")
        panels[1].set_ylabel(f"left over [{pretty(unit)}]")
        panels[1].set_xlabel("temperature [°C]")
        legend(figure, panels[0], 4)
        return svg_of(figure)


# The log, and what was found in it


def over_time(log: LogResult, kind: str) -> str:
    """Smallest, mean and largest sample of stretches of the log, and the warm-up where there is
    one.
    """
    s, unit = log.sensors[kind], DENSITY[kind]
    with matplotlib.rc_context(STYLE):
        figure, panels = new_figure(WIDTH, 0.7 + 1.3 * 3, 3)
        factor, label = (
            (3600.0, "h")
            if log.duration > 3 * 3600
            else (60.0, "min")
            if log.duration > 600
            else (1.0, "s")
        )
        for ch, panel in zip(s.channels, panels, strict=True):
            o = ch.overview
            start = o.time[0]
            panel.fill_between(
                (o.time - start) / factor,
                *(in_unit(v, SAMPLE[kind], unit) for v in (o.low, o.high)),
                color=AFTER,
                alpha=0.25,
                lw=0,
                label="samples",
            )
            panel.plot(
                (o.time - start) / factor,
                in_unit(o.mean, SAMPLE[kind], unit),
                color=AFTER,
                lw=1.2,
                label="mean",
            )
            if ch.warm_up is not None and not (ch.thermal is not None and ch.thermal.warranted):
                w = ch.warm_up
                panel.plot(
                    w.time / factor,
                    in_unit(w.fitted, SAMPLE[kind], unit),
                    color=BEFORE,
                    lw=1.5,
                    label="warm-up",
                )
            panel.set_ylabel(f"{ch.name[-1]} [{pretty(unit)}]")
        panels[-1].set_xlabel(f"time [{label}]")
        legend(figure, panels[0], 3)
        return svg_of(figure)


def finding(shown: Evidence, column: str) -> str:
    """What shows a finding."""
    draw: Callable = {Excerpt: _excerpt, Comb: _comb, Steps: _steps, Timeline: _timeline}[
        type(shown)
    ]
    with matplotlib.rc_context(STYLE):
        figure, (panel,) = new_figure(4.4, 1.3 if isinstance(shown, Timeline) else 2.4)
        draw(panel, shown, column)
        return svg_of(figure)


def _excerpt(panel: Axes, e: Excerpt, column: str) -> None:
    kind = column.partition("_")[0]
    unit, time = DENSITY[kind], e.time - e.time[0]
    values = in_unit(e.values, SAMPLE[kind], unit)
    panel.plot(time, values, ".-", color=AFTER, lw=0.8, ms=3)
    panel.plot(time[e.first : e.last], values[e.first : e.last], "o", color=BEFORE, ms=5, mew=0)
    panel.set(xlabel=f"time [s] since {e.time[0]:.6g} s", ylabel=f"{column[-1]} [{pretty(unit)}]")


def _comb(panel: Axes, comb: Comb, column: str) -> None:
    unit = DENSITY[column.partition("_")[0]]
    panel.bar(np.arange(-LEVELS, LEVELS + 1), 100 * comb.share, width=0.25, color=AFTER)
    step = number(float(in_unit(comb.step, SAMPLE[column.partition("_")[0]], unit)), 4)
    panel.set(
        xlabel=f"{column[-1]}, from its median, in steps of {step} {pretty(unit)}",
        ylabel="samples [%]",
    )


def _steps(panel: Axes, steps: Steps, _: str) -> None:
    unit = unit_for(steps.h, "s")
    panel.stairs(
        np.maximum(steps.count, 0.5),
        in_unit(STEPS * steps.h, "s", unit),
        color=AFTER,
        fill=True,
        baseline=0.5,
    )
    panel.set(
        yscale="log",
        ylim=(0.5, None),
        xlabel=f"time step [{pretty(unit)}]; longer ones in the last bin",
        ylabel="steps",
    )
    panel.locator_params(axis="x", nbins=6)
    plain_logarithm(panel.yaxis)


def _timeline(panel: Axes, line: Timeline, _: str) -> None:
    start = line.spans[0][0]
    panel.broken_barh([(a - start, max(b - a, 0.0)) for a, b in line.spans], (0, 1), color=AFTER)
    panel.set(yticks=[], ylim=(-0.2, 1.2), xlabel="time [s]; samples without gap")
    panel.grid(axis="y", visible=False)
