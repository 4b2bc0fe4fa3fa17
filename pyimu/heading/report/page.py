"""The report of the heading by several methods as one HTML page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from markupsafe import Markup

from pyimu.heading.outcome import Outcome
from pyimu.heading.report.pictures import (
    error_picture,
    estimates_picture,
    runs_picture,
    transfer_picture,
)
from pyimu.heading.report.words import (
    CALIBRATION_HEAD,
    HEAD,
    PAIRED_HEAD,
    about,
    calibration_rows,
    error_rows,
    paired_rows,
    remarks,
    transfer_words,
)
from pyimu.report.page import Picture, Table, prose, quality_table, templates

TABLE = "heading.parquet"
"""Name of the file with the headings."""

SHOWN = 10
"""Characters of the title that name logs, at most so many logs."""


def page(found: Outcome) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return templates("pyimu.heading.report").get_template("report.html").render(**_contents(found))


def _contents(found: Outcome) -> dict[str, Any]:
    logs = found.recordings
    has_error = any(len(m.errors) for m in found.methods)
    return {
        "title": logs[0].name if len(logs) == 1 else f"{logs[0].name} and {len(logs) - 1} more",
        "about": about(found),
        "notes": list(remarks(found)),
        "errors": Table(HEAD, error_rows(found)),
        "words": Table(
            ("method", "what it does"), [(m.name, prose(m.words)) for m in found.methods]
        ),
        "paired": Table(PAIRED_HEAD, paired_rows(found)),
        "calibrations": Table(CALIBRATION_HEAD, calibration_rows(found)),
        "over_time": _picture(
            error_picture,
            found,
            f"Heading error over {found.methods[0].tracks[0].name}, estimate less reference; the "
            "band is two standard deviations of the filter.",
            "heading error over time",
        )
        if has_error
        else None,
        "runs": _picture(
            runs_picture,
            found,
            "The error of each log at its end, by method.",
            "errors of all runs",
        )
        if has_error and len(logs) > 1
        else None,
        "estimates": _picture(
            estimates_picture,
            found,
            "Bias and scale factor as the filter has them, with two standard deviations.",
            "bias and scale factor over time",
        )
        if any(m.tracks[0].filter is not None for m in found.methods)
        else None,
        "transfer": _transfer(found),
        "quality": quality_table(*((r.name, r.findings) for r in logs)),
        "files": Table(
            ("file", "what it is"),
            [
                (TABLE, prose("the heading of the first log by each method, a row a sample")),
                ("report.json", prose("the figures of this page as data, in SI")),
            ],
        ),
    }


def _picture(draw: Callable[[Outcome], str], found: Outcome, caption: str, alt: str) -> Picture:
    return Picture(Markup(draw(found)), caption, alt)


def _transfer(found: Outcome) -> dict[str, Any] | None:
    if found.transfer is None:
        return None
    caption = (
        "What each plateau of the rate table differs from slope, asymmetry and bias, in percent of "
        "the range."
    )
    return {
        "words": transfer_words(found.transfer),
        "picture": _picture(transfer_picture, found, caption, "residual of the rate transfer"),
    }
