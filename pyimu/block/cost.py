"""How many operations one evaluation of a casadi function makes at most."""

from __future__ import annotations

import casadi as ca


def operations(function: ca.Function) -> int:
    """Of a choice between functions, those of the longest; of an operation on a matrix, one for
    each of its elements. Of a function of another kind, as a solver, nobody knows: it is one.
    """
    kind = function.class_name()
    if kind == "SXFunction":
        return function.n_instructions()
    if kind == "MXFunction":
        return sum(_of_instruction(function, k) for k in range(function.n_instructions()))
    if kind == "Switch":
        parts = function.info()
        return max(operations(each) for each in (*parts["f"], parts["f_def"]))
    return 1


def _of_instruction(function: ca.Function, k: int) -> int:
    kind = function.instruction_id(k)
    if kind in (ca.OP_INPUT, ca.OP_OUTPUT):
        return 1
    node = function.instruction_MX(k)
    return operations(node.which_function()) if kind == ca.OP_CALL else max(1, node.nnz())
