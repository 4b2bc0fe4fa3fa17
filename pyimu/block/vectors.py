"""C of a function that is a plain list of operations, with vectors of four numbers.

Each lane does what casadi's virtual machine does with a number, so the bits are the same. What is
alike in the three axes of a body takes a third of the instructions, and a processor reads that much
less code. It pays where vectors of four fit the registers; of others a compiler makes more of it.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import casadi as ca

from pyimu.block.alike import MOST, VECTOR, Alike, Lanes
from pyimu.block.program import program
from pyimu.block.straight import SPELLED, as_body, name_of, places, straight
from pyimu.block.unit_order import ordered
from pyimu.block.vector_cost import Cost
from pyimu.block.vector_plan import Choice, Plan, Unit

LEAST_GAIN = 0.01
"""Instructions that a vector must save."""


@lru_cache(maxsize=256)
def vectors(function: ca.Function) -> str | None:
    """The body in C of an SX ``function`` with vectors, as ``straight`` has it without."""
    if straight(function) is None:
        return None
    one = program(function)
    sizes = [function.nnz_in(k) for k in range(function.n_in())]
    alike = Alike(one)
    plan = Plan(alike, chosen(alike, sizes), sizes)
    return as_body([*places(one), *_Text(alike, plan.choice).lines(ordered(plan))])


def chosen(alike: Alike, sizes: list[int]) -> Choice:
    """The vectors that save instructions, one seed after the other."""
    by_results = _with_seeds(alike, {}, sizes, alike.neighbours())
    return _with_seeds(alike, by_results, sizes, alike.likenesses(by_results))


def _with_seeds(alike: Alike, choice: Choice, sizes: list[int], seeds: Iterable[Lanes]) -> Choice:
    """The choice, and what of the ``seeds`` lowers the cost."""
    cost = Cost(alike, choice, sizes)
    for seed in seeds:
        if any(k in choice for k in seed):
            continue
        wider = _extended(alike, choice, seed)
        if cost.widened(wider, LEAST_GAIN):
            choice = wider
    return choice


def _extended(alike: Alike, choice: Choice, seed: Lanes) -> Choice:
    """The choice with a ``seed``, and with the operands of its vectors as vectors where they are
    alike.
    """
    choice, left = dict(choice), [seed]
    while left:
        lanes = left.pop()
        if not any(k in choice for k in lanes) and alike.together(lanes):
            choice |= {k: (lanes, lane) for lane, k in enumerate(lanes)}
            left += alike.aligned(lanes)
    return choice


class _Text:
    """Units in C."""

    def __init__(self, alike: Alike, choice: Choice) -> None:
        self.alike, self.choice = alike, choice
        self.vectors: dict[Lanes, str] = {}

    def lines(self, units: list[Unit]) -> list[str]:
        return [line for unit in units for line in self._of(unit)]

    def _of(self, unit: Unit) -> list[str]:
        if unit.kind == "number":
            return [f"const casadi_real {self._number(unit.lanes[0])}={self._operation(unit)};"]
        if unit.kind in ("stored", "copied"):
            return self._stored(unit)
        name = self.vectors[unit.lanes] = f"p{len(self.vectors)}"
        before = []
        if unit.kind == "computed":
            value = self._operation(unit)
        elif unit.kind == "read":
            value = "VECTOR4_AT(i{}+{})".format(*unit.place)
        elif unit.kind == "taken":
            number, start = unit.place
            before = [f"const Vector4 {name}m=VECTOR4_AT(i{number}+{start});"]
            value = _four([f"{name}m[{self.alike.read[k][1] - start}]" for k in unit.lanes])
        else:
            value = _four([self._number(k) for k in unit.lanes])
        return [*before, f"const Vector4 {name}={value};"]

    def _operation(self, unit: Unit) -> str:
        op = self.alike.op[unit.lanes[0]]
        if unit.kind == "number":
            return SPELLED[op].format(*map(self._number, self.alike.operands[unit.lanes[0]]))
        return VECTOR[op].format(*(self.vectors[a] for a in self.alike.aligned(unit.lanes)))

    def _stored(self, unit: Unit) -> list[str]:
        number, entry = unit.place
        if unit.kind == "copied":
            given, first = self.alike.read[unit.lanes[0]]
            return [f"STORE4(o{number}+{entry},VECTOR4_AT(i{given}+{first}));"]
        if len(unit.lanes) == 1:
            return [f"o{number}[{entry}]={self._number(unit.lanes[0])};"]
        name, kind = self.vectors[unit.lanes], len(unit.lanes)
        return [f"STORE{kind}(o{number}+{entry},{name});"]

    def _number(self, k: int) -> str:
        if k in self.choice:
            lanes, lane = self.choice[k]
            return f"{self.vectors[lanes]}[{lane}]"
        return name_of(self.alike.one, k)


def _four(numbers: list[str]) -> str:
    """A vector of ``numbers``, of which the last fills what is left."""
    return f"(Vector4){{{','.join([*numbers, *numbers[-1:] * (MOST - len(numbers))])}}}"
