"""The test drives as one HTML page."""

from __future__ import annotations

from typing import Any

from markupsafe import Markup

from pyimu.report.page import Picture, Table, prose, templates
from pyimu.rover.outcome import DriveRuns, RoverOutcome
from pyimu.rover.pictures import errors_picture, over_time
from pyimu.rover.words import HEAD, MADE, findings, table


def page(o: RoverOutcome) -> str:
    """The page, which needs nothing beside it."""
    return templates("pyimu.rover").get_template("rover.html").render(**_contents(o))


def _contents(o: RoverOutcome) -> dict[str, Any]:
    return {
        "part": o.known.name,
        "made": MADE,
        "table": Table(HEAD, [(prose(row[0]), prose(row[1]), *row[2:]) for row in table(o)]),
        "seeds": len(o.seeds),
        "findings": findings(o),
        "errors": _errors(o),
        "drives": [_over_time(o, r) for r in o.runs],
    }


def _errors(o: RoverOutcome) -> Picture:
    caption = (
        f"Heading error of the first of {len(o.seeds)} noises, set right where the rover starts; "
        "the band is two standard deviations of what the declared noise of the gyro makes of a "
        "heading that nothing corrects."
    )
    return Picture(Markup(errors_picture(o)), caption, "heading error over time of each drive")


def _over_time(o: RoverOutcome, r: DriveRuns) -> tuple[str, Picture]:
    caption = (
        "Heading, pitch and roll by the optical reference, the integrated gyros, the filter as "
        "published and our filter with the loop closed; the first of the noises."
    )
    alt = f"attitude over time, {r.paper.title}"
    return r.paper.title.capitalize(), Picture(Markup(over_time(o, r)), caption, alt)
