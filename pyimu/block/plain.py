"""Casadi functions in plain arithmetic, which gives the same bits on every platform.

What IEEE 754 prescribes to the last bit, sums, products, roots, is the same everywhere; sines and
exponentials are as the C library at hand has them. Whatever units compute is therefore made here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import casadi as ca

from pyimu.block.program import Instruction, Program, program
from pyimu.symbolic import elementary

PLAIN: dict[int, Callable[..., ca.SX]] = {
    ca.OP_SIN: elementary.sine,
    ca.OP_COS: elementary.cosine,
    ca.OP_TAN: elementary.tangent,
    ca.OP_ASIN: elementary.arc_sine,
    ca.OP_ACOS: elementary.arc_cosine,
    ca.OP_ATAN: lambda x: elementary.arc_tangent(x, ca.SX(1)),
    ca.OP_ATAN2: elementary.arc_tangent,
    ca.OP_EXP: elementary.exponential,
    ca.OP_EXPM1: elementary.exponential_less_one,
    ca.OP_LOG: elementary.logarithm,
    ca.OP_TANH: elementary.hyperbolic_tangent,
    ca.OP_SINH: elementary.hyperbolic_sine,
    ca.OP_COSH: elementary.hyperbolic_cosine,
}
"""What stands for a function of the C library. A power of one variable to another, ``log1p``,
``erf`` and the inverse hyperbolic functions, which no effect or filter has, stay calls; ``fmod`` is
exact everywhere."""

POWERS = (ca.OP_POW, ca.OP_CONSTPOW)
CALLS = frozenset((*PLAIN, *POWERS))

LARGEST_POWER = 16
"""Of whole powers, which are products; casadi has a square of its own."""


def plain_function(
    name: str, arguments: Sequence, results: Sequence, *rest: Any, **named: Any
) -> ca.Function:
    """``casadi.Function(name, arguments, results, ...)`` in plain arithmetic.

    What is made of functions is as these are.
    """
    made = ca.Function(name, arguments, results, *rest, **named)
    if not made.is_a("SXFunction") or CALLS.isdisjoint(
        map(made.instruction_id, range(made.n_instructions()))
    ):
        return made
    one = program(made)
    symbols = made.sx_in()
    values = _values(one, symbols)
    found = [ca.SX(made.sparsity_out(k)) for k in range(made.n_out())]
    for (k, entry), place in one.outputs.items():
        found[k].nz[entry] = values[place]
    return ca.Function(name, symbols, found, *rest, **named)


def _values(one: Program, symbols: Sequence[ca.SX]) -> list[ca.SX]:
    """What each instruction gives."""
    values: list[ca.SX] = []
    for i in one.instructions:
        plain = _stands_for(one, i)
        operands = [values[k] for k in i.operands]
        values.append(plain(*operands) if plain else i.value_of(symbols, operands))
    return values


def _stands_for(one: Program, i: Instruction) -> Callable[..., ca.SX] | None:
    """What is computed in place of an instruction, if that is a call."""
    if i.op not in POWERS:
        return PLAIN.get(i.op)
    base, to = (one.instructions[k] for k in i.of)
    if to.op == ca.OP_CONST and abs(to.value) <= LARGEST_POWER and to.value == int(to.value):
        return lambda x, n: _power(x, int(to.value))
    if base.op == ca.OP_CONST and base.value > 0:
        return lambda x, y: elementary.exponential(math.log(base.value) * y)
    return None


def _power(x: ca.SX, n: int) -> ca.SX:
    product = ca.SX(1)
    for _ in range(abs(n)):
        product = product * x
    return product if n >= 0 else 1 / product
