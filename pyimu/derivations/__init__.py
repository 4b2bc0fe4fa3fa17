"""The symbolic results: each as an equation that prints and computes, and what it was checked
against.

``derive()`` runs every check and gives results whose ``report()`` reads in a terminal; ``write``
makes files of them. The equations are texts in the language of ``pyimu.derivations.formula``;
casadi expressions, plain text and LaTeX come from that one text. The checks compare them with
numpy and scipy, and with the functions of the package.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from pyimu.derivations import correlated, errors, kinematics, printed, walk
from pyimu.derivations.model import Check, Derivation, Table

DERIVATIONS: tuple[Derivation, ...] = (
    *kinematics.DERIVATIONS,
    *errors.DERIVATIONS,
    *walk.DERIVATIONS,
    *printed.DERIVATIONS,
    *correlated.DERIVATIONS,
)


@dataclass(frozen=True)
class Result:
    """A derivation with the checks it went through and the tables that were computed."""

    derivation: Derivation
    checks: tuple[Check, ...]
    tables: tuple[Table, ...]

    @property
    def passed(self) -> bool:
        return all(c.passed for c in self.checks)


@dataclass(frozen=True)
class Derived:
    """All results, in order."""

    results: tuple[Result, ...]

    @property
    def passed(self) -> bool:
        return all(r.passed for r in self.results)

    def report(self) -> str:
        """All of it as text, the last line a summary."""
        from pyimu.derivations.text import document

        return document(self)

    def summary(self) -> str:
        """One line."""
        checks = [c for r in self.results for c in r.checks]
        failed = [r.derivation.key for r in self.results if not r.passed]
        said = f"failed: {', '.join(failed)}" if failed else "none failed"
        return (
            f"{len(self.results)} results, {sum(c.passed for c in checks)} of {len(checks)} checks "
            f"passed, {said}"
        )

    __str__ = report


def derive(say: Callable[[str], None] = lambda text: None) -> Derived:
    """Every result with its checks, which are computed now; ``say`` is told what is being
    checked.
    """
    results = []
    for d in DERIVATIONS:
        say(f"checking {d.key}")
        results.append(Result(d, tuple(d.check(d)), tuple(d.tables(d))))
    return Derived(tuple(results))
