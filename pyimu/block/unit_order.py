"""The order in which a processor does units soonest.

It begins an operation once its operands are there, as far as it looks ahead, which is some hundred
operations of the thousands of a step. In casadi's order many of these wait for one another.
"""

from __future__ import annotations

from heapq import heappop, heappush
from math import frexp

import casadi as ca

from pyimu.block.vector_plan import Plan, Unit

AT_ONCE = 4
"""Operations that begin in one cycle."""

CYCLES = {
    ca.OP_ADD: 2,
    ca.OP_SUB: 2,
    ca.OP_TWICE: 2,
    ca.OP_NEG: 1,
    ca.OP_FABS: 1,
    ca.OP_DIV: 13,
    ca.OP_INV: 13,
    ca.OP_SQRT: 20,
    ca.OP_LT: 4,
    ca.OP_LE: 4,
    ca.OP_EQ: 4,
    ca.OP_NE: 4,
    ca.OP_NOT: 5,
    ca.OP_AND: 5,
    ca.OP_OR: 5,
}
"""After which the value of an operation is there, of processors of these years; others take
``USUAL``, vectors that are read or filled ``FILLED``, and a store ``STORED``."""

HELD = 60
"""Values that wait for their use, beyond which those are made first that end the waiting of others.

A processor has 32 registers; what is kept in memory besides costs code, of which a step must fit
the processor's 32 kB. Of 24 to 180, 60 and 90 took least time with an update by gravity, by 7 %,
and 130 without, by 2 %."""

USUAL, FILLED, STORED = 3, 4, 1


def ordered(plan: Plan) -> list[Unit]:
    """The units of a plan, of those that can begin that first after which most cycles follow; where
    more values wait than ``HELD``, that first which leaves fewest.
    """
    units, needs = plan.units, _needs(plan)
    cycles = [_cycles(plan, unit) for unit in units]
    followers: list[list[int]] = [[] for _ in units]
    for n, before in enumerate(needs):
        for m in before:
            followers[m].append(n)
    left = [0] * len(units)
    for n in reversed(range(len(units))):
        left[n] = cycles[n] + max((left[m] for m in followers[n]), default=0)
    return [units[n] for n in _listed(needs, followers, left, cycles)]


def _listed(
    needs: list[set[int]], followers: list[list[int]], left: list[int], cycles: list[int]
) -> list[int]:
    """The list schedule (Graham 1966) of units with so many ``cycles`` to their end ``left``."""
    missing, start = [len(before) for before in needs], [0] * len(needs)
    waiting = [(0, n) for n in range(len(needs)) if not missing[n]]
    ready = _Ready(needs, followers, left)
    out: list[int] = []
    now = 0
    while len(out) < len(needs):
        while waiting and waiting[0][0] <= now:
            ready.add(heappop(waiting)[1])
        for _ in range(min(AT_ONCE, len(ready.units))):
            n = ready.taken()
            out.append(n)
            for m in followers[n]:
                start[m] = max(start[m], now + cycles[n])
                missing[m] -= 1
                if not missing[m]:
                    heappush(waiting, (start[m], m))
        now += 1
    return out


class _Ready:
    """The ``units`` that can begin, and how many values are ``held`` for their use.

    A unit stands in two heaps, by what it leaves to do and by how many more values are held after
    it; the second changes while it waits, so that its older entries there no longer count.
    """

    def __init__(self, needs: list[set[int]], followers: list[list[int]], left: list[int]) -> None:
        self.needs, self.followers, self.left = needs, followers, left
        self.units: set[int] = set()
        self.held = 0
        self._users = [len(after) for after in followers]
        self._more = [
            (self._users[n] > 0) - sum(self._users[m] == 1 for m in before)
            for n, before in enumerate(needs)
        ]
        self._done = [False] * len(needs)
        self._by_left: list[tuple[int, int]] = []
        self._by_more: list[tuple[int, int, int]] = []

    def add(self, n: int) -> None:
        self.units.add(n)
        heappush(self._by_left, (-self.left[n], n))
        heappush(self._by_more, (self._more[n], -self.left[n], n))

    def taken(self) -> int:
        """The unit that is done next."""
        n = self._fewest() if self.held > HELD else self._longest()
        self.units.discard(n)
        self._done[n] = True
        self.held += self._more[n]
        for m in self.needs[n]:
            self._users[m] -= 1
            if self._users[m] == 1:
                self._ends(next(f for f in self.followers[m] if not self._done[f]))
        return n

    def _longest(self) -> int:
        while self._by_left[0][1] not in self.units:
            heappop(self._by_left)
        return heappop(self._by_left)[1]

    def _fewest(self) -> int:
        while True:
            more, _, n = heappop(self._by_more)
            if n in self.units and more == self._more[n]:
                return n

    def _ends(self, n: int) -> None:
        """A unit has become the last that uses one of its values."""
        self._more[n] -= 1
        if n in self.units:
            heappush(self._by_more, (self._more[n], -self.left[n], n))


def _cycles(plan: Plan, unit: Unit) -> int:
    if unit.kind in ("number", "computed"):
        op, operands = plan.alike.op[unit.lanes[0]], plan.alike.operands[unit.lanes[0]]
        if op == ca.OP_DIV and _is_power_of_two(plan, operands[1]):
            return USUAL  # a compiler multiplies
        return CYCLES.get(op, USUAL)
    return STORED if unit.kind in ("stored", "copied") else FILLED


def _is_power_of_two(plan: Plan, k: int) -> bool:
    one = plan.alike.one.instructions[k]
    return one.op == ca.OP_CONST and abs(frexp(one.value)[0]) == 0.5


def _needs(plan: Plan) -> list[set[int]]:
    """By number of a unit those that come before it."""
    alike, choice = plan.alike, plan.choice
    made: dict = {}
    needs = []
    for n, unit in enumerate(plan.units):
        lanes = unit.lanes
        if unit.kind == "number":
            wanted = [choice[k][0] if k in choice else k for k in alike.operands[lanes[0]]]
        elif unit.kind == "computed":
            wanted = [*alike.aligned(lanes)]
        elif unit.kind == "stored" and len(lanes) > 1:
            wanted = [lanes]
        elif unit.kind in ("stored", "filled"):
            wanted = [choice[k][0] if k in choice else k for k in lanes]
        else:
            wanted = []
        needs.append({made[value] for value in wanted if value in made})
        if unit.kind not in ("stored", "copied"):
            made[lanes if len(lanes) > 1 else lanes[0]] = n
    return needs
