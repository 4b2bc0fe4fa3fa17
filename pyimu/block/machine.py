"""A machine for programs of scalars, compiled once for all of them: it takes a step through a log.

What depends on neither state, input nor normals is done once, and the rest row after row.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np
from numba import njit

from pyimu.block.program import program

STATE, INPUT, NORMAL = -1, -2, -3
"""Where a value is read from: the state, this row's inputs, its normals."""

CODES = {
    ca.OP_ASSIGN: 0,
    ca.OP_ADD: 1,
    ca.OP_SUB: 2,
    ca.OP_MUL: 3,
    ca.OP_DIV: 4,
    ca.OP_NEG: 5,
    ca.OP_SQ: 6,
    ca.OP_TWICE: 7,
    ca.OP_INV: 8,
    ca.OP_EXP: 9,
    ca.OP_LOG: 10,
    ca.OP_POW: 11,
    ca.OP_CONSTPOW: 11,
    ca.OP_SQRT: 12,
    ca.OP_SIN: 13,
    ca.OP_COS: 14,
    ca.OP_TANH: 15,
    ca.OP_EXPM1: 16,
    ca.OP_ATAN2: 17,
    ca.OP_LT: 18,
    ca.OP_LE: 19,
    ca.OP_EQ: 20,
    ca.OP_NE: 21,
    ca.OP_NOT: 22,
    ca.OP_AND: 23,
    ca.OP_OR: 24,
    ca.OP_FLOOR: 25,
    ca.OP_CEIL: 26,
    ca.OP_FABS: 27,
    ca.OP_SIGN: 28,
    ca.OP_IF_ELSE_ZERO: 29,
    ca.OP_FMIN: 30,
    ca.OP_FMAX: 31,
    ca.OP_COPYSIGN: 32,
}
"""This machine's own numbers of casadi's operations, kind after kind: what is compiled is kept on
disk, and must mean the same beside another casadi.
"""


@njit(cache=True, error_model="numpy")
def _arithmetic(code, x, y):
    """What arithmetic makes of its operands."""
    if code == 0:
        return x
    if code == 1:
        return x + y
    if code == 2:
        return x - y
    if code == 3:
        return x * y
    if code == 4:
        return x / y
    if code == 5:
        return -x
    if code == 6:
        return x * x
    if code == 7:
        return x + x
    return 1.0 / x


@njit(cache=True, error_model="numpy")
def _function(code, x, y):
    """What a root, a power or a transcendental function makes of them."""
    if code == 9:
        return math.exp(x)
    if code == 10:
        return math.log(x) if x > 0.0 else (-np.inf if x == 0.0 else np.nan)
    if code == 11:
        return x**y
    if code == 12:
        return np.sqrt(x)
    if code == 13:
        return math.sin(x)
    if code == 14:
        return math.cos(x)
    if code == 15:
        return math.tanh(x)
    if code == 16:
        return math.expm1(x)
    return math.atan2(x, y)


@njit(cache=True, error_model="numpy")
def _truth(code, x, y):
    """What a comparison or a logical operation makes of them: 1 where it holds, 0 else."""
    if code == 18:
        return 1.0 if x < y else 0.0
    if code == 19:
        return 1.0 if x <= y else 0.0
    if code == 20:
        return 1.0 if x == y else 0.0
    if code == 21:
        return 1.0 if x != y else 0.0
    if code == 22:
        return 1.0 if x == 0.0 else 0.0
    if code == 23:
        return 1.0 if x != 0.0 and y != 0.0 else 0.0
    return 1.0 if x != 0.0 or y != 0.0 else 0.0


@njit(cache=True, error_model="numpy")
def _chosen(code, x, y):
    """What rounding, a sign or a choice among them gives."""
    if code == 25:
        return np.floor(x)
    if code == 26:
        return np.ceil(x)
    if code == 27:
        return abs(x)
    if code == 28:
        return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else x)
    if code == 29:
        return y if x != 0.0 else 0.0
    if code == 30:
        return x if x < y or y != y else y
    if code == 31:
        return x if x > y or y != y else y
    return math.copysign(x, y)


