"""One case through the loop, and what is kept of its result."""

from __future__ import annotations

import time
import traceback
from dataclasses import asdict
from typing import Any

import numpy as np
from effect_logs.alike import nat_apart
from effect_logs.cases import Made, make

import pyimu
from pyimu.files import plain
from pyimu.identification.fit.trial import SETTLE
from pyimu.identification.result import Closed
from pyimu.model.part_reader import parse_part

HELD_OUT = 0.3


def record(name: str, number: int, low: float, high: float) -> dict[str, Any]:
    """The case of a name and a number, of ``low`` to ``high`` minutes: its truth and what was
    found.

    An error of the loop is a result, too.
    """
    made = make(name, number, (low, high))
    began = time.perf_counter()
    found: dict[str, Any]
    try:
        found = _found(made, closed(made))
    except pyimu.UserError as error:
        found = {"refused_log": str(error)}
    except Exception as error:  # noqa: BLE001 - whatever the loop raises is what is counted
        at = traceback.extract_tb(error.__traceback__)[-1]
        found = {"failed": f"{type(error).__name__} in {at.name}: {error}"}
    seconds = round(time.perf_counter() - began, 2)
    return plain({"name": name, "number": number, "seconds": seconds} | _told(made) | found)


def closed(made: Made) -> Closed:
    logs = [pyimu.Recording.from_arrays(f"log{i}", **c) for i, c in enumerate(made.logs)]
    part = parse_part(made.part, "case.toml") if made.form == "declared" else None
    return pyimu.close(logs, part=part)


def _told(made: Made) -> dict[str, Any]:
    minutes = [len(c["time"]) / 6000 for c in made.logs]
    return {
        "form": made.form,
        "motions": list(made.motions),
        "minutes": minutes,
        "columns": sorted(set(made.logs[0])),
        "truths": [asdict(t) for t in made.truths],
    }


def _found(made: Made, c: Closed) -> dict[str, Any]:
    return {
        "verdict": c.verdict,
        "reason": c.reason,
        "added": [a.as_dict() for a in c.added],
        "changed": [[x.sensor, x.effect, x.parameter] for x in c.changed],
        "instead": {f"{x.sensor}.{x.effect}": list(x.alternatives) for x in c.changed},
        "nat_apart": _apart(made, c),
        "refused": [{"sensor": s} | r.as_dict() for s, r in c.refused],
        "drift": [s for s, axes in c.drift.items() if axes],
        "unexplained": [u.as_dict() for u in c.unexplained],
        "formulas": [f.as_dict() for f in c.formulas],
        "candidates": [f.as_dict() for f in c.candidates],
        "visible": {f"{v.sensor}.{v.effect}": v.reason for v in c.observability},
        "quality": sorted({f.kind for f in c.quality}),
        "errors": {k: _errors(made, k, e) for k, e in c.errors.items() if k in made.left[0]},
    }


def _apart(made: Made, c: Closed) -> dict[str, float]:
    """By "named truth" the expected nat by which the logs speak for the truth, where another effect
    was named and the result says that the truth explains as much.
    """
    named = [(x.sensor, x.effect, x.alternatives) for x in (*c.added, *c.changed)]
    found = {
        f"{effect} {t.effect}": nat_apart(made.chains, t.term, made.cases[t.term], effect)
        for sensor, effect, others in named
        for t in made.truths
        if sensor == t.kind and t.effect in others
    }
    return {k: v for k, v in found.items() if v is not None}


def _errors(made: Made, kind: str, e) -> dict[str, float]:
    """RMS on held-out rows before, after, and of the true model."""
    return {"before": e.before.total, "after": e.after.total, "true": true_error(made, kind)}


def true_error(made: Made, kind: str) -> float:
    """RMS that the true model leaves on the rows that the loop holds out, less the bias that it
    shows on those that are fitted.
    """
    squares, count = 0.0, 0
    for left in made.left:
        noise = left[kind]
        at = round(len(noise) * (1 - HELD_OUT))
        rest = noise[at + SETTLE :] - noise[SETTLE:at].mean(axis=0)
        squares, count = squares + float(np.sum(rest**2)), count + rest.size
    return float(np.sqrt(squares / count))
