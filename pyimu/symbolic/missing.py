"""Inputs that are missing or are no number, memories that must outlive them, and such as fade."""

from __future__ import annotations

import casadi as ca


def is_number(x):
    """1 where an element is not NaN. A comparison of ``x`` with itself would be simplified away."""
    return ca.fabs(x) <= ca.inf


def is_finite(x):
    """1 where an element is neither NaN nor infinite."""
    return ca.fabs(x) < ca.inf


def kept(after, before):
    """A memory's following value, where that is NaN the one before: one missing input must not stay
    for ever.
    """
    return ca.if_else(is_number(after), after, before)


FADED = 1e-60
"""What is smaller, in any unit, is zero. Its square is no denormal number, nor is that of what it
fades to before it is looked at again."""


def faded(memory):
    """A memory's value, which is zero once it is less than ``FADED``.

    One that fades by a share of itself in each sample would end as a denormal number, with which
    processors compute twenty times slower.
    """
    return ca.if_else(ca.fabs(memory) < FADED, 0, memory)
