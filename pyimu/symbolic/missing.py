"""Inputs that are missing or are no number, and memories that must outlive them."""

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
