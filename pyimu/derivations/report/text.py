"""The results as plain text."""

from __future__ import annotations

from textwrap import indent, wrap

from pyimu.derivations import formula
from pyimu.derivations.model import Check, Equation, Result, Results, Table
from pyimu.derivations.report.tex import equation as latex_equation

WIDTH = 118
HEAD = (
    "The symbolic results of pyimu. SI units and radians; vectors are columns; [v x] is the matrix "
    "of the cross product with v; x^T the "
    "transpose. A space multiplies. Every number beside a check was computed when this text was "
    "made."
)


def document(results: Results) -> str:
    """All results; the last line says how many checks passed."""
    parts = [
        "\n".join(wrap(HEAD, WIDTH)),
        *(_result(i + 1, r) for i, r in enumerate(results.results)),
        results.summary(),
    ]
    return "\n\n\n".join(parts) + "\n"


def _result(number: int, r: Result) -> str:
    d = r.derivation
    title = f"{number}. {d.title}"
    parts = [
        f"{title}\n{'=' * len(title)}",
        "\n".join(wrap(formula.prose(d.about), WIDTH)),
        "\n".join(indent(equation(e), "    ") for e in d.equations),
        _symbols(r),
        _filled("source  ", formula.prose(d.source)),
        "LaTeX\n" + "\n".join("    " + latex_equation(e) for e in d.equations),
        *map(_table, r.tables),
        "checked against\n" + "\n".join(map(_check, r.checks)),
    ]
    return "\n\n".join(p for p in parts if p)


def equation(e: Equation) -> str:
    """``left = right`` as lines of text.

    A long sum is broken between its terms, a matrix has a line for each row of blocks.
    """
    note = f"    ({formula.prose(e.note)})" if e.note else ""
    shown = formula.text(e.formula).split("\n")
    margin = " " * (len(e.left) + 3)
    if len(shown) == 1:
        shown = _broken(formula.terms(e.formula), WIDTH - len(margin) - 4)
    shown[-1 if len(shown) == 1 else 0] += note
    return f"{e.left} = {shown[0]}" + "".join(f"\n{margin}{line}" for line in shown[1:])


def _broken(terms: list[str], width: int) -> list[str]:
    lines = [terms[0]]
    for term in terms[1:]:
        if len(lines[-1]) + len(term) < width:
            lines[-1] += " " + term
        else:
            lines.append(term)
    return lines


def _symbols(r: Result) -> str:
    rows = [(s.name, f"[{s.unit}]", formula.prose(s.meaning)) for s in r.derivation.symbols]
    names, units = (max(map(len, column)) for column in list(zip(*rows))[:2])
    return "where\n" + "\n".join(f"    {n.ljust(names)}  {u.ljust(units)}  {m}" for n, u, m in rows)


def _check(c: Check) -> str:
    verdict = "passed" if c.passed else "FAILED"
    cases = f", {c.cases} cases" if c.cases > 1 else ""
    return (
        _filled("    ", formula.prose(c.against))
        + f"\n        {verdict}: {c.kind} {c.largest:.2g}, at most {c.bound:.2g} expected{cases}"
    )


def _table(t: Table) -> str:
    rows = [tuple(map(formula.prose, row)) for row in (t.head, *t.rows)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "    " + "   ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    return "\n".join(
        [
            formula.prose(t.title),
            lines[0],
            "    " + "-" * (sum(widths) + 3 * len(widths) - 3),
            *lines[1:],
        ]
    )


def _filled(label: str, words: str) -> str:
    return "\n".join(wrap(words, WIDTH, initial_indent=label, subsequent_indent=" " * len(label)))
