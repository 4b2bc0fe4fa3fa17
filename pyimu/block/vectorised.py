"""Evaluation of a memoryless casadi function on whole columns with numpy.

There is one array operation for each of its instructions.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import casadi as ca
import numpy as np

_UNARY = {
    ca.OP_ASSIGN: lambda a: a,
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
    ca.OP_NOT: lambda a: np.equal(a, 0).astype(float),
    ca.OP_FLOOR: np.floor,
    ca.OP_CEIL: np.ceil,
    ca.OP_FABS: np.abs,
    ca.OP_SIGN: np.sign,
    ca.OP_INV: lambda a: np.divide(1.0, a),
}
_BINARY = {
    ca.OP_ADD: np.add,
    ca.OP_SUB: np.subtract,
    ca.OP_MUL: np.multiply,
    ca.OP_DIV: np.divide,
    ca.OP_POW: np.power,
    ca.OP_CONSTPOW: np.power,
    ca.OP_LT: lambda a, b: np.less(a, b).astype(float),
    ca.OP_LE: lambda a, b: np.less_equal(a, b).astype(float),
    ca.OP_EQ: lambda a, b: np.equal(a, b).astype(float),
    ca.OP_NE: lambda a, b: np.not_equal(a, b).astype(float),
    ca.OP_AND: lambda a, b: np.logical_and(a, b).astype(float),
    ca.OP_OR: lambda a, b: np.logical_or(a, b).astype(float),
    ca.OP_FMIN: np.fmin,
    ca.OP_FMAX: np.fmax,
    ca.OP_FMOD: np.fmod,
    ca.OP_COPYSIGN: np.copysign,
    ca.OP_ATAN2: np.arctan2,
    ca.OP_HYPOT: np.hypot,
    ca.OP_IF_ELSE_ZERO: lambda c, a: np.where(np.not_equal(c, 0), a, 0.0),
}


BLOCK = 4096
"""Rows that are evaluated at once: few enough that what is worked on stays in the cache."""


def over_rows(
    function: ca.Function, columns: Sequence[np.ndarray], fixed: np.ndarray
) -> np.ndarray:
    """Values (n, m) of an SX function ``(row, fixed) -> dense (m,)`` for n rows, whose entries are
    the k ``columns`` (n,); each column of the answer is contiguous.

    Raises NotImplementedError for an operation that has no numpy twin in the tables above.
    """
    rows, program = len(columns[0]), _program(function)
    out = np.zeros((function.numel_out(0), rows))
    work: list = [None] * function.sz_w()
    with np.errstate(all="ignore"):
        for a in range(0, rows, BLOCK):
            b = min(a + BLOCK, rows)
            for op, to, of, twin in program:
                if op == ca.OP_CONST:
                    work[to] = of
                elif op == ca.OP_INPUT:
                    work[to] = columns[of[1]][a:b] if of[0] == 0 else float(fixed[of[1]])
                elif op == ca.OP_OUTPUT:
                    out[to, a:b] = work[of[0]]
                else:
                    work[to] = twin(*[work[i] for i in of])
    return out.T


@lru_cache(maxsize=256)
def _program(function: ca.Function) -> list[tuple]:
    """Instructions of a function: what it does, where to, of what, and the numpy twin of that."""
    out: list[tuple] = []
    for k in range(function.n_instructions()):
        op, to = function.instruction_id(k), function.instruction_output(k)
        of = function.instruction_input(k)
        if op == ca.OP_CONST:
            out.append((op, to[0], function.instruction_constant(k), None))
        elif op == ca.OP_OUTPUT:
            out.append((op, to[1], of, None))
        elif op == ca.OP_INPUT:
            out.append((op, to[0], of, None))
        elif op in _UNARY:
            out.append((op, to[0], of[:1], _UNARY[op]))
        elif op in _BINARY:
            out.append((op, to[0], of[:2], _BINARY[op]))
        else:
            raise NotImplementedError(
                f"casadi operation {op} of {function.name()} has no numpy twin"
            )
    return out
