"""A casadi function as a graph of scalar operations, with what Modelica has no word for taken out.

A number that is not NaN is known there to be one, so that the test for it is true; a choice, which
casadi writes as a sum of two products with a condition, is one node.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import casadi as ca

from pyimu.block.program import operands_of

OPERATIONS = {getattr(ca, name): name[3:] for name in dir(ca) if name.startswith("OP_")}
"""Number to name of every operation of casadi."""

RELATIONS = {"LT": "<", "LE": "<=", "EQ": "==", "NE": "<>"}

BOOLEAN = frozenset({*RELATIONS, "NOT", "AND", "OR", "BOOLEAN"})
"""Operations whose value is true or false; ``BOOLEAN`` is an input or a constant that is so."""


@dataclass(frozen=True, eq=False)
class Node:
    """One operation on others; ``text`` is an input's name, ``value`` a constant's."""

    op: str
    args: tuple[Node, ...] = ()
    text: str = ""
    value: float = 0.0

    @property
    def is_boolean(self) -> bool:
        return self.op in BOOLEAN

    @property
    def is_leaf(self) -> bool:
        return not self.args


TRUE = Node("BOOLEAN", text="true")
FALSE = Node("BOOLEAN", text="false")


def number(value: float) -> Node:
    return Node("CONST", value=float(value))


def nodes_of(
    function: ca.Function, leaf: Callable[[int, int], Node]
) -> tuple[list[Node], list[Node]]:
    """All nodes in casadi's order, and those of the dense output.

    ``leaf(argument, element)`` is the node of an element of an argument.
    """
    work: dict[int, Node] = {}
    seen: dict[tuple, Node] = {}  # what was two before numbers were known to be such may be one
    made: list[Node] = []
    outputs: dict[int, Node] = {}
    for i in range(function.n_instructions()):
        op = OPERATIONS[function.instruction_id(i)]
        inputs, results = function.instruction_input(i), function.instruction_output(i)
        if op == "OUTPUT":
            outputs[results[1]] = work[inputs[0]]
            continue
        if op == "INPUT":
            node = leaf(inputs[0], inputs[1])
        elif op == "CONST":
            node = number(function.instruction_constant(i))
        else:
            taken = operands_of(function.instruction_id(i), inputs)
            node = _simplified(op, [work[j] for j in taken])
        node = seen.setdefault((node.op, node.args, node.text, repr(node.value)), node)
        work[results[0]] = node
        made.append(node)
    return made, [outputs.get(k, number(0.0)) for k in range(function.nnz_out(0))]


def _simplified(op: str, args: list[Node]) -> Node:
    if op == "ASSIGN":
        return args[0]
    if op in ("LE", "LT") and (_is(args[1], math.inf) or _is(args[0], -math.inf)):
        return TRUE
    if op in ("NOT", "AND", "OR"):
        return _logic(op, args)
    if op == "IF_ELSE_ZERO":
        if args[0] is TRUE:
            return args[1]
        return number(0.0) if args[0] is FALSE else Node(op, tuple(args))
    if op == "ADD":
        return _sum(*args)
    return Node(op, tuple(args))


def _logic(op: str, args: list[Node]) -> Node:
    first = args[0]
    if op == "NOT":
        if first in (TRUE, FALSE):
            return FALSE if first is TRUE else TRUE
        return first.args[0] if first.op == "NOT" else Node(op, (first,))
    neutral, ruling = (TRUE, FALSE) if op == "AND" else (FALSE, TRUE)
    if ruling in args:
        return ruling
    left = [a for a in args if a is not neutral]
    return Node(op, tuple(left)) if len(left) == 2 else (left or [neutral])[0]


def _sum(a: Node, b: Node) -> Node:
    """A sum; of two terms of which one is there where the other is not, the choice."""
    for one, other in ((a, b), (b, a)):
        if _is(one, 0.0):
            return other
    if a.op == b.op == "IF_ELSE_ZERO":
        condition, opposite = a.args[0], b.args[0]
        if opposite.op == "NOT" and opposite.args[0] is condition:
            return Node("IF", (condition, a.args[1], b.args[1]))
        if condition.op == "NOT" and condition.args[0] is opposite:
            return Node("IF", (opposite, b.args[1], a.args[1]))
    return Node("ADD", (a, b))


def _is(node: Node, value: float) -> bool:
    return node.op == "CONST" and node.value == value


def replaced(
    order: Sequence[Node], results: Sequence[Node], others: Mapping[Node, Node]
) -> tuple[list[Node], list[Node]]:
    """The same graph with operations replaced by what ``others`` gives for them."""
    new = {node: other for node, other in others.items() if not node.is_leaf}
    for node in order:
        if node not in new:
            args = tuple(new.get(a, a) for a in node.args)
            new[node] = node if args == node.args else replace(node, args=args)
    return [new[node] for node in order], [new.get(node, node) for node in results]
