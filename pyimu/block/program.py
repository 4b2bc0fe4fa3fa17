"""The instructions of a casadi function, each with a place of its own for what it gives.

A casadi function uses its places again and again; where each value has its own, what depends on
what can be read off.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import casadi as ca

UNARY = frozenset(
    getattr(ca, f"OP_{name}")
    for name in (
        "ASSIGN NEG EXP EXPM1 LOG LOG1P SQRT SQ TWICE SIN COS TAN ASIN ACOS ATAN SINH COSH TANH "
        "ASINH ACOSH ATANH NOT FLOOR CEIL FABS SIGN INV ERF ERFINV"
    ).split()
)
"""Operations on one number; of others casadi knows those on two alone."""

LEAVES = (ca.OP_CONST, ca.OP_INPUT)
"""Instructions that take no value of an earlier one."""


def operands_of(op: int, named: Sequence[int]) -> Sequence[int]:
    """What an operation takes of the values that casadi has ``named``: that of one number it names
    twice.
    """
    return named[:1] if op in UNARY else named


class Instruction(NamedTuple):
    """One operation ``op`` of casadi's on the values ``of`` earlier instructions.

    ``of`` is the number of an input and of its entry for ``OP_INPUT``, and empty for ``OP_CONST``,
    whose ``value`` it is.
    """

    op: int
    of: tuple[int, ...]
    value: float = 0.0

    @property
    def operands(self) -> Sequence[int]:
        """The values that an operation takes; none for an input or a constant."""
        return () if self.op in LEAVES else operands_of(self.op, self.of)

    def value_of(self, inputs: Sequence[ca.SX], operands: Sequence[ca.SX]) -> ca.SX:
        """What it gives of the ``inputs`` of its function and the values of its ``operands``."""
        if self.op == ca.OP_CONST:
            return ca.SX(self.value)
        if self.op == ca.OP_INPUT:
            return inputs[self.of[0]].nz[self.of[1]]
        return (ca.SX.unary if len(operands) == 1 else ca.SX.binary)(self.op, *operands)


@dataclass(frozen=True)
class Program:
    """Instructions in their order, and by number of an output and of its entry which of them gives
    it.
    """

    instructions: tuple[Instruction, ...]
    outputs: dict[tuple[int, int], int]

    def entries(self, number: int) -> list[int]:
        """The entries of an input that the function reads."""
        read = (i.of for i in self.instructions if i.op == ca.OP_INPUT)
        return sorted({entry for which, entry in read if which == number})


@lru_cache(maxsize=256)
def program(function: ca.Function) -> Program:
    """The program of an SX function."""
    made: list[Instruction] = []
    place: dict[int, int] = {}
    outputs: dict[tuple[int, int], int] = {}
    for k in range(function.n_instructions()):
        op, to = function.instruction_id(k), function.instruction_output(k)
        if op == ca.OP_CONST:
            one = Instruction(op, (), function.instruction_constant(k))
        else:
            of = function.instruction_input(k)
            if op == ca.OP_OUTPUT:
                outputs[to[0], to[1]] = place[of[0]]
                continue
            one = Instruction(op, tuple(of if op == ca.OP_INPUT else [place[i] for i in of]))
        place[to[0]] = len(made)
        made.append(one)
    return Program(tuple(made), outputs)
