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
``USUAL``, as do vectors that are read or filled, and a store ``STORED``."""

USUAL, FILLED, STORED = 3, 4, 1


def ordered(plan: Plan) -> list[Unit]:
    """The units of a plan, of those that can begin that first after which most cycles follow."""
    units, needs = plan.units, _needs(plan)
    cycles = [_cycles(plan, unit) for unit in units]
    followers: list[list[int]] = [[] for _ in units]
    for n, before in enumerate(needs):
        for m in before:
            followers[m].append(n)
    left = [0] * len(units)
    for n in reversed(range(len(units))):
        left[n] = cycles[n] + max((left[m] for m in followers[n]), default=0)
    missing, start = [len(before) for before in needs], [0] * len(units)
    ready = [(0, -left[n], n) for n in range(len(units)) if not missing[n]]
    return [units[n] for n in _listed(ready, followers, missing, start, left, cycles)]


def _listed(waiting: list, followers, missing, start, left, cycles) -> list[int]:
    """The list schedule (Graham 1966) of units that wait as (cycle, -cycles left, number)."""
    waiting, ready, out, now = sorted(waiting), [], [], 0
    while waiting or ready:
        while waiting and waiting[0][0] <= now:
            heappush(ready, heappop(waiting)[1:])
        for _ in range(min(AT_ONCE, len(ready))):
            _, n = heappop(ready)
            out.append(n)
            for m in followers[n]:
                start[m] = max(start[m], now + cycles[n])
                missing[m] -= 1
                if not missing[m]:
                    heappush(waiting, (start[m], -left[m], m))
        now += 1
    return out


def _cycles(plan: Plan, unit: Unit) -> int:
    if unit.kind in ("number", "computed"):
        op, operands = plan.alike.op[unit.lanes[0]], plan.alike.operands[unit.lanes[0]]
        if op == ca.OP_DIV and _is_power_of_two(plan, operands[1]):
            return USUAL  # a compiler multiplies
        return CYCLES.get(op, USUAL)
    return STORED if unit.kind == "stored" else FILLED


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
        if unit.kind != "stored":
            made[lanes if len(lanes) > 1 else lanes[0]] = n
    return needs
