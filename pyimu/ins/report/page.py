"""The report of a navigated recording as one HTML page."""

from __future__ import annotations

from typing import Any

import numpy as np
from markupsafe import Markup

from pyimu.ins.outcome import Outcome
from pyimu.ins.report.pictures import (
    error_picture,
    nis_picture,
    path_picture,
    position_picture,
)
from pyimu.ins.report.words import TITLES, about, consistency, notes
from pyimu.report.numbers import number
from pyimu.report.page import Picture, Table, prose, quality_table, templates

TABLE = "navigation.parquet"
"""Name of the file with the estimates."""


def page(a: Outcome) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return templates("pyimu.ins.report").get_template("report.html").render(**_contents(a))


def _contents(a: Outcome) -> dict[str, Any]:
    return {
        "title": a.name,
        "about": about(a),
        "notes": notes(a),
        "summary": _summary(a),
        "path": _path(a),
        "position": _position(a),
        "error": _error(a) if a.errors else None,
        "consistency": consistency(a),
        "nis": _nis(a) if len(a.first_zupts) else None,
        "quality": quality_table((a.recording.name, [f for f in a.findings if f.count])),
        "files": Table(
            ("file", "what it is"),
            [
                (TABLE, prose("the estimates of each method, a row a sample")),
                (
                    "estimate.parquet",
                    prose("the recording with the best estimate as its motion, for other commands"),
                ),
                ("report.json", prose("the figures of this page as data, in SI")),
            ],
        ),
    }


def _summary(a: Outcome) -> Table:
    head = ("method", "end: east, north, up [m]", "± 2 std [m]")
    if a.errors:
        head += ("error at the end [m]", "RMS [m]", "yaw at the end [deg]")
    rows = []
    for name, track in a.tracks.items():
        std = track.position_std
        row: tuple = (
            prose(TITLES[name]),
            ", ".join(number(v) for v in track.position[-1]),
            "–" if std is None else ", ".join(number(2 * v) for v in std[-1]),
        )
        if a.errors:
            e = a.errors[name]
            yaw = f"{np.degrees(e.yaw):.3g}" if np.isfinite(e.yaw) else "–"
            row += (number(e.end), number(e.rms), yaw)
        rows.append(row)
    return Table(head, rows)


def _path(a: Outcome) -> Picture:
    caption = (
        "Path in the plane, from the start at 0, 0, with 95 % ellipses of the best estimate. Paths "
        "that leave the picture go on beyond it."
    )
    return Picture(Markup(path_picture(a)), caption, "path in the plane")


def _position(a: Outcome) -> Picture:
    caption = (
        "Position over time. Bands are two standard deviations to either side of filter and "
        "smoother."
    )
    return Picture(Markup(position_picture(a)), caption, "position over time")


def _error(a: Outcome) -> Picture:
    caption = (
        "Horizontal error against the reference, whose first position is taken for right; dashed "
        "what filter and smoother claim, the root of the two variances' sum."
    )
    return Picture(Markup(error_picture(a)), caption, "position error over time")


def _nis(a: Outcome) -> Picture:
    caption = (
        "Normalised innovation squared (three degrees of freedom) of the first zero velocity of "
        "each stop, which judges the drive before it. Above the band the sensors are worse than "
        "the part says, or the body still moved."
    )
    return Picture(Markup(nis_picture(a)), caption, "innovations of zero velocities")
