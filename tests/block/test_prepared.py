"""What follows from some arguments alone is computed apart, and the bits stay the same."""

import casadi as ca
import numpy as np

from pyimu.block.plain import CALLS, plain_function
from pyimu.block.prepared import Prepared, taken_apart

X, P, H = ca.SX.sym("x", 2), ca.SX.sym("p", 3), ca.SX.sym("h")


def operations(*functions: ca.Function) -> set[int]:
    return {f.instruction_id(k) for f in functions for k in range(f.n_instructions())}


def functions() -> list[ca.Function]:
    gain = ca.exp(-H / P[0]) / (1 + P[1])
    one = [X * gain + ca.fmax(P[2], X[0]), ca.if_else(P[2] > 0, X[1], gain)]
    two = [ca.vertcat(-gain, X[0], 3.0), ca.sqrt(ca.sumsqr(X)) * ca.sin(P[0])]
    return [ca.Function(name, [X, P, H], out) for name, out in (("one", one), ("two", two))]


def test_the_parts_give_the_bits_of_the_functions_in_plain_arithmetic():
    constants, left = taken_apart(functions(), [1, 2])
    symbols = [X, P, H]
    given = [plain_function(f.name(), symbols, f.call(symbols, True, False)) for f in functions()]
    rng = np.random.default_rng(1)
    for x, p, h in zip(rng.normal(size=(9, 2)), rng.normal(size=(9, 3)), rng.random(9)):
        c = constants(p, h)
        for function, without in zip(given, left, strict=True):
            assert without.name() == function.name() and without.n_in() == 2
            for a, b in zip(function(x, p, h), without(x, c), strict=True):
                np.testing.assert_array_equal(np.array(a), np.array(b))


def test_what_is_left_has_no_operation_on_constants_alone():
    constants, left = taken_apart(functions(), [1, 2])
    # The gain, its negative, and where it is chosen; p[2], whether it is above zero; the sine.
    assert constants.numel_out(0) == 6
    assert not operations(*left) & {ca.OP_EXP, ca.OP_SIN, ca.OP_DIV, ca.OP_NEG}
    assert not operations(constants, *left) & CALLS


def test_the_whole_step_is_both_parts():
    s, u, w, c = (ca.SX.sym(n, k) for n, k in (("s", 2), ("u", 1), ("w", 0), ("c", 1)))
    constants = ca.Function("constants", [P, H], [P[0] * H])
    step = ca.Function(
        "quick", [s, u, P, w, H, c], [s + c, ca.dot(s, s) + u], [*"supwhc"], ["s_next", "y"]
    )
    after, y = Prepared(constants, step).whole([1.0, 2.0], 3.0, [0.5, 0, 0], [], 0.1)
    assert np.array(after).ravel().tolist() == [1.05, 2.05] and float(y) == 8.0
