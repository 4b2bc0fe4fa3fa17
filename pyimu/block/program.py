"""The instructions of a casadi function, each with a place of its own for what it gives.

A casadi function uses its places again and again; where each value has its own, what depends on
what can be read off.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import casadi as ca
import numpy as np


@dataclass(frozen=True)
class Instruction:
    """One operation ``op`` of casadi's on the values ``of`` earlier instructions.

    ``of`` is the number of an input and of its entry for ``OP_INPUT``, and empty for ``OP_CONST``,
    whose ``value`` it is.
    """

    op: int
    of: tuple[int, ...]
    value: float = 0.0


@dataclass(frozen=True)
class Program:
    """Instructions in their order, and by number of an output and of its entry which of them gives
    it.
    """

    instructions: tuple[Instruction, ...]
    outputs: dict[tuple[int, int], int]

    def needed(self, wanted: set[int]) -> list[int]:
        """The numbers, in order, of what the instructions ``wanted`` are made from."""
        known = np.zeros(len(self.instructions), dtype=bool)
        known[list(wanted)] = True
        for number in range(len(known) - 1, -1, -1):
            one = self.instructions[number]
            if known[number] and one.op != ca.OP_INPUT:
                known[list(one.of)] = True
        return np.flatnonzero(known).tolist()


@lru_cache(maxsize=256)
def program(function: ca.Function) -> Program:
    """The program of an SX function."""
    made: list[Instruction] = []
    place: dict[int, int] = {}
    outputs: dict[tuple[int, int], int] = {}
    for k in range(function.n_instructions()):
        op, to = function.instruction_id(k), function.instruction_output(k)
        of = tuple(function.instruction_input(k))
        if op == ca.OP_OUTPUT:
            outputs[to[0], to[1]] = place[of[0]]
            continue
        if op == ca.OP_CONST:
            one = Instruction(op, (), function.instruction_constant(k))
        else:
            one = Instruction(op, of if op == ca.OP_INPUT else tuple(place[i] for i in of))
        place[to[0]] = len(made)
        made.append(one)
    return Program(tuple(made), outputs)
