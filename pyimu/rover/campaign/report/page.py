"""The summary of a campaign as one HTML page."""

from __future__ import annotations

from typing import Any

import numpy as np
from markupsafe import Markup

from pyimu.report.numbers import MISSING, number
from pyimu.report.page import Picture, Table, prose, templates
from pyimu.rover.campaign.faults import NONE
from pyimu.rover.campaign.report.pictures import (
    causes_picture,
    errors_picture,
    faults_picture,
    honesty_picture,
)
from pyimu.rover.campaign.report.words import degrees, lines, plain_name, share
from pyimu.rover.campaign.score import ANGLES, FREEDOM
from pyimu.rover.campaign.sensitivity import LEVEL
from pyimu.rover.campaign.settings import Settings
from pyimu.rover.campaign.summary import TARGETS, Quantile, Summary, explained

CAUSES = 10
"""Parameters in a table of causes."""


def page(settings: Settings, s: Summary) -> str:
    """The page, which needs nothing beside it."""
    report = templates("pyimu.rover.campaign.report").get_template("report.html")
    return report.render(**_contents(settings, s))


def _contents(settings: Settings, s: Summary) -> dict[str, Any]:
    sound = bool(s.sound.any())
    causes = sound and any(s.causes.values())
    return {
        "title": f"{settings.part.name}, {settings.drive}: {s.runs:,} runs",
        "about": about(settings, s),
        "lines": lines(s),
        "errors": _errors(s) if sound else None,
        "errors_picture": _errors_picture(s) if sound else None,
        "honesty": _honesty(s) if sound else None,
        "honesty_picture": _honesty_picture(s) if sound else None,
        "causes": _causes(s) if causes else None,
        "causes_picture": _causes_picture(s) if causes else None,
        "faults": _faults(s) if s.fault_names != [NONE] else None,
        "faults_picture": _faults_picture(s) if s.fault_names != [NONE] else None,
        "files": _files(),
    }


def about(settings: Settings, s: Summary) -> str:
    """What the campaign is, in a sentence or two."""
    filtered = settings.sensor_rate / settings.every
    heading = (
        f"a heading of {degrees(settings.heading_std)} deg every {settings.heading_every:g} s"
        if settings.heading_every
        else "no heading sensor"
    )
    parts = "a specimen of the part each" if settings.draws_specimens else "the nominal part"
    return (
        f"{s.runs:,} drives, {parts}; sensors at {settings.sensor_rate:g} Hz, the filter at "
        f"{filtered:.4g} Hz, {heading}. Seed {settings.seed}: pyimu campaign repeats a run with "
        "--run and its number."
    )


def _errors(s: Summary) -> Table:
    head = ("error [deg]", "runs", *(f"{p.p:.0%}" for p in s.quantiles("steps")))
    rows = []
    for name in reversed(ANGLES):
        for kind, words in (("max", "largest"), ("rms", "root mean square"), ("end", "at the end")):
            found = s.quantiles(f"{name}_error_{kind} [rad]")
            rows.append((f"{name}, {words}", f"{s.sound.sum()}", *(_quantile(q) for q in found)))
    return Table(head, rows)


def _quantile(q: Quantile) -> Markup:
    ends = [degrees(v) if np.isfinite(v) else "more" for v in (q.low, q.high)]
    return Markup("{} <small>{} to {}</small>").format(degrees(q.value), *ends)


def _honesty(s: Summary) -> Table:
    rows = []
    for name in FREEDOM:
        h = s.honesty(name)
        rows.append(
            (
                name,
                f"{h.freedom}",
                number(h.mean),
                f"{number(h.bounds[0])} to {number(h.bounds[1])}",
                share(h.inside),
                number(h.over_time),
            )
        )
    head = ("error", "degrees of freedom", "mean at the end", f"{LEVEL:.0%} bounds of that mean")
    return Table((*head, f"runs within the {LEVEL:.0%} of one", "mean over the drive"), rows)


def _causes(s: Summary) -> list[tuple[str, Table]]:
    out = []
    for target in TARGETS:
        rows = [
            (plain_name(i.factor), f"{i.value:.3f}", f"{i.low:.3f} to {i.high:.3f}", _beyond(i, s))
            for i in s.causes[target][:CAUSES]
        ]
        rest = 1 - explained(s.causes[target])
        rows.append((prose("noise, start, and what acts together"), f"{rest:.3f}", MISSING, ""))
        head = ("parameter", "first-order index", f"{LEVEL:.0%}", "")
        out.append((plain_name(target).replace("_", " "), Table(head, rows)))
    return out


def _beyond(index: Any, s: Summary) -> str:
    return "" if index.value > s.chance else "as chance would"


def _faults(s: Summary) -> Table:
    rows = []
    for name in s.fault_names:
        flags = ", ".join(f"{words} {f.value:.0%}" for words, f in s.flags(name).items())
        half, _, most, _ = s.quantiles("heading_error_max [rad]", name)
        tilt = max(
            s.quantiles(f"{angle}_error_max [rad]", name)[2].value for angle in ("pitch", "roll")
        )
        count = f"{len(s.of_fault(name, 'run'))}"
        cells = (degrees(half.value), degrees(most.value), degrees(tilt), prose(flags or "none"))
        rows.append((name, count, *cells))
    head = ("fault", "runs", "heading [deg], 50 %", "95 %", "tilt [deg], 95 %")
    return Table((*head, "what the filter's status said"), rows)


def _errors_picture(s: Summary) -> Picture:
    caption = (
        "Largest error of each run without fault from the start of its drive on, with the errors "
        "below which 50 % (line) and 95 % (dashed) of the runs stay, and 2 deg (coloured) where "
        "some are beyond. The largest half per cent may lie beyond the axis."
    )
    return Picture(Markup(errors_picture(s)), caption, "histograms of the largest errors")


def _honesty_picture(s: Summary) -> Picture:
    caption = (
        "Normalised errors squared at the end of the runs, in twentieths of their chi-square "
        "distribution: where the filter is as good as it says, each bar is at the dashed line. "
        "More on the right: it says less than its error; more on the left: more."
    )
    return Picture(Markup(honesty_picture(s)), caption, "normalised errors by percentile")


def _causes_picture(s: Summary) -> Picture:
    caption = (
        "First-order indices by RBD-FAST with 95 % intervals. The dashed line is what a parameter "
        f"without effect may reach by chance ({s.chance:.3f} with 5 % for all together)."
    )
    return Picture(Markup(causes_picture(s)), caption, "first-order indices of the parameters")


def _faults_picture(s: Summary) -> Picture:
    caption = "Largest heading error by what failed."
    return Picture(Markup(faults_picture(s)), caption, "heading errors by fault")


def _files() -> Table:
    rows = [
        ("runs.parquet", prose("a row a run: its draws, its errors, what the filter said of them")),
        ("report.json", prose("the figures of this page as data, in SI")),
        ("campaign.json", prose("the settings; with a run's number all that the run follows from")),
        ("parts", prose("the same rows as they came, from which a campaign goes on")),
    ]
    return Table(("file", "what it is"), rows)
