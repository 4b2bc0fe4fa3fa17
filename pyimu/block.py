"""A discrete-time block: what a Python run, the C generator and the FMU layer all take.

A block knows no physics of its own.  It is one pure casadi function together with the names, units and
start values of everything that goes in and out.  Randomness is an input of the function, so a run does not
depend on who calls it and a restored state replays exactly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import casadi as ca
import numpy as np

from pyimu.native import compiled

Kind = Literal["real", "boolean", "integer"]


@dataclass(frozen=True)
class Variable:
    """One scalar of a block; ``name`` is its FMI name (``gyro_error.g_sensitivity.G[1,2]``), ``unit`` an SI spelling."""

    name: str
    unit: str = "1"
    description: str = ""
    start: float = 0.0
    kind: Kind = "real"
    minimum: float | None = None
    maximum: float | None = None


@dataclass(frozen=True)
class NoiseChannel:
    """One standard normal input; ``number`` names its stream, whatever else the block holds."""

    name: str
    number: int


@dataclass(frozen=True)
class Block:
    """A sampled system ``(s, u, p, w, h) -> (s_next, y)`` with named scalars.

    ``step`` maps state (ns,), input (nu,), parameter (np,), standard normals (nw,) and sample period (1,)
    to the next state and the output (ny,).  ``initial`` maps the parameters to the state before the first
    sample and to the outputs shown before it.
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

    def __post_init__(self) -> None:
        want = (len(self.inputs), len(self.parameters), len(self.noise), 1)
        have = tuple(self.step.numel_in(i) for i in range(1, 5))
        if want != have or self.step.numel_out(1) != len(self.outputs):
            raise ValueError(f"block {self.name}: step takes {have} and gives {self.step.numel_out(1)} outputs, "
                             f"its variables say {want} and {len(self.outputs)}")

    @property
    def n_state(self) -> int:
        return self.step.numel_in(0)

    @cached_property
    def start(self) -> np.ndarray:
        """Start values of the parameters, shape (np,)."""
        return np.array([v.start for v in self.parameters], dtype=float)

    def run(self, u: np.ndarray, *, p: np.ndarray | None = None, w: np.ndarray | None = None,
            state: np.ndarray | None = None, sample_period: float | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Step through a whole log: inputs (n, nu), normals (n, nw) or none; gives outputs (n, ny) and the last state.

        Row k of the output is the answer to row k of the input.
        """
        u = np.ascontiguousarray(u, dtype=float)
        n = len(u)
        if u.shape != (n, len(self.inputs)):
            raise ValueError(f"block {self.name}: inputs have shape {u.shape}, not (n, {len(self.inputs)})")
        p = np.ascontiguousarray(self.start if p is None else p, dtype=float)
        h = np.array([self.sample_period if sample_period is None else sample_period])
        w = np.zeros((n, len(self.noise))) if w is None else np.ascontiguousarray(w, dtype=float)
        s = np.array(self.initial(p)[0], dtype=float).ravel() if state is None else np.array(state, dtype=float)
        y = np.empty((n, len(self.outputs)))
        go = compiled(self.step, n) or step_through
        return y, go(self.step, s, u, p, w, h, y)


def step_through(step: ca.Function, s: np.ndarray, u: np.ndarray, p: np.ndarray, w: np.ndarray, h: np.ndarray,
                 y: np.ndarray) -> np.ndarray:
    """Fill ``y`` row by row through casadi's buffer interface; the arrays are bound once, so a step allocates nothing."""
    buffer, evaluate = step.buffer()
    row_u, row_w = np.zeros(u.shape[1]), np.zeros(w.shape[1])
    following, row_y = np.zeros_like(s), np.zeros(y.shape[1])
    for i, array in enumerate((s, row_u, p, row_w, h)):
        buffer.set_arg(i, memoryview(array))
    buffer.set_res(0, memoryview(following))
    buffer.set_res(1, memoryview(row_y))
    for k in range(len(u)):
        row_u[:] = u[k]
        row_w[:] = w[k]
        evaluate()
        s[:] = following
        y[k] = row_y
    return s

