"""A formula as an effect of the user's own: the text of its file, and the effect it makes."""

from __future__ import annotations

from collections.abc import Sequence

from pyimu.identification.formula.terms import HELPERS, SYMBOLS, Term
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effect import Effect
from pyimu.model.effects import EFFECTS
from pyimu.model.kinds import KINDS

NAME = "found_effect"

TERM = "found in these data, no physical name"

HEAD = '''\
"""Errors that pyimu close found in logs and for which no effect of the catalogue accounts.

Each is a formula that fits, without a physical name. Use: --effects {file}.
"""

import casadi as ca

from pyimu.model.effect import Environment, Parameter, effect
'''

EFFECT = """\
@effect(
    stage="{stage}",
    term="{term}",
    equation=r"{equation}",
    source="no source: found by pyimu close",
    sensors=("{kind}",),
    smooth={smooth},
)
def {name}(
    x,
{arguments}):
    return x{terms}
"""


def free_name() -> str:
    """A name for a formula that no effect has: ``found_effect``, or that with a number."""
    names = (NAME if n == 1 else f"{NAME}_{n}" for n in range(1, 1000))
    return next(n for n in names if n not in CATALOGUE)


def coefficients(terms: Sequence[Term]) -> list[tuple[str, Term, int]]:
    """The coefficient of each column of each term: its name, the term, the column's number."""
    flat = [(t, k) for t in terms for k in range(len(t.code))]
    return [(f"c{n + 1}", t, k) for n, (t, k) in enumerate(flat)]


def function_text(name: str, kind: str, terms: Sequence[Term]) -> str:
    """The definition of the effect."""
    named, own = coefficients(terms), KINDS[kind].own
    signals = [s for s in SYMBOLS if any(s in t.signals for t in terms) and s != own]
    lines = [
        f'    {c}: Parameter("{t.coefficient_unit()}", description={_about(t, k)!r}),\n'
        for c, t, k in named
    ]
    lines += [f'    {SYMBOLS[s][0]}: Environment("{s}"),\n' for s in signals]
    # What depends on the sensor's own signal follows the motion itself, not the bias of a day.
    follows = any(own in t.signals for t in terms)
    return EFFECT.format(
        stage="gain" if follows else "bias",
        term=TERM,
        equation=equation(terms),
        kind=kind,
        smooth=all(t.switch is None for t in terms),
        name=name,
        arguments="".join(lines),
        terms="".join(f" + {c} * ({t.code[k]})" for c, t, k in named),
    )


def _about(t: Term, k: int) -> str:
    which = f" ({('sine', 'cosine')[k]})" if t.angle else ""
    return f"factor of {t.text}{which}"


def equation(terms: Sequence[Term]) -> str:
    """The formula as it is set."""
    parts = [rf"c_{{{c[1:]}}}\, {t.latex[k]}" for c, t, k in coefficients(terms)]
    return " + ".join(["y = x", *parts])


def plain(terms: Sequence[Term]) -> str:
    """The formula in plain words of mathematics, without its coefficients."""
    return " + ".join(t.text for t in terms)


def file_text(functions: Sequence[str], file: str) -> str:
    """The text of a file that defines these effects."""
    return "\n\n".join([HEAD.format(file=file) + "\n\n" + HELPERS.rstrip() + "\n", *functions])


def made(name: str, kind: str, terms: Sequence[Term]) -> Effect:
    """The effect that the text of its file defines, known by its name from now on.

    One of this name that an earlier formula left is forgotten.
    """
    scope: dict[str, object] = {}
    text = file_text([function_text(name, kind, terms)], "found_effect.py")
    exec(compile(text, "found_effect.py", "exec", dont_inherit=True), scope)
    found = scope[name]
    assert isinstance(found, Effect)
    put(found)
    return found


def put(effect: Effect) -> None:
    """Make an effect known, in place of an older one of its name."""
    if effect.name in CATALOGUE:
        CATALOGUE.remove(effect.name)
    CATALOGUE.add(effect)


def forget() -> None:
    """Forget the formulas of earlier runs; those that a user loaded from a file stay."""
    names = [
        n
        for n, e in CATALOGUE.items()
        if n.startswith(NAME) and e not in EFFECTS and not e.file and e.term == TERM
    ]
    CATALOGUE.remove(*names)
