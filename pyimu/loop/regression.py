"""Regression of a sensor model on several logs: residuals, regressors, whitening, Gram matrices, Gauss-Newton.

Everything that a log shows of a coefficient is a column: the slope of the model's output against it.  Columns and
residual go through the same band and the same whitening filter, after which each row counts alike and the normal
equations are all that selection needs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.effect import CATALOGUE, OWN, Parameter
from pyimu.errors import UserError
from pyimu.loop.response import dynamics, felt, motion, predict, remembers, tail, tail_of, through_dynamics
from pyimu.loop.trial import Trial, rest_noise
from pyimu.loop.whiten import Autoregressive, RandomWalk
from pyimu.sensor import Sensor, Slot

Key = tuple
"""Name of a column: ("slot", effect, parameter, index), ("bias", trial, axis), ("rotation", trial, axis) or ("scan", ...)."""

BLOCKS = 80
"""Stretches into which all rows are cut to see how much the scores really scatter."""

Noise = dict[int, "RandomWalk | Autoregressive"]


@dataclass(frozen=True)
class LogState:
    """What belongs to a log and not to the part: bias (3,) at power-on and mounting rotation (3, 3) of the reference."""

    bias: np.ndarray = field(default_factory=lambda: np.zeros(3))
    rotation: np.ndarray = field(default_factory=lambda: np.eye(3))

    def moved(self, key: Key, change: float) -> LogState:
        """The state with the coefficient of a "bias" or "rotation" column changed."""
        unit = np.eye(3)[key[2]]
        if key[0] == "bias":
            return replace(self, bias=self.bias + change * unit)
        return replace(self, rotation=Rotation.from_rotvec(change * unit).as_matrix() @ self.rotation)


@dataclass(frozen=True)
class Linear:
    """A trial linearised: residual (m, 3) in its band, and for each axis the columns that act on it."""

    time: np.ndarray
    segments: list[tuple[int, int]]
    residual: np.ndarray
    keys: dict[int, list[Key]]
    columns: dict[int, np.ndarray]


def reference_input(trial: Trial, state: LogState) -> np.ndarray:
    """Inputs (n, N_INPUT) with the reference turned into the sensor's axes."""
    u = np.array(trial.u)
    u[:, OWN[trial.kind]] = u[:, OWN[trial.kind]] @ state.rotation.T
    return u


def residual(sensor: Sensor, trial: Trial, state: LogState) -> np.ndarray:
    """Measured less model (n, 3), at the sample rate."""
    return trial.y - predict(sensor, reference_input(trial, state), trial.segments, trial.h) - state.bias


def in_band(trial: Trial, values: np.ndarray) -> np.ndarray:
    """Rows (m, c) of values (n, c) as the trial's band shows them."""
    return trial.band.apply(values, trial.row_segments)


def band_segments(trial: Trial) -> list[tuple[int, int]]:
    """Segments of the rows that ``in_band`` gives."""
    lengths = [len(trial.band.centres([s])) for s in trial.row_segments]
    ends = np.cumsum([n for n in lengths if n])
    return list(zip([0, *ends[:-1].tolist()], ends.tolist(), strict=True)) if len(ends) else []


def band_time(trial: Trial) -> np.ndarray:
    return trial.time[trial.band.centres(trial.row_segments)]


class Columns:
    """Collects columns as (key, axis, values at the sample rate) and filters them all at once."""

    def __init__(self, trial: Trial) -> None:
        self.trial = trial
        self.items: list[tuple[Key, int, np.ndarray]] = []

    def add(self, key: Key, axis: int, values: np.ndarray) -> None:
        if axis in self.trial.axes and np.any(values):
            self.items.append((key, axis, values))

    def filtered(self) -> tuple[dict[int, list[Key]], dict[int, np.ndarray]]:
        keys = {i: [k for k, axis, _ in self.items if axis == i] for i in self.trial.axes}
        columns = {}
        for i in self.trial.axes:
            arrays = [v for _, axis, v in self.items if axis == i]
            stacked = np.column_stack(arrays) if arrays else np.zeros((len(self.trial.time), 0))
            columns[i] = in_band(self.trial, stacked)
        return keys, columns


def slot_key(slot: Slot) -> Key:
    return ("slot", slot.effect, slot.parameter, slot.index)


