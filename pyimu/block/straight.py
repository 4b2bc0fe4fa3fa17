"""C of a function that is a plain list of operations: a name for each value, assigned once.

A compiler that knows that no result overlaps an argument or another result, and that each is asked
for, need not keep to the order of loads and stores, and asks nothing at a store.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import casadi as ca

from pyimu.block.program import Program, program

SPELLED = {
    ca.OP_ASSIGN: "{0}",
    ca.OP_ADD: "{0}+{1}",
    ca.OP_SUB: "{0}-{1}",
    ca.OP_MUL: "{0}*{1}",
    ca.OP_DIV: "{0}/{1}",
    ca.OP_INV: "1./{0}",
    ca.OP_SQ: "{0}*{0}",
    ca.OP_TWICE: "2.*{0}",
    ca.OP_NEG: "-{0}",
    ca.OP_FABS: "fabs({0})",
    ca.OP_SQRT: "sqrt({0})",
    ca.OP_FLOOR: "floor({0})",
    ca.OP_CEIL: "ceil({0})",
    ca.OP_COPYSIGN: "copysign({0},{1})",
    ca.OP_FMIN: "casadi_fmin({0},{1})",
    ca.OP_FMAX: "casadi_fmax({0},{1})",
    ca.OP_LT: "{0}<{1}",
    ca.OP_LE: "{0}<={1}",
    ca.OP_EQ: "{0}=={1}",
    ca.OP_NE: "{0}!={1}",
    ca.OP_NOT: "!{0}",
    ca.OP_AND: "{0}&&{1}",
    ca.OP_OR: "{0}||{1}",
    ca.OP_IF_ELSE_ZERO: "{0}?{1}:0",
}
"""Operations and their C, as casadi writes it; of any other the function stays as casadi has it."""


def straight(function: ca.Function) -> str | None:
    """The body in C of an SX ``function``, which begins after its brace; None where it has an
    operation that is not ``SPELLED``, or no operation at all.

    Every argument is given and every result asked for.
    """
    one = program(function)
    done = [i for i in one.instructions if i.op not in (ca.OP_INPUT, ca.OP_CONST)]
    if not done or any(i.op not in SPELLED for i in done):
        return None
    lines = places(one)
    wanted = results_of(one)
    for k, i in enumerate(one.instructions):
        if i.op in SPELLED:
            value = SPELLED[i.op].format(*(name_of(one, j) for j in i.operands))
            lines.append(f"const casadi_real v{k}={value};")
        lines += [f"o{n}[{entry}]={name_of(one, k)};" for n, entry in wanted.get(k, ())]
    return as_body(lines)


def as_body(lines: Sequence[str]) -> str:
    """The ``lines`` as the body of a function that succeeds."""
    return "".join(f"  {line}\n" for line in (*lines, "return 0;"))


def places(one: Program) -> list[str]:
    """Lines that name the arguments i0, i1, ... of a program that it reads, and its results o0, o1,
    ...
    """
    read = {i.of[0] for i in one.instructions if i.op == ca.OP_INPUT}
    given = [f"const casadi_real *restrict i{k}=arg[{k}];" for k in sorted(read)]
    made = sorted({number for number, _ in one.outputs})
    return given + [f"casadi_real *restrict o{k}=res[{k}];" for k in made]


def results_of(one: Program) -> dict[int, list[tuple[int, int]]]:
    """By number of an instruction the results, and their entries, that it gives."""
    found: dict[int, list[tuple[int, int]]] = {}
    for place, k in one.outputs.items():
        found.setdefault(k, []).append(place)
    return found


def name_of(one: Program, k: int) -> str:
    """What stands for the value of an instruction."""
    i = one.instructions[k]
    if i.op == ca.OP_CONST:
        return literal(i.value)
    return f"i{i.of[0]}[{i.of[1]}]" if i.op == ca.OP_INPUT else f"v{k}"


def literal(value: float) -> str:
    """A number in C, to the last bit."""
    if math.isnan(value):
        return "NAN"
    text = "INFINITY" if math.isinf(value) else repr(abs(value))
    return f"(-{text})" if math.copysign(1, value) < 0 else text
