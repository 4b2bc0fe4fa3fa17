"""How many operations a function makes at most, counted by hand."""

import casadi as ca
import pytest

from pyimu.block.cost import operations

x = ca.SX.sym("x", 3)
f = ca.Function("f", [x], [ca.sin(x) + 1])
"""For each of three elements an input, a sine, a sum and an output, and the one, which is read once
for all.
"""


def test_of_scalars_every_instruction_counts():
    assert operations(f) == f.n_instructions() >= 3 * 4


def test_of_matrices_every_element_counts_and_of_calls_what_is_called():
    m = ca.MX.sym("m", 3)
    g = ca.Function("g", [m], [2 * f(m)])
    assert operations(g) == 1 + operations(f) + 3 + 1 + (g.n_instructions() - 4)


@pytest.mark.parametrize("longer_first", [True, False])
def test_of_a_choice_the_longest_counts(longer_first):
    short = ca.Function("short", [x], [x])
    branches = [f, short] if longer_first else [short, f]
    switch = ca.Function.conditional("choice", branches, short)
    assert operations(switch) == operations(f) > operations(short)
    assert operations(ca.Function.if_else("either", *branches)) == operations(f)


def test_of_a_solver_nobody_knows():
    a = ca.MX.sym("a", 2, 2)
    solver = ca.Linsol("s", "qr", a.sparsity())
    assert operations(ca.Function("solve", [a], [solver.solve(a, ca.DM.ones(2))])) >= 3
    root = ca.rootfinder("root", "newton", {"x": x, "g": x**2 - 4})
    assert operations(root) == 1
