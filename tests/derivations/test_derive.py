"""The symbolic results: every check holds and would notice a wrong equation; what is printed; and
the C in the FMU agrees.
"""

import re
import subprocess
import sys
from dataclasses import replace
from xml.etree import ElementTree

import casadi as ca
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pyimu import cli, derivations
from pyimu.block.compiled import compiler_command
from pyimu.derivations import DERIVATIONS, Derived, correlated, errors, kinematics, printed, walk
from pyimu.derivations.files import write
from pyimu.derivations.independent import scalar_first
from pyimu.derivations.model import Check, Equation, call
from pyimu.derivations.symbols import SYMBOLS
from pyimu.derivations.tex import equation as latex_equation
from pyimu.fmu.generate import generated_folder
from pyimu.symbolic.earth import EARTH_RATE

BY_KEY = {d.key: d for d in DERIVATIONS}


# The checks


@pytest.mark.parametrize("key", BY_KEY)
def test_result_is_what_other_derivations_give(key):
    failed = [
        f"{c.against}: {c.largest:.3g} is above {c.bound:.3g}"
        for c in BY_KEY[key].check(BY_KEY[key])
        if not c.passed
    ]
    assert not failed, "\n".join(failed)


@pytest.mark.parametrize("key", BY_KEY)
def test_a_change_of_any_equation_is_noticed(key, monkeypatch):
    """Each equation in turn off by one part in ten million: a thousand times what any bound
    allows.
    """
    for module in (correlated, errors, kinematics, printed, walk):
        monkeypatch.setattr(module, "CASES", 10)
    monkeypatch.setattr(errors, "INTEGRATIONS", 2)
    d, unnoticed = BY_KEY[key], []
    for i, e in enumerate(d.equations):
        wrong = replace(
            d,
            equations=(
                *d.equations[:i],
                replace(e, right=f"({e.right})*1.0000001"),
                *d.equations[i + 1 :],
            ),
        )
        if all(c.passed for c in d.check(wrong)):
            unnoticed.append(e.left)
    assert not unnoticed


@pytest.mark.parametrize("key", BY_KEY)
def test_every_symbol_is_told_or_defined(key):
    d = BY_KEY[key]
    defined = {e.left for e in d.equations}
    told = {s.name for s in d.symbols}
    used = {n for e in d.equations for n in e.formula.names}
    assert used - defined <= told
    assert all(s.unit and s.meaning for s in d.symbols) and d.source and d.about


# What is printed


@pytest.fixture(scope="module")
def quick():
    """Results whose checks are made up: printing takes no part in them."""
    checks = (
        Check("a & b_c of 50 %, `F**2 = 0`", 3, 1.25e-15, 2e-13),
        Check("another", 1, 0.0, 1.0),
    )
    return Derived(
        tuple(
            derivations.Result(d, checks, tuple(d.tables(d)) if d is printed.PRINTED else ())
            for d in DERIVATIONS
        )
    )


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
        (
            derivations.Result(
                DERIVATIONS[0], (Check("x", 1, 2.0, 1.0), Check("y", 1, np.nan, 1.0)), ()
            ),
        )
    )
    assert (
        not failed.passed and "FAILED: largest difference 2, at most 1 expected" in failed.report()
    )
    assert failed.summary() == "1 results, 0 of 2 checks passed, failed: quaternion_kinematics"


def test_term_by_term_table_shows_sign_and_factors(quick):
    term, sign, turning = printed.PRINTED.tables(printed.PRINTED)
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
    tex = write(quick, tmp_path)[1].read_text(encoding="utf-8")
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
    page = write(quick, tmp_path)[2].read_text(encoding="utf-8")
    for block in re.findall(r"(?:^\|.*\n)+", page, flags=re.MULTILINE):
        assert len({len(re.findall(r"(?<!\\)\|", line)) for line in block.splitlines()}) == 1
    assert page.count("$$\n") == 2 * sum(len(d.equations) for d in DERIVATIONS) and "`" not in page


def test_files_are_the_same_twice_and_nothing_else_is_left(quick, tmp_path):
    first = [p.read_bytes() for p in write(quick, tmp_path / "new" / "folder")]
    again = [p.read_bytes() for p in write(quick, tmp_path / "new" / "folder")]
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


# The command


def run(monkeypatch, capsys, *words):
    monkeypatch.setattr(sys, "argv", ["pyimu", *map(str, words)])
    with pytest.raises(SystemExit) as end:
        cli.main()
    return end.value.code, *capsys.readouterr()


