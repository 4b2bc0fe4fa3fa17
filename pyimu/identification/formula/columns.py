"""The columns of the terms of a formula: what each would add to every axis."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import casadi as ca
import numpy as np

from pyimu.block.vectorised import over_rows, split_over_rows
from pyimu.identification.fit.keys import Shape
from pyimu.identification.fit.trial import Trial
from pyimu.identification.formula.terms import HELPERS, SYMBOLS, Term
from pyimu.model.kinds import KINDS
from pyimu.model.signals import COLUMNS, N_INPUT


@lru_cache(maxsize=32)
def compiled(kind: str, code: tuple[str, ...]) -> ca.Function:
    """Values (3 a column) of columns, one after another, for an input vector."""
    u = ca.SX.sym("u", N_INPUT)
    names: dict[str, object] = {"ca": ca}
    exec(HELPERS, names)
    names |= {symbol: u[COLUMNS[name]] for name, (symbol, _) in SYMBOLS.items()}
    names["x"] = u[COLUMNS[KINDS[kind].own]]
    columns = [eval(one, dict(names)) for one in code]
    full = [ca.SX.ones(3) * c if ca.SX(c).numel() == 1 else c for c in columns]
    return ca.Function("terms", [u, ca.SX.sym("none", 0)], [ca.densify(ca.vertcat(*full))])


def columns_of(kind: str, terms: list[Term]) -> Callable:
    """Column maker for ``Fit.beside``."""
    function = compiled(kind, tuple(code for t in terms for code in t.code))
    keys = [(t.text, k) for t in terms for k in range(len(t.code))]

    def add_all(trial: Trial, u: np.ndarray, add: Callable) -> None:
        values = split_over_rows(function, u.T, np.zeros(0), 0)[1]
        for column, (text, number) in enumerate(keys):
            for i in range(3):
                add(Shape(text, number, i), i, values[3 * column + i])

    return add_all


def values_of(kind: str, code: str, u: np.ndarray) -> np.ndarray:
    """Values (n, 3) of an expression over inputs (n, N_INPUT), axis by axis."""
    return over_rows(compiled(kind, (code,)), u.T, np.zeros(0))
