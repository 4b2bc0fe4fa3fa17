"""Evaluation of a memoryless casadi function on whole columns with numpy.

There is one array operation for each of its instructions whose value is not known beforehand: a
coefficient that is zero, or a signal that never changes, takes all with it that follows from it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np

from pyimu.block.program import Program, program

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

Value = float | int
"""What is known of a value before any row is: itself, or the number of the instruction that gives
it.
"""

Step = tuple[int, Callable | None, int, int | None, tuple[int, ...]]


@dataclass(frozen=True)
class Plan:
    """What is left to do for each block of rows, and by number of an output what it is, ``given``.

    A step is the number of its value, its numpy twin (None for a column, whose number is the only
    operand), the places of its operands in ``work``, the second None where there is one, and those
    that nobody needs after it. Before the first step all places there are empty but those of
    numbers that are known.
    """

    steps: list[Step]
    work: list
    given: list[tuple[int, Value]]


def over_rows(
    function: ca.Function, columns: Sequence[np.ndarray], fixed: np.ndarray
) -> np.ndarray:
    """Values (n, m) of an SX function ``(row, fixed) -> dense (m,)`` for n rows, whose entries are
    the k ``columns`` (n,); each column of the answer is contiguous.

    Inputs are finite, so that what is multiplied by zero is zero. Raises NotImplementedError for an
    operation that has no numpy twin in the tables above.
    """
    return split_over_rows(function, columns, fixed, function.numel_out(0))[0]


def split_over_rows(
    function: ca.Function,
    columns: Sequence[np.ndarray],
    fixed: np.ndarray,
    first: int,
    wanted: np.ndarray | None = None,
    precision: type[np.floating] = np.float64,
) -> tuple[np.ndarray, list[np.ndarray]]:
    """The ``first`` of the values that ``over_rows`` gives, (n, first), and the others, m - first
    columns (n,) in a ``precision``; those that are not ``wanted`` (m,) are zero.

    Of the others those that are one, or the same in all rows, share their memory, and are not to be
    written to.
    """
    rows, m = len(columns[0]), function.numel_out(0)
    few = range(m) if wanted is None else np.flatnonzero(wanted).tolist()
    whole, others = np.zeros((first, rows)), [_same(0.0, rows, precision)] * m
    with np.errstate(all="ignore"):
        known = _known(columns, program(function).entries(0)) if rows > BLOCK else {}
        of_row = np.asarray(fixed, dtype=float).tobytes()
        plan = _plan(function, tuple(few), of_row, tuple(known), tuple(known.values()))
        varies = [(to, v) for to, v in plan.given if isinstance(v, int)]
        own = {v: np.empty(rows, precision) for to, v in varies if to >= first}
        for to, value in plan.given:
            if isinstance(value, int):
                others[to] = own.get(value, others[to])
            elif to < first:
                whole[to] = value
            else:
                others[to] = _same(value, rows, precision)
        into = [(whole[to], v) for to, v in varies if to < first]
        _run(plan, columns, [*into, *((array, v) for v, array in own.items())])
    return whole.T, others[first:]


def _same(value: float, rows: int, precision: type[np.floating]) -> np.ndarray:
    """A column (rows,) of one value."""
    return np.broadcast_to(precision(value), rows)


def _run(plan: Plan, columns: Sequence[np.ndarray], into: Sequence[tuple[np.ndarray, int]]) -> None:
    """Take the steps of a plan over all rows, block after block, and put what they give into arrays
    (n,), each with the number of its value.
    """
    rows = len(columns[0])
    for a in range(0, rows, BLOCK):
        b = min(a + BLOCK, rows)
        work = list(plan.work)
        for number, twin, first, second, dead in plan.steps:
            if twin is None:
                work[number] = columns[first][a:b]
            elif second is None:
                work[number] = twin(work[first])
            else:
                work[number] = twin(work[first], work[second])
            for i in dead:
                work[i] = None
        for array, number in into:
            array[a:b] = work[number]


def _known(columns: Sequence[np.ndarray], read: Sequence[int]) -> dict[int, float]:
    """Those of the columns that are ``read`` which are the same in all rows."""
    ends = ((k, c) for k in read if (c := columns[k])[0] == c[-1] == c[len(c) // 2])
    return {k: float(c[0]) for k, c in ends if np.all(c == c[0])}


@lru_cache(maxsize=256)
def _plan(
    function: ca.Function,
    wanted: tuple[int, ...],
    fixed: bytes,
    at: tuple[int, ...],
    known: tuple[float, ...],
) -> Plan:
    """The plan for a function, of whose outputs some are ``wanted``, at ``fixed`` coefficients and
    columns ``at`` places that are ``known``.
    """
    one, of_row, alike = program(function), np.frombuffer(fixed), dict(zip(at, known, strict=True))
    values: list[Value] = []
    for number, i in enumerate(one.instructions):
        if i.op == ca.OP_CONST:
            values.append(float(i.value))
        elif i.op == ca.OP_INPUT:
            row = alike.get(i.of[1], number)
            values.append(row if i.of[0] == 0 else float(of_row[i.of[1]]))
        else:
            values.append(_value(i.op, [values[k] for k in i.operands], number, function))
    given = [(to, values[one.outputs[0, to]]) for to in wanted if (0, to) in one.outputs]
    steps, work = _in_order(one, values, [v for _, v in given if isinstance(v, int)])
    return Plan(steps, work, given)


def _value(op: int, of: list[Value], number: int, function: ca.Function) -> Value:
    """The value of an operation: known, that of another instruction, or its own ``number``."""
    twin = _UNARY.get(op) or _BINARY.get(op)
    if twin is None:
        raise NotImplementedError(f"casadi operation {op} of {function.name()} has no numpy twin")
    if all(isinstance(v, float) for v in of):
        return float(twin(*of))
    if op == ca.OP_ASSIGN:
        return of[0]
    zero, one = ([isinstance(v, float) and v == size for v in of] for size in (0.0, 1.0))
    if op in (ca.OP_MUL, ca.OP_IF_ELSE_ZERO) and any(zero):
        return 0.0
    if op == ca.OP_IF_ELSE_ZERO and isinstance(of[0], float):
        return of[1]
    if op == ca.OP_ADD and any(zero) or op == ca.OP_MUL and any(one):
        return of[1] if (zero if op == ca.OP_ADD else one)[0] else of[0]
    if op == ca.OP_SUB and zero[1] or op == ca.OP_DIV and one[1]:
        return of[0]
    return number


def _in_order(one: Program, values: list[Value], wanted: list[int]) -> tuple[list[Step], list]:
    """The steps that ``wanted`` instructions need, and what they begin with."""
    needed, steps, numbers = set(wanted), [], []
    for number in range(len(values) - 1, -1, -1):
        if number not in needed:
            continue
        i = one.instructions[number]
        if i.op == ca.OP_INPUT:
            steps.append((number, None, i.of[1], None, ()))
            continue
        operands = [values[k] for k in i.operands]
        later = {v for v in operands if isinstance(v, int)}
        places = []
        for v in operands:
            places.append(v if isinstance(v, int) else len(values) + len(numbers))
            numbers += [] if isinstance(v, int) else [v]
        twin, second = _UNARY.get(i.op) or _BINARY.get(i.op), places[1] if places[1:] else None
        steps.append((number, twin, places[0], second, tuple(later - needed)))
        needed |= later
    return steps[::-1], [None] * len(values) + numbers
