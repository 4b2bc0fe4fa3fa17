"""Which effects of the catalogue a formula looks like in the logs that it was found in."""

from __future__ import annotations

import numpy as np

from pyimu.identification.fit.columns import Linear
from pyimu.identification.fit.errors_in_variables import equations
from pyimu.identification.fit.fit import Fit, with_prior
from pyimu.identification.fit.keys import Coefficient, Shape
from pyimu.identification.fit.normal import solve
from pyimu.identification.formula.columns import columns_of
from pyimu.identification.formula.effect import coefficients
from pyimu.identification.formula.formula import Formula
from pyimu.identification.search.candidates import absent, scan_columns
from pyimu.identification.search.candidates import groups as groups_of
from pyimu.identification.search.investigation import Investigation
from pyimu.identification.search.projected import Projected

MOST, LEAST = 3, 0.3
"""Effects that are told, and the correlation from which on one is worth telling."""


def resembled(inv: Investigation, formula: Formula) -> tuple[tuple[str, float], ...]:
    """Effects by the correlation of what a formula adds with the best that each could make of it,
    beside what the model was before.
    """
    before, kind = inv.before, formula.sensor
    effects = [e for e in absent(before) if e.name != formula.name]
    scans, own_columns = scan_columns(before, effects), columns_of(kind, list(formula.terms))
    linear = [e.name for e in effects if all(p.scan is None for p in e.parameters.values())]

    def linearised(f: Fit) -> list[Linear]:
        return f.beside(f.linearise(linear, [scans]), [own_columns])

    normal = with_prior(equations(before, linearised), before)
    groups = groups_of(normal, before.sensor, effects)
    of_effects = sorted({c for g in groups for choice in g.choices for c in choice.columns})
    own = [i for i, k in enumerate(normal.keys) if isinstance(k, Shape)]
    wanted = [*of_effects, *own]
    base = [i for i in range(len(normal.keys)) if i not in set(wanted)]
    projected, place = Projected.of(normal, base, wanted), {c: n for n, c in enumerate(wanted)}
    value = _values(inv, formula, normal.keys, wanted)
    gram = projected.gram
    power = float(value @ gram @ value)
    if not power > 0.0:
        return ()
    shares: dict[str, float] = {}
    for g in groups:
        best = 0.0
        for choice in g.choices:
            at = [place[c] for c in choice.columns]
            along = gram[at] @ value
            best = max(best, float(along @ solve(gram[np.ix_(at, at)], along)) / power)
        shares[g.effect] = shares.get(g.effect, 0.0) + best
    like = {n: float(np.sqrt(min(s, 1.0))) for n, s in shares.items()}
    ranked = sorted(like.items(), key=lambda item: -item[1])
    return tuple((n, r) for n, r in ranked[:MOST] if r >= LEAST)


def _values(inv: Investigation, formula: Formula, keys: list, wanted: list[int]) -> np.ndarray:
    """The fitted coefficients of a formula, by column."""
    values = inv.after.sensor.values[formula.name]
    named = {(t.text, k): c for c, t, k in coefficients(formula.terms)}
    out = np.zeros(len(wanted))
    for n, column in enumerate(wanted):
        key = keys[column]
        if isinstance(key, Shape) and not isinstance(key, Coefficient):
            out[n] = values[named[key.term, key.number]][key.axis]
    return out
