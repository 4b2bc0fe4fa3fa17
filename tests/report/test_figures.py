"""Axes of pictures: what lies on them, and that each keeps its room."""

import warnings

import pytest

from pyimu.report.figures import new_figure, plain_logarithm, style, svg_of


@pytest.mark.parametrize("values", [(0.012, 0.019), (0.012, 0.03), (0.2, 700.0), (1.02, 1.04)])
def test_a_logarithmic_axis_leaves_its_panel_where_it_is(values):
    """Of less than an octave, too, in which no mark of a whole number lies."""
    with style(), warnings.catch_warnings():
        warnings.simplefilter("error")
        figure, panels = new_figure(5.4, 7.0, 3)
        for panel in panels:
            panel.plot([1, 2], values)
            panel.set_yscale("log")
            plain_logarithm(panel.yaxis)
        svg_of(figure)
    heights = [panel.get_window_extent().height for panel in panels]
    assert min(heights) == pytest.approx(max(heights), rel=0.1)
    assert sum(heights) > 0.75 * figure.bbox.height