@njit(cache=True, error_model="numpy")
def _done(code, x, y):
    """What an operation makes of its operands."""
    if code < 9:
        return _arithmetic(code, x, y)
    if code < 18:
        return _function(code, x, y)
    if code < 25:
        return _truth(code, x, y)
    return _chosen(code, x, y)


@njit(cache=True, error_model="numpy")
def _evaluated(code, one, two, to, work):
    for i in range(len(code)):
        work[to[i]] = _done(code[i], work[one[i]], work[two[i]])


@njit(cache=True, error_model="numpy")
def _through(code, one, two, to, reads, source, work, ends, answers, s, u, w, y):
    """Take rows through a program, whose values are ``work``: ``reads`` (k, 2) from which
    ``source`` entry and to which value, ``ends`` the values that are the state after, ``answers``
    those that are the outputs.
    """
    for k in range(len(u)):
        for i in range(len(source)):
            at = reads[i, 0]
            if source[i] == STATE:
                work[reads[i, 1]] = s[at]
            elif source[i] == INPUT:
                work[reads[i, 1]] = u[k, at]
            else:
                work[reads[i, 1]] = w[k, at]
        _evaluated(code, one, two, to, work)
        for i in range(len(ends)):
            s[i] = work[ends[i]]
        for i in range(len(answers)):
            y[k, i] = work[answers[i]]


@dataclass(frozen=True)
class Machine:
    """A step function as this machine runs it.

    ``before`` and ``each`` are the operations (code, operands, place) that are done once and in
    each row; ``fixed`` where parameters and the sample period go.
    """

    start: np.ndarray
    fixed: tuple[tuple[int, int, int], ...]
    before: tuple[np.ndarray, ...]
    each: tuple[np.ndarray, ...]
    reads: np.ndarray
    source: np.ndarray
    ends: np.ndarray
    answers: np.ndarray

    def run(self, s, u, p, w, h, y) -> None:
        """What ``step_through`` does."""
        work = self.start.copy()
        for number, of, at in self.fixed:
            work[at] = (p if number == 2 else h)[of]
        _evaluated(*self.before, work)
        last = np.array(s)
        rows = np.ascontiguousarray
        answers = np.empty(y.shape)
        args = (self.reads, self.source, work, self.ends, self.answers)
        _through(*self.each, *args, last, rows(u), rows(w), answers)
        s[:], y[:] = last, answers


@lru_cache(maxsize=64)
def machine(step: ca.Function) -> Machine | None:
    """The machine of a step ``(s, u, p, w, h) -> (s_next, y)``; None where it has an operation that
    this machine does not know, calls other functions, or has an output that is not dense.
    """
    if not step.is_a("SXFunction") or not all(step.sparsity_out(i).is_dense() for i in range(2)):
        return None
    one = program(step)
    start, varies = np.zeros(len(one.instructions)), np.zeros(len(one.instructions), dtype=bool)
    fixed, reads, source = [], [], []
    done: tuple[list, list] = ([], [])
    for at, i in enumerate(one.instructions):
        if i.op == ca.OP_CONST:
            start[at] = i.value
        elif i.op == ca.OP_INPUT and i.of[0] in (2, 4):
            fixed.append((i.of[0], i.of[1], at))
        elif i.op == ca.OP_INPUT:
            varies[at] = True
            reads.append((i.of[1], at))
            source.append({0: STATE, 1: INPUT, 3: NORMAL}[i.of[0]])
        elif i.op not in CODES:
            return None
        else:
            varies[at] = varies[list(i.of)].any()
            done[int(varies[at])].append((CODES[i.op], i.of[0], i.of[-1], at))
    ends, answers = (
        np.array([one.outputs[k, n] for n in range(step.numel_out(k))], dtype=np.int64)
        for k in range(2)
    )
    before, each = (tuple(np.array(d, dtype=np.int64).reshape(-1, 4).T.copy()) for d in done)
    tables = np.array(reads, dtype=np.int64).reshape(-1, 2), np.array(source, dtype=np.int64)
    return Machine(start, tuple(fixed), before, each, *tables, ends, answers)
