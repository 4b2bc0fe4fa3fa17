"""Pictures of motions."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from pyimu.recording.recording import Recording
from pyimu.report.figures import (
    AFTER,
    BEFORE,
    BINS,
    FLOOR,
    STYLE,
    envelope,
    legend,
    new_figure,
    svg_of,
)

COLOURS = (AFTER, BEFORE, FLOOR)


SMALL_BINS = 140
"""Columns of a small picture."""


def motion_picture(motion: Recording, small: bool = False) -> str:
    """Rate, specific force and temperature over time, as SVG; a ``small`` one without what is
    constant.
    """
    panels = [
        (np.degrees(motion.ref_rate), "rate [deg/s]"),
        (motion.ref_force, "force [m/s²]"),
        (motion.temperature[:, None], "temperature [°C]"),
    ]
    if motion.supply is not None:
        panels.append((motion.supply[:, None], "supply [V]"))
    if small:
        moving = [p for p in panels if np.ptp(p[0], axis=0).max() > 1e-6]
        panels = moving or panels[1:2]
    width, height = (4.4, 1.2) if small else (7.2, 1.45)
    with mpl.rc_context(STYLE):
        figure, axes = new_figure(width, height * len(panels) + 0.5, len(panels))
        for panel, (values, name) in zip(axes, panels, strict=True):
            _drawn(panel, motion.time / 60.0, values, SMALL_BINS if small else BINS)
            panel.set_ylabel(name)
        axes[-1].set_xlabel("time [min]")
        if panels[0][0].shape[1] > 1:
            legend(figure, axes[0], 3)
        return svg_of(figure)


def _drawn(panel: Axes, minutes: np.ndarray, values: np.ndarray, bins: int) -> None:
    """The columns of values (n, axes) over time."""
    for i, column in enumerate(values.T):
        at, low, high = envelope(minutes, column, bins)
        label = "xyz"[i] if values.shape[1] > 1 else None
        panel.fill_between(at, low, high, color=COLOURS[i], alpha=0.35, linewidth=0)
        panel.plot(at, high, color=COLOURS[i], linewidth=0.8, label=label)
        panel.plot(at, low, color=COLOURS[i], linewidth=0.8)
