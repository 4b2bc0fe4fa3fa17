"""The errors of every invertible effect are undone without growth, at the bounds of what a sensor
can have, in both signs, alone and together.

An hour at 400 Hz has 1.4e6 samples. An inverse that feeds on what it restored is a recursion of the
compensation's memory; an error in that memory grows over the hours where an eigenvalue of the
recursion's slope is beyond 1, by whatever little. So the slope is looked at, at many samples of a
motion, beside a run of seconds that shows the result to be right.
"""

import casadi as ca
import numpy as np
import pytest
from attitude_cases import output, parameters
from catalogue_cases import CASES, excited

from pyimu.attitude import attitude_ukf
from pyimu.attitude.filter.compensation import Compensation
from pyimu.identification.search.belief import FARTHEST, most
from pyimu.model.catalogue import CATALOGUE
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS

H, N = 0.0025, 1500
LOOKED_AT = range(100, N, 70)
ROUNDING = 1e-3
"""By which an eigenvalue of zero that stands n times in a slope may be off, the n-th root of 1e-16,
as may then one of 1 of the counters."""

UNDONE = [
    (name, kind, sign)
    for name, kind in CASES
    for sign in (1, -1)
    if not CATALOGUE[name].stochastic and CATALOGUE[name].invertible
]


def course(rng, size: float, low: float = 0.0) -> np.ndarray:
    """Sines (N, 3) of up to 5 Hz, as large as ``size`` together."""
    t, out = H * np.arange(1, N + 1)[:, None], np.zeros((N, 3))
    for f, phase in zip(rng.uniform(0.1, 5, (6, 3)), rng.uniform(0, 6.3, (6, 3)), strict=True):
        out += size / 6 * np.sin(2 * np.pi * f * t + phase)
    return out + [0, 0, low]


@pytest.fixture(scope="module")
def world():
    rng, t = np.random.default_rng(3), H * np.arange(1, N + 1)
    return {
        "rate": course(rng, 8.0),
        "specific_force": course(rng, 10.0, 9.8),
        "temperature": 25 + 20 * np.sin(t / 3)[:, None],
        "supply": 3.3 + 0.1 * np.sin(t)[:, None],
        "mag": 5e-5 * np.column_stack([np.cos(t), np.sin(t), np.ones(N)]),
    }


def at_bounds(name: str, kind: str, sign: int) -> Sensor:
    """A sensor with one effect, each coefficient as large as any part's or as its bounds let it."""
    sensor, otherwise = Sensor(kind).with_values(name), excited(name, kind)
    p = sensor.p.copy()
    for i, slot in enumerate(sensor.slots):
        d = slot.definition
        if d.form or d.reference:
            continue
        size = most(name, kind, slot.parameter)
        size = FARTHEST * d.known if d.known is not None else size
        p[i] = sign * (size if np.isfinite(size) else abs(otherwise.p[i]))
        p[i] = max(p[i], -np.inf if d.minimum is None else d.minimum)
    return sensor.with_p(p)


def undone(part: Part, world) -> tuple[np.ndarray, ca.Function, np.ndarray]:
    """Rate and force (N, 6) as measured and compensated, the slope of the memory's recursion, and
    the memory at each sample.
    """
    block, compensation = part.block, Compensation(part)
    u = np.tile([v.start for v in block.inputs], (N, 1))
    for i, variable in enumerate(block.inputs):
        signal, _, axis = variable.name.partition("[")
        if signal in world:
            u[:, i] = world[signal][:, int(axis[:-1]) - 1 if axis else 0]
    y, _ = block.run(u, sample_period=H)
    names = ("temperature", *compensation.extra)
    rows = np.hstack([y[:, :6], *[world[n] for n in names]])
    memory, row = ca.SX.sym("m", len(compensation.start)), ca.SX.sym("row", rows.shape[1])
    known, at = {"rate": row[:3], "specific_force": row[3:6]}, 6
    for n in names:
        known[n] = row[at : at + SIGNALS[n].size]
        at += SIGNALS[n].size
    p = [ca.SX(ca.DM(s.p)) for s in (part.gyro, part.accel)]
    after, rate, force, *_ = compensation.apply(memory, known, *p, ca.SX(H))
    step = ca.Function("step", [memory, row], [ca.densify(after), ca.vertcat(rate, force)])
    slope = ca.Function("slope", [memory, row], [ca.densify(ca.jacobian(after, memory))])
    if not len(compensation.start):
        return np.array(step.map(N)(np.zeros((0, N)), rows.T)[1]).T, slope, rows
    memories, x = step.mapaccum(N)(compensation.start, rows.T)
    return np.array(x).T, slope, np.hstack([np.array(memories).T, rows])


