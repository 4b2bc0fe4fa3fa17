"""Quantities along a motion: a value with its derivatives with respect to time."""

from __future__ import annotations

import casadi as ca


def along(quantity, state, first, second) -> tuple:
    """The first and the second derivative of ``quantity`` with respect to time.

    ``quantity`` is an expression in the symbols ``state`` (n,); ``first`` and ``second`` (n,) are
    symbols for the derivatives of these. By the chain rule, exactly: no differences are taken.
    """
    velocity = ca.jtimes(quantity, state, first)
    return velocity, ca.jtimes(velocity, state, first) + ca.jtimes(quantity, state, second)
