"""The report of the attitude filter as one HTML page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from markupsafe import Markup

from pyimu.attitude.outcome import NIS_BOUNDS, Outcome
from pyimu.attitude.report.pictures import (
    angles_picture,
    bias_picture,
    error_picture,
    nis_picture,
    status_picture,
)
from pyimu.attitude.report.words import (
    ALIGNED,
    FREEDOM,
    about,
    claimed_inclination,
    error_sizes,
    gravity_used,
    heading_from,
    last_attitude,
    last_bias,
    notes,
    reference_words,
)
from pyimu.report.numbers import number
from pyimu.report.page import Picture, Table, prose, quality_table, templates

TABLE = "attitude.parquet"
"""Name of the file with the estimates."""


def page(a: Outcome) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return templates("pyimu.attitude.report").get_template("report.html").render(**_contents(a))


def _contents(a: Outcome) -> dict[str, Any]:
    return {
        "title": a.name,
        "about": about(a),
        "notes": notes(a),
        "summary": _summary(a),
        "error": _error(a),
        "angles": _angles(a),
        "bias": _bias(a),
        "gravity": gravity_used(a),
        "nis": _nis(a) if a.updates.any() else None,
        "status": _status(a),
        "events": _events(a),
        "quality": quality_table((a.recording.name, a.findings)),
        "files": Table(
            ("file", "what it is"),
            [
                (TABLE, prose("the estimates and their standard deviations, a row a sample")),
                ("report.json", prose("the figures of this page as data, in SI")),
            ],
        ),
    }


def _summary(a: Outcome) -> Table:
    rows = [
        ("last attitude", prose(last_attitude(a))),
        ("last gyro bias", prose(last_bias(a))),
        ("quasi-static", prose(gravity_used(a))),
    ]
    if a.magnetometer.used:
        rows.append(("heading", prose(heading_from(a))))
    return Table(("", "at the end, and over the log"), rows)


def _error(a: Outcome) -> dict[str, Any] | None:
    if a.error is None:
        return None
    claimed = {"inclination": f"{number(np.degrees(claimed_inclination(a)))} deg"}
    rows = [
        (
            name,
            f"{number(np.degrees(rms))} deg",
            f"{number(np.degrees(most))} deg",
            claimed.get(name, "–"),
        )
        for name, (rms, most) in error_sizes(a.error).items()
    ]
    caption = (
        "Error against the reference, from the least to the largest of the samples that share a "
        "column of the picture, and the root mean square that is claimed of the inclination."
    )
    return {
        "assumed": f"Over {len(a.error.time):,} rows: {ALIGNED}.",
        "other": reference_words(a),
        "sizes": Table(("", "RMS", "95 % below", "RMS claimed"), rows),
        "picture": _picture(error_picture, a, caption, "attitude error over time"),
    }


def _picture(draw: Callable[[Outcome], str], a: Outcome, caption: str, alt: str) -> Picture:
    return Picture(Markup(draw(a)), caption, alt)


def _angles(a: Outcome) -> Picture:
    reference = " and that of the reference" if a.error is not None else ""
    kind = "Smoothed attitude" if a.smoothed else "Attitude"
    caption = (
        f"{kind}, body to world (east-north-up){reference}, without jumps by whole turns. The "
        "band is two standard deviations to either side, to first order, with the tilt's for both "
        "of its axes; it is large for roll and yaw where the nose points up or down."
    )
    return _picture(angles_picture, a, caption, "roll, pitch and yaw over time")


def _bias(a: Outcome) -> Picture:
    caption = (
        f"{'Smoothed gyro' if a.smoothed else 'Gyro'} bias, what remains of the compensated rate, "
        "and two standard deviations."
    )
    return _picture(bias_picture, a, caption, "gyro bias over time")


def _nis(a: Outcome) -> Picture:
    low, high = NIS_BOUNDS
    caption = (
        f"Normalised innovation squared of gravity's updates on a quasi-static body ({FREEDOM})"
        f"{', of the filter before it was smoothed' if a.smoothed else ''}: "
        f"95 % of them should lie between {low:.3g} and {high:.3g}. Lower, the accelerometer is "
        "better than the filter takes it for; higher, worse."
    )
    return _picture(nis_picture, a, caption, "normalised innovations squared over time")


def _status(a: Outcome) -> Picture:
    caption = (
        "Which share of the samples is quasi-static, so that a sample of the force shows gravity "
        "(in motion a velocity that stays bounded tells tilt from acceleration)"
        + (", and where a bit of the status was set." if a.events else "; no bit of the status.")
    )
    return _picture(status_picture, a, caption, "quasi-static samples and status over time")


def _events(a: Outcome) -> Table:
    return Table(
        ("bit", "what it says", "samples", "share", "first", "last"),
        [
            (
                f"{e.bit}",
                prose(e.text),
                f"{e.samples:,}",
                f"{e.samples / len(a.time):.2%}",
                f"{e.first:.2f} s",
                f"{e.last:.2f} s",
            )
            for e in a.events
        ],
    )
