"""The results as Markdown with LaTeX between dollars, as notebooks and code hosts render it."""

from __future__ import annotations

from pyimu.derivations.model import Check, Equation, Result, Results, Table
from pyimu.derivations.report.tex import equation, escaped, number, unit

HEAD = """# Symbolic results

SI units and radians; vectors are columns; $\\left[\\boldsymbol{v}\\times\\right]$ is the matrix
of the cross product with $\\boldsymbol{v}$. Every number beside a check was computed when this
page was made.
"""


def prose(words: str) -> str:
    """Words with Markdown's own marks escaped; formulas in backquotes become mathematics."""
    return escaped(words, lambda plain: "".join("\\" + c if c in "_*<>|" else c for c in plain))


def document(results: Results) -> str:
    """The whole page."""
    return (
        "\n".join(
            [
                HEAD,
                *(_result(i + 1, r) for i, r in enumerate(results.results)),
                prose(results.summary()) + ".",
            ]
        )
        + "\n"
    )


def _result(number_: int, r: Result) -> str:
    d = r.derivation
    parts = [
        f"## {number_}. {prose(d.title)}",
        prose(d.about),
        *map(_display, d.equations),
        "\n".join(f"- ${s.latex}$ [${unit(s.unit)}$]: {prose(s.meaning)}" for s in d.symbols),
        f"Source: {prose(d.source)}.",
        *map(_table, r.tables),
        _checks(r.checks),
    ]
    return "\n\n".join(p for p in parts if p) + "\n"


def _display(e: Equation) -> str:
    return f"$$\n{equation(e)}\n$$" + (f"\n\n({prose(e.note)})" if e.note else "")


def _checks(checks: tuple[Check, ...]) -> str:
    rows = [
        (
            c.against,
            "passed" if c.passed else "FAILED",
            c.kind,
            f"${number(c.largest)}$",
            f"${number(c.bound)}$",
            str(c.cases),
        )
        for c in checks
    ]
    return _grid(("checked against", "", "", "found", "at most expected", "cases"), rows)


def _table(t: Table) -> str:
    return f"{prose(t.title)}:\n\n" + _grid(t.head, t.rows)


def _grid(head: tuple[str, ...], rows) -> str:
    # Numbers are mathematics already; what is words is escaped.
    cells = [[c if c.startswith("$") else prose(c) for c in row] for row in rows]
    return "\n".join(
        "| " + " | ".join(row) + " |"
        for row in ([prose(c) for c in head], ["---"] * len(head), *cells)
    )
