"""What is printed is what is computed: text and LaTeX are read back by other rules, and give the
same numbers.
"""

import ast
import re

import casadi as ca
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pyimu.derivations import DERIVATIONS
from pyimu.derivations.formula import Formula, latex, prose, terms, text
from pyimu.derivations.report.tex import NAMES, equation
from pyimu.derivations.symbols import SYMBOLS

# Reading what was printed


class Value:
    """A casadi matrix whose only product is ``@``, as side by side means it, and whose ``**`` is a
    matrix's.
    """

    def __init__(self, m):
        self.m = ca.DM(m)

    def __add__(self, other):
        return Value(self.m + other.m)

    def __sub__(self, other):
        return Value(self.m - other.m)

    def __neg__(self):
        return Value(-self.m)

    def __matmul__(self, other):
        return Value(ca.mtimes(self.m, other.m))

    def __truediv__(self, other):
        assert other.m.numel() == 1
        return Value(self.m / other.m)

    def __pow__(self, other):
        if self.m.numel() == 1:
            return Value(self.m**other.m)
        return Value(np.linalg.matrix_power(np.array(self.m), int(other.m)))

    @property
    def T(self):
        return Value(self.m.T)

    @property
    def inv(self):
        return Value(np.linalg.inv(np.array(self.m)))


READ = {
    "sin": lambda v: Value(ca.sin(v.m)),
    "cos": lambda v: Value(ca.cos(v.m)),
    "exp": lambda v: Value(ca.exp(v.m)),
    "sqrt": lambda v: Value(ca.sqrt(v.m)),
    "norm": lambda v: Value(ca.norm_2(v.m)),
    "skew": lambda v: Value(ca.skew(v.m)),
    "Value": Value,
}


def value_of(pieces, values):
    """Value of pieces of Python between which products are left out."""
    source = ""
    for piece in pieces:
        operand = re.match(r"[\w(]", piece)
        if (
            operand
            and re.search(r"[\w)]$", source)
            and not re.search(r"\b(sin|cos|exp|sqrt|norm|skew|Value)$", source)
        ):
            source += "@"
        source += f"Value({piece})" if re.fullmatch(r"\d+(\.\d+)?(e[+-]?\d+)?", piece) else piece
    return eval(source, {**READ, **{n: Value(v) for n, v in values.items()}}).m


def read_text(line, values):
    """Rules of the text: a space multiplies, ^ raises, |v| and [v x]."""
    line = re.sub(r"\[(\w+) x\]", r"skew(\1)", line)
    line = re.sub(r"\|([^|]+)\|", r"norm(\1)", line)
    line = line.replace("^T", ".T").replace("^-1", ".inv").replace("^", "**")
    return value_of(
        re.findall(r"\.T|\.inv|\*\*|\d+(?:\.\d+)?(?:e[+-]?\d+)?|\w+|[-+/()]", line), values
    )


def read_latex(tex, values):
    """Rules of LaTeX: side by side multiplies; fractions, roots, bars and the bracketed cross."""
    symbols = {re.sub(r"\s", "", NAMES.get(n, n)): n for n in values}
    rest, pieces, closers = plain(tex), [], []
    while rest:
        token, rest = first_token(rest, symbols)
        if token in symbols:
            pieces.append(symbols[token])
        elif token == "\\frac":
            # Two: one around the whole, so that a power or a product takes all of it.
            pieces += ["(", "("]
            closers.append("above")
            rest = rest.removeprefix("{")
        elif token == "{":
            pieces.append("(")
            closers.append("group")
        elif token == "}":
            closed = closers.pop()
            pieces += AFTER[closed]
            if closed == "above":
                rest = rest.removeprefix("{")
                closers.append("below")
        elif token == "\\times":
            rest = rest.removeprefix("]")
            pieces.append(")")
        elif token.strip():
            pieces += TOKENS.get(token, [token])
    assert not closers
    return value_of(pieces, values)


