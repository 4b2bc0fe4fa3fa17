"""The statements of a Modelica function from a graph of scalar operations.

What is used once stands where it is used, what is used more often is a variable of its own,
assigned in casadi's order. Parentheses keep casadi's order of operations, on which the last bits
depend.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from pyimu.errors import UserError
from pyimu.modelica.graph import FALSE, RELATIONS, TRUE, Node

_IF, _OR, _AND, _NOT, _RELATION, _SUM, _PRODUCT, _ATOM = range(8)
"""How strongly an expression holds together (Modelica specification 3.6, 3.2)."""

_FUNCTIONS = {
    "EXP": "exp",
    "LOG": "log",
    "SQRT": "sqrt",
    "SIN": "sin",
    "COS": "cos",
    "TAN": "tan",
    "ASIN": "asin",
    "ACOS": "acos",
    "ATAN": "atan",
    "ATAN2": "atan2",
    "SINH": "sinh",
    "COSH": "cosh",
    "TANH": "tanh",
    "FLOOR": "floor",
    "CEIL": "ceil",
    "FABS": "abs",
    "SIGN": "sign",
    "FMIN": "min",
    "FMAX": "max",
    "EXPM1": "PyImu.Math.expm1",
}
"""What is a function of the same arguments there."""

_INFIX = {
    "ADD": (" + ", _SUM),
    "SUB": (" - ", _SUM),
    "MUL": ("*", _PRODUCT),
    "DIV": ("/", _PRODUCT),
}

LARGEST_INTEGER = 1e5
"""Whole constants up to it are written without a point: far below what an Integer may be."""

_PARTIAL = frozenset({"DIV", "INV", "SQRT", "LOG", "POW", "CONSTPOW", "ASIN", "ACOS"})
"""Operations that some tools stop at where their argument is out of range."""


@dataclass(frozen=True)
class Statements:
    """Variables of a function, ``(type, name)``, and its assignments in their order."""

    variables: tuple[tuple[str, str], ...]
    lines: tuple[str, ...]


def statements(
    order: Sequence[Node],
    outputs: Sequence[tuple[str, Node]],
    taken: Iterable[str],
    what: str,
    positive: Iterable[str] = (),
) -> Statements:
    """Assignments to the named ``outputs``; ``taken`` are names that no variable may have,
    ``positive`` inputs that are never zero.

    Raises UserError, which starts with ``what``, for an operation that Modelica does not have.
    """
    return _Printer(order, outputs, frozenset(taken), what, frozenset(positive)).statements()


class _Printer:
    def __init__(
        self,
        order: Sequence[Node],
        outputs: Sequence[tuple[str, Node]],
        taken: frozenset[str],
        what: str,
        positive: frozenset[str],
    ) -> None:
        self.outputs, self.what, self.positive = outputs, what, positive
        self.place = {node: i for i, node in reversed(list(enumerate(order)))}
        reached = below(*(node for _, node in outputs))
        self.order = sorted(reached, key=lambda n: self.place.get(n, len(order)))
        uses = Counter(a for node in reached for a in node.args)
        uses.update(node for _, node in outputs)
        self.shared = [n for n in self.order if uses[n] > 1 and not _cheap(n)]
        self.names = self._named(taken)

    def _named(self, taken: frozenset[str]) -> dict[Node, str]:
        names, count = {}, 0
        for node in self.shared:
            count += 1
            while f"v{count}" in taken:
                count += 1
            names[node] = f"v{count}"
        return names

    def statements(self) -> Statements:
        lines: dict[Node, str] = {}
        for node in self.shared:
            self._assign(node, lines)
        found = [f"{name} := {self._text(node, _IF)};" for name, node in self.outputs]
        kinds = tuple(("Boolean" if n.is_boolean else "Real", self.names[n]) for n in self.shared)
        return Statements(kinds, (*lines.values(), *found))

    def _assign(self, node: Node, lines: dict[Node, str]) -> None:
        """Assign a variable after those that it needs, where it is used under a condition only
        there.

        What it stands for may have no value elsewhere, as a quotient by zero has none.
        """
        if node in lines:
            return
        text, condition = self._operation(node, _IF), self._condition(node)
        if condition is not None:
            for other in self._variables(condition):
                self._assign(other, lines)
            text = f"if {self._truth(condition, _OR)} then {text} else 0"
        lines[node] = f"{self.names[node]} := {text};"

    def _condition(self, node: Node) -> Node | None:
        """The condition under which alone a variable that may have no value is needed."""
        if node.is_boolean or not self._may_fail(node):
            return None
        for condition in self.guards.get(node, ()):
            if node not in below(condition):
                return condition
        return None

    def _may_fail(self, node: Node) -> bool:
        """Whether the text of a variable holds an operation that needs its argument in a range."""
        last = node.args[-1] if node.args else node
        if node.op in _PARTIAL and not (
            last.op == "CONST" or last.text.partition("[")[0] in self.positive
        ):
            return True
        return any(a not in self.names and self._may_fail(a) for a in node.args)

    def _variables(self, node: Node) -> list[Node]:
        if node in self.names:
            return [node]
        return [found for a in node.args for found in self._variables(a)]

    @cached_property
    def guards(self) -> dict[Node, tuple[Node, ...]]:
        """The conditions that all uses of a node have in common, the nearest first."""
        found: dict[Node, list[Node] | None] = {}
        opposites: dict[Node, Node] = {}

        def use(node: Node, conditions: list[Node]) -> None:
            known = found.get(node)
            found[node] = conditions if known is None else [c for c in known if c in conditions]

        for _, node in self.outputs:
            use(node, [])
        for node in self._from_users():
            here = found[node] or []
            if node.op in ("IF", "IF_ELSE_ZERO"):
                condition = node.args[0]
                other = opposites.setdefault(condition, Node("NOT", (condition,)))
                use(condition, here)
                use(node.args[1], [condition, *here])
                if node.op == "IF":
                    use(node.args[2], [other, *here])
            else:
                for argument in node.args:
                    use(argument, here)
        return {node: tuple(conditions or ()) for node, conditions in found.items()}

    def _from_users(self) -> list[Node]:
        """Every node after all that use it."""
        done: dict[Node, None] = {}

        def visit(node: Node) -> None:
            for argument in node.args:
                if argument not in done:
                    visit(argument)
            done.setdefault(node)

        for _, node in self.outputs:
            visit(node)
        return list(done)[::-1]

    # Text

    def _text(self, node: Node, level: int) -> str:
        return self.names[node] if node in self.names else self._operation(node, level)

    def _operation(self, node: Node, level: int) -> str:
        text, own = self._printed(node)
        return text if own >= level else f"({text})"

    def _printed(self, node: Node) -> tuple[str, int]:
        """An operation, and how strongly its text holds together."""
        op, args = node.op, node.args
        if not args:
            return (node.text, _ATOM) if node.text else self._constant(node.value)
        if op in ("IF", "IF_ELSE_ZERO"):
            other = self._number(args[2], _IF) if op == "IF" else "0"
            return (
                f"if {self._truth(args[0], _OR)} then {self._number(args[1], _IF)} else {other}",
                _IF,
            )
        if op in _INFIX:
            return self._infix(op, *args)
        if op in RELATIONS:
            sign = RELATIONS[op]
            if args[0].op == "CONST":
                args, sign = args[::-1], sign.replace("<", ">") if sign != "<>" else sign
            left, right = (self._number(a, _SUM) for a in args)
            return f"{left} {sign} {right}", _RELATION
        if op in _FUNCTIONS:
            return f"{_FUNCTIONS[op]}({', '.join(self._number(a, _IF) for a in args)})", _ATOM
        return self._other(op, args)

    def _infix(self, op: str, left: Node, right: Node) -> tuple[str, int]:
        """A sum or a product; the sign of a first factor is that of the product."""
        sign, own = _INFIX[op]
        first = self._number(left, own)
        if own == _PRODUCT:
            signed = self._number(left, _SUM)
            if signed.startswith("-") and first == f"({signed})" and self._is_negative(left):
                return f"{signed}{sign}{self._number(right, _ATOM)}", _SUM
        return first + sign + self._number(right, own + 1), own

    def _is_negative(self, node: Node) -> bool:
        """A negated factor or a negative constant, no sum that begins with one."""
        return node not in self.names and (node.op in ("NEG", "CONST", "MUL", "DIV"))

    def _other(self, op: str, args: tuple[Node, ...]) -> tuple[str, int]:
        if op == "NOT":
            return f"not {self._truth(args[0], _RELATION)}", _NOT
        if op in ("AND", "OR"):
            own = _AND if op == "AND" else _OR
            return f" {op.lower()} ".join(self._truth(a, own + 1) for a in args), own
        if op == "NEG":
            return f"-{self._number(args[0], _PRODUCT)}", _SUM
        if op == "TWICE":
            return f"2*{self._number(args[0], _ATOM)}", _PRODUCT
        if op == "INV":
            return f"1/{self._number(args[0], _ATOM)}", _PRODUCT
        if op in ("POW", "CONSTPOW"):
            return "^".join(self._number(a, _ATOM) for a in args), _PRODUCT
        if op == "SQ":
            factor = self._number(args[0], _ATOM)
            if args[0].is_leaf or args[0] in self.names:
                return f"{factor}*{factor}", _PRODUCT
            return f"PyImu.Math.square({self._number(args[0], _IF)})", _ATOM
        raise UserError(
            f"{self.what}: its function uses {op.lower()}, which cannot be said in Modelica; write "
            "it with sums, products, quotients, roots, exp, log, sin, cos, min, max, floor, "
            "comparisons and choices"
        )

    def _constant(self, value: float) -> tuple[str, int]:
        if not math.isfinite(value):
            raise UserError(
                f"{self.what}: its function uses the constant {value}, and Modelica has finite "
                "numbers only"
            )
        whole = value == int(value) and abs(value) < LARGEST_INTEGER
        return str(int(value)) if whole else repr(value), _ATOM if value >= 0 else _SUM

    def _number(self, node: Node, level: int) -> str:
        """Where a number is wanted: a truth is 1 or 0."""
        if not node.is_boolean:
            return self._text(node, level)
        if node in (TRUE, FALSE):
            return "1" if node is TRUE else "0"
        text = f"if {self._text(node, _OR)} then 1 else 0"
        return text if level == _IF else f"({text})"

    def _truth(self, node: Node, level: int) -> str:
        """Where a condition is wanted: a number is true unless it is 0."""
        if node.is_boolean:
            return self._text(node, level)
        text = f"{self._text(node, _SUM)} <> 0"
        return text if level <= _RELATION else f"({text})"


def _cheap(node: Node) -> bool:
    """What is said again wherever it is needed: an input, and its comparison with another."""
    return node.is_leaf or (node.is_boolean and all(a.is_leaf for a in node.args))


def below(*nodes: Node) -> set[Node]:
    """These nodes and all from which they follow."""
    reached: set[Node] = set()
    waiting = list(nodes)
    while waiting:
        node = waiting.pop()
        if node not in reached:
            reached.add(node)
            waiting += node.args
    return reached
