"""What a sensor answers to a whole log at once, and how the answer changes with each coefficient.

The dynamics of a chain are linear and time-invariant, so they act by their impulse response; what
comes before and what follows has no memory once the noise is off, so casadi evaluates it, and its
Jacobian, over all samples together. What an effect remembers of other signals than the sensor's own
follows from these alone: it is stepped through by itself and taken as one more input. A chain with
an effect that remembers in another way is stepped through as a whole.
"""

from __future__ import annotations

from functools import cache, lru_cache

import casadi as ca
import numpy as np
from scipy.signal import freqz, oaconvolve

from pyimu.block.program import program
from pyimu.block.stepping import step_often, step_through
from pyimu.block.vectorised import over_rows, split_over_rows
from pyimu.model.chain import Chain, chain_of
from pyimu.model.effect import Effect
from pyimu.model.kinds import OWN
from pyimu.model.sensor import Sensor
from pyimu.model.signals import N_INPUT

LONGEST_RESPONSE = 1 << 14

FEW_TAPS = 128
"""Samples of an impulse response up to which sums are faster than Fourier transforms: of a delay,
which has two or three, twenty times."""

Columns = list[np.ndarray]
"""Inputs (n,), one after another: what changes one of them leaves the others where they are."""


def remembers(sensor: Sensor) -> bool:
    """Whether some effect's memory of the sensor's own signal is more than a filter's (rounding
    left out).
    """
    return any(
        e.remembers and not is_step(e, sensor.kind) and not is_driven(e, sensor.kind)
        for e in sensor.effects
    )


@cache
def is_driven(e: Effect, kind: str) -> bool:
    """Whether an effect remembers, and what it remembers follows from other signals than the
    sensor's own.
    """
    if not e.remembers:
        return False
    chain = chain_of(kind, (e,))
    s = ca.SX.sym("s", len(chain.start))
    after = chain.step(s, chain.u, chain.p, np.zeros(len(chain.noise)), chain.h)[0]
    return not ca.depends_on(after, chain.x)


def with_memory(
    rest: Sensor, inputs: Columns, h: float, earlier: np.ndarray | None = None
) -> Columns:
    """Inputs, N_INPUT + k columns (n,), of what is ``memoryless``: with the memory that the chain's
    effects have of other signals as it stands before each sample. It begins with the inputs
    ``earlier`` (m, N_INPUT), and goes on where the sensor's own signal has a gap.
    """
    chain = rest.chain
    if not has_memory(chain):
        return inputs
    function, read, of = _memory(chain)
    u, first = np.empty((len(inputs[0]), len(read))), 0
    for k, at in enumerate(read):
        u[:, k] = inputs[at]
    if earlier is not None:
        u, first = np.concatenate([earlier[:, read], u]), len(earlier)
    memory, none = np.empty((len(u), len(chain.start))), np.zeros((len(u), 0))
    step_often(function, chain.start.copy(), u, rest.p[of], none, np.array([h]), memory)
    return [*inputs, *memory[first:].T]


def has_memory(chain: Chain) -> bool:
    """Whether some effect of a chain remembers other signals."""
    return any(is_driven(e, chain.kind) for e in chain.effects)


@lru_cache(maxsize=32)
def _memory(chain: Chain) -> tuple[ca.Function, list[int], list[int]]:
    """The step of a chain's memory alone, whose output is the memory before it, and the numbers of
    the inputs and of the coefficients that it takes: few of them all, and so the same step in many
    chains, which is compiled once.
    """
    s, w = ca.SX.sym("s", len(chain.start)), np.zeros(len(chain.noise))
    after = ca.densify(chain.step(s, chain.u, chain.p, w, chain.h)[0])

    def stepped(u: ca.SX, p: ca.SX) -> ca.Function:
        return ca.Function("memory", [s, u, p, ca.SX.sym("w", 0), chain.h], [after, s])

    read, of = (program(stepped(chain.u, chain.p)).entries(k) for k in (1, 2))
    return stepped(chain.u[read], chain.p[of]), read, of


def before_dynamics(sensor: Sensor) -> Sensor:
    """The part of the chain that lies before the dynamics."""
    return sensor.without(*(e.name for e in sensor.effects if e.stage != "motion"))


def dynamics(sensor: Sensor) -> Sensor:
    """The part of the chain that filters."""
    return sensor.without(*(e.name for e in sensor.effects if e.stage != "dynamics"))


def after_dynamics(sensor: Sensor) -> Sensor:
    """What follows the dynamics, less the effects whose output has no slope (rounding acts as noise
    here).
    """
    left_out = (
        e.name
        for e in sensor.effects
        if e.stage in ("motion", "dynamics") or is_step(e, sensor.kind)
    )
    return sensor.without(*left_out)


