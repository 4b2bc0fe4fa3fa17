"""The report of ``characterize`` as one HTML page."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from markupsafe import Markup

from pyimu.characterization.evidence import Excerpt, LevelHistogram, StepHistogram, Timeline
from pyimu.characterization.outcome import Channel, LogResult, Outcome
from pyimu.characterization.report.beside import beside_tables
from pyimu.characterization.report.channel_notes import (
    bandwidth_sentence,
    fit_notes,
    headline,
    loop_sentence,
    searched,
    spectrum_note,
    thermal_sentence,
)
from pyimu.characterization.report.log_notes import about, notes, what_it_is, why_no_part
from pyimu.characterization.report.magnetometer import magnetometer_lines
from pyimu.characterization.report.pictures.allan import allan_picture, deviations_picture
from pyimu.characterization.report.pictures.evidence import evidence_picture
from pyimu.characterization.report.pictures.overview import overview_picture
from pyimu.characterization.report.pictures.spectrum import spectrum_picture
from pyimu.characterization.report.pictures.temperature import temperature_picture
from pyimu.characterization.report.tables import (
    coefficient_table,
    line_table,
    log_table,
    model_table,
)
from pyimu.characterization.report.terminal import in_lines
from pyimu.display import notebook
from pyimu.model.part import AXES
from pyimu.report.findings import SENSORS
from pyimu.report.page import Picture, Table, prose, quality_table, templates

PART = "part.toml"
"""Name of the part's file."""

MAGNETOMETER = "magnetometer.toml"
"""Name of the file of the magnetometer's calibration."""


def page(c: Outcome) -> str:
    """The report as one HTML page that needs nothing beside it."""
    return (
        templates("pyimu.characterization.report")
        .get_template("report.html")
        .render(**_contents(c))
    )


def in_notebook(c: Outcome) -> str:
    """Headline, Allan deviations and the lines of a terminal, for a notebook."""
    pictures = [
        notebook.picture(_allan(c, kind).svg) for kind in c.kinds if _characterised(c, kind)
    ]
    return notebook.block("Characterization", _opening(c), *pictures, notebook.lines(in_lines(c)))


def _opening(c: Outcome) -> str:
    """Noise of each sensor, or why there is none to be told."""
    return " ".join(why_no_part(c)) or headline(c)


def _contents(c: Outcome) -> dict[str, Any]:
    return {
        "title": ", ".join(log.name for log in c.logs),
        "headline": _opening(c),
        "logs": [f"{log.name}: {about(log)}" for log in c.logs],
        "notes": notes(c),
        "level": f"{100 * c.level:g}",
        "sensors": [_sensor(c, kind) for kind in c.kinds],
        "thermal": _thermal(c),
        "thermal_reasons": _thermal_reasons(c),
        "magnetometer": magnetometer_lines(c),
        "quality": quality_table(*((log.name, log.findings) for log in c.logs)),
        "evidence": _evidence(c),
        "overviews": [_overview(log, kind) for log in c.logs for kind in log.sensors],
        "by_log": log_table(c),
        "beside": beside_tables(c),
        "data_sheet": c.part_given and f"{c.part_given.name}: {c.part_given.description}",
        "files": Table(
            ("file", "what it is"),
            [
                ("report.json", prose("everything of this page as data, and all curves")),
                *[(PART, prose("the part, for pyimu build, pyimu close and pyimu parts"))][
                    : not c.no_part
                ],
                *[(MAGNETOMETER, prose("the calibration, for pyimu attitude --magnetometer"))][
                    : c.magnetometer is not None
                ],
            ],
        ),
    }


# A sensor


def _sensor(c: Outcome, kind: str) -> dict[str, Any]:
    if not _characterised(c, kind):
        empty = Table(("",))
        return {
            "name": SENSORS[kind],
            "allan": None,
            "coefficients": empty,
            "models": empty,
            "notes": [],
            "others": None,
            "spectra": [],
            "lines": empty,
            "searched": [],
        }
    logs = [log for log in c.logs if kind in log.sensors]
    spectra = [_spectrum(log, kind, _named(c, kind), len(c.logs) > 1) for log in logs]
    return {
        "name": SENSORS[kind],
        "what": what_it_is(c, kind),
        "allan": _allan(c, kind),
        "coefficients": coefficient_table(c, kind),
        "models": model_table(c, kind),
        "notes": _notes(c, kind),
        "others": _deviations(c, kind),
        "spectra": [p for p in spectra if p is not None],
        "lines": line_table(c, kind),
        "searched": [
            *(f"{said}." for said in _bandwidths(logs, kind)),
            *dict.fromkeys(searched(log.sensors[kind]) for log in logs),
        ],
    }


def _bandwidths(logs: Iterable[LogResult], kind: str) -> Iterable[str]:
    """Where the noise of the channels rolls off."""
    return (
        f"{ch.name}: {bandwidth_sentence(ch)}"
        for log in logs
        for ch in log.sensors[kind].channels
        if ch.bandwidth is not None
    )


def _characterised(c: Outcome, kind: str) -> bool:
    return any(ch.noise for axis in AXES for ch in c.channel(f"{kind}_{axis}"))


