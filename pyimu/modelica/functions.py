"""Functions of Modelica from casadi expressions: one function for each output."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.modelica.graph import Node, nodes_of, replaced
from pyimu.modelica.names import indexed
from pyimu.modelica.printer import Statements, below, statements
from pyimu.modelica.text import wrapped

_CHOICE = re.compile(r"\w+(\[[\d,]+\]) := (if \w+ then \w+)\1( else \w+)\1;")
"""An element that is one of two arrays' elements at the same place."""


@dataclass(frozen=True)
class Argument:
    """An argument of a function: its casadi symbols in the order of ``elements``.

    ``elements`` are the indices (from 0) in the Modelica array of ``shape`` at which the symbols
    stand; what has no symbol is not used.
    """

    name: str
    shape: tuple[int, ...]
    symbols: ca.SX
    elements: tuple[tuple[int, ...], ...]
    boolean: bool = False

    @property
    def kind(self) -> str:
        return "Boolean" if self.boolean else "Real"

    @property
    def sized(self) -> str:
        return f"{self.name}[{','.join(map(str, self.shape))}]" if self.shape else self.name

    def leaf(self, k: int) -> Node:
        """The node of the k-th symbol."""
        op = "BOOLEAN" if self.boolean else "INPUT"
        return Node(op, text=indexed(self.name, self.elements[k]))


def array(name: str, shape: tuple[int, ...], symbols: ca.SX) -> Argument:
    """An argument all of whose elements have a symbol, which stand column by column."""
    return Argument(name, shape, ca.vec(symbols), tuple(_columns(shape)))


@dataclass(frozen=True)
class Function:
    """A function of Modelica whose one output ``result`` has a ``shape``."""

    name: str
    description: str
    arguments: tuple[Argument, ...]
    result: str
    shape: tuple[int, ...]
    body: Statements
    boolean: bool = False

    @property
    def result_declaration(self) -> str:
        size = f"[{','.join(map(str, self.shape))}]" if self.shape else ""
        return f"{'Boolean' if self.boolean else 'Real'} {self.result}{size}"

    @property
    def inputs(self) -> list[str]:
        """Declarations of the arguments."""
        return _declared("input ", ((a.kind, a.sized) for a in self.arguments))

    @property
    def variables(self) -> list[str]:
        """Declarations of the temporaries."""
        return _declared("", self.body.variables)

    @property
    def lines(self) -> list[str]:
        """The statements, the long ones in several lines."""
        return [part for line in self.body.lines for part in wrapped(line)]

    @property
    def plain(self) -> str:
        """The one expression that a call may be replaced by; empty where there is none.

        It is a constant, an argument as it is, or a choice between two.
        """
        if self.body.variables:
            return ""
        chosen = {
            "".join(m.groups()[1:]) if m else "" for m in map(_CHOICE.fullmatch, self.body.lines)
        }
        if len(chosen) == 1 and self._whole(*chosen):
            return chosen.pop()
        if not self.arguments and not self.shape:
            return self.body.lines[0].partition(" := ")[2].rstrip(";")
        if len(self.arguments) == 1 and self.arguments[0].shape == self.shape:
            name = self.arguments[0].name
            copied = [line.replace(self.result, name, 1) for line in self.body.lines]
            if all(
                line == f"{line.partition(' ')[0]} := {line.partition(' ')[0]};" for line in copied
            ):
                return name
        return ""

    def _whole(self, text: str) -> bool:
        """Whether a text names, beside Booleans, nothing but arrays of the result's shape."""
        named = [a for a in self.arguments if re.search(rf"\b{a.name}\b", text)]
        return bool(text) and all(a.boolean or a.shape == self.shape for a in named)

    def call(self, given: Mapping[str, str]) -> str:
        """A call with an expression for each argument by its name, its own name where none is."""
        if self.plain:
            return re.sub(r"[A-Za-z_]\w*", lambda name: given.get(name[0], name[0]), self.plain)
        return f"{self.name}({', '.join(given.get(a.name, a.name) for a in self.arguments)})"


def _declared(prefix: str, found: Iterable[tuple[str, str]]) -> list[str]:
    """Declarations of pairs of type and name, those of one type together."""
    lines: list[tuple[str, list[str]]] = []
    for kind, name in found:
        if not lines or lines[-1][0] != kind:
            lines.append((kind, []))
        lines[-1][1].append(name)
    return [
        line for kind, names in lines for line in wrapped(f"{prefix}{kind} {', '.join(names)};")
    ]


def function(
    name: str,
    description: str,
    arguments: Sequence[Argument],
    expression: ca.SX,
    shape: tuple[int, ...],
    what: str,
    result: str = "y",
    boolean: bool = False,
    positive: Iterable[str] = (),
    known: Sequence[Argument] = (),
) -> Function:
    """The function whose result is ``expression``, of those ``arguments`` that it depends on.

    The expression's elements stand column by column; ``positive`` are arguments that are never
    zero. ``known`` are further arguments, whose symbols are expressions of the others: what of
    them the result is made of is not computed again. Raises UserError, which starts with ``what``,
    where an operation cannot be said in Modelica.
    """
    given = [a.symbols for a in arguments]
    parts = [ca.vec(ca.SX(expression)), *(ca.vec(ca.SX(a.symbols)) for a in known)]
    dense = ca.cse(ca.densify(ca.vertcat(*parts)))
    compiled = ca.Function("f", given, [dense])
    order, found = nodes_of(compiled, lambda argument, k: arguments[argument].leaf(k))
    names = [indexed(result, i) for i in _columns(shape)]
    leaves = [a.leaf(k) for a in known for k in range(len(a.elements))]
    order, found = replaced(order, found[: len(names)], dict(zip(found[len(names) :], leaves)))
    arguments = [*arguments, *known]
    read = {node.text.partition("[")[0] for node in below(*found)}
    used = [a for a in arguments if a.name in read]
    taken = {a.name for a in arguments} | {result}
    body = statements(order, list(zip(names, found, strict=True)), taken, what, positive)
    return Function(name, description, tuple(used), result, shape, body, boolean)


def _columns(shape: tuple[int, ...]) -> list[tuple[int, ...]]:
    return sorted(np.ndindex(*shape), key=lambda i: i[::-1])
