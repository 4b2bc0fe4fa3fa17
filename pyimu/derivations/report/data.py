"""The results as data, as JSON has them."""

from __future__ import annotations

from typing import Any

from pyimu.derivations.model import Check, Equation, Result, Results, Table
from pyimu.derivations.report.tex import equation as latex_equation


def document(results: Results) -> dict[str, Any]:
    """All results, in order.

    {``passed``, ``results``: [{``key``, ``title``, ``about``, ``source``, ``passed``,
    ``equations``: [{``left``, ``right``, ``latex``, ``note``}], ``symbols``: [{``name``, ``unit``,
    ``meaning``}], ``tables``: [{``title``, ``head``, ``rows``}], ``checks``: [{``against``,
    ``kind``, ``cases``, ``largest``, ``bound``, ``passed``}]}]}.
    """
    return {"passed": results.passed, "results": [_result(r) for r in results.results]}


def _result(r: Result) -> dict[str, Any]:
    d = r.derivation
    return {
        "key": d.key,
        "title": d.title,
        "about": d.about,
        "source": d.source,
        "passed": r.passed,
        "equations": [_equation(e) for e in d.equations],
        "symbols": [{"name": s.name, "unit": s.unit, "meaning": s.meaning} for s in d.symbols],
        "tables": [_table(t) for t in r.tables],
        "checks": [_check(c) for c in r.checks],
    }


def _equation(e: Equation) -> dict[str, str | None]:
    latex = latex_equation(e)
    return {"left": e.left, "right": e.right, "latex": latex, "note": e.note or None}


def _table(t: Table) -> dict[str, Any]:
    return {"title": t.title, "head": list(t.head), "rows": [list(row) for row in t.rows]}


def _check(c: Check) -> dict[str, Any]:
    """``largest`` and ``bound`` as they are in memory: the texts round them to two digits."""
    said = {"against": c.against, "kind": c.kind, "cases": c.cases}
    return said | {"largest": c.largest, "bound": c.bound, "passed": c.passed}
