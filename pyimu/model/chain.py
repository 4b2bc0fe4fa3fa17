"""The chain of a sensor's effects: its step, compensation and limits as casadi functions."""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache

import casadi as ca
import numpy as np

from pyimu.block.variables import Limits, NoiseChannel
from pyimu.model.arguments import INPUT, Parameter
from pyimu.model.effect import Effect
from pyimu.model.kinds import OWN_RATE, TRIADS
from pyimu.model.signals import COLUMNS, N_INPUT
from pyimu.symbolic.missing import is_number, kept

NEWTON_STEPS = 6
"""Iterations of the symbolic inverse; an error of 0.1 squares to below 1e-16 in five."""

HALF = 0.5 + 1e-6
"""Of a step: so much rounding may take off an output at its limit, and what a sum is off by."""


@dataclass(frozen=True)
class Slot:
    """Where one coefficient stands: effect, parameter, index in its array."""

    effect: str
    parameter: str
    index: tuple[int, ...]
    unit: str
    definition: Parameter

    @property
    def suffix(self) -> str:
        return f"[{','.join(str(i + 1) for i in self.index)}]" if self.index else ""

    @property
    def name(self) -> str:
        return f"{self.effect}.{self.parameter}{self.suffix}"


class Chain:
    """Effects in series: names and places of coefficients and normals, and the casadi functions.

    ``effects`` stand in the order in which they act. A chain has no values; a ``Sensor`` is a
    chain with values.
    """

    def __init__(self, kind: str, effects: tuple[Effect, ...]) -> None:
        self.kind, self.effects, self.output = kind, effects, TRIADS[kind]
        self.u = ca.SX.sym("u", N_INPUT)
        self.h = ca.SX.sym("h")
        self.p = ca.SX.sym("p", len(self.slots))
        self.w = ca.SX.sym("w", len(self.noise))
        self.signals = {name: self.u[at] for name, at in COLUMNS.items()}
        if self.output.own_rate:
            self.signals[OWN_RATE] = self.signals[self.output.own_rate]
        self.x = self.signals[self.output.own]
        self.parameters = self._split_parameters()
        self.noises = self._split_noise()
        self.states, self.s = self._split_states()
        self.waits = any(isinstance(q.start, str) for e in self.effects for q in e.states.values())

    @cached_property
    def by_name(self) -> dict[str, Effect]:
        return {e.name: e for e in self.effects}

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """Every coefficient in the order of the vector ``p``."""
        return tuple(
            Slot(e.name, n, i, self.output.units(q.unit), q)
            for e in self.effects
            for n, q in e.parameters.items()
            for i in q.indices
        )

    @cached_property
    def noise(self) -> tuple[NoiseChannel, ...]:
        """The standard normals.

        The number of a stream follows from its name alone, so adding an effect never shifts
        another.
        """
        names = [
            f"{self.kind}_error.{e.name}.{n}[{i + 1}]"
            for e in self.effects
            for n, w in e.noises.items()
            for i in range(w.size)
        ]
        return tuple(NoiseChannel(n, zlib.crc32(n.encode())) for n in names)

    def _split_parameters(self) -> dict[str, dict[str, ca.SX]]:
        """Arrange the vector ``p`` in the matrices of the definitions, row by row.

        This is the only place that sets this order.
        """
        slots = iter(ca.vertsplit(self.p)) if len(self.slots) else iter(())
        out: dict[str, dict[str, ca.SX]] = {}
        for e in self.effects:
            out[e.name] = {}
            for name, q in e.parameters.items():
                matrix = ca.SX.zeros(*(q.shape or (1,)))
                for index in q.indices:
                    matrix[index or 0] = next(slots)
                out[e.name][name] = matrix
        return out

    def _split_noise(self) -> dict[str, dict[str, ca.SX]]:
        out, at = {}, 0
        for e in self.effects:
            out[e.name] = {}
            for name, w in e.noises.items():
                out[e.name][name] = self.w[at : at + w.size]
                at += w.size
        return out

    def _split_states(self) -> tuple[dict[str, dict[str, ca.SX]], ca.SX]:
        symbols = {
            e.name: {n: ca.SX.sym(n, *q.shape) for n, q in e.states.items()} for e in self.effects
        }
        flat = [ca.vec(v) for group in symbols.values() for v in group.values()]
        return symbols, ca.vertcat(*flat) if flat else ca.SX.zeros(0, 1)

    def _current(self, e: Effect, x: ca.SX, started: ca.SX | None) -> dict[str, ca.SX]:
        """States of an effect, with those that wait for the first input set from it.

        A state that is NaN still waits for its first input.
        """
        out = {}
        for name, q in e.states.items():
            s = self.states[e.name][name]
            if isinstance(q.start, str):
                first = x if q.start == INPUT else self.signals[e.environment[q.start]]
                steady = ca.repmat(first.T, q.shape[0], 1) if len(q.shape) == 2 else first
                # All rows are filled together, so that the newest one, which is the first, speaks
                # for all.
                begun = ca.logic_and(started, is_number(s[0, :] if len(q.shape) == 2 else s))
                s = ca.if_else(
                    ca.repmat(begun, q.shape[0], 1) if len(q.shape) == 2 else begun, s, steady
                )
            out[name] = s
        return out

    @cached_property
    def step(self) -> ca.Function:
        started = ca.SX.sym("started") if self.waits else None
        x, following = self.x, []
        for e in self.effects:
            x, after = self.apply(e, x, self.noises[e.name], started)
            following.append(after)
        flag, one = ([started], [ca.SX(1)]) if self.waits else ([], [])
        return ca.Function(
            f"{self.kind}_step",
            [ca.vertcat(*flag, self.s), self.u, self.p, self.w, self.h],
            [ca.vertcat(*one, *following), ca.densify(x)],
            ["s", "u", "p", "w", "h"],
            ["s_next", "y"],
        )

    @cached_property
    def start(self) -> np.ndarray:
        """State before the first sample, as ``step`` takes it."""
        values = [
            np.full(int(np.prod(q.shape)), 0.0 if isinstance(q.start, str) else q.start)
            for e in self.effects
            for q in e.states.values()
        ]
        return np.concatenate([np.zeros(int(self.waits)), *values])

    @cached_property
    def compensation(self) -> ca.Function:
        started = ca.SX.sym("started") if self.waits else None
        measured = ca.SX.sym("y", 3)
        x, lost, following = measured, ca.SX.zeros(3), {}
        step = ca.SX.zeros(3)
        for e in reversed(self.effects):
            if e.lost is not None:
                most = x + HALF * step * ca.sign(x) if e.reading("ceiling") else x
                lost = ca.fmax(lost, e.lost(most, **self.parameters[e.name]))
            if (name := e.reading("step")) is not None:
                step = self.parameters[e.name][name]
            if e.invertible:
                x = self._invert(e, x, started)
            elif e.restore is not None:
                x = e.restore(x, **self.parameters[e.name])
            following[e.name] = self._call(e, x, started)[1]
        ordered = [following[e.name] for e in self.effects]
        flag, one = ([started], [ca.SX(1)]) if self.waits else ([], [])
        return ca.Function(
            f"{self.kind}_compensation",
            [ca.vertcat(*flag, self.s), measured, self.u, self.p, self.h],
            [ca.vertcat(*one, *ordered), ca.densify(x), ca.densify(lost)],
            ["s", "y", "u", "p", "h"],
            ["s_next", "x", "lost"],
        )

    def apply(self, e: Effect, x: ca.SX, w: Mapping, started: ca.SX | None) -> tuple[ca.SX, ca.SX]:
        """Output of an effect and its following states in one column.

        A state that follows from inputs keeps its value where it would become NaN: the output shows
        that an input is missing, the memory has never heard of it.
        """
        states = self._current(e, x, started)
        y, update = e(
            x, self.parameters[e.name], states, w, {**self.signals, self.output.own: x}, self.h
        )
        before, after = (
            [ca.vec(ca.densify(ca.SX(group[n]))) for n in e.states] for group in (states, update)
        )
        pairs = (
            zip(
                ca.vertsplit(ca.vertcat(*before)),
                ca.vertsplit(ca.vertcat(*after)),
                self._fed(e),
                strict=True,
            )
            if e.states
            else ()
        )
        return y, ca.vertcat(
            ca.SX(0, 1), *[kept(now, then) if fed else now for then, now, fed in pairs]
        )

    def _call(self, e: Effect, x: ca.SX, started: ca.SX | None) -> tuple[ca.SX, ca.SX]:
        silent = {n: ca.SX.zeros(w.size) for n, w in e.noises.items()}
        return self.apply(e, x, silent, started)

    def _fed(self, e: Effect) -> list[bool]:
        """Which numbers of an effect's states follow from inputs of this sample.

        The others, which follow from noise and older states, are never NaN.
        """
        x = ca.SX.sym("x", 3)
        _, update = e(
            x,
            self.parameters[e.name],
            self.states[e.name],
            self.noises[e.name],
            {**self.signals, self.output.own: x},
            self.h,
        )
        column = ca.vertcat(*[ca.vec(ca.densify(ca.SX(update[n]))) for n in e.states])
        rows = set(ca.jacobian_sparsity(column, ca.vertcat(x, self.u)).row())
        return [i in rows for i in range(column.numel())]

    @cached_property
    def limits(self) -> Limits | None:
        """The conditions that the coefficients must keep together, and with the sample period.

        None where there are no such conditions.
        """
        found = [
            (f"{self.kind} {e.name}: {text}", broken(self.h, **self.parameters[e.name]))
            for e in self.effects
            for text, broken in e.limits.items()
        ]
        if not found:
            return None
        flags = ca.Function(
            "limits",
            [self.p, self.h],
            [ca.densify(ca.vertcat(*[flag for _, flag in found]))],
            ["p", "h"],
            ["broken"],
        )
        return Limits(tuple(text for text, _ in found), flags)

    def _invert(self, e: Effect, y: ca.SX, started: ca.SX | None) -> ca.SX:
        """Solve ``e(x) = y`` for x.

        One linear solve where the effect is affine in x, else Newton's method from ``x = y``.
        """
        x = ca.SX.sym("x", 3)
        out, _ = self._call(e, x, started)
        slope = ca.jacobian(out, x)
        if ca.is_equal(slope, ca.SX.eye(3), 1):
            # What switches with x has no slope either: at the output as at the input, but for
            # samples nearer to the switch than its step.
            added = out - x
            if ca.depends_on(added, x):
                return y - ca.substitute(added, x, y)
            return y - ca.substitute(out, x, ca.SX.zeros(3))
        improved = x - _solve(slope, out - y)
        guess = y
        for _ in range(1 if not ca.depends_on(slope, x) else NEWTON_STEPS):
            guess = ca.substitute(improved, x, guess)
        return guess


def _solve(a: ca.SX, b: ca.SX) -> ca.SX:
    """a^-1 b of a 3 x 3 system by the adjugate, elementwise where ``a`` is diagonal."""
    if a.sparsity().is_diag():
        return b / ca.diag(a)
    r = [ca.densify(a[i, :]).T for i in range(3)]
    c = [ca.cross(r[1], r[2]), ca.cross(r[2], r[0]), ca.cross(r[0], r[1])]
    return ca.horzcat(*c) @ b / ca.dot(r[0], c[0])


@lru_cache(maxsize=256)
def chain_of(kind: str, effects: tuple[Effect, ...]) -> Chain:
    """The chain of these effects, made once."""
    return Chain(kind, effects)