def largest_eigenvalue(slope: ca.Function, course: np.ndarray) -> float:
    size = slope.size1_in(0)
    return max(
        np.abs(np.linalg.eigvals(np.array(slope(course[k - 1, :size], course[k, size:])))).max(
            initial=0.0
        )
        for k in LOOKED_AT
    )


def part_with(sensor: Sensor) -> Part:
    return Part("test", 1 / H, **{s.kind: s for s in (Sensor("gyro"), Sensor("accel"), sensor)})


@pytest.mark.parametrize("name, kind, sign", UNDONE)
def test_what_is_called_invertible_is_undone_without_growth(name, kind, sign, world):
    """To a hundredth of the effect, and to rounding where it is not solved in rounds.

    The inverse of a lag of the accelerometer is left to the samples' times.
    """
    part = part_with(at_bounds(name, kind, sign))
    x, slope, course = undone(part, world)
    assert largest_eigenvalue(slope, course) <= 1 + ROUNDING
    truth = np.hstack([world["rate"], world["specific_force"]])
    settled = slice(10, None)
    if CATALOGUE[name].delay is None:
        error = np.abs(x - truth)[settled].max()
        assert error < (0.01 if CATALOGUE[name].grows else 1e-6)


def test_by_the_plain_inverse_it_would_grow():
    """Of y = x + C dx/dt, C with all of its six coefficients at the bound, solved for x with a
    backward difference: its pole is beyond 1 for one of the two signs, which the last test sees.
    """
    c = at_bounds("angular_acceleration", "gyro", 1).values["angular_acceleration"]["c"] / H
    poles = [np.abs(np.linalg.eigvals(np.linalg.solve(np.eye(3) + s * c, s * c))) for s in (1, -1)]
    assert max(p.max() for p in poles) > 1.5


@pytest.mark.long
@pytest.mark.parametrize("sign", [1, -1])
def test_the_whole_chain_is_undone_without_growth(sign, world):
    """All effects that are called invertible at once, the size of a consumer part's each: to a
    hundredth of the largest, that which is solved in rounds.
    """
    sensors = {kind: Sensor(kind) for kind in ("gyro", "accel")}
    for name, kind in {(n, k) for n, k, _ in UNDONE if not CATALOGUE[n].delay}:
        one = at_bounds(name, kind, sign)
        sizes = {n: (q.form or q.reference) for n, q in CATALOGUE[name].parameters.items()}
        values = {n: v if sizes[n] else v / FARTHEST for n, v in one.values[name].items()}
        sensors[kind] = sensors[kind].with_values(name, **values)
    x, slope, course = undone(Part("test", 1 / H, **sensors), world)
    assert largest_eigenvalue(slope, course) <= 1 + ROUNDING
    truth = np.hstack([world["rate"], world["specific_force"]])
    assert np.abs(x - truth)[10:].max() < 0.01


@pytest.mark.parametrize("sign", [1, -1])
def test_nothing_grows_beside_missing_rows(sign, world):
    """A run over rows of which one in fifty is missing ends where one over all rows does, to the
    turn between two samples.
    """
    part = part_with(at_bounds("angular_acceleration", "gyro", sign))
    block = attitude_ukf(part)
    y, _ = part.block.run(np.hstack([world["rate"], world["specific_force"], world["temperature"]]))
    u = np.tile([v.start for v in block.inputs], (N, 1))
    u[:, :6] = y[:, :6]
    p = parameters(block, lost_rate_std=1.0, std0=np.array([1e-3] * 3 + [1e-6] * 3))
    whole, _ = block.run(u, p=p, sample_period=H)
    u[::50, :6] = np.nan
    holed, state = block.run(u, p=p, sample_period=H)
    assert np.isfinite(state).all()
    apart = np.abs(output(block, whole, "q") - output(block, holed, "q")).max()
    assert apart < np.abs(world["rate"]).max() * H * len(u[::50]) ** 0.5
