"""What a step computes from parameters and sample period alone, computed once for many samples."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import casadi as ca

from pyimu.block.plain import plain_function
from pyimu.block.program import Program, program


@dataclass(frozen=True)
class Prepared:
    """A step in two parts: ``constants`` (p, h) -> c, and ``step`` (s, u, p, w, h, c) -> (s_next,
    y).
    """

    constants: ca.Function
    step: ca.Function

    @cached_property
    def whole(self) -> ca.Function:
        """The step of a block: both for each sample, with the same bits."""
        s, u, p, w, h = symbols = [ca.MX.sym(n, self.step.numel_in(n)) for n in "supwh"]
        outputs = self.step.call([*symbols, self.constants(p, h)], True, False)
        return ca.Function("step", symbols, outputs, [*"supwh"], ["s_next", "y"])


def taken_apart(
    functions: Sequence[ca.Function], fixed: Sequence[int]
) -> tuple[ca.Function, list[ca.Function]]:
    """``constants``, which gives c from the ``fixed`` arguments, and the functions with c as their
    last argument in place of these.

    They are SX functions of the same arguments. In c is what follows from the fixed arguments and
    is asked for by anything that follows from others, too: the bits are those of the functions in
    plain arithmetic, in which they come back.
    """
    symbols = functions[0].sx_in()
    together = [ca.densify(out) for f in functions for out in f.call(symbols, True, False)]
    whole = ca.Function("whole", symbols, [ca.vertcat(*map(ca.vec, together))], {"cse": True})
    column, constants, c = _with_constants(program(whole), symbols, fixed)
    ends = [0]
    for out in together:
        ends.append(ends[-1] + out.numel())
    outputs = iter(ca.vertsplit(column, ends))
    left = [*(a for i, a in enumerate(symbols) if i not in fixed), c]
    given = [symbols[i] for i in fixed]
    return plain_function("constants", given, [constants], {"cse": True}), [
        plain_function(f.name(), left, [next(outputs) for _ in range(f.n_out())], {"cse": True})
        for f in functions
    ]


def _with_constants(
    one: Program, symbols: list, fixed: Sequence[int]
) -> tuple[ca.SX, ca.SX, ca.SX]:
    """The output of a program as a column, where symbols c stand for what follows from the
    ``fixed`` arguments; these constants; and c.
    """
    values: list[ca.SX] = []
    follows: list[bool] = []
    found: dict[int, ca.SX] = {}

    def varying(k: int) -> ca.SX:
        """The value of an instruction as something that varies takes it."""
        if not follows[k] or one.instructions[k].op == ca.OP_CONST:
            return values[k]
        return found.setdefault(k, ca.SX.sym(f"c{len(found)}"))

    for i in one.instructions:
        fixes = i.of[0] in fixed if i.op == ca.OP_INPUT else all(follows[k] for k in i.operands)
        operands = [values[k] if fixes else varying(k) for k in i.operands]
        value = i.value_of(symbols, operands)
        values.append(value)
        follows.append(fixes)
    column = ca.vertcat(*(varying(one.outputs[0, k]) for k in range(len(one.outputs))))
    return column, ca.vertcat(*(values[k] for k in found)), ca.vertcat(*found.values())
