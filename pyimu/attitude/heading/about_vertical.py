"""What of a part one gyro about the vertical shows, and can undo."""

from __future__ import annotations

import casadi as ca

from pyimu.attitude.filter.compensation import NOT_UNDONE, left_in
from pyimu.attitude.filter.timing import timed
from pyimu.block.plain import plain_function
from pyimu.model.effect import Effect
from pyimu.model.kinds import OWN
from pyimu.model.part import Part
from pyimu.model.sensor import Sensor
from pyimu.model.signals import SIGNALS

KNOWN = ("rate", "specific_force", "temperature")
"""Signals on which the errors of the gyro about the vertical may depend and be undone."""


def about_the_vertical(part: Part) -> Part:
    """The part with those of its gyro's effects that one axis can undo, and its noise.

    Left out are effects by which the other axes leak into it, that make it late, or that depend on
    what the unit is not told. Of the accelerometer, which only tells rest from motion, the noise
    stays.
    """
    late = {e.name for e in timed(part.gyro)}
    drop = [e.name for e in part.gyro.effects if e.name in late or not _alone(part.gyro, e)]
    loud = [e.name for e in part.accel.effects if e.law is None]
    return part.with_sensor(part.gyro.without(*drop)).with_sensor(part.accel.without(*loud))


def _alone(gyro: Sensor, e: Effect) -> bool:
    """Whether an effect on z needs no other axis, and no signal but ``KNOWN`` and the time."""
    told = {*KNOWN, "time"}
    for name in e.signals(gyro.kind):
        if not ({name} | {*SIGNALS[name].of}) <= told or name.endswith("_rate"):
            return False
    one = Sensor(gyro.kind, {e.name: dict(gyro.values[e.name])})
    own, z = OWN[gyro.kind], 2
    rows, columns = one.step.jac_sparsity(1, 1).get_triplet()
    pairs = set(zip(rows, columns, strict=True))
    return not any((z, own.start + axis) in pairs for axis in (0, 1))


def left(part: Part) -> str:
    """Which of the gyro's errors stay in, for the description."""
    kept = {e.name for e in about_the_vertical(part).gyro.effects}
    gone = [e.name for e in part.gyro.effects if e.name not in kept]
    inside = [t.removesuffix(" of the gyro") for t in left_in(part) if t.endswith("gyro")]
    names = list(dict.fromkeys([*gone, *inside]))
    return f"; {NOT_UNDONE}: {', '.join(names)}" if names else ""


def without_idle(step: ca.Function, initial: ca.Function, every: tuple) -> tuple:
    """The functions of a block with the parameters ``every``, and those on which something of them
    depends: the ones of the gyro's other axes do nothing.
    """
    places = (step, 2), (initial, 1)
    used = sorted(
        {c for f, at in places for y in (0, 1) for c in f.jac_sparsity(y, at).get_triplet()[1]}
    )
    p, full = ca.SX.sym("p", len(used)), ca.SX(ca.DM([v.start for v in every]))
    full[used] = p
    found = []
    for f, at in places:
        given = [p if i == at else ca.SX.sym(f.name_in(i), f.size_in(i)) for i in range(f.n_in())]
        y = f(*[full if i == at else a for i, a in enumerate(given)])
        found.append(plain_function(f.name(), given, y, f.name_in(), f.name_out()))
    return *found, tuple(every[i] for i in used)
