"""A plan as one HTML page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from markupsafe import Markup

from pyimu.display.silent import silent
from pyimu.identification.model.as_part import SENSORS
from pyimu.identification.plan.motions import Motion
from pyimu.identification.plan.outcome import Log, Outcome, Pair, Predicted
from pyimu.identification.plan.pictures import motion_picture
from pyimu.identification.plan.words import (
    by_reason,
    headline,
    lasting,
    place,
    si_unit,
)
from pyimu.model.catalogue import CATALOGUE
from pyimu.report.numbers import MISSING, number, quantity
from pyimu.report.page import Picture, Table, both, prose, templates


def page(p: Outcome, heard: Callable[[float], None] = silent) -> str:
    """The plan as one HTML page that needs nothing beside it.

    ``heard`` hears which share of its pictures is drawn.
    """
    contents = _contents(p, heard)
    return templates("pyimu.identification.plan").get_template("plan.html").render(**contents)


def _contents(p: Outcome, heard: Callable[[float], None]) -> dict[str, Any]:
    logs, own = [*zip(p.files(), p.logs), *((None, log) for log in p.library)], len(p.logs)
    pictures = []
    for i, (name, log) in enumerate(logs):
        heard(i / len(logs))
        pictures.append(_of_library(log) if name is None else _of_log(name, log))
    return {
        "part": p.part,
        "sensor": SENSORS[p.kind],
        "headline": headline(p),
        "noise": p.noise,
        "of_class": p.of_class,
        "sigmas": number(p.sigmas, 2),
        "steps": steps_table(p),
        "pictures": pictures[:own],
        "effects": [_effect(p, name) for name in p.effects],
        "library": library_table(p),
        "motions": pictures[own:],
        "pairs": pairs_table(p),
        "hidden": hidden_table(p),
        "notes": [f"{n[0].upper()}{n[1:]}." for n in p.notes],
        "files": Table(
            ("file", "what it is"),
            [
                *((name, prose(_file_text(log))) for name, log in zip(p.files(), p.logs)),
                ("plan.json", prose("everything of this page as data")),
            ],
        ),
    }


def _file_text(log: Log) -> str:
    return (
        f"the motion as a recording, {lasting(sum(s.duration for s in log.steps))}: rate, specific "
        "force and temperature, a row every "
        f"{number(log.recording.sample_period, 3)} s; {_use([s.motion for s in log.steps])}"
    )


def _use(motions: Sequence[Motion]) -> str:
    """What the recording of motions is good for."""
    if all(m.still for m in motions):
        return "at rest pyimu close needs no reference"
    if all(m.driven for m in motions):
        return (
            "a rate table or a shaker makes it as it stands here, and for pyimu close it is then "
            "the --reference of the sensor's own log"
        )
    return (
        "to look at: no hand and no vehicle moves twice the same way, so the reference for pyimu "
        "close is what tracked the motion, or gravity where the part lies still"
    )


def steps_table(p: Outcome) -> Table:
    return Table(
        ("motion", "what to do", "times", "duration"),
        [
            (
                s.motion.name.replace("_", " "),
                prose(f"{s.motion.text[0].upper()}{s.motion.text[1:]}."),
                f"{s.times}",
                lasting(s.duration),
            )
            for s in p.steps
        ],
    )


def _of_log(name: str, log: Log) -> Picture:
    text = f"{name}: rate, specific force and temperature."
    return Picture(Markup(motion_picture(log.recording)), text, f"motion of {name}")


def _of_library(log: Log) -> Picture:
    (step,) = log.steps
    name = step.motion.name.replace("_", " ")
    text = f"{name}: {step.motion.text}"
    return Picture(Markup(motion_picture(log.recording, small=True)), text, name, small=True)


def _effect(p: Outcome, name: str) -> dict[str, Any]:
    own = [q for q in p.predicted if q.goal.key.effect == name and np.isfinite(q.std)]
    e = CATALOGUE[name]
    return {
        "name": name.replace("_", " "),
        "term": e.term,
        "table": Table(
            ("coefficient", "size", "wanted", "standard error", "size over it"),
            [_predicted(q) for q in own],
        ),
    }


def _predicted(q: Predicted) -> tuple:
    si = si_unit(q)
    size = MISSING if q.goal.size is None else f"{quantity(q.goal.size, si, 2)} {q.goal.source}"
    wanted = MISSING if q.goal.wanted is None else f"{quantity(q.goal.wanted, si, 2)}"
    return place(q), size, wanted, both(q.std, si), number(q.sigmas, 2)


def library_table(p: Outcome) -> Table:
    """Motion x effect: the standard error of the least known coefficient that is shown."""
    head = ("motion", "once takes", *(n.replace("_", " ") for n in p.effects))
    return Table(head, [_of_motion(p, m) for m in p.motions])


def _of_motion(p: Outcome, m: Motion) -> tuple:
    cells = [_worst(p, m, n) for n in p.effects]
    return m.name.replace("_", " "), lasting(m.duration), *cells


def _worst(p: Outcome, m: Motion, effect: str) -> Any:
    main = [q for q in p.predicted if q.goal.key.effect == effect]
    main = [q for q in main if q.goal.wanted is not None] or main
    errors = [p.by_motion[m.name].get(q.goal.key, np.inf) for q in main]
    shown = [v for v in errors if np.isfinite(v)]
    if not shown:
        return MISSING
    text = f"±{quantity(max(shown), si_unit(main[0]), 2)}"
    left = "" if len(shown) == len(errors) else f"{len(shown)} of {len(errors)} coefficients"
    sigmas = [
        q.goal.size / v for q, v in zip(main, errors, strict=True) if q.goal.size and np.isfinite(v)
    ]
    said = ", ".join(t for t in (f"{number(min(sigmas), 2)} σ" if sigmas else "", left) if t)
    return Markup("{}<small>{}</small>").format(text, said)


def pairs_table(p: Outcome) -> Table:
    """Motion x pair: correlation, and the least distance; motions that show none are left out."""
    pairs = list(dict.fromkeys(pair.effects for pair in p.pairs))
    rows: dict[str | None, list[Pair]] = {}
    for pair in p.pairs:
        rows.setdefault(pair.motion, []).append(pair)
    shown = {m: ones for m, ones in rows.items() if any(pair.distance for pair in ones)}
    return Table(
        ("motion", *map(_two, pairs)),
        [
            ("the plan" if m is None else m.replace("_", " "), *map(_apart, ones))
            for m, ones in shown.items()
        ],
    )


def _two(names: Sequence[str]) -> Markup:
    return prose(" and ".join(n.replace("_", " ") for n in names))


def _apart(pair: Pair) -> Any:
    if pair.distance == 0.0:
        return MISSING
    return Markup("{} σ<small>r = {}</small>").format(
        number(pair.distance, 2), f"{pair.correlation:.2f}"
    )


def hidden_table(p: Outcome) -> Table:
    rows = []
    for name in p.effects:
        own = [q for q in p.predicted if q.goal.key.effect == name]
        for reason, ones in by_reason(own).items():
            which = "all" if len(ones) == len(own) else ", ".join(place(q) for q in ones)
            rows.append((name.replace("_", " "), prose(which), prose(f"{reason}.")))
    return Table(("effect", "coefficients", "why not"), rows)
