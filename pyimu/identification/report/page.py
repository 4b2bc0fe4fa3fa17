"""The report of ``close``: one page for people, the same as report.json has for programs."""

from __future__ import annotations

from typing import Any

from markupsafe import Markup

from pyimu.identification.model.as_part import SENSORS
from pyimu.identification.outcome import Outcome
from pyimu.identification.report.candidates import fate_table, observability_table, screenings
from pyimu.identification.report.coefficients import LEGEND
from pyimu.identification.report.errors import (
    by_log_table,
    error_notes,
    error_table,
    over_time,
    spectra,
)
from pyimu.identification.report.logs import (
    lag_pictures,
    log_states,
    overview_table,
    overviews,
    reference_table,
)
from pyimu.identification.report.model import added, changed_table, models, remains
from pyimu.identification.report.next import next_table
from pyimu.identification.report.words import headline
from pyimu.model.kinds import KINDS
from pyimu.report.page import Table, file_name, prose, quality_table, templates

MODEL, FORMULA = "model.toml", "found_effect.py"


def page(closed: Outcome, fmus: tuple[str, ...] = (), left_out: str | None = None) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return (
        templates("pyimu.identification.report")
        .get_template("report.html")
        .render(**_contents(closed, fmus, left_out))
    )


def _contents(closed: Outcome, fmus: tuple[str, ...], left_out: str | None) -> dict[str, Any]:
    return {
        "verdict": closed.verdict,
        "headline": headline(closed),
        "about": _about(closed),
        "simulated": closed.simulated,
        "overview": overview_table(closed),
        "overviews": overviews(closed),
        "over_time": over_time(closed),
        "errors": error_table(closed),
        "error_notes": error_notes(closed),
        "by_log": by_log_table(closed),
        "log_states": log_states(closed),
        "references": reference_table(closed),
        "lags": lag_pictures(closed),
        "models": models(closed),
        "legend": LEGEND,
        "added": [added(closed, a) for a in closed.added],
        "changed": changed_table(closed),
        "remains": remains(closed),
        "screenings": screenings(closed),
        "fates": fate_table(closed),
        "observability": observability_table(closed.observability),
        "next": next_table(closed),
        "spectra": spectra(closed),
        "quality": quality_table(("", closed.quality)),
        "files": _files(closed, fmus, left_out),
        "made_with": closed.made_with,
        "digests": _digests(closed),
    }


def _about(closed: Outcome) -> str:
    count = len(closed.recordings)
    return f"{count} recording{'s' * (count != 1)}, part {closed.before.name}"


def _files(closed: Outcome, fmus: tuple[str, ...], left_out: str | None) -> Table:
    rows = [
        ("report.json", "everything of this page as data"),
        (MODEL, "the model with what was added, each coefficient with its interval and its source"),
    ]
    if closed.formulas:
        use = f"the formula as an effect of your own: {MODEL} needs --effects {FORMULA}"
        rows.append((FORMULA, use))
    if left_out:
        rows.append(("*.fmu", left_out))
    return Table(
        ("file", "what it is"),
        [(name, prose(text)) for name, text in (*rows, *((f, _unit_of(closed, f)) for f in fmus))],
    )


def _unit_of(closed: Outcome, name: str) -> str:
    before = name.startswith("before/")
    part = closed.before if before else closed.after
    passed = [SENSORS[k] for k in closed.not_examined if k in KINDS and not part.sensor(k).effects]
    unchanged = f"; it passes the {' and '.join(passed)} on unchanged, which was not examined"
    return (
        f"the sensor {'as it was' if before else 'with what was added'}, as a co-simulation unit"
        f"{unchanged if passed else ''}"
    )


def _digests(closed: Outcome) -> Table:
    made = closed.made_with
    return Table(
        ("input", "SHA-256"),
        [
            (file_name(name), Markup('<code class="words">{}</code>').format(digest))
            for name, digest in (made.files if made else ())
        ],
    )
