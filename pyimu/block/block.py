"""A discrete-time block: what a Python run, the C generator and the FMU layer all take.

A block knows no physics of its own. It is one pure casadi function together with the names, units
and start values of everything that goes in and out. Randomness is an input of the function, so a
run does not depend on who calls it and a restored state replays exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import casadi as ca
import numpy as np

from pyimu.block.compiled import compiled
from pyimu.block.prepared import Prepared
from pyimu.block.stepping import step_through
from pyimu.block.variables import Limits, NoiseChannel, Variable, sample_period_of, seed_of
from pyimu.errors import UserError

CHUNK = 4096
"""Samples whose normals are made at a time where the virtual machine does the work."""


@dataclass(frozen=True)
class Block:
    """A sampled system ``(s, u, p, w, h) -> (s_next, y)`` with named scalars.

    ``step`` maps state (ns,), input (nu,), parameter (np,), standard normals (nw,) and sample
    period (1,) to the next state and the output (ny,). ``initial`` maps the inputs at the start
    and the parameters to the state before the first sample and to the outputs shown before it; the
    state depends on the parameters alone. Where the parameters break ``limits`` no run begins.
    ``prepared`` is the same step in two parts, of which compiled runs and units take the first once
    for many samples.
    """

    name: str
    description: str
    step: ca.Function
    initial: ca.Function
    inputs: tuple[Variable, ...]
    parameters: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    noise: tuple[NoiseChannel, ...]
    sample_period: float
    limits: Limits | None = None
    prepared: Prepared | None = None
    stop_time: float = 10.0
    """s; how long it runs where nobody says."""

    def __post_init__(self) -> None:
        want = (len(self.inputs), len(self.parameters), len(self.noise), 1)
        have = tuple(self.step.numel_in(i) for i in range(1, 5))
        if want != have or self.step.numel_out(1) != len(self.outputs):
            raise ValueError(
                f"block {self.name}: step takes {have} and gives {self.step.numel_out(1)} outputs, "
                f"its variables say {want} and {len(self.outputs)}"
            )

        shown = tuple(self.initial.numel_in(i) for i in range(self.initial.n_in()))
        if shown != want[:2]:
            raise ValueError(
                f"block {self.name}: initial takes {shown}, not inputs and parameters {want[:2]}"
            )

    @property
    def n_state(self) -> int:
        return self.step.numel_in(0)

    @cached_property
    def start_inputs(self) -> np.ndarray:
        """Start values of the inputs, shape (nu,)."""
        return np.array([v.start for v in self.inputs], dtype=float)

    @cached_property
    def start(self) -> np.ndarray:
        """Start values of the parameters, shape (np,)."""
        return np.array([v.start for v in self.parameters], dtype=float)

    def run(
        self,
        u: np.ndarray,
        *,
        p: np.ndarray | None = None,
        w: np.ndarray | None = None,
        seed: int | None = None,
        first_sample: int = 1,
        state: np.ndarray | None = None,
        sample_period: float | None = None,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Step through a whole log: inputs (n, nu); gives outputs (n, ny) and the last state.

        Row k of the output is the answer to row k of the input. Its noise is that of the FMU's
        sample ``first_sample`` + k under ``seed``, or row k of the normals ``w`` (n, nw); with
        neither there is none.
        """
        u = np.ascontiguousarray(u, dtype=float)
        run = Run(
            self,
            len(u),
            p=p,
            seed=seed,
            first_sample=first_sample,
            state=state,
            sample_period=sample_period,
        )
        return run.advance(u, w), run.state


class Run:
    """A run under way: the constants of the block, the state, and the number of the next sample.

    ``rows`` is how many samples are to come in all, by which is decided whether compiling pays; the
    rest is as for ``Block.run``. Memory beyond the arrays does not grow with the length of the
    run.

    Raises UserError for a seed that is no integer of 64 bits, a sample period that is not positive
    and finite, and parameters that are not finite or break the block's limits.
    """

    def __init__(
        self,
        block: Block,
        rows: int,
        *,
        p: np.ndarray | None = None,
        seed: int | None = None,
        first_sample: int = 1,
        state: np.ndarray | None = None,
        sample_period: float | None = None,
    ) -> None:
        seed = None if seed is None else seed_of(seed)
        h = sample_period_of(
            block.sample_period if sample_period is None else sample_period, f"block {block.name}"
        )
        self.block, self.sample = block, int(first_sample)
        self.seed = seed if block.noise else None
        self.p = _vector(
            block, "parameters", block.start if p is None else p, len(block.parameters)
        )
        _check_finite(block, self.p)
        if state is None:
            state = block.initial(block.start_inputs, self.p)[0]
        self.state = _vector(block, "state", state, block.n_state)
        if block.limits:
            block.limits.check(self.p, h, f"block {block.name}")
        self.h = np.array([h])
        self.channels = np.array([c.number for c in block.noise], dtype=np.uint64)
        self._native = compiled(block.step, rows, block.prepared)

    def advance(
        self,
        u: np.ndarray,
        w: np.ndarray | None = None,
        y: np.ndarray | None = None,
        sample_period: float | None = None,
    ) -> np.ndarray:
        """Outputs (n, ny) to the next inputs (n, nu).

        They are written into ``y`` where that is given; the normals are ``w`` (n, nw) where these
        are given. ``sample_period`` in s is that of these samples and those to come.
        """
        if sample_period is not None:
            self.h[:] = sample_period
        n, block = len(u), self.block
        u = _rows(block, "inputs", u, n, len(block.inputs))
        w = None if w is None else _rows(block, "normals", w, n, len(block.noise))
        y = np.empty((n, len(block.outputs))) if y is None else y
        if self._native is not None:
            drawn = self.channels if self.seed is not None else None
            self._native(self.state, u, self.p, self.h, y, w, drawn, self.seed or 0, self.sample)
        else:
            for k in range(0, n, CHUNK):
                rows = slice(k, min(k + CHUNK, n))
                step_through(
                    block.step, self.state, u[rows], self.p, self._normals(rows, w), self.h, y[rows]
                )
        self.sample += n
        return y

    def _normals(self, rows: slice, w: np.ndarray | None) -> np.ndarray:
        if w is not None:
            return w[rows]
        n = rows.stop - rows.start
        if self.seed is None:
            return np.broadcast_to(np.zeros(len(self.channels)), (n, len(self.channels)))
        from pyimu.block.normals import (
            normals,
        )  # loads numba, which takes a while and which compiled runs do without

        return normals(self.seed, self.channels, self.sample + rows.start, n)


def _check_finite(block: Block, p: np.ndarray) -> None:
    """Raise UserError for the first parameter that is not finite, as the block's FMU refuses it."""
    bad = np.flatnonzero(~np.isfinite(p))
    if len(bad):
        name, value = block.parameters[bad[0]].name, p[bad[0]]
        raise UserError(f"block {block.name}: parameter {name} must be finite, not {value:g}")


def _vector(block: Block, what: str, values, size: int) -> np.ndarray:
    """A copy, as the state is overwritten."""
    array = np.array(values, dtype=float).ravel()
    if len(array) != size:
        raise ValueError(f"block {block.name}: {what} has {len(array)} numbers, not {size}")
    return array


def _rows(block: Block, what: str, values: np.ndarray, n: int, width: int) -> np.ndarray:
    array = np.ascontiguousarray(values, dtype=float)
    if array.shape != (n, width):
        raise ValueError(f"block {block.name}: {what} have shape {array.shape}, not ({n}, {width})")
    return array
