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
    needs: list[set[int]], followers: list[list[int]], left: list[int], cycles
) -> list[int]:
    """The list schedule (Graham 1966) of units with so many ``cycles`` to their end ``left``."""
    missing, start = [len(before) for before in needs], [0] * len(needs)
    users, held = [len(after) for after in followers], 0
    waiting = [(0, n) for n in range(len(needs)) if not missing[n]]
    ready: set[int] = set()
    out: list[int] = []

    def more(n: int) -> int:
        """How many more values are held after a unit."""
        return (users[n] > 0) - sum(users[m] == 1 for m in needs[n])

    now = 0
    while len(out) < len(needs):
        while waiting and waiting[0][0] <= now:
            ready.add(heappop(waiting)[1])
        for _ in range(min(AT_ONCE, len(ready))):
            full = held > HELD
            n = min(ready, key=lambda k: (more(k) if full else 0, -left[k], k))
            ready.discard(n)
            held += more(n)
            out.append(n)
            for m in needs[n]:
                users[m] -= 1
            for m in followers[n]:
                start[m] = max(start[m], now + cycles[n])
                missing[m] -= 1
                if not missing[m]:
                    heappush(waiting, (start[m], m))
        now += 1
    return out


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