@cache
def is_step(e: Effect, kind: str) -> bool:
    """Whether the slope of an effect's output is zero almost everywhere: a staircase."""
    chain = chain_of(kind, (e,))
    y = chain.step(chain.start, chain.u, chain.p, np.zeros(len(chain.noise)), 1.0)[1]
    slope = ca.Function("slope", [chain.u, chain.p], [ca.jacobian(y, chain.x)])
    # Inside and outside of a threshold or limit of one.
    inside = np.array([s.definition.start for s in chain.slots]) + 1.0
    return all(float(ca.norm_fro(slope(np.full(N_INPUT, v), inside))) == 0.0 for v in (0.3, 30.3))


def impulse_response(sensor: Sensor, h: float) -> np.ndarray:
    """Response (L, 3) of a chain of dynamics to a unit impulse, until it has died away (or
    ``LONGEST_RESPONSE`` samples). It cannot be written to.
    """
    return _impulse_response(sensor.chain, sensor.p.tobytes(), h)


@lru_cache(maxsize=64)
def _impulse_response(chain: Chain, coefficients: bytes, h: float) -> np.ndarray:
    p, state = np.frombuffer(coefficients).copy(), chain.start.copy()
    if chain.waits:
        state[0] = 1.0
    parts, total = [], 0
    while total < LONGEST_RESPONSE:
        u = np.zeros((64, N_INPUT))
        if not total:
            u[0, OWN[chain.kind]] = 1.0
        y = np.empty((64, 3))
        step_through(chain.step, state, u, p, np.zeros((64, 0)), np.array([h]), y)
        parts.append(y)
        total += 64
        if np.abs(y).max() < 1e-13 and np.abs(state[chain.waits :]).max(initial=0) < 1e-13:
            break
    out = np.concatenate(parts)
    last = int(np.flatnonzero(np.any(out != 0.0, axis=1)).max(initial=0))
    out = out[: last + 1]
    out.flags.writeable = False
    return out


def through_dynamics(
    sensor: Sensor, x: np.ndarray, segments: list[tuple[int, int]], h: float
) -> np.ndarray:
    """Input (n, 3) after the sensor's dynamics, each segment started at rest on its first row."""
    chain = dynamics(sensor)
    if not chain.effects:
        return x
    response = impulse_response(chain, h)
    out = np.array(x, order="F")
    for column, taps in zip(out.T, response.T, strict=True):
        for a, b in segments:
            origin = column[a]
            # Dynamics pass a constant as it is; a response that was cut off before it had died
            # away must not change the level.
            column[a:b] = _convolved(column[a:b] - origin, taps[: b - a]) + origin
    return out


def power_through_dynamics(sensor: Sensor, frequency: np.ndarray, h: float) -> np.ndarray:
    """Share (f, 3) of an input's power that comes through the sensor's dynamics at ``frequency`` in
    Hz.
    """
    chain = dynamics(sensor)
    if not chain.effects:
        return np.ones((len(frequency), 3))
    taps = impulse_response(chain, h).T
    gains = [freqz(t, worN=frequency, fs=1.0 / h)[1] for t in taps]
    return np.abs(np.column_stack(gains)) ** 2


def _convolved(x: np.ndarray, taps: np.ndarray) -> np.ndarray:
    """The answer (n,) to ``x`` (n,) from its first row on."""
    convolved = oaconvolve if len(taps) > FEW_TAPS else np.convolve
    return convolved(x, taps)[: len(x)]


def behind_dynamics(
    sensor: Sensor,
    u: np.ndarray,
    segments: list[tuple[int, int]],
    h: float,
    earlier: np.ndarray | None = None,
) -> Columns:
    """Inputs (n, N_INPUT), column by column, with the sensor's own signal as it comes out of the
    dynamics; ``earlier`` (m, N_INPUT) are those before them.
    """
    own, before = OWN[sensor.kind], before_dynamics(sensor)
    out, x = list(u.T), u[:, own]
    if before.effects:
        x = memoryless(before.chain).output(with_memory(before, out, h, earlier), before.p, h)
    out[own] = through_dynamics(sensor, x, segments, h).T
    return out


