"""The numbers of a picture's curves: in the page, as CSV, and what zooms into them."""

import base64
import csv
import json

import numpy as np
import pytest
from matplotlib.figure import Figure

from pyimu.report.curves import MOST
from pyimu.report.figures import AFTER, BEFORE, style, svg_of
from pyimu.report.page import Markup, Picture, templates

X, LINE = np.arange(1.0, 6.0), np.array([1.0, 4.0, np.nan, 16.0, 25.0])


@pytest.fixture
def figure():
    """Two panels: a line, a band, and what has no name; a line of other abscissae."""
    figure = Figure()
    above, below = figure.subplots(2, 1)
    above.plot(X, LINE, color=BEFORE, ls="--", label="squares")
    above.fill_between(X, X - 1, X + 1, color=AFTER, label="its interval")
    above.plot(X, 2 * X, color="k")
    above.set(yscale="log", ylabel="y [mg]")
    below.plot([0.0, 0.5, 2.0], [3.0, 2.0, 1.0], label="other")
    below.plot(np.arange(MOST + 1.0), np.arange(MOST + 1.0), label="too long")
    below.set(xlabel="time [s]", ylabel="z [mg]")
    return figure


def picture(figure, curves=True):
    with style():
        drawn = svg_of(figure, curves)
    return Picture(Markup(drawn), "caption", 'squares & "others"')


def table(shown):
    text = base64.b64decode(shown.curves.table).decode()
    return list(csv.reader(text.splitlines()))


def test_the_table_has_the_points_of_the_lines_and_of_the_edges_of_a_band(figure):
    shown = picture(figure)
    (head, *rows), (above, below) = table(shown), json.loads(shown.curves.panels)

    def column(k):
        return np.array([float(r[k]) if r[k] else np.nan for r in rows])

    assert (above["ylog"], above["xlog"], above["ylabel"]) == (True, False, "y [mg]")
    assert [s["label"] for s in above["series"]] == [
        "squares",
        "its interval, low",
        "its interval, high",
    ]
    for series, want in zip(above["series"], (LINE, X - 1, X + 1), strict=True):
        np.testing.assert_array_equal(column(series["column"]), want)
    np.testing.assert_array_equal(column(above["x"]), X)
    np.testing.assert_array_equal(column(below["x"])[:3], [0.0, 0.5, 2.0])
    assert [s["label"] for s in below["series"]] == ["other"]
    assert above["series"][0] | {"dashed": True, "colour": "var(--before)"} == above["series"][0]
    assert head[above["x"]] == "time [s] (y [mg])" and above["xlabel"] == "time [s]"


def test_a_band_with_gaps_is_one_curve_with_empty_cells():
    """As where a log has no samples: two edges, and in each gap a point that has no ordinate."""
    figure = Figure()
    low = np.array([1.0, 2.0, np.nan, 4.0, np.nan, 6.0, 7.0])
    at = np.arange(7.0)
    figure.subplots().fill_between(at, low, low + 1, color=AFTER, label="x")
    shown = picture(figure)
    (_, *rows), (panel,) = table(shown), json.loads(shown.curves.panels)
    below, above = (s["column"] for s in panel["series"])
    assert [s["label"] for s in panel["series"]] == ["x, low", "x, high"]
    assert [float(r[panel["x"]]) for r in rows] == list(at)
    assert [r[below] for r in rows] == ["1", "2", "", "4", "", "6", "7"]
    assert [r[above] for r in rows] == ["2", "3", "", "5", "", "7", "8"]


def test_a_page_carries_the_script_and_its_licence_once_where_there_are_curves(figure):
    page = templates("pyimu.report").from_string(
        '{% extends "page.html" %}{% from "parts.html" import picture %}'
        "{% block body %}{% for p in shown %}{{ picture(p) }}{% endfor %}{% endblock %}"
    )
    shown = picture(figure)
    text = page.render(shown=[shown, shown])
    assert text.count("var uPlot=") == 1 and "Leon Sorokin" in text and "Permission is" in text
    assert text.count('download="squares_others.csv"') == 2
    assert "<metadata" not in text and text.count("</script>") == 1
    without = page.render(shown=[picture(figure, False)])
    assert "<script" not in without and picture(figure, False).curves is None


def test_a_picture_is_the_same_with_and_without(figure):
    assert picture(figure).drawn == picture(figure, False).svg
