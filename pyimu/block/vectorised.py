"""Evaluation of a memoryless casadi function on whole columns with numpy.

There is one array operation for each of its instructions.
"""

from __future__ import annotations

import casadi as ca
import numpy as np

_UNARY = {
    ca.OP_ASSIGN: np.positive,
    ca.OP_NEG: np.negative,
    ca.OP_EXP: np.exp,
    ca.OP_EXPM1: np.expm1,
    ca.OP_LOG: np.log,
    ca.OP_SQRT: np.sqrt,
    ca.OP_SQ: np.square,
    ca.OP_TWICE: lambda a: a + a,
    ca.OP_SIN: np.sin,
    ca.OP_COS: np.cos,
    ca.OP_TAN: np.tan,
    ca.OP_ASIN: np.arcsin,
    ca.OP_ACOS: np.arccos,
    ca.OP_ATAN: np.arctan,
    ca.OP_SINH: np.sinh,
    ca.OP_COSH: np.cosh,
    ca.OP_TANH: np.tanh,
    ca.OP_NOT: lambda a: (a == 0).astype(float),
    ca.OP_FLOOR: np.floor,
    ca.OP_CEIL: np.ceil,
    ca.OP_FABS: np.abs,
    ca.OP_SIGN: np.sign,
    ca.OP_INV: lambda a: 1.0 / a,
}
_BINARY = {
    ca.OP_ADD: np.add,
    ca.OP_SUB: np.subtract,
    ca.OP_MUL: np.multiply,
    ca.OP_DIV: np.divide,
    ca.OP_POW: np.power,
    ca.OP_CONSTPOW: np.power,
    ca.OP_LT: lambda a, b: (a < b).astype(float),
    ca.OP_LE: lambda a, b: (a <= b).astype(float),
    ca.OP_EQ: lambda a, b: (a == b).astype(float),
    ca.OP_NE: lambda a, b: (a != b).astype(float),
    ca.OP_AND: lambda a, b: ((a != 0) & (b != 0)).astype(float),
    ca.OP_OR: lambda a, b: ((a != 0) | (b != 0)).astype(float),
    ca.OP_FMIN: np.fmin,
    ca.OP_FMAX: np.fmax,
    ca.OP_FMOD: np.fmod,
    ca.OP_COPYSIGN: np.copysign,
    ca.OP_ATAN2: np.arctan2,
    ca.OP_HYPOT: np.hypot,
    ca.OP_IF_ELSE_ZERO: lambda c, a: np.where(c != 0, a, 0.0),
}


def over_rows(function: ca.Function, rows: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """Values (n, m) of an SX function ``(row, fixed) -> dense (m,)`` for every row of (n, k).

    Raises NotImplementedError for an operation that has no numpy twin in the tables above.
    """
    columns = np.ascontiguousarray(rows.T)
    out = np.zeros((function.numel_out(0), len(rows)))
    work: list = [None] * function.sz_w()
    with np.errstate(all="ignore"):
        for k in range(function.n_instructions()):
            op, to, of = (
                function.instruction_id(k),
                function.instruction_output(k),
                function.instruction_input(k),
            )
            if op == ca.OP_CONST:
                work[to[0]] = function.instruction_constant(k)
            elif op == ca.OP_INPUT:
                work[to[0]] = columns[of[1]] if of[0] == 0 else float(fixed[of[1]])
            elif op == ca.OP_OUTPUT:
                out[to[1]] = work[of[0]]
            elif op in _UNARY:
                work[to[0]] = _UNARY[op](np.asarray(work[of[0]]))
            elif op in _BINARY:
                work[to[0]] = _BINARY[op](np.asarray(work[of[0]]), np.asarray(work[of[1]]))
            else:
                raise NotImplementedError(
                    f"casadi operation {op} of {function.name()} has no numpy twin"
                )
    return out.T