def slot_keys(sensor: Sensor, effect: str) -> frozenset[Key]:
    """Keys of all coefficients of an effect that can be estimated."""
    one = Sensor(sensor.kind, {effect: {}})
    return frozenset(slot_key(s) for s in one.slots if not s.definition.reference)


def linearise(sensor: Sensor, trial: Trial, state: LogState, wanted: Iterable[Key], extra: Iterable = ()) -> Linear:
    """Residual and columns of a trial.

    ``sensor`` holds the model and any candidates at their identity; ``wanted`` are the keys of the coefficients that get
    columns; ``extra`` are functions ``(trial, u, y, add)`` that add columns of their own (scans, generic inputs).
    """
    wanted = frozenset(wanted)
    u = reference_input(trial, state)
    own = OWN[trial.kind]
    moved = felt(sensor, u, trial.segments, trial.h)
    rest = tail(sensor)
    response = tail_of(rest.kind, tuple(rest.values))
    y, slope, entries = response(moved, rest.p, trial.h)
    if remembers(sensor):
        y = predict(sensor, u, trial.segments, trial.h)
    out = Columns(trial)
    for e, (axis, slot) in enumerate(zip(response.axis, response.slot, strict=True)):
        s = rest.slots[slot]
        if slot_key(s) in wanted:
            out.add(slot_key(s), int(axis), entries[:, e])
    _log_columns(out, trial, moved[:, own], slope)
    _motion_columns(out, sensor, trial, u, slope, wanted)
    _dynamics_columns(out, sensor, trial, u, wanted)
    for function in extra:
        function(trial, u, y, out.add)
    keys, columns = out.filtered()
    return Linear(band_time(trial), band_segments(trial), in_band(trial, trial.y - y - state.bias), keys, columns)


def _log_columns(out: Columns, trial: Trial, x: np.ndarray, slope: np.ndarray) -> None:
    """Bias of each axis; where the mounting is free, a small turn about each axis."""
    for i in range(3):
        out.add(("bias", trial.name, i), i, np.ones(len(x)))
    if trial.free_rotation:
        for k in range(3):
            turned = np.einsum("nij,nj->ni", slope, np.cross(np.eye(3)[k], x))
            for i in range(3):
                out.add(("rotation", trial.name, k), i, turned[:, i])


def _motion_columns(out: Columns, sensor: Sensor, trial: Trial, u: np.ndarray, slope: np.ndarray, wanted: frozenset[Key]) -> None:
    """Slopes against the coefficients of what comes before the dynamics: through these, and through what follows."""
    chain = motion(sensor)
    if not any(slot_key(s) in wanted for s in chain.slots):
        return
    before = tail_of(chain.kind, tuple(chain.values))
    entries = before(u, chain.p, trial.h)[2]
    for number, s in enumerate(chain.slots):
        of_slot = np.flatnonzero(before.slot == number)
        if slot_key(s) not in wanted or not len(of_slot):
            continue
        change = np.zeros((len(u), 3))
        change[:, before.axis[of_slot]] = entries[:, of_slot]
        change = np.einsum("nij,nj->ni", slope, through_dynamics(sensor, change, trial.segments, trial.h))
        for i in range(3):
            out.add(slot_key(s), i, change[:, i])


def _dynamics_columns(out: Columns, sensor: Sensor, trial: Trial, u: np.ndarray, wanted: frozenset[Key]) -> None:
    """Slopes against the coefficients of dynamics that are switched on, by central differences, one-sided at a bound."""
    chain = dynamics(sensor)
    for s, value in zip(chain.slots, chain.p, strict=True):
        if slot_key(s) not in wanted or sensor.is_off(s.effect):
            continue
        step = 1e-3 * max(abs(value), 1e-3 * trial.h)
        ends = _clipped(s.definition, value + step), _clipped(s.definition, value - step)
        high, low = (predict(_moved(sensor, s, v), u, trial.segments, trial.h) for v in ends)
        for i in range(3):
            out.add(slot_key(s), i, (high[:, i] - low[:, i]) / (ends[0] - ends[1]))


def _moved(sensor: Sensor, slot, value: float) -> Sensor:
    array = np.array(sensor.values[slot.effect][slot.parameter])
    array[slot.index] = value
    return sensor.with_values(slot.effect, **{slot.parameter: array})


