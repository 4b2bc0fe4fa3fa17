"""Operations of a program that are alike, so that the lanes of one vector can do them together."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from functools import cached_property

import casadi as ca

from pyimu.block.program import LEAVES, Program

Lanes = tuple[int, ...]
"""Numbers of three or four instructions, one for each lane of a vector."""

AXES, MOST = 3, 4
"""Lanes of a vector that are used where three axes are alike, and all that it has."""

VECTOR = {
    ca.OP_ADD: "{0}+{1}",
    ca.OP_SUB: "{0}-{1}",
    ca.OP_MUL: "{0}*{1}",
    ca.OP_DIV: "{0}/{1}",
    ca.OP_INV: "1./{0}",
    ca.OP_SQ: "{0}*{0}",
    ca.OP_TWICE: "{0}+{0}",
    ca.OP_NEG: "-{0}",
    ca.OP_FABS: "FABS4({0})",
    ca.OP_SQRT: "SQRT4({0})",
    ca.OP_COPYSIGN: "COPYSIGN4({0},{1})",
    ca.OP_FMIN: "FMIN4({0},{1})",
    ca.OP_FMAX: "FMAX4({0},{1})",
    ca.OP_LT: "LESS4({0},{1})",
    ca.OP_LE: "AT_MOST4({0},{1})",
    ca.OP_EQ: "EQUAL4({0},{1})",
    ca.OP_NOT: "NOT4({0})",
    ca.OP_IF_ELSE_ZERO: "IF4({0},{1})",
}
"""Operations that vectors have, and their C by the macros of ``fmu_src/vector.h``."""

EITHER_WAY = frozenset((ca.OP_ADD, ca.OP_MUL))
"""Operations whose operands may be exchanged."""

MORE = {
    **dict.fromkeys((ca.OP_LT, ca.OP_LE, ca.OP_EQ, ca.OP_NOT, ca.OP_IF_ELSE_ZERO), (2.0, 2.0)),
    **dict.fromkeys((ca.OP_FMIN, ca.OP_FMAX), (2.0, 3.0)),
    ca.OP_COPYSIGN: (3.0, 3.0),
    ca.OP_SQRT: (1.0, 2.0),
}
"""Instructions of a processor for an operation on a number and on a vector, where not one each."""

READ = 0.35
"""What a number that is read from memory adds to them: most operations take one along."""

DEPTH = 3
"""Of operands by which two operations are compared."""


class Alike:
    """The operations of a program, and which of them resemble each other."""

    def __init__(self, one: Program) -> None:
        self.one = one
        self.op = [i.op for i in one.instructions]
        self.operands = [tuple(i.operands) for i in one.instructions]
        self.read = [i.of if i.op == ca.OP_INPUT else None for i in one.instructions]
        self._aligned: dict[Lanes, tuple[Lanes, ...]] = {}

    @cached_property
    def depth(self) -> list[int]:
        """How many operations stand behind each value, one after the other."""
        found: list[int] = []
        for operands in self.operands:
            found.append(1 + max((found[k] for k in operands), default=-1))
        return found

    @cached_property
    def inner(self) -> list[list[int]]:
        """The operands of each operation that are operations themselves."""
        return [[k for k in operands if not self.is_leaf(k)] for operands in self.operands]

    @cached_property
    def cost(self) -> list[float]:
        """What each operation costs on a number."""
        read = (sum(self.read[k] is not None for k in operands) for operands in self.operands)
        more = (MORE.get(op, (1.0, 1.0))[0] for op in self.op)
        return [m + READ * r for m, r in zip(more, read, strict=True)]

    @cached_property
    def results(self) -> dict[int, dict[int, int]]:
        """By number of a result, and of its entry, which instruction gives it."""
        found: dict[int, dict[int, int]] = {}
        for (number, entry), k in sorted(self.one.outputs.items()):
            found.setdefault(number, {})[entry] = k
        return found

    def is_leaf(self, k: int) -> bool:
        """Whether a value is an input or a constant."""
        return self.op[k] in LEAVES

    def together(self, lanes: Lanes) -> bool:
        """Whether one operation on vectors makes these values."""
        op = self.op[lanes[0]]
        alike = op in VECTOR and all(self.op[k] == op for k in lanes)
        return alike and len(set(lanes)) == len(lanes)

    def aligned(self, lanes: Lanes) -> tuple[Lanes, ...]:
        """The operands of such an operation, each a vector; of a sum or product in that order in
        which they resemble each other most.
        """
        if lanes not in self._aligned:
            pairs = [self.operands[k] for k in lanes]
            if self.op[lanes[0]] in EITHER_WAY:
                first = pairs[0]
                pairs = [first, *(self._exchanged(first, pair) for pair in pairs[1:])]
            self._aligned[lanes] = tuple(zip(*pairs, strict=True))
        return self._aligned[lanes]

    def _exchanged(self, first: Lanes, pair: Lanes) -> Lanes:
        def fits(one: Lanes) -> float:
            return sum(self._resemblance(a, b, DEPTH) for a, b in zip(first, one, strict=True))

        return pair[::-1] if fits(pair[::-1]) > fits(pair) else pair

    def _resemblance(self, one: int, two: int, depth: int) -> float:
        """How well two values go into one vector: the same value and two constants best, neighbours
        of one input well, and the same operation by what it is done on.
        """
        if one == two:
            return 3.0
        if self.is_leaf(one) or self.is_leaf(two):
            if self.op[one] == self.op[two] == ca.OP_CONST:
                return 3.0
            a, b = self.read[one], self.read[two]
            return 2.0 + (abs(a[1] - b[1]) < MOST) if a and b and a[0] == b[0] else 0.0
        if self.op[one] != self.op[two]:
            return 0.0
        pairs = zip(self.operands[one], self.operands[two], strict=True) if depth else ()
        return 1.5 + sum(self._resemblance(a, b, depth - 1) for a, b in pairs) / 4

    # Where vectors may begin

    def neighbours(self) -> list[Lanes]:
        """Operations whose values stand together in a result, three of them, the last first."""
        groups = (list(entries.values()) for entries in self.results.values())
        return [*self._groups(groups, AXES)][::-1]

    def likenesses(self, others: Container[int]) -> list[Lanes]:
        """Operations, ``others`` apart, that are made alike, in threes and then in fours, those
        first that have most behind them.
        """
        made: dict[tuple, list[int]] = {}
        for k, op in enumerate(self.op):
            if op in VECTOR and k not in others:
                made.setdefault((self.depth[k], self._made_of(k, DEPTH)), []).append(k)
        groups = [same for _, same in sorted(made.items(), key=lambda item: (-item[0][0], item[1]))]
        return [lanes for size in (AXES, MOST) for lanes in self._groups(groups, size)]

    def _groups(self, groups: Iterable[list[int]], size: int) -> Iterator[Lanes]:
        for values in groups:
            for at in range(len(values) - size + 1):
                lanes = tuple(values[at : at + size])
                if self.together(lanes):
                    yield lanes

    def _made_of(self, k: int, depth: int) -> tuple:
        """Of which operations a value is made."""
        read = self.read[k]
        if read is not None:
            return (self.op[k], read[0])
        if not depth:
            return (self.op[k],)
        operands = [self._made_of(j, depth - 1) for j in self.operands[k]]
        return (self.op[k], *(sorted(operands, key=repr) if self.op[k] in EITHER_WAY else operands))
