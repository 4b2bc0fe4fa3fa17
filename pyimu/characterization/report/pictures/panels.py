"""What the pictures have in common: three panels above each other, an axis of the sensor each."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pyimu.model.part import AXES
from pyimu.report.figures import GREY, new_figure, plain_logarithm

WIDTH = 5.4
"""Width of a picture [inch]."""

PANEL = 2.15
"""Height of a panel [inch]."""

FITTED = (0, (5, 2))
"""Line style of a fit."""


def axis_panels(height: float = PANEL) -> tuple[Figure, list[Axes]]:
    """A figure with a panel of this height [inch] for each axis."""
    return new_figure(WIDTH, 0.7 + height * len(AXES), len(AXES))


def logarithmic(panels: Sequence[Axes]) -> None:
    """Make the axes logarithmic; a panel without a curve says so."""
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
