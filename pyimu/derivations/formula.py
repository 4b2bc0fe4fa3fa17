"""Formulas that are printed and computed from one text: what a reader sees is what was checked.

A formula is a Python expression over named matrices, such as
``s**2*(N**2*h*I_3 + 2*K**2*psi_5*W**2)``: ``*`` multiplies by a number, ``@`` two matrices. It
evaluates to a casadi matrix and prints as plain text and as LaTeX. Its functions are sin, cos, exp,
sqrt; T (transpose), inv, norm, skew (the matrix of a cross product), diag, blocks (rows of blocks),
and sines(k, x), the sum over i of (-1)^i x^(2 i)/(k + 2 i)! (``pyimu.symbolic.series.stumpff`` of
x^2).
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import casadi as ca

from pyimu.symbolic.series import stumpff

SUM, NEGATIVE, PRODUCT, POWER, ATOM = range(5)
"""Precedence of an expression, from a sum to what never needs parentheses."""


@dataclass(frozen=True)
class Formula:
    """One expression. Raises SyntaxError at its first use where ``source`` is none."""

    source: str

    @cached_property
    def tree(self) -> ast.expr:
        return ast.parse(self.source, mode="eval").body

    @property
    def names(self) -> tuple[str, ...]:
        """The names in it, in the order of the text."""
        called = {id(n.func) for n in ast.walk(self.tree) if isinstance(n, ast.Call)}
        found = [n for n in ast.walk(self.tree) if isinstance(n, ast.Name) and id(n) not in called]
        return tuple(
            dict.fromkeys(n.id for n in sorted(found, key=lambda n: (n.lineno, n.col_offset)))
        )

    def evaluate(self, values: Mapping):
        """The casadi matrix, with ``values`` for the names.

        Raises KeyError for a name without a value, TypeError for what a formula cannot hold.
        """
        return _evaluate(self.tree, values)


# Value


def _power(base, exponent):
    """A power; of a matrix the product with itself."""
    if isinstance(exponent, int) and getattr(base, "shape", (1, 1)) != (1, 1):
        out = base
        for _ in range(exponent - 1):
            out = out @ base
        return out
    return base**exponent


_OPERATORS = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.MatMult: lambda a, b: a @ b,
    ast.Pow: _power,
}

_FUNCTIONS = {
    "sin": ca.sin,
    "cos": ca.cos,
    "exp": ca.exp,
    "sqrt": ca.sqrt,
    "T": lambda a: a.T,
    "inv": ca.inv,
    "norm": ca.norm_2,
    "skew": ca.skew,
    "diag": ca.diag,
    "sines": lambda k, x: stumpff(k, x**2),
    "blocks": lambda *rows: ca.vertcat(*[ca.horzcat(*row) for row in rows]),
}


def _evaluate(node: ast.expr, values: Mapping):
    match node:
        case ast.BinOp():
            return _OPERATORS[type(node.op)](
                _evaluate(node.left, values), _evaluate(node.right, values)
            )
        case ast.UnaryOp(op=ast.USub()):
            return -_evaluate(node.operand, values)
        case ast.Call():
            return _FUNCTIONS[node.func.id](*[_evaluate(a, values) for a in node.args])
        case ast.List():
            return [_evaluate(a, values) for a in node.elts]
        case ast.Name():
            return values[node.id]
        case ast.Constant():
            return node.value
    raise TypeError(f"a formula has no {type(node).__name__}")


# Print


@dataclass(frozen=True)
class Style:
    """How names and marks are written."""

    names: Mapping[str, str]
    latex: bool

    def name(self, name: str) -> str:
        return self.names.get(name, name)

    def parentheses(self, text: str) -> str:
        return rf"\left({text}\right)" if self.latex else f"({text})"


def text(formula: Formula) -> str:
    """One line; a matrix of blocks comes as several, its columns aligned."""
    style = Style({}, latex=False)
    rows = _rows(formula.tree)
    if rows is None:
        return _printed(formula.tree, style)[0]
    cells = [[_printed(cell, style)[0] for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))]
    return "\n".join(
        "[ " + "   ".join(c.ljust(w) for c, w in zip(row, widths, strict=True)) + " ]"
        for row in cells
    )


def latex(formula: Formula, names: Mapping[str, str]) -> str:
    """LaTeX for display mathematics (amsmath); ``names`` are those of the symbols."""
    return _printed(formula.tree, Style(names, latex=True))[0]


def terms(formula: Formula, names: Mapping[str, str] | None = None) -> list[str]:
    """The terms of a sum, each with its sign, as text or (with ``names``) as LaTeX.

    A long sum may be broken between them.
    """
    style, node, out = Style(names or {}, latex=names is not None), formula.tree, []
    while isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
        out.append(f"{_sign(node)} {_bracketed(node.right, style, PRODUCT)}")
        node = node.left
    return [_bracketed(node, style, SUM), *reversed(out)]


def prose(words: str, names: Mapping[str, str] | None = None) -> str:
    """Words with the formulas among them as text or (with ``names``) as LaTeX.

    The formulas stand in backquotes; ``=`` may join formulas.
    """

    def shown(match: re.Match) -> str:
        parts = [
            _printed(Formula(part).tree, Style(names or {}, names is not None))[0] if part else ""
            for part in match[1].split("= ")
        ]
        joined = " = ".join(p.strip() for p in parts).strip()
        return f"${joined}$" if names is not None else joined

    return re.sub("`([^`]+)`", shown, words)


def _rows(node: ast.expr) -> list | None:
    """Cells of a matrix of blocks, None for anything else."""
    if isinstance(node, ast.Call) and node.func.id == "blocks":
        return [row.elts for row in node.args]
    return None


def _bracketed(node: ast.expr, style: Style, level: int) -> str:
    """The expression, in parentheses where its precedence is below ``level``."""
    shown, own = _printed(node, style)
    return style.parentheses(shown) if own < level else shown


def _printed(node: ast.expr, style: Style) -> tuple[str, int]:
    """The expression without parentheses around it, and its precedence."""
    match node:
        case ast.BinOp(op=ast.Add() | ast.Sub()):
            left, right = _bracketed(node.left, style, SUM), _bracketed(node.right, style, PRODUCT)
            return f"{left} {_sign(node)} {right}", SUM
        case ast.BinOp(op=ast.Mult() | ast.MatMult()):
            return _product(node, style), NEGATIVE if _begins_negative(node) else PRODUCT
        case ast.BinOp(op=ast.Div()):
            return _quotient(node, style)
        case ast.BinOp(op=ast.Pow()):
            return _bracketed(node.left, style, ATOM) + _exponent(node.right, style), POWER
        case ast.UnaryOp(op=ast.USub()):
            return "-" + _bracketed(node.operand, style, PRODUCT), NEGATIVE
        case ast.Call():
            return _call(node, style)
        case ast.Name():
            return style.name(node.id), ATOM
        case ast.Constant():
            return repr(node.value), ATOM
    raise TypeError(f"a formula has no {type(node).__name__}")


def _sign(node: ast.BinOp) -> str:
    return "+" if isinstance(node.op, ast.Add) else "-"


def _exponent(node: ast.expr, style: Style) -> str:
    if style.latex:
        return "^{" + _printed(node, style)[0] + "}"
    return "^" + _bracketed(node, style, ATOM)


def _begins_negative(node: ast.expr) -> bool:
    while isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult | ast.MatMult | ast.Div):
        node = node.left
    return isinstance(node, ast.UnaryOp)


def _product(node: ast.BinOp, style: Style) -> str:
    def factor(side: ast.expr, level: int) -> str:
        # In a line of text "a/b c" could be read both ways; a fraction in LaTeX cannot.
        quotient = isinstance(side, ast.BinOp) and isinstance(side.op, ast.Div)
        return _bracketed(side, style, ATOM if quotient and not style.latex else level)

    left, right = factor(node.left, NEGATIVE), factor(node.right, PRODUCT)
    between = r" \cdot " if style.latex and right[0].isdigit() else " "
    return left + between + right


def _quotient(node: ast.BinOp, style: Style) -> tuple[str, int]:
    if style.latex:
        above, below = _printed(node.left, style)[0], _printed(node.right, style)[0]
        return rf"\frac{{{above}}}{{{below}}}", PRODUCT
    level = NEGATIVE if _begins_negative(node.left) else PRODUCT
    return f"{_bracketed(node.left, style, NEGATIVE)}/{_bracketed(node.right, style, POWER)}", level


def _call(node: ast.Call, style: Style) -> tuple[str, int]:
    name, arguments = node.func.id, node.args
    if name in _MARKS:
        mark = _MARKS[name][style.latex]
        return _bracketed(arguments[0], style, ATOM) + mark, POWER
    if name == "blocks":
        return _blocks(
            [[_printed(cell, style)[0] for cell in r.elts] for r in arguments], style
        ), ATOM
    shown = [_printed(a, style)[0] for a in arguments]
    calls = _LATEX_CALLS if style.latex else _TEXT_CALLS
    return calls.get(name, _plain_call(name, style))(*shown), ATOM


def _blocks(rows: list[list[str]], style: Style) -> str:
    if style.latex:
        lines = r" \\ ".join(" & ".join(row) for row in rows)
        return rf"\begin{{bmatrix}} {lines} \end{{bmatrix}}"
    return "[" + "; ".join(", ".join(row) for row in rows) + "]"


def _plain_call(name: str, style: Style):
    return lambda *shown: (
        rf"\{name}\left({', '.join(shown)}\right)" if style.latex else f"{name}({', '.join(shown)})"
    )


_MARKS = {"T": ("^T", r"^{\mathsf T}"), "inv": ("^-1", "^{-1}")}
"""What stands behind an argument, as text and as LaTeX."""

_TEXT_CALLS = {
    "norm": lambda a: f"|{a}|",
    "skew": lambda a: f"[{a} x]",
    "sines": lambda k, x: f"sum_i (-1)^i ({x})^(2 i)/({k} + 2 i)!",
}

_LATEX_CALLS = {
    "norm": lambda a: rf"\lVert {a} \rVert",
    "skew": lambda a: rf"\left[{a}\times\right]",
    "sqrt": lambda a: rf"\sqrt{{{a}}}",
    "diag": lambda a: rf"\operatorname{{diag}}\left({a}\right)",
    "sines": lambda k, x: (
        rf"\sum_{{i \ge 0}} \frac{{(-1)^i \left({x}\right)^{{2 i}}}}{{({k} + 2 i)!}}"
    ),
}
