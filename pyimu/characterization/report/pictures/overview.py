"""The picture of a sensor's samples over time."""

from __future__ import annotations

import matplotlib
from matplotlib.axes import Axes

from pyimu.characterization.outcome import SAMPLE, Channel, LogResult
from pyimu.characterization.report.coefficients import SAMPLE_UNIT
from pyimu.characterization.report.pictures.panels import axis_panels
from pyimu.report.figures import AFTER, BEFORE, STYLE, legend, svg_of, unit_of_time
from pyimu.report.numbers import in_unit, pretty


def overview_picture(log: LogResult, kind: str) -> str:
    """Least, mean and largest samples over time, and the warm-up where there is one, as an SVG."""
    second, label = unit_of_time(log.duration)
    with matplotlib.rc_context(STYLE):
        figure, panels = axis_panels(1.3)
        for ch, panel in zip(log.sensors[kind].channels, panels, strict=True):
            _samples(panel, ch, second)
            if ch.warm_up is not None and not (ch.thermal is not None and ch.thermal.warranted):
                w = ch.warm_up
                values = in_unit(w.fitted, SAMPLE[kind], SAMPLE_UNIT[kind])
                panel.plot(w.time / second, values, color=BEFORE, lw=1.5, label="warm-up")
            panel.set_ylabel(f"{ch.axis} [{pretty(SAMPLE_UNIT[kind])}]")
        panels[-1].set_xlabel(f"time [{label}]")
        legend(figure, panels[0], 3)
        return svg_of(figure, curves=True)


def _samples(panel: Axes, ch: Channel, unit_of_time: float) -> None:
    o = ch.overview
    time = (o.time - o.time[0]) / unit_of_time
    low, mean, high = (
        in_unit(v, SAMPLE[ch.kind], SAMPLE_UNIT[ch.kind]) for v in (o.low, o.mean, o.high)
    )
    panel.fill_between(time, low, high, color=AFTER, alpha=0.25, lw=0, label="samples")
    panel.plot(time, mean, color=AFTER, lw=1.2, label="mean")