TOKENS = {
    "\\cdot": ["@"],
    "\\sqrt": ["sqrt"],
    "\\sin": ["sin"],
    "\\cos": ["cos"],
    "\\exp": ["exp"],
    "\\lVert": ["norm", "("],
    "\\rVert": [")"],
    "[": ["skew", "("],
    "^": ["**"],
    "\1": [".T"],
    "\2": [".inv"],
}
"""What a token of LaTeX is in Python; those not here stand for themselves."""

AFTER = {"group": [")"], "above": [")", "/", "("], "below": [")", ")"]}
"""What a closing brace is, by what it closes: a group, or a part of a fraction."""


def plain(tex):
    """LaTeX without sizes and spaces, a transpose and an inverse as one character each."""
    tex = re.sub(r"\\left|\\right", "", tex).replace("\\mathsf T", "\\mathsf{T}")
    tex = re.sub(r"(?<![a-zA-Z])\s+|\s+(?![a-zA-Z])", "", tex)
    return tex.replace(r"^{\mathsf{T}}", "\1").replace("^{-1}", "\2")


def first_token(tex, symbols):
    """The first of ``symbols``, commands, numbers or characters in ``tex``, and the rest of it."""
    command = re.match(r"\\([a-zA-Z]+)|\d+(\.\d+)?(e[+-]?\d+)?|.", tex, re.DOTALL)[0]
    for symbol in sorted(symbols, key=len, reverse=True):
        longer = symbol[0] == "\\" and symbol[-1].isalpha() and tex[len(symbol) :][:1].isalpha()
        if tex.startswith(symbol) and not longer and (not symbol.isdigit() or symbol == command):
            return symbol, tex[len(symbol) :]
    return command, tex[len(command) :]


def cells(formula):
    """The formula, or those in the blocks of its matrix."""
    tree = formula.tree
    if isinstance(tree, ast.Call) and tree.func.id == "blocks":
        return [Formula(ast.unparse(cell)) for row in tree.args for cell in row.elts]
    return [formula]


EQUATIONS = [
    pytest.param(e, id=f"{d.key}-{e.left}")
    for d in DERIVATIONS
    for e in d.equations
    if "sines" not in e.right
]


@pytest.mark.parametrize("e", EQUATIONS)
def test_text_and_latex_of_every_equation_read_back_to_its_value(e):
    rng = np.random.default_rng(0)
    values = {n: ca.DM(rng.uniform(0.2, 1.2, SYMBOLS[n].shape)) for n in e.formula.names}
    for cell in cells(e.formula):
        own = {n: values[n] for n in cell.names}
        expected = np.array(ca.DM(cell.evaluate(values)))
        np.testing.assert_allclose(np.array(read_text(text(cell), own)), expected, rtol=1e-13)
        np.testing.assert_allclose(
            np.array(read_latex(latex(cell, NAMES), own)), expected, rtol=1e-13
        )


def expressions():
    """Sources of random expressions of positive numbers: every operator inside every other."""
    leaves = st.sampled_from(["a", "b", "tau", "2", "3"])

    def grown(inner):
        pair = st.tuples(inner, st.sampled_from("+-*/"), inner).map(
            lambda t: f"(({t[0]}) {t[1]} ({t[2]}))"
        )
        return (
            pair
            | inner.map(lambda t: f"(({t})**2)")
            | inner.map(lambda t: f"(-({t}))")
            | inner.map(lambda t: f"cos({t})")
            | inner.map(lambda t: f"sqrt(({t})**2)")
        )

    return st.recursive(leaves, grown, max_leaves=8)


