"""The symbolic results: every check holds, would notice a wrong equation, and every symbol is
explained.
"""

from dataclasses import replace

import pytest

from pyimu.derivations import DERIVATIONS, cases
from pyimu.derivations.kinematics import attitude_error
from pyimu.derivations.model import Equation
from pyimu.derivations.symbols import SYMBOLS

BY_KEY = {d.key: d for d in DERIVATIONS}


@pytest.mark.parametrize("key", BY_KEY)
def test_result_is_what_other_derivations_give(key):
    failed = [
        f"{c.against}: {c.largest:.3g} is above {c.bound:.3g}"
        for c in BY_KEY[key].check(BY_KEY[key])
        if not c.passed
    ]
    assert not failed, "\n".join(failed)


@pytest.mark.parametrize("key", BY_KEY)
def test_a_change_of_any_equation_is_noticed(key, monkeypatch):
    """Each equation in turn off by one part in ten million: a thousand times what any bound
    allows.
    """
    monkeypatch.setattr(cases, "CASES", 10)
    monkeypatch.setattr(attitude_error, "INTEGRATIONS", 2)
    d, unnoticed = BY_KEY[key], []
    for i, e in enumerate(d.equations):
        wrong = replace(
            d,
            equations=(
                *d.equations[:i],
                replace(e, right=f"({e.right})*1.0000001"),
                *d.equations[i + 1 :],
            ),
        )
        if all(c.passed for c in d.check(wrong)):
            unnoticed.append(e.left)
    assert not unnoticed


@pytest.mark.parametrize("key", BY_KEY)
def test_every_symbol_is_told_or_defined(key):
    d = BY_KEY[key]
    defined = {e.left for e in d.equations}
    told = {s.name for s in d.symbols}
    used = {n for e in d.equations for n in e.formula.names}
    assert used - defined <= told
    assert all(s.unit and s.meaning for s in d.symbols) and d.source and d.about


def test_equation_is_a_symbol_and_a_formula():
    for d in DERIVATIONS:
        assert all(
            isinstance(e, Equation) and e.left in SYMBOLS and e.formula.names is not None
            for e in d.equations
        )
