"""What a derivation is: equations that print and compute, and the checks that they pass."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import casadi as ca
import numpy as np

from pyimu.derivations.formula import Formula
from pyimu.derivations.independent import largest
from pyimu.derivations.symbols import SYMBOLS, Symbol

CONSTANTS = {"I_3": ca.SX.eye(3), "I_6": ca.SX.eye(6), "O_3": ca.SX(3, 3), "O_31": ca.SX(3, 1)}
"""Symbols that are known matrices."""

EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Equation:
    """``left`` = ``right``: the name of a symbol and the text of a ``Formula``.

    ``note`` is a remark for the reader.
    """

    left: str
    right: str
    note: str = ""

    @cached_property
    def formula(self) -> Formula:
        return Formula(self.right)


@dataclass(frozen=True)
class Check:
    """The ``largest`` difference between a result and another way to it, over a number of cases.

    ``bound`` is what rounding sets.
    """

    against: str
    cases: int
    largest: float
    bound: float
    kind: str = "largest difference"

    @property
    def passed(self) -> bool:
        return bool(self.largest <= self.bound)

    @classmethod
    def of_pairs(cls, against: str, pairs: Sequence[tuple], bound: float, each: int = 1) -> Check:
        """The largest difference between the two arrays of each pair; a case has ``each`` pairs."""
        return cls(against, len(pairs) // each, largest(pairs), bound)

    @classmethod
    def of_covariances(cls, against: str, differences: Sequence[float], bound: float) -> Check:
        """The largest of ``independent.in_standard_deviations``, one for each case."""
        kind = "largest difference in standard deviations"
        return cls(against, len(differences), max(differences), bound, kind)


@dataclass(frozen=True)
class Table:
    """Rows of texts under a head, computed for the reader."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Derivation:
    """A result: its equations, and how it is checked.

    Each of ``equations`` may use those before it, and ``given``, which belong to another result.
    ``check`` and ``tables`` take the derivation; what they return is computed when they are called.
    """

    key: str
    title: str
    about: str
    source: str
    equations: tuple[Equation, ...]
    check: Callable[[Derivation], list[Check]]
    given: tuple[Equation, ...] = ()
    tables: Callable[[Derivation], list[Table]] = lambda derivation: []

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """The symbols to be explained, in the order of the equations.

        These are what the equations take as given, and results with a meaning of their own.
        """
        given = _free(self.equations, ())
        named = dict.fromkeys(n for e in self.equations for n in (e.left, *e.formula.names))
        return tuple(
            SYMBOLS[n]
            for n in named
            if SYMBOLS[n].meaning and (n in given or not SYMBOLS[n].elsewhere)
        )

    def function(self, outputs: tuple[str, ...], inputs: tuple[str, ...]) -> ca.Function:
        """The casadi function from symbols to results, both by name.

        Raises KeyError where an input is missing.
        """
        sx = {n: ca.SX.sym(n, *SYMBOLS[n].shape) for n in inputs}
        values = {**CONSTANTS, **sx}
        waiting = [*self.given, *self.equations]
        while ready := [e for e in waiting if set(e.formula.names) <= values.keys()]:
            # One at a time and in order: an inverse gives a symbol anew that the equations before
            # it took as an input.
            values[ready[0].left] = ca.SX(ready[0].formula.evaluate(values))
            waiting.remove(ready[0])
        return ca.Function(
            self.key,
            list(sx.values()),
            [ca.densify(values[n]) for n in outputs],
            list(sx),
            _unique(outputs, sx),
        )


@dataclass(frozen=True)
class Result:
    """A derivation, the checks it went through, and the tables that were computed."""

    derivation: Derivation
    checks: tuple[Check, ...]
    tables: tuple[Table, ...]

    @property
    def passed(self) -> bool:
        return all(c.passed for c in self.checks)


@dataclass(frozen=True)
class Results:
    """All results, in order."""

    results: tuple[Result, ...]

    @property
    def passed(self) -> bool:
        return all(r.passed for r in self.results)

    def summary(self) -> str:
        """One line: how many checks passed, and which results failed."""
        checks = [c for r in self.results for c in r.checks]
        failed = [r.derivation.key for r in self.results if not r.passed]
        said = f"failed: {', '.join(failed)}" if failed else "none failed"
        return (
            f"{len(self.results)} results, {sum(c.passed for c in checks)} of {len(checks)} checks "
            f"passed, {said}"
        )


def _free(equations: tuple[Equation, ...], known: tuple[str, ...]) -> tuple[str, ...]:
    """The names that the equations use before any of them defines them."""
    found, defined = [], set(known)
    for e in equations:
        found += [n for n in e.formula.names if n not in defined]
        defined.add(e.left)
    return tuple(dict.fromkeys(found))


def _unique(outputs: tuple[str, ...], inputs) -> list[str]:
    """Names of outputs for casadi, which wants them different from those of inputs."""
    return [f"{n}_out" if n in inputs else n for n in outputs]


def library(function: Callable, *sizes: int) -> ca.Function:
    """A function of the package as a casadi function, its arguments columns of these sizes."""
    symbols = [ca.SX.sym(f"x{i}", size) for i, size in enumerate(sizes)]
    return ca.Function("library", symbols, [ca.densify(function(*symbols))])


def call(function: ca.Function, *arguments) -> list[np.ndarray]:
    """The outputs as arrays; a column comes as (n,), a single number as (), a matrix as it is."""
    values = [np.array(ca.densify(v)) for v in function.call([ca.DM(a) for a in arguments])]
    return [v[0, 0] if v.size == 1 else v[:, 0] if v.shape[1] == 1 else v for v in values]