@given(expressions())
@settings(max_examples=300, deadline=None)
def test_text_and_latex_of_any_expression_read_back_to_its_value(source):
    values = {"a": ca.DM(0.7), "b": ca.DM(1.3), "tau": ca.DM(0.45)}
    formula = Formula(source)
    try:
        expected = float(ca.DM(formula.evaluate(values)))
    except ZeroDivisionError:
        # Of numbers alone, where casadi has no part in it.
        expected = np.inf
    assume(np.isfinite(expected))
    own = {n: values[n] for n in formula.names}
    # Quotients of differences may be any multiple of rounding; the readings differ from the value
    # by none.
    for read in (read_text(text(formula), own), read_latex(latex(formula, NAMES), own)):
        np.testing.assert_allclose(float(read), expected, rtol=1e-9, atol=1e-12)


# How it is printed


@pytest.mark.parametrize(
    "source, plain, tex",
    [
        (
            "s**2*(N**2*h*I_3 + 2*K**2*psi_5*W**2)",
            "s^2 (N^2 h I_3 + 2 K^2 psi_5 W^2)",
            r"s^{2} \left(N^{2} h I + 2 K^{2} \psi_5 W^{2}\right)",
        ),
        ("a - (b - tau)", "a - (b - tau)", r"a - \left(\boldsymbol{b} - \tau\right)"),
        ("h/2*f", "(h/2) f", r"\frac{h}{2} f"),
        ("a/(b*f)", "a/(b f)", r"\frac{a}{\boldsymbol{b} f}"),
        ("-(a**2)", "-a^2", "-a^{2}"),
        ("(-a)**2", "(-a)^2", r"\left(-a\right)^{2}"),
        ("a*-h", "a (-h)", r"a \left(-h\right)"),
        (
            "T(skew(p)@F)",
            "([p x] F)^T",
            r"\left(\left[\boldsymbol{p}\times\right] F\right)^{\mathsf T}",
        ),
        ("inv(I_3 + M)", "(I_3 + M)^-1", r"\left(I + M\right)^{-1}"),
        ("32*2", "32 2", r"32 \cdot 2"),
    ],
)
def test_marks_stand_where_they_are_needed_and_nowhere_else(source, plain, tex):
    assert (text(Formula(source)), latex(Formula(source), NAMES)) == (plain, tex)


def test_matrix_of_blocks_is_aligned():
    assert text(Formula("blocks([a + b, 0], [c, -f])")) == "[ a + b   0  ]\n[ c       -f ]"
    assert (
        latex(Formula("blocks([a, 0], [c, -f])"), NAMES)
        == r"\begin{bmatrix} a & 0 \\ c & -f \end{bmatrix}"
    )


def test_terms_of_a_sum_give_the_sum_again():
    for d in DERIVATIONS:
        for e in d.equations:
            if not e.right.startswith("blocks"):
                assert " ".join(terms(e.formula)) == text(e.formula)
                assert " ".join(terms(e.formula, NAMES)) == latex(e.formula, NAMES)
                assert "aligned" in equation(e) or equation(e).endswith(latex(e.formula, NAMES))


def test_formulas_among_words_are_printed_and_the_words_are_left():
    words = "where `w*h` is small, `f = a = 1`, see `= T(R_nb)`; 50 % of_it"
    assert prose(words) == "where w h is small, f = a = 1, see = R_nb^T; 50 % of_it"
    assert prose(words, NAMES).startswith(
        r"where $\omega h$ is small, $f = a = 1$, see $= R_{nb}^{\mathsf T}$"
    )


def test_every_text_of_a_derivation_has_formulas_that_can_be_printed():
    for d in DERIVATIONS:
        for words in (
            d.about,
            d.source,
            *(e.note for e in d.equations),
            *(s.meaning for s in d.symbols),
        ):
            assert "`" not in prose(words) and "`" not in prose(words, NAMES)


def test_what_a_formula_cannot_hold_is_refused():
    for source in ("a if b else c", "a and b", "x.y"):
        with pytest.raises(TypeError, match="a formula has no"):
            Formula(source).evaluate({n: ca.DM(1) for n in "abcxy"})
        with pytest.raises(TypeError, match="a formula has no"):
            text(Formula(source))
