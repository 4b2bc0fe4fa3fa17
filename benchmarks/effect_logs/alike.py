"""By how much a log speaks for one effect against another that is fitted in its place.

The error of the one, less what the other's columns explain of it, all whitened by the sensor's
noise: half the squared norm of the rest is the log-likelihood [nat] by which the true effect is
expected to be ahead. It follows from the motion and the noise alone, whatever the loop makes of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from effect_logs.chain import TERMS, Chain
from effect_logs.term import Case, Term

FORMS = 8
"""Forms of the other effect that are drawn; the one that explains most counts."""

DEAD = 1e-9
"""Share of a column's square below which it is taken for a sum of the others."""


def nat_apart(chains: Sequence[Chain], truth: str, case: Case, other: str) -> float | None:
    """Expected nat by which the logs of ``chains`` speak for a true effect in its ``case`` against
    another by its name in the catalogue; None where either is random or the other is unknown.
    """
    terms = [t for t in TERMS.values() if t.right == other and chains[0].kind in t.sizes]
    terms = [t for t in terms if t.gain is None]
    if TERMS[truth].gain is not None or not terms:
        return None
    errors = [c.error({truth: c.case(case.c, case.form)}) for c in chains]
    return min(
        _left(chains, errors, term, form) for term in terms for form in _forms(term, chains[0])
    )


def _forms(term: Term, chain: Chain) -> list[dict]:
    drawn = [term.form(np.random.default_rng(i), chain.scene) for i in range(FORMS)]
    return drawn if drawn[0] else drawn[:1]


def _left(chains: Sequence[Chain], errors, term: Term, form: dict) -> float:
    """Half the squared norm of errors (n, 3) by log that a term in a form leaves."""
    total = 0.0
    for chain, error in zip(chains, errors, strict=True):
        columns = [chain.error({term.name: chain.case(c, form)}) for c in _each(term, chain.kind)]
        total = total + sum(chain.grams(np.stack([error, *columns], axis=2)))
    scale = np.sqrt(np.maximum(np.diag(total), 1e-300))
    scaled = total / np.outer(scale, scale)
    share = np.linalg.lstsq(scaled[1:, 1:], scaled[1:, 0], rcond=DEAD)[0]
    return 0.5 * float(total[0, 0] * max(1.0 - scaled[0, 1:] @ share, 0.0))


def _each(term: Term, kind: str) -> Iterable[np.ndarray | float]:
    """The term's coefficient with one entry at its size after another."""
    size = term.sizes[kind]
    if term.known or not term.shape:
        return [size]
    allowed = 1 - np.eye(3) if term.hollow else np.ones(term.shape)
    out = []
    for index in zip(*np.nonzero(allowed), strict=True):
        one = np.zeros(term.shape)
        one[index] = size
        out.append(one)
    return out
