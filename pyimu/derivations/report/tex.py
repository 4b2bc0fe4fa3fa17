"""The results as a LaTeX document.

It needs no packages but amsmath, amssymb, booktabs and geometry; its equations serve Markdown, too.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from pyimu.derivations import formula
from pyimu.derivations.model import Check, Derivation, Equation, Result, Results, Table
from pyimu.derivations.symbols import SYMBOLS

NAMES = {s.name: s.latex for s in SYMBOLS.values()} | {
    "m_ij": "m_{ij}",
    "g_i": "g_i",
    "tau_i": r"\tau_i",
    "v_i": "v_i",
}
"""How each symbol is written."""

LONG, IN_A_LINE = 9, 3
"""Terms of a sum from which on it is broken, and how many of them a line then has."""

WRAPPED = 40
"""Letters in a cell of the first column of a table from which on that is wrapped."""

PREAMBLE = r"""\documentclass[a4paper,11pt]{article}
\usepackage[T1]{fontenc}
\usepackage[margin=22mm]{geometry}
\usepackage{amsmath,amssymb,booktabs}
\setlength{\parindent}{0pt}
\setlength{\parskip}{4pt}
\begin{document}
\section*{Symbolic results of pyimu}
SI units and radians; vectors are columns; $\left[\boldsymbol{v}\times\right]$ is the matrix of the
cross product with $\boldsymbol{v}$.
Every number beside a check was computed when this text was made.
"""

_ESCAPED = {
    "\\": r"\textbackslash{}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "{": r"\{",
    "}": r"\}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
}


def equation(e: Equation) -> str:
    """``left = right`` for display mathematics; a sum of many terms stands in aligned lines."""
    left, terms = NAMES[e.left], formula.terms(e.formula, NAMES)
    if len(terms) < LONG:
        return f"{left} = {formula.latex(e.formula, NAMES)}"
    lines = [" ".join(terms[i : i + IN_A_LINE]) for i in range(0, len(terms), IN_A_LINE)]
    return rf"\begin{{aligned}} {left} ={{}}& " + r" \\ &".join(lines) + r" \end{aligned}"


def prose(words: str) -> str:
    """Words with LaTeX's own marks escaped; formulas in backquotes become mathematics."""
    return escaped(words, lambda plain: "".join(_ESCAPED.get(c, c) for c in plain))


def escaped(words: str, escape: Callable[[str], str]) -> str:
    """Formulas in backquotes as LaTeX between dollars, the words between them by ``escape``."""
    pieces = re.split("(`[^`]+`)", words)
    return "".join(formula.prose(p, NAMES) if p.startswith("`") else escape(p) for p in pieces)


def unit(text: str) -> str:
    """A unit such as rad/s/sqrt(s), for mathematics."""
    return (
        r"\mathrm{"
        + re.sub(r"\^(\d+)", r"^{\1}", re.sub(r"sqrt\((\w+)\)", r"\\sqrt{\1}", text))
        + "}"
    )


def number(value: float) -> str:
    """Two digits; a power of ten as such."""
    mantissa, _, exponent = f"{value:.2g}".partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


def document(results: Results) -> str:
    """The whole document."""
    return (
        PREAMBLE
        + "\n".join(map(_result, results.results))
        + "\n\\bigskip\n"
        + prose(results.summary())
        + ".\n\\end{document}\n"
    )


def _result(r: Result) -> str:
    d = r.derivation
    parts = [
        rf"\section{{{prose(d.title)}}}",
        prose(d.about),
        *map(_display, d.equations),
        _symbols(d),
        rf"\textbf{{Source:}} {prose(d.source)}.",
        *map(_table, r.tables),
        _checks(r.checks),
    ]
    return "\n\n".join(p for p in parts if p) + "\n"


def _display(e: Equation) -> str:
    shown = f"\\[\n  {equation(e)}\n\\]"
    return shown + (f"\n{{\\small ({prose(e.note)})}}" if e.note else "")


def _symbols(d: Derivation) -> str:
    rows = [rf"  ${s.latex}$ & ${unit(s.unit)}$ & {prose(s.meaning)} \\" for s in d.symbols]
    return "\n".join([r"\begin{tabular}{@{}llp{0.7\textwidth}@{}}", *rows, r"\end{tabular}"])


def _checks(checks: tuple[Check, ...]) -> str:
    items = [
        rf"  \item {prose(c.against)}: {'passed' if c.passed else 'FAILED'}, {c.kind} "
        rf"${number(c.largest)}$ "
        rf"(expected at most ${number(c.bound)}$, {c.cases} case{'s' * (c.cases > 1)})"
        for c in checks
    ]
    return "\n".join([r"\textbf{Checked against}", r"\begin{itemize}", *items, r"\end{itemize}"])


def _table(t: Table) -> str:
    body = [" & ".join(map(prose, row)) + r" \\" for row in t.rows]
    widest = max(len(row[0]) for row in t.rows)
    columns = ("p{0.45\\textwidth}" if widest > WRAPPED else "l") + "l" * (len(t.head) - 1)
    return "\n".join(
        [
            rf"\textbf{{{prose(t.title)}}}",
            "",
            r"{\small",
            rf"\begin{{tabular}}{{@{{}}{columns}@{{}}}}",
            r"\toprule",
            " & ".join(map(prose, t.head)) + r" \\",
            r"\midrule",
            *body,
            r"\bottomrule",
            r"\end{tabular}",
            "}",
        ]
    )