def _named(c: Outcome, kind: str) -> str:
    """The sensor, and what is seen of it where that is not its own noise."""
    what = what_it_is(c, kind)
    return SENSORS[kind].capitalize() + (f", {what}" if what else "")


def _allan(c: Outcome, kind: str) -> Picture:
    name = SENSORS[kind]
    interval = (
        f" {len(c.logs)} logs."
        if len(c.logs) > 1
        else " The interval is that of the degrees of freedom which the fitted noise leaves."
    )
    caption = (
        f"{_named(c, kind)}: overlapping Allan deviation, measured and fitted; dotted, each term "
        f"of the fit by itself.{interval}"
    )
    return Picture(Markup(allan_picture(c, kind)), caption, f"Allan deviation of the {name}")


def _deviations(c: Outcome, kind: str) -> Picture:
    name = SENSORS[kind]
    where = f" Log {c.logs[0].name}." if len(c.logs) > 1 else ""
    caption = (
        f"{_named(c, kind)}: the modified deviation tells quantization from white noise, the "
        f"Hadamard deviation does not see a ramp.{where}"
    )
    svg = Markup(deviations_picture(c, kind))
    return Picture(svg, caption, f"further deviations of the {name}")


def _notes(c: Outcome, kind: str) -> list[str]:
    """Notes on the fits and the spectra; those of several channels alike are one."""
    found = (
        (log.name if len(c.logs) > 1 else "", text, ch.name)
        for log in c.logs
        if kind in log.sensors
        for i, ch in enumerate(log.sensors[kind].channels)
        for text in (fit_notes(ch), spectrum_note(log.sensors[kind], i))
    )
    alike: dict[tuple[str, str], list[str]] = {}
    for log, text, channel in found:
        if text:
            alike.setdefault((log, text), []).append(channel)
    return [
        f"{log}{', ' if log else ''}{', '.join(channels)}: {text}."
        for (log, text), channels in alike.items()
    ]


def _spectrum(log: LogResult, kind: str, named: str, several: bool) -> Picture | None:
    svg = spectrum_picture(log.sensors[kind])
    if svg is None:
        return None
    removed = " and ".join(
        n
        for n in ("temperature", "warm-up")
        if any(n in ch.compensated_for for ch in log.sensors[kind].channels)
    )
    compensated = (
        f" The samples are as measured, the noise is that without {removed}." if removed else ""
    )
    where = f" Log {log.name}." if several else ""
    caption = (
        f"{named}: root of the one-sided power spectral density (Welch, Hann "
        "window, averaged in logarithm) and "
        "the noise fitted to the Allan deviation, also one-sided: white noise N lies at √2 "
        f"N.{compensated}{where}"
    )
    return Picture(Markup(svg), caption, f"spectrum of the {SENSORS[kind]}")


# Temperature


def _thermal(c: Outcome) -> list[Picture]:
    return [
        _temperature(ch, f", {log.name}" if len(c.logs) > 1 else "")
        for log in c.logs
        for ch in log.channels
        if ch.thermal is not None
    ]


def _temperature(ch: Channel, where: str) -> Picture:
    caption = f"{ch.name}{where}: {thermal_sentence(ch)}. {_sentence(loop_sentence(ch))}"
    svg = Markup(temperature_picture(ch))
    return Picture(svg, caption, f"bias of {ch.name} against temperature", small=True)


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}." if text else ""


def _thermal_reasons(c: Outcome) -> list[str]:
    """Why there is no effect of temperature, and of which channels."""
    found = [
        (ch.thermal_reason, f"{log.name}: {ch.name}")
        for log in c.logs
        for ch in log.channels
        if ch.thermal is None and ch.thermal_reason
    ]
    reasons = _by_reason(found)
    # The reason alone, where it is that of all channels.
    alone = len(reasons) == 1 and len(found) == sum(1 for log in c.logs for _ in log.channels)
    return [
        _sentence(reason) if alone else f"{', '.join(who)}: {reason}."
        for reason, who in reasons.items()
    ]


def _by_reason(found: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    reasons: dict[str, list[str]] = {}
    for reason, who in found:
        reasons.setdefault(reason, []).append(who)
    return reasons


# Quality


CAPTIONS = {
    Excerpt: "the samples around the first",
    LevelHistogram: "the levels that the samples keep to",
    StepHistogram: "how long the steps of the time are",
    Timeline: "where there are samples",
}


def _evidence(c: Outcome) -> list[Picture]:
    made = []
    for log in c.logs:
        for (kind, column), found in log.evidence.items():
            where = f", {log.name}" if len(c.logs) > 1 else ""
            caption = f"{kind.replace('_', ' ')}, {column}{where}: {CAPTIONS[type(found)]}."
            svg = Markup(evidence_picture(found, column.partition(" ")[0]))
            made.append(
                Picture(svg, caption.capitalize() if not where else caption, caption, small=True)
            )
    return made


def _overview(log: LogResult, kind: str) -> Picture:
    caption = (
        f"{SENSORS[kind].capitalize()}, {log.name}: least, mean and largest sample in equal parts "
        "of the log."
    )
    return Picture(Markup(overview_picture(log, kind)), caption, f"{SENSORS[kind]} over time")
