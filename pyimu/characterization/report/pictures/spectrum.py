"""The picture of a sensor's spectrum, of its lines and of the fitted noise."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.axes import Axes

from pyimu.characterization.outcome import SAMPLE, Channel, SensorResult
from pyimu.characterization.report.coefficients import SAMPLE_UNIT
from pyimu.characterization.report.pictures.panels import FITTED, axis_panels, logarithmic
from pyimu.report.figures import AFTER, BEFORE, INK, STYLE, legend, svg_of
from pyimu.report.numbers import in_unit, number, pretty


def spectrum_picture(s: SensorResult) -> str | None:
    """Root of the one-sided density, that of the fitted noise, and the lines, as an SVG.

    None where there is no spectrum.
    """
    if not len(s.psd.frequency):
        return None
    unit, f = SAMPLE_UNIT[s.kind], s.psd.frequency
    with matplotlib.rc_context(STYLE):
        figure, panels = axis_panels()
        for i, (ch, panel) in enumerate(zip(s.channels, panels, strict=True)):
            density = in_unit(np.sqrt(s.psd.density[:, i]), SAMPLE[s.kind], unit)
            if np.any(density > 0):
                panel.plot(f, density, color=AFTER, lw=1.2, label="measured, one-sided")
            if ch.noise is not None:
                fitted = in_unit(np.sqrt(s.fitted[:, i]), SAMPLE[s.kind], unit)
                panel.plot(f, fitted, color=BEFORE, lw=1.5, ls=FITTED, label="fitted noise")
            _mark_lines(panel, ch, f, density)
            panel.set_ylabel(f"{ch.axis} [{pretty(unit)}/√Hz]")
        panels[-1].set_xlabel("frequency [Hz]")
        logarithmic(panels)
        legend(figure, max(panels, key=lambda p: len(p.get_legend_handles_labels()[0])), 3)
        return svg_of(figure, curves=True)


def _mark_lines(panel: Axes, ch: Channel, f: np.ndarray, density: np.ndarray) -> None:
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
