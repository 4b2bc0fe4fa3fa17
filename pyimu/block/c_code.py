"""Functions of casadi in C, with the few lines of its runtime that cost time written anew."""

from __future__ import annotations

import re
from collections.abc import Iterable

import casadi as ca

FASTER = {
    "casadi_copy(const casadi_real* x, casadi_int n, casadi_real* y) {": (
        "casadi_copy(const casadi_real* restrict x, casadi_int n, casadi_real* restrict y) {"
    ),
    "return fmax(x, y);": "return x >= y || y != y ? x : y;",
    "return fmin(x, y);": "return x <= y || y != y ? x : y;",
}
"""Lines of casadi's runtime and what stands for them, which gives the same bits.

What is copied never overlaps what it is copied to; a compiler that knows it copies whole blocks.
A call of fmax has the registers saved and loaded again; compared in place it takes two
instructions, and as in C the other argument stands for a NaN."""

_IF_GIVEN = re.compile(r"arg\[(\d+)\]\? (arg\[\1\]\[\d+\]) : 0;")
"""Casadi reads an argument that is not given as zeros; here every argument is given."""


def c_code(name: str, functions: Iterable[ca.Function]) -> str:
    """The C of ``functions``, as casadi writes it for a file ``name``."""
    generator = ca.CodeGenerator(name)
    for function in functions:
        generator.add(function)
    text = generator.dump()
    for line, faster in FASTER.items():
        text = text.replace(line, faster)
    return _IF_GIVEN.sub(r"\2;", text)
