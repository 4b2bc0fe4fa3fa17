"""Functions of Modelica from casadi expressions: one function for each output."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.modelica.graph import Node, nodes_of
from pyimu.modelica.names import indexed
from pyimu.modelica.printer import Statements, below, statements
from pyimu.modelica.text import wrapped


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

        It is a constant or an argument as it is.
        """
        if self.body.variables:
            return ""
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

    def call(self, given: Mapping[str, str]) -> str:
        """A call with an expression for each argument by its name, its own name where none is."""
        if self.plain:
            return given.get(self.plain, self.plain)
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
) -> Function:
    """The function whose result is ``expression``, of those ``arguments`` that it depends on.

    The expression's elements stand column by column; ``positive`` are arguments that are never
    zero. Raises UserError, which starts with ``what``,
    where an operation cannot be said in Modelica.
    """
    given = [a.symbols for a in arguments]
    dense = ca.cse(ca.densify(ca.vec(ca.SX(expression))))
    compiled = ca.Function("f", given, [dense])
    order, found = nodes_of(compiled, lambda argument, k: arguments[argument].leaf(k))
    names = [indexed(result, i) for i in _columns(shape)]
    read = {node.text.partition("[")[0] for node in below(*found)}
    used = [a for a in arguments if a.name in read]
    taken = {a.name for a in arguments} | {result}
    body = statements(order, list(zip(names, found, strict=True)), taken, what, positive)
    return Function(name, description, tuple(used), result, shape, body, boolean)


def _columns(shape: tuple[int, ...]) -> list[tuple[int, ...]]:
    return sorted(np.ndindex(*shape), key=lambda i: i[::-1])
