"""A step function of casadi taken through a log."""

from __future__ import annotations

import casadi as ca
import numpy as np

from pyimu.block.compiled import compiled

FEW = 256
"""Rows for which casadi's virtual machine is good enough: the faster one takes as long to load."""


def step_through(
    step: ca.Function,
    s: np.ndarray,
    u: np.ndarray,
    p: np.ndarray,
    w: np.ndarray,
    h: np.ndarray,
    y: np.ndarray,
) -> None:
    """Fill ``y`` row by row and leave the last state in ``s``.

    A few rows, and functions that are no plain list of operations, go through casadi's virtual
    machine. Its buffer interface has the arrays bound once, so that a step allocates nothing.
    """
    if len(u) > FEW:
        from pyimu.block.machine import machine  # loads numba, which few rows do without

        quick = machine(step)
        if quick is not None:
            return quick.run(s, u, p, w, h, y)
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


def step_often(
    step: ca.Function,
    s: np.ndarray,
    u: np.ndarray,
    p: np.ndarray,
    w: np.ndarray,
    h: np.ndarray,
    y: np.ndarray,
) -> None:
    """What ``step_through`` does, bit for bit, for a step that one process takes through many logs,
    or again and again: compiled, once that pays and where it can be done.
    """
    native = compiled(step, len(u)) if len(u) > FEW else None
    if native is None:
        return step_through(step, s, u, p, w, h, y)
    native(s, u, p, h, y, w, None, 0, 0)