@dataclass
class Normal:
    """Normal equations in whitened units, whole and by block: ``gram`` (P, P), ``score`` (P,), for named columns."""

    keys: list[Key]
    block_gram: np.ndarray
    block_score: np.ndarray
    power: float
    rows: int
    log_det: float

    @cached_property
    def gram(self) -> np.ndarray:
        return self.block_gram.sum(axis=0)

    @cached_property
    def score(self) -> np.ndarray:
        return self.block_score.sum(axis=0)

    @cached_property
    def position(self) -> dict[Key, int]:
        return {k: i for i, k in enumerate(self.keys)}

    @property
    def log_likelihood(self) -> float:
        """Gaussian log-likelihood [nat] of the residual as it stands, constant left out."""
        return -0.5 * (self.power + self.log_det)


def normal_equations(linears: list[Linear], noise: Noise) -> Normal:
    """Whiten residual and columns, axis by axis, and add up what the rows say."""
    keys = list(dict.fromkeys(k for one in linears for i in one.keys for k in one.keys[i]))
    position = {k: i for i, k in enumerate(keys)}
    blocks = [max(2, round(BLOCKS * len(one.time) / max(1, sum(len(o.time) for o in linears)))) for one in linears]
    gram = np.zeros((sum(blocks), len(keys), len(keys)))
    score = np.zeros((sum(blocks), len(keys)))
    power, log_det, rows, first = 0.0, 0.0, 0, 0
    for one, count in zip(linears, blocks, strict=True):
        edges = np.linspace(0, len(one.time), count + 1).astype(int)
        for i, columns in one.columns.items():
            at = np.array([position[k] for k in one.keys[i]], dtype=int)
            white = noise[i].whiten(np.column_stack([columns, one.residual[:, i]]), one.time, one.segments)
            power += float(white[:, -1] @ white[:, -1])
            log_det += noise[i].log_det(one.time, one.segments)
            rows += len(white)
            for b in range(count):
                part = white[edges[b]:edges[b + 1]]
                whole = part.T @ part
                gram[first + b][np.ix_(at, at)] += whole[:-1, :-1]
                score[first + b][at] += whole[:-1, -1]
        first += count
    return Normal(keys, gram, score, power, rows, log_det)


