"""The shaping filter of a simulated effect: the Jacobians of its step, and its density."""

from __future__ import annotations

import casadi as ca
import control
import numpy as np

from pyimu.errors import UserError
from pyimu.model.chain import Chain
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import COLUMNS, START


def shaping_filter(
    sensor: Sensor,
    effect: str,
    axis: int,
    sample_period: float,
    *,
    at: float | None = None,
    slope: float = 0.0,
) -> control.StateSpace:
    """The discrete system from standard normals to one axis (0 to 2) of one effect's output.

    Its inputs are those normals that reach the axis.

    Its output is in the sensor's unit (rad/s or m/s^2), its step ``sample_period`` in seconds; it
    has as many inputs as the effect has normals that reach the axis, in their order. States that
    the noise does not reach are left out.

    The effect is linearised in the state after its first sample, with the axis's own input at
    ``at`` (that of a part at rest and level unless given) and growing by ``slope`` a second: exact,
    since every effect is linear in its noise once it has started. Raises UserError where the
    sensor lacks the effect or the effect draws no noise.
    """
    alone = only(sensor, effect)
    if not alone.noise:
        raise UserError(f"{sensor.kind}.{effect} draws no noise and has no shaping filter")
    step, u = alone.chain.step, operating_point(sensor, axis, at, slope)
    state, _ = step(alone.chain.start, u, alone.p, 0, sample_period)
    linear, (a, b, c, d) = _linearised(alone.chain, axis)
    states = _reached(a, b.any(axis=1)) & _reached(a.T, c[0])
    inputs = d[0] | b[states].any(axis=0)
    a, b, c, d = (np.array(ca.densify(m)) for m in linear(state, u, alone.p, 0, sample_period))
    return control.ss(
        a[np.ix_(states, states)],
        b[np.ix_(states, inputs)],
        c[:, states],
        d[:, inputs],
        sample_period,
    )


def only(sensor: Sensor, effect: str) -> Sensor:
    """The sensor with this effect alone. Raises UserError where it lacks the effect."""
    if effect not in sensor.values:
        raise UserError(
            f"the {sensor.kind} has no effect {effect}, only {', '.join(sensor.values) or 'none'}"
        )
    return Sensor(sensor.kind, {effect: sensor.values[effect]})


def operating_point(sensor: Sensor, axis: int, at: float | None, slope: float) -> np.ndarray:
    """Inputs (N_INPUT,) at rest and level, but for one axis.

    ``at`` and ``slope`` set the sensor's own signal and its rate on that axis.
    """
    u = START.copy()
    if at is not None:
        u[OWN[sensor.kind].start + axis] = at
    u[COLUMNS[sensor.output.own_rate].start + axis] = slope
    return u


def _linearised(chain: Chain, axis: int) -> tuple[ca.Function, tuple[np.ndarray, ...]]:
    """A, B, C, D as a function of (s, u, p, w, h), and where each can differ from zero.

    The second holds for any coefficients.
    """
    s, u, p, w, h = (chain.step.sx_in(i) for i in range(5))
    s_next, y = chain.step(s, u, p, w, h)
    jacobians = [ca.jacobian(of, by) for of in (s_next, y[axis]) for by in (s, w)]
    patterns = tuple(np.array(ca.DM(m.sparsity(), 1)) != 0 for m in jacobians)
    return ca.Function("linear", [s, u, p, w, h], jacobians), patterns


def _reached(a: np.ndarray, entered: np.ndarray) -> np.ndarray:
    """Mask (n,) of the states that a signal entering at ``entered`` (n,) reaches.

    For the transposed system these are the states that are seen.
    """
    reached = entered
    for _ in range(len(a)):
        reached = reached | (a @ reached)
    return reached


def psd_two_sided(system: control.lti.LTI, f: np.ndarray) -> np.ndarray:
    """Two-sided density of a system's one output at ``f`` [Hz], the sum over its inputs.

    It has the shape of ``f``.

    In the square of the output's unit per Hz; infinite at a pole. A discrete system of step h is
    driven by standard normals and has |H(exp(j 2 pi f h))|^2 h, a continuous one by white noise of
    density 1 and has |H(j 2 pi f)|^2.
    """
    f = np.asarray(f, dtype=float)
    s = 2j * np.pi * f.ravel()
    z, step = (s, 1.0) if system.isctime() else (np.exp(s * system.dt), system.dt)
    return (_power(system, z) * step).reshape(f.shape)


def _power(system: control.lti.LTI, z: np.ndarray) -> np.ndarray:
    """Sum over the inputs of |H(z)|^2, shape (n,)."""
    if not isinstance(system, control.StateSpace) or np.any(system.A != np.diag(np.diag(system.A))):
        response = np.atleast_3d(system(z, squeeze=False, warn_infinite=False))
        return np.sum(np.abs(response[0]) ** 2, axis=0)
    # A sum over the poles, thousands of times faster than a system of equations for each frequency.
    power, infinite = np.zeros(len(z)), np.zeros(len(z), dtype=bool)
    for b, d in zip(system.B.T, system.D[0], strict=True):
        response = np.full(len(z), d, dtype=complex)
        for pole, weight in zip(np.diag(system.A), system.C[0] * b, strict=True):
            gap = z - pole
            infinite |= (gap == 0) & (weight != 0)
            response += weight / np.where(gap == 0, 1, gap)
        power += np.abs(response) ** 2
    return np.where(infinite, np.inf, power)
