"""The symbolic results as text, LaTeX and Markdown."""

import re

import numpy as np
import pytest

from pyimu.derivations import DERIVATIONS, Derived, Result
from pyimu.derivations.model import Check
from pyimu.derivations.process_noise.printed import PRINTED
from pyimu.derivations.report.tex import equation as latex_equation
from pyimu.derivations.symbols import SYMBOLS


def test_report_has_every_result_with_its_equations_checks_and_source(quick):
    report = quick.report()
    for number, d in enumerate(DERIVATIONS, 1):
        assert f"{number}. {d.title}\n" in report and all(
            f"    {latex_equation(e)}\n" in report for e in d.equations
        )
        assert all(f"\n    {e.left} = " in report for e in d.equations)
    assert report.count(
        "passed: largest difference 1.2e-15, at most 2e-13 expected, 3 cases"
    ) == len(DERIVATIONS)
    assert report.endswith(
        f"{len(DERIVATIONS)} results, {2 * len(DERIVATIONS)} of {2 * len(DERIVATIONS)} checks "
        "passed, none failed\n"
    )
    assert (
        "`" not in report and max(map(len, (x for x in report.split("\n") if "\\" not in x))) <= 140
    )


def test_failed_check_is_told(quick):
    failed = Derived(
        (Result(DERIVATIONS[0], (Check("x", 1, 2.0, 1.0), Check("y", 1, np.nan, 1.0)), ()),)
    )
    assert (
        not failed.passed and "FAILED: largest difference 2, at most 1 expected" in failed.report()
    )
    assert failed.summary() == "1 results, 0 of 2 checks passed, failed: quaternion_kinematics"


def test_term_by_term_table_shows_sign_and_factors(quick):
    term, sign, turning = PRINTED.tables(PRINTED)
    assert [row[2:] for row in term.rows] == [("1", "1/16"), ("1", "1/4"), ("1", "1")]
    for _, van_loan, minus, plus in sign.rows:
        assert van_loan == minus == f"-{plus}" and float(minus) < 0
    assert float(turning.rows[0][1]) == pytest.approx(5e-3, rel=0.1)


MATHEMATICS = {
    "begin",
    "end",
    "frac",
    "left",
    "right",
    "sqrt",
    "sin",
    "cos",
    "exp",
    "sum",
    "ge",
    "cdot",
    "times",
    "boldsymbol",
    "mathrm",
    "mathsf",
    "lVert",
    "rVert",
    "hat",
    "tilde",
    "dot",
    "Omega",
    "Phi",
    "Xi",
    "beta",
    "chi",
    "delta",
    "eta",
    "kappa",
    "nu",
    "omega",
    "pi",
    "psi",
    "tau",
    "varphi",
}
WORDS = {
    "documentclass",
    "usepackage",
    "setlength",
    "parindent",
    "parskip",
    "section",
    "textbf",
    "small",
    "item",
    "toprule",
    "midrule",
    "bottomrule",
    "textwidth",
    "bigskip",
    "textbackslash",
    "textasciicircum",
    "textasciitilde",
}


def balanced(tex):
    """Nothing but what amsmath and booktabs know, and everything that is opened closed in order."""
    assert set(re.findall(r"\\([A-Za-z]+)", tex)) <= MATHEMATICS | WORDS
    opened, closing = [], {"}": "{", "end": "begin", "right": "left", "]": "["}
    for mark in re.finditer(
        r"\\(begin|end)\{(\w+\*?)\}|\\(left|right)\b|\\([\[\]])|(?<!\\)([{}])", tex
    ):
        name = next(g for g in (mark[1], mark[3], mark[4], mark[5]) if g)
        if name not in closing:
            opened.append((name, mark[2]))
        elif opened.pop() != (closing[name], mark[2]):
            return False
    return not opened


def test_latex_is_balanced_and_needs_standard_packages_only(quick, tmp_path):
    tex = quick.write(tmp_path)[1].read_text(encoding="utf-8")
    assert (
        balanced(tex)
        and not balanced(tex.replace(r"\end{bmatrix}", "", 1))
        and not balanced(tex.replace("}", "", 1))
    )
    assert set(re.findall(r"\\usepackage(?:\[.*\])?\{(.*)\}", tex)) == {
        "fontenc",
        "geometry",
        "amsmath,amssymb,booktabs",
    }
    assert all(latex_equation(e) in tex for d in DERIVATIONS for e in d.equations)
    words = re.sub(r"\$[^$]*\$|\\\[.*?\\\]", "", tex, flags=re.DOTALL).replace("\\\\", "")
    assert (
        "$" not in words
        and not re.search(r"(?<!\\)[_^#%`]", words)
        and words.count(r"\&") == len(DERIVATIONS)
    )


def test_markdown_keeps_its_tables_whole(quick, tmp_path):
    page = quick.write(tmp_path)[2].read_text(encoding="utf-8")
    for block in re.findall(r"(?:^\|.*\n)+", page, flags=re.MULTILINE):
        assert len({len(re.findall(r"(?<!\\)\|", line)) for line in block.splitlines()}) == 1
    assert page.count("$$\n") == 2 * sum(len(d.equations) for d in DERIVATIONS) and "`" not in page


def test_files_are_the_same_twice_and_nothing_else_is_left(quick, tmp_path):
    first = [p.read_bytes() for p in quick.write(tmp_path / "new" / "folder")]
    again = [p.read_bytes() for p in quick.write(tmp_path / "new" / "folder")]
    assert first == again and len(list((tmp_path / "new" / "folder").iterdir())) == len(first)


def test_symbols_are_spelled_alike_nowhere_within_a_result():
    for d in DERIVATIONS:
        names = {n for e in d.equations for n in (e.left, *e.formula.names)} - {
            "I_3",
            "I_6",
            "O_3",
            "O_31",
        }
        spelled = [SYMBOLS[n].latex for n in names]
        assert len(set(spelled)) == len(spelled)
