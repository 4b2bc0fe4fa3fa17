"""Pictures of the Allan deviation, of its fit, and of further deviations."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyimu.characterization.outcome import SAMPLE, Curve, NoiseAnalysis, Outcome
from pyimu.characterization.report.coefficients import UNITS
from pyimu.characterization.report.pictures.panels import FITTED, PANEL, axis_panels, logarithmic
from pyimu.model.part import AXES
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    FLOOR,
    GREY,
    ON_WHITE,
    STYLE,
    legend,
    new_figure,
    style,
    svg_of,
)
from pyimu.report.numbers import in_unit, pretty

LOGS = (AFTER, FLOOR, "#cc79a7", "#d55e00", "#56b4e9", "#9467bd")
"""Colours of several logs, of Okabe-Ito as far as they go beside that of the fit."""

LETTER_AT = {"Q": 0.0, "N": 0.12, "B": 0.5, "K": 0.85, "R": 1.0, "G": 0.72, "H": 0.62}
"""Where along its curve the letter of a term stands."""


def allan_picture(c: Outcome, kind: str) -> str:
    """Allan deviations of all logs with intervals, the fitted noise and its terms, as an SVG."""
    with matplotlib.rc_context(STYLE):
        figure, panels = axis_panels()
        for axis, panel in zip(AXES, panels, strict=True):
            _panel(panel, c, kind, axis)
            panel.set(ylabel=f"{axis} [{pretty(UNITS[kind]['B'])}]")
        panels[-1].set_xlabel("cluster time τ [s]")
        logarithmic(panels)
        legend(figure, max(panels, key=lambda p: len(p.lines)), 3)
        return svg_of(figure, curves=True)


def whole_figure(c: Outcome) -> Figure:
    """The same of every sensor, one below the other, on white."""
    with style(ON_WHITE):
        figure, panels = new_figure(9.0, 0.7 + PANEL * len(AXES) * len(c.kinds), 3 * len(c.kinds))
        channels = [(kind, axis) for kind in c.kinds for axis in AXES]
        for (kind, axis), panel in zip(channels, panels, strict=True):
            _panel(panel, c, kind, axis)
            panel.set(ylabel=f"{kind}_{axis} [{pretty(UNITS[kind]['B'])}]")
        panels[-1].set_xlabel("cluster time τ [s]")
        logarithmic(panels)
        legend(figure, max(panels, key=lambda p: len(p.lines)), 3)
    return figure


def deviations_picture(c: Outcome, kind: str) -> str:
    """Overlapping, modified and Hadamard deviation of the first log, as an SVG."""
    with matplotlib.rc_context(STYLE):
        figure, panels = axis_panels(1.7)
        for axis, panel in zip(AXES, panels, strict=True):
            noise = next((ch.noise for ch in c.channel(f"{kind}_{axis}") if ch.noise), None)
            if noise is not None:
                for curve, colour, name in (
                    (noise.allan, AFTER, "Allan, overlapping"),
                    (noise.hadamard, BEFORE, "Hadamard"),
                    (noise.modified, FLOOR, "modified Allan"),
                ):
                    values = _scaled(curve.deviation, kind)
                    panel.plot(curve.tau, values, color=colour, lw=1.4, label=name)
            panel.set(ylabel=f"{axis} [{pretty(UNITS[kind]['B'])}]")
        panels[-1].set_xlabel("cluster time τ [s]")
        logarithmic(panels)
        legend(figure, max(panels, key=lambda p: len(p.lines)), 3)
        return svg_of(figure, curves=True)


def _scaled(values: np.ndarray, kind: str) -> np.ndarray:
    return in_unit(values, SAMPLE[kind], UNITS[kind]["B"])


def _panel(panel: Axes, c: Outcome, kind: str, axis: str) -> None:
    """One axis of all logs."""
    found = [
        (k, log.name, ch.noise)
        for k, log in enumerate(c.logs)
        for ch in log.channels
        if ch.name == f"{kind}_{axis}" and ch.noise
    ]
    for k, name, noise in found:
        if len(c.logs) == 1:
            _measured(panel, noise, kind, f"its {100 * c.level:g} % interval")
        else:
            _one_of(panel, noise, kind, name, k, len(c.logs))
    if found:
        noises = [noise for _, _, noise in found]
        _fit(panel, noises[0], kind, len(noises))
        curves = [v for n in noises for v in (n.allan, n.as_measured) if v is not None]
        _limit_to(panel, curves, kind)


def _one_of(panel: Axes, noise: NoiseAnalysis, kind: str, name: str, k: int, logs: int) -> None:
    """One of several logs, with a colour and a name of its own as long as there are colours."""
    colour, label = (LOGS[k], name) if logs <= len(LOGS) else (AFTER, None if k else "measured")
    values = _scaled(noise.allan.deviation, kind)
    panel.plot(noise.allan.tau, values, color=colour, lw=1.1, alpha=0.85, label=label)


def _measured(panel: Axes, noise: NoiseAnalysis, kind: str, interval: str) -> None:
    """The deviation with its interval, and that of the samples as measured."""
    a, raw = noise.allan, noise.as_measured
    if raw is not None:
        values = _scaled(raw.deviation, kind)
        panel.plot(raw.tau, values, color=GREY, lw=1.0, label="as measured")
    limits = (_scaled(v, kind) for v in (a.low, a.high))
    panel.fill_between(a.tau, *limits, color=AFTER, alpha=0.22, lw=0, label=interval)
    name = "measured" if raw is None else "compensated"
    panel.plot(a.tau, _scaled(a.deviation, kind), color=AFTER, lw=1.5, label=name)


def _fit(panel: Axes, noise: NoiseAnalysis, kind: str, logs: int) -> None:
    """The deviation of the fitted noise, and of each of its terms by itself."""
    tau = noise.allan.tau
    name = "fit" if logs == 1 else "fit of the first log"
    panel.plot(tau, _scaled(noise.fitted, kind), color=BEFORE, lw=1.5, ls=FITTED, label=name)
    for term, deviation in noise.terms.items():
        values = _scaled(deviation, kind)
        panel.plot(tau, values, color=GREY, lw=0.8, ls=(0, (2, 2)), zorder=1)
        k = int(LETTER_AT[term] * (len(tau) - 1))
        panel.annotate(
            term,
            (tau[k], values[k]),
            xytext=(0, -9),
            textcoords="offset points",
            color=GREY,
            fontsize=8.5,
            annotation_clip=True,
        )


def _limit_to(panel: Axes, curves: Sequence[Curve], kind: str) -> None:
    """Limit the panel to what was measured: a term far below would otherwise shrink it."""
    values = [
        _scaled(v, kind) for a in curves for v in (a.deviation, getattr(a, "low", a.deviation))
    ]
    low, high = min(map(np.min, values)), max(_scaled(a.deviation, kind).max() for a in curves)
    panel.set_ylim(max(low / 1.5, high / 1e4), 1.5 * high)