def test_command_prints_and_writes_the_same(quick, monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(derivations, "derive", lambda say: quick)
    code, out, err = run(monkeypatch, capsys, "derive", "--out", tmp_path / "here")
    report = (tmp_path / "here" / "derivations.txt").read_text(encoding="utf-8")
    assert code == 0 and err == "" and out.startswith(report)
    assert out[len(report) :].split() == [
        str(tmp_path / "here" / f"derivations.{e}") for e in ("txt", "tex", "md")
    ]


def test_command_ends_with_one_where_a_check_fails(quick, monkeypatch, capsys):
    failed = Derived((replace(quick.results[0], checks=(Check("x", 1, 2.0, 1.0),)),))
    monkeypatch.setattr(derivations, "derive", lambda say: failed)
    code, out, _ = run(monkeypatch, capsys, "derive")
    assert code == 1 and "FAILED" in out


def test_out_that_is_a_file_is_refused_before_the_work(monkeypatch, capsys, tmp_path):
    monkeypatch.setattr(derivations, "derive", lambda say: pytest.fail("worked first"))
    (tmp_path / "file").write_text("")
    code, _, err = run(monkeypatch, capsys, "derive", "--out", tmp_path / "file")
    assert code == 2 and err.count("\n") == 1 and "file" in err


# The C in the FMU


H, STEPS = 0.5, 4
"""A long period and a fast turn, so that every term of a transition counts."""

FLAGS = ("-std=c11", "-O1", "-ffp-contract=off", "-fPIC", "-shared", "-w")
"""As in the FMUs, without contracted multiply-adds."""

STD = 1e-5
"""rad, rad/s; so small that what an unscented filter adds to the linear covariance, of order STD^2,
stays below 1e-8."""


class FilterInC:
    """The checked-in C of AttitudeUkf, compiled; inputs, parameters and outputs by the names of its
    model description.
    """

    def __init__(self, folder):
        source = generated_folder() / "AttitudeUkf"
        library = folder / "libukf.so"
        subprocess.run(
            [*compiler_command(), *FLAGS, str(source / "step.c"), "-o", str(library), "-lm"],
            check=True,
        )
        self.step, self.initial = (
            ca.external("step", str(library)),
            ca.external("initial", str(library)),
        )
        variables = ElementTree.parse(source / "modelDescription.fmi3.xml").find("ModelVariables")
        self.names = {
            c: [v.get("name") for v in variables if v.get("causality") == c]
            for c in ("input", "parameter", "output")
        }
        start = {v.get("name"): v.get("start") for v in variables}
        self.p = {n: float(start[n]) for n in self.names["parameter"][: self.step.numel_in(2)]}

    def run(self, u, p):
        """Outputs after each row of inputs, given by name (others zero, and a force that opens no
        gate), by name.
        """
        parameters = list({**self.p, **p}.values())
        state, out = self.initial(parameters)[0], []
        for row in u:
            inputs = {
                "accel[1]": 50.0,
                "temperature": self.p.get("gyro_error.thermal_bias.T0", 25.0),
                **row,
            }
            state, y = self.step(
                state, [inputs.get(n, 0.0) for n in self.names["input"]], parameters, [], H
            )
            out.append(dict(zip(self.names["output"], np.array(y).ravel(), strict=True)))
        return out


@pytest.fixture(scope="module")
def in_c(tmp_path_factory):
    if not compiler_command():
        pytest.skip("needs a C compiler")
    return FilterInC(tmp_path_factory.mktemp("ukf"))


def named(name, values):
    return {f"{name}[{i + 1}]": float(v) for i, v in enumerate(values)}


def array(y, name, n):
    return np.array([y[f"{name}[{i + 1}]"] for i in range(n)])


def test_c_of_the_fmu_turns_as_the_derived_step_less_bias_and_earth_rate(in_c):
    omega = kinematics.CLOSED_STEP.function(("Omega",), ("omega", "h"))
    rng = np.random.default_rng(1)
    for _ in range(20):
        attitude, rate, bias = (
            Rotation.from_quat(rng.standard_normal(4)),
            rng.normal(size=3),
            rng.normal(size=3) / 10,
        )
        latitude, q = rng.uniform(-1.5, 1.5), scalar_first(attitude)
        y = in_c.run(
            [named("gyro", rate)],
            {
                "latitude": latitude,
                **named("q0", q),
                **named("bias0", bias),
                **named("std0", np.zeros(6)),
            },
        )[0]
        earth = call(
            errors.EARTH.function(("omega_enu",), ("lat", "omega_ie")), latitude, EARTH_RATE
        )[0]
        expected = call(omega, rate - bias - attitude.apply(earth, inverse=True), H)[0] @ q
        got = array(y, "q", 4)
        np.testing.assert_allclose(got * np.sign(got @ expected), expected, atol=1e-14)
        np.testing.assert_array_equal(array(y, "gyro_bias", 3), bias)


def covariances(rates, std0, n, k, sign=1.0):
    """Standard deviations (steps, 6) by the derived transition matrix and process noise."""
    transition = walk.TRANSITION.function(("Phi",), ("omega", "h", "s"))
    q = call(
        walk.STILL.function(("Q",), ("S_N", "S_K", "h", "s")), np.diag(n**2), np.diag(k**2), H, 1.0
    )[0]
    q[:3, 3:], q[3:, :3] = sign * q[:3, 3:], sign * q[3:, :3]
    p, out = np.diag(std0**2), []
    for rate in rates:
        phi = call(transition, rate, H, 1.0)[0]
        p = phi @ p @ phi.T + q
        out.append(np.sqrt(np.diag(p)))
    return np.array(out)


def test_c_of_the_fmu_has_the_derived_transition_matrix_and_process_noise(in_c):
    """The other sign off the diagonal would differ by more than a hundredth."""
    rng = np.random.default_rng(2)
    for _ in range(5):
        rates, std0, (n, k) = (
            rng.normal(size=(STEPS, 3)),
            STD * rng.uniform(0.5, 2, 6),
            STD * rng.uniform(0.5, 2, (2, 3)),
        )
        settings = {
            "latitude": 10.0,
            **named("std0", std0),
            **named("gyro_error.angle_random_walk.N", n),
            **named("gyro_error.rate_random_walk.K", k),
        }
        got = np.array(
            [
                array(y, "std", 6)
                for y in in_c.run([named("gyro", rate) for rate in rates], settings)
            ]
        )
        np.testing.assert_allclose(got, covariances(rates, std0, n, k), rtol=1e-8)
        assert np.abs(got / covariances(rates, std0, n, k, sign=-1.0) - 1).max() > 0.01


def test_equation_is_a_symbol_and_a_formula():
    for d in DERIVATIONS:
        assert all(
            isinstance(e, Equation) and e.left in SYMBOLS and e.formula.names is not None
            for e in d.equations
        )