class Memoryless:
    """A memoryless part of a chain with its Jacobians, for one structure (which effects, not which
    values). Its inputs are those ``with_memory``.
    """

    def __init__(self, chain: Chain) -> None:
        s = ca.SX.sym("s", len(chain.start)) if has_memory(chain) else chain.start
        y = chain.step(s, chain.u, chain.p, np.zeros(len(chain.noise)), chain.h)[1]
        u = ca.vertcat(chain.u, s) if has_memory(chain) else chain.u
        fixed = ca.vertcat(chain.p, chain.h)
        jp = ca.jacobian(y, chain.p)
        self.axis, self.slot = (np.array(i, dtype=int) for i in jp.sparsity().get_triplet())
        outputs = ca.vertcat(y, ca.vec(ca.densify(ca.jacobian(y, chain.x)).T), *jp.nonzeros())
        self._all = ca.Function("memoryless", [u, fixed], [ca.densify(outputs)])
        self._output = ca.Function("output", [u, fixed], [ca.densify(y)])

    def __call__(
        self,
        inputs: Columns,
        p: np.ndarray,
        h: float,
        wanted: np.ndarray | None = None,
        precision: type[np.floating] = np.float64,
    ) -> tuple[np.ndarray, np.ndarray, Columns]:
        """Output (n, 3) for inputs, N_INPUT + k columns (n,), and its slopes.

        Against the own input (n, 3, 3), and dy/dp, a column (n,) in a ``precision`` for each entry.

        Entry e of dy/dp belongs to output axis ``self.axis[e]`` and to coefficient
        ``self.slot[e]``; those that are not ``wanted`` (entries,) are zero.
        """
        few = None if wanted is None else np.append(np.ones(12, dtype=bool), wanted)
        fixed = np.append(p, h)
        whole, entries = split_over_rows(self._all, inputs, fixed, 12, few, precision)
        return whole[:, :3], whole[:, 3:].reshape(-1, 3, 3), entries

    def output(self, inputs: Columns, p: np.ndarray, h: float) -> np.ndarray:
        """Output (n, 3) alone."""
        return over_rows(self._output, inputs, np.append(p, h))


@lru_cache(maxsize=32)
def memoryless(chain: Chain) -> Memoryless:
    """The ``Memoryless`` of a chain, built once."""
    return Memoryless(chain)


def predict(
    sensor: Sensor,
    u: np.ndarray,
    segments: list[tuple[int, int]],
    h: float,
    earlier: np.ndarray | None = None,
) -> np.ndarray:
    """Noise-free answer (n, 3) of a sensor to a log (rounding left out), of which ``earlier``
    (m, N_INPUT) are the inputs before the first row of ``u`` (n, N_INPUT).
    """
    if remembers(sensor):
        return _stepped(
            sensor.without(*[e.name for e in sensor.effects if is_step(e, sensor.kind)]),
            u,
            segments,
            h,
        )
    rest = after_dynamics(sensor)
    moved = behind_dynamics(sensor, u, segments, h, earlier)
    return memoryless(rest.chain).output(with_memory(rest, moved, h, earlier), rest.p, h)


def predict_each(
    sensor: Sensor, u: np.ndarray, h: float, slot: int, values: np.ndarray
) -> np.ndarray:
    """Answers (3, n, k) of a sensor that remembers nothing and has no dynamics to inputs (n,
    N_INPUT), for each of ``values`` (k,) of its coefficient number ``slot``.
    """
    n, k = len(u), len(values)
    function, unread = _with_free(sensor.chain, slot), np.broadcast_to(0.0, n * k)
    read = set(program(function).entries(0))
    inputs = [np.repeat(c, k) if i in read else unread for i, c in enumerate(np.asarray(u).T)]
    fixed = np.append(sensor.p, h)
    return over_rows(function, [*inputs, np.tile(values, n)], fixed).T.reshape(3, n, k)


@lru_cache(maxsize=32)
def _with_free(chain: Chain, slot: int) -> ca.Function:
    """The output of a chain without memory, of rows that hold one of its coefficients, too."""
    free, p = ca.SX.sym("free"), ca.SX(chain.p)
    p[slot] = free
    y = chain.step(chain.start, chain.u, p, np.zeros(len(chain.noise)), chain.h)[1]
    row, fixed = ca.vertcat(chain.u, free), ca.vertcat(chain.p, chain.h)
    return ca.Function("output", [row, fixed], [ca.densify(y)])


def _stepped(
    sensor: Sensor, u: np.ndarray, segments: list[tuple[int, int]], h: float
) -> np.ndarray:
    """Answer (n, 3) sample by sample, each segment from the start.

    Outside of segments the input itself.
    """
    out = np.array(u[:, OWN[sensor.kind]])
    for a, b in segments:
        w = np.zeros((b - a, len(sensor.noise)))
        step_through(
            sensor.step, sensor.chain.start.copy(), u[a:b], sensor.p, w, np.array([h]), out[a:b]
        )
    return out