def _scaled(gram: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Scale of each column, eigenvalues and eigenvectors of the scaled matrix, and which directions the data show."""
    scale = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    values, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
    return scale, values, vectors, values > 1e-9 * max(values.max(initial=0.0), 1e-300)


def variances(gram: np.ndarray) -> np.ndarray:
    """Variances (P,) of the solution; infinite for a coefficient that a direction which the data do not show takes part in."""
    scale, values, vectors, keep = _scaled(gram)
    shown = np.sum(vectors[:, keep] ** 2 / values[keep], axis=1) / scale ** 2
    hidden = np.sum(vectors[:, ~keep] ** 2, axis=1)
    return np.where(hidden > 1e-6, np.inf, shown)


def solve(gram: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Least-norm solution of normal equations; directions that the data do not show stay where they are."""
    scale, values, vectors, keep = _scaled(gram)
    turned = vectors[:, keep].T @ (right / (scale if right.ndim == 1 else scale[:, None]))
    inverse = values[keep] if right.ndim == 1 else values[keep][:, None]
    answer = vectors[:, keep] @ (turned / inverse)
    return answer / (scale if right.ndim == 1 else scale[:, None])


@dataclass(frozen=True)
class Fit:
    """A model fitted to trials: values in ``sensor``, per-log states, noise by axis, log-likelihood [nat].

    ``free`` are the keys of the coefficients that are estimated; ``std`` the standard errors by column key.
    """

    sensor: Sensor
    free: frozenset[Key]
    trials: tuple[Trial, ...]
    states: dict[str, LogState]
    noise: Noise
    log_likelihood: float = -np.inf
    std: Mapping[Key, float] = field(default_factory=dict)

    def linearise(self, candidates: Iterable[str] = (), extra: Iterable = ()) -> list[Linear]:
        """All trials with columns for the free coefficients, the logs' own, and effects ``candidates`` put in at their identity."""
        sensor, wanted = self.sensor, self.free
        for name in candidates:
            sensor = sensor if name in sensor.values else sensor.with_values(name)
            wanted |= slot_keys(sensor, name)
        return [linearise(sensor, t, self.states[t.name], wanted, extra) for t in self.trials]

    def residuals(self) -> list[Linear]:
        """All trials' residuals in their band, without columns."""
        return [bare(t, in_band(t, residual(self.sensor, t, self.states[t.name]))) for t in self.trials]

    def with_noise(self) -> Fit:
        """The same model with the noise fitted to its present residual."""
        return replace(self, noise=fit_noise(self.trials, self.residuals()))


def bare(trial: Trial, r: np.ndarray) -> Linear:
    """A residual (m, 3) of a trial, in its band, with no columns beside it."""
    return Linear(band_time(trial), band_segments(trial), r, {i: [] for i in trial.axes},
                  {i: np.zeros((len(r), 0)) for i in trial.axes})


def fit_noise(trials: tuple[Trial, ...], residuals: list[Linear]) -> Noise:
    """Noise model of each axis, one for all logs: the whitening follows what the reference is."""
    derived = any(t.reference in ("attitude", "heading") for t in trials)
    made = {}
    for i in sorted({i for t in trials for i in t.axes}):
        parts = [(one.residual[:, i], one.time, one.segments) for one in residuals if i in one.keys]
        made[i] = (Autoregressive if derived else RandomWalk).fit(parts)
    return made


def initial_state(sensor: Sensor, trial: Trial) -> LogState:
    """Mounting by the rotation that turns the reference into the measurement, bias as the mean of what is left."""
    rotation = np.eye(3)
    if trial.free_rotation:
        x, y = (in_band(trial, v) for v in (trial.u[:, OWN[trial.kind]], trial.y))
        # Turns whose size the two sides tell apart (a clipped sensor, a bad reference) would bend the estimate.
        fast = (np.linalg.norm(x, axis=1) > 0.05) & (np.abs(np.linalg.norm(x, axis=1) - np.linalg.norm(y, axis=1))
                                                     < 0.2 * np.linalg.norm(x, axis=1))
        if fast.sum() > 10:
            rotation = Rotation.align_vectors(y[fast], x[fast])[0].as_matrix()
    rest = in_band(trial, residual(sensor, trial, LogState(np.zeros(3), rotation)))
    return LogState(np.median(rest, axis=0) if len(rest) else np.zeros(3), rotation)


def begin(sensor: Sensor, free: Iterable[Key], trials: Iterable[Trial]) -> Fit:
    """A model before its first fit."""
    trials = tuple(trials)
    states = {t.name: initial_state(sensor, t) for t in trials}
    return Fit(sensor, frozenset(free), trials, states, {}).with_noise()


def fit(start: Fit, rounds: int = 3, steps: int = 6) -> Fit:
    """Maximum likelihood of the free coefficients and the logs' own, whitening fitted anew in each round."""
    for _ in range(rounds):
        before = start.sensor.p
        start = gauss_newton(start, steps).with_noise()
        if np.allclose(before, start.sensor.p, rtol=1e-4, atol=1e-9):
            break
    start = without_attenuation(start)
    normal = normal_equations(start.linearise(), start.noise)
    variance = variances(normal.gram)
    # A coefficient that was set by other means than regression keeps the standard error it came with.
    std = {**start.std, **{k: float(np.sqrt(variance[i])) for i, k in enumerate(normal.keys)}}
    return replace(start, log_likelihood=normal.log_likelihood, std=std)


def gauss_newton(start: Fit, steps: int) -> Fit:
    """Least squares of the whitened residual, each step halved until it lowers it."""
    normal = normal_equations(start.linearise(), start.noise)
    for _ in range(steps):
        change = solve(normal.gram, normal.score)
        if float(change @ normal.score) < 1e-3:
            break
        moved = next((m for m in (_step(start, normal.keys, change / 2 ** k) for k in range(8)) if power(m) < normal.power), None)
        if moved is None:
            break
        start, normal = moved, normal_equations(moved.linearise(), moved.noise)
    return start


def without_attenuation(fitted: Fit) -> Fit:
    """Take out the bias that noise of a derived reference puts into coefficients (errors in variables).

    With an error e on the input, residual and regressor hold -e and (d column/dx) e: their product has a mean, which
    pulls a scale factor down.  In whitened rows the residual has unit variance, so the sum of the products is the number
    of rows times the mean of d column/dx times the reference's share of that variance (Fuller 1987, section 1.2).
    """
    if all(t.band_hz is None for t in fitted.trials):
        return fitted
    normal = normal_equations(fitted.linearise(), fitted.noise)
    pull = np.zeros(len(normal.keys))
    rest = tail(fitted.sensor)
    response = tail_of(rest.kind, tuple(rest.values))
    shares = _reference_shares(fitted)
    for t in fitted.trials:
        bend = response.mean_bend(reference_input(t, fitted.states[t.name]), rest.p, t.h)
        rows = len(band_time(t))
        for e, (axis, slot) in enumerate(zip(response.axis, response.slot, strict=True)):
            key = slot_key(rest.slots[slot])
            if key in normal.position and int(axis) in t.axes:
                pull[normal.position[key]] += rows * bend[e] * shares[int(axis)]
    return _step(fitted, normal.keys, solve(normal.gram, pull)).with_noise()


def own_noise(fitted: Fit) -> dict[int, RandomWalk]:
    """The sensor's own noise at the sample rate: as declared, else its white part as its quiet stretches show it."""
    values, h = fitted.sensor.values, fitted.trials[0].h
    declared = {n: values[e][n] for e, n in (("angle_random_walk", "N"), ("rate_random_walk", "K")) if e in values and np.any(values[e][n])}
    white = declared["N"] / np.sqrt(h) if "N" in declared else np.mean([rest_noise(t) for t in fitted.trials], axis=0)
    walk = declared.get("K", np.zeros(3))
    return {i: RandomWalk(float(white[i] ** 2), float(walk[i] ** 2)) for i in fitted.noise}


def simulated(noise: dict[int, RandomWalk], time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """White noise and random walk (n, 3) at the sample rate."""
    out = np.zeros((len(time), 3))
    steps = np.sqrt(np.maximum(np.diff(time, prepend=time[:1]), 0.0))
    for i, n in noise.items():
        out[:, i] = np.sqrt(n.r) * rng.standard_normal(len(time)) + np.cumsum(np.sqrt(n.k2) * steps * rng.standard_normal(len(time)))
    return out


def _reference_shares(fitted: Fit, seed: int = 1) -> dict[int, float]:
    """Share of each axis's whitened residual that is not the sensor's own noise: one less what that noise, simulated, leaves."""
    t = max(fitted.trials, key=lambda t: t.count)
    seen = in_band(t, simulated(own_noise(fitted), t.time, np.random.default_rng(seed)))
    return {i: max(0.0, 1.0 - float(np.mean(n.whiten(seen[:, i:i + 1], band_time(t), band_segments(t)) ** 2)))
            for i, n in fitted.noise.items()}


def power(fit: Fit) -> float:
    """Sum of squares of the whitened residual: what ``normal_equations`` calls power, without its columns."""
    return sum(float(np.sum(fit.noise[i].whiten(one.residual[:, i:i + 1], one.time, one.segments) ** 2))
               for one in fit.residuals() for i in one.keys)


def _step(start: Fit, keys: list[Key], change: np.ndarray) -> Fit:
    """Move every coefficient and log state by its share of ``change``."""
    values = {e: {n: np.array(v) for n, v in p.items()} for e, p in start.sensor.values.items()}
    states = dict(start.states)
    for key, d in zip(keys, change, strict=True):
        if key[0] == "slot":
            _, effect, parameter, index = key
            values[effect][parameter][index] = _bounded(CATALOGUE[effect].parameters[parameter], values[effect][parameter][index], d)
        elif key[0] in ("bias", "rotation"):
            states[key[1]] = states[key[1]].moved(key, d)
    return replace(start, sensor=_possible(Sensor(start.sensor.kind, values), start), states=states)


def _possible(sensor: Sensor, start: Fit) -> Sensor:
    """The sensor, with the coefficients of ``start`` where no part of the trials' sample periods can have new ones together."""
    for effect in (e for e in sensor.effects if e.limits):
        alone = Sensor(sensor.kind, {effect.name: sensor.values[effect.name]})
        try:
            for h in {t.h for t in start.trials}:
                alone.check(h, "step")
        except UserError:
            sensor = sensor.with_values(effect.name, **start.sensor.values[effect.name])
    return sensor


def _clipped(definition: Parameter, value: float) -> float:
    least, most = (bound if bound is not None else unbounded for bound, unbounded in ((definition.minimum, -np.inf), (definition.maximum, np.inf)))
    return min(max(value, least), most)


def _bounded(definition: Parameter, value: float, change: float) -> float:
    """A step across a bound goes half way to it: a bound often means "off", where there is no slope to come back by."""
    if definition.minimum is not None and value + change <= definition.minimum:
        return 0.5 * (value + definition.minimum)
    if definition.maximum is not None and value + change >= definition.maximum:
        return 0.5 * (value + definition.maximum)
    return value + change
