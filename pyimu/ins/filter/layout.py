"""What the filter of a part estimates: error state and nominal state, and how they are packed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import casadi as ca
import numpy as np

from pyimu.attitude.filter.compensation import Compensation
from pyimu.block.variables import Variable
from pyimu.ins.filter import rest_window
from pyimu.ins.filter.rest_hidden import Hidden
from pyimu.ins.filter.rest_judged import Judged
from pyimu.ins.filter.rest_level import Level
from pyimu.ins.filter.variables import INPUTS, LASTING, OWN_PARAMETERS, WHEELS
from pyimu.model.part import Part, input_variables
from pyimu.model.signals import SIGNALS
from pyimu.symbolic.linear import pack, unpack

TURN, VELOCITY, POSITION, GYRO_BIAS, RESTING = (slice(i, i + 3) for i in range(0, 15, 3))
"""Where the error state has attitude, velocity, position, gyro bias and the force of a rest, all in
world axes."""

HEADING, UP = TURN.stop - 1, RESTING.stop - 1
"""Where it has the attitude about the vertical, and the resting force upwards."""

PLANE = slice(POSITION.start, POSITION.stop - 1)
"""Where it has the position to the east and to the north."""

BASE = 15
"""Errors that every filter has."""

UNDONE = {"scale_factor": "s", "misalignment": "m"}
"""Effects whose errors are states where the part leaves them open, and their parameters."""

OPEN = 0.03
"""Standard deviation of a scale factor or a misalignment of which the part says "estimate" and no
tolerance: the 3 % of a consumer part (``mpu6050``)."""


@dataclass(frozen=True)
class Gain:
    """One element of a triad's matrix M that is a state: measured = (1 + M) true + bias.

    ``sensor`` is gyro or accel, ``row`` and ``column`` are the element's, ``std`` is its standard
    deviation before the first sample.
    """

    sensor: str
    row: int
    column: int
    std: float


def gains_of(part: Part) -> tuple[Gain, ...]:
    """The elements that a part leaves open, by its tolerances or because it says "estimate"."""
    found = []
    for kind in ("gyro", "accel"):
        std = np.zeros((3, 3))
        for effect, parameter in UNDONE.items():
            own = open_std(part, (kind, effect, parameter), OPEN)
            std += np.diag(own) if effect == "scale_factor" else own.reshape(3, 3)
        found += [
            Gain(kind, i, j, float(std[i, j])) for i in range(3) for j in range(3) if std[i, j] > 0
        ]
    return tuple(found)


def open_std(part: Part, key: tuple[str, str, str], otherwise: float) -> np.ndarray:
    """Standard deviations of a coefficient that is left open, flat; zeros where it is not."""
    for t in part.tolerances:
        if t.key == key:
            return t.std.ravel()
    size = 9 if key[1] == "misalignment" else 3
    if key not in part.estimate:
        return np.zeros(size)
    return otherwise * (1 - np.eye(3).ravel() if size == 9 else np.ones(3))


@dataclass(frozen=True)
class State:
    """An estimate: nominal values, and the covariance of their error.

    ``q`` (4,) body to east-north-up; ``velocity`` and ``position`` (3,); ``gyro_bias`` (3,);
    ``resting`` (3,) m/s^2 is what the accelerometer would show at rest in this attitude, its bias
    and gravity; ``gains`` (g,) in the order of ``Layout.gains``; ``mounting`` (2,) rad, by which
    the vehicle's axes are pitched and turned against the body's; ``centre`` (3,) m is the place
    about which the heading's error turns the position: where the last measured position was, else
    the start; ``wheels`` (5,) are the error of the
    measured speed's scale, 1, by how many s it is late, how far the point that does not slip lies
    from where it was told along and across the body, m, and the angle by which the vehicle crabs,
    rad; ``lasting`` (3,) m is the error of measured positions that lasts; ``covariance`` (n, n).
    """

    q: ca.SX
    velocity: ca.SX
    position: ca.SX
    gyro_bias: ca.SX
    resting: ca.SX
    gains: ca.SX
    mounting: ca.SX
    wheels: ca.SX
    lasting: ca.SX
    centre: ca.SX
    covariance: ca.SX


@dataclass(frozen=True)
class Layout:
    """The sizes of a filter for a part; ``nhc`` says whether it can take a vehicle's constraint,
    ``detects`` whether it finds rests by itself.

    ``mounting_std`` rad is how well the vehicle's axes are known in those of the body; where
    errors of positions are ``lasting``, that part of them is estimated, and where the body has
    ``wheels``, what these measure and where they are.
    """

    part: Part
    nhc: bool = False
    detects: bool = False
    mounting_std: float = 0.02
    lasting: bool = False
    wheels: bool = False

    @property
    def structure(self) -> tuple:
        """All that the equations depend on: the coefficients of the effects are parameters."""
        flags = self.nhc, self.detects, self.mounting_std, self.lasting, self.wheels
        return self.compensation.structure, self.gains, flags

    @cached_property
    def compensation(self) -> Compensation:
        return Compensation(self.part, now=False)

    @cached_property
    def gains(self) -> tuple[Gain, ...]:
        return gains_of(self.part)

    @property
    def errors(self) -> int:
        """Numbers of the error state."""
        return self.of_wheels.stop + 3 * self.lasting

    @property
    def mounting(self) -> slice:
        """Where the error state has the mounting of the vehicle's axes; empty without them."""
        first = BASE + len(self.gains)
        return slice(first, first + 2 * self.nhc)

    @property
    def of_wheels(self) -> slice:
        """Where the error state has that of ``State.wheels``; empty without it."""
        return slice(self.mounting.stop, self.mounting.stop + 5 * self.wheels)

    @property
    def crabs(self) -> int:
        """Where the error state has the angle by which the vehicle crabs, the last of these."""
        return self.of_wheels.stop - 1

    @property
    def of_positions(self) -> slice:
        """Where the error state has that of ``State.lasting``; empty without it."""
        return slice(self.of_wheels.stop, self.errors)

    @property
    def nominal(self) -> int:
        """Numbers of an estimate but for its covariance: a quaternion has one more than its error,
        and the centre has none.
        """
        return self.errors + 4

    @property
    def centre(self) -> slice:
        """Where the packed state has ``State.centre``."""
        return slice(self.nominal - 3, self.nominal)

    @cached_property
    def inputs(self) -> tuple[Variable, ...]:
        return (*INPUTS, *input_variables(self.compensation.extra))

    @property
    def own_parameters(self) -> tuple[Variable, ...]:
        """The filter's own, before the coefficients of the part's sensors."""
        more = (*(WHEELS if self.wheels else ()), *(LASTING if self.lasting else ()))
        return (*OWN_PARAMETERS, *more)

    @cached_property
    def parameters(self) -> tuple[Variable, ...]:
        start = start_values(self.part)
        own = [replace(v, start=start.get(v.name, v.start)) for v in self.own_parameters]
        if self.nhc:
            own = [replace(v, start=1.0) if v.name == "nhc" else v for v in own]
        return (*own, *self.part.gyro.variables, *self.part.accel.variables)

    @property
    def packed(self) -> int:
        """Numbers of a packed ``State``."""
        return self.nominal + self.errors * (self.errors + 1) // 2

    @property
    def held(self) -> int:
        """Numbers of a row as it was measured."""
        return 7 + sum(SIGNALS[n].size for n in self.compensation.extra)

    @property
    def memory_sizes(self) -> tuple[int, ...]:
        """Of the ``Memory``, in the order of its fields."""
        window = rest_window.SIZE * self.detects
        of_rests = [kept.size() * self.detects for kept in (Level, Judged, Hidden)]
        pushed = 3 * self.wheels
        kept = len(self.compensation.start), window, *of_rests
        return (self.held, 3, 3, 3, 3, pushed, 1, 3, 3, 1, *kept)

    @property
    def begun(self) -> int:
        """Where the state has ``Memory.begun``."""
        return self.packed + sum(self.memory_sizes[:-6])

    @property
    def state(self) -> int:
        return self.packed + sum(self.memory_sizes)

    def pack(self, x: State) -> ca.SX:
        values = tuple(vars(x).values())
        return ca.densify(ca.vertcat(*values[:-1], pack(x.covariance)))

    def unpack(self, column) -> State:
        more = 2 * self.nhc, 5 * self.wheels, 3 * self.lasting
        ends = np.cumsum([0, 4, 3, 3, 3, 3, len(self.gains), *more, 3]).tolist()
        nominal = ca.vertsplit(column[: self.nominal], ends)
        return State(*nominal, unpack(column[self.nominal : self.packed], self.errors))

    def matrix(self, gains, kind: str):
        """The matrix M (3, 3) of a triad, from the estimated ``gains``."""
        m = ca.SX(3, 3)
        for i, gain in enumerate(self.gains):
            if gain.sensor == kind:
                m[gain.row, gain.column] = gains[i]
        return m

    def slopes(self, kind: str, true) -> ca.SX:
        """d(M true) / d(gains) (3, g) of a triad."""
        out = ca.SX(3, len(self.gains))
        for i, gain in enumerate(self.gains):
            if gain.sensor == kind:
                out[gain.row, i] = true[gain.column]
        return out


@dataclass(frozen=True)
class Memory:
    """What is kept from sample to sample beside the estimate.

    ``held`` is the last good row; ``rate`` and ``force`` (3,) are its compensated ones;
    ``mean_rate`` (3,) in body axes that of the last tenths of a second; ``counted`` (3,) in world
    axes the velocity that counts (``weight``); ``mean_force`` (3,) in body axes that of the time by
    which a measured speed may be late, empty without wheels; ``unturned`` whether it did not turn;
    ``gyro_lost`` and ``accel_lost`` (3,) s, for how long an axis was lost; ``begun`` whether there
    was any row; ``sensors`` is the compensation's own; ``window``, ``level``,
    ``judged`` and ``hidden`` are those of ``rest_window`` to ``rest_hidden``, empty where the
    filter does not look for rests.
    """

    held: ca.SX
    rate: ca.SX
    force: ca.SX
    mean_rate: ca.SX
    counted: ca.SX
    mean_force: ca.SX
    unturned: ca.SX
    gyro_lost: ca.SX
    accel_lost: ca.SX
    begun: ca.SX
    sensors: ca.SX
    window: ca.SX
    level: ca.SX
    judged: ca.SX
    hidden: ca.SX

    def pack(self) -> ca.SX:
        return ca.densify(ca.vertcat(*vars(self).values()))

    @classmethod
    def unpack(cls, column, layout: Layout) -> Memory:
        return cls(*ca.vertsplit(column, np.cumsum([0, *layout.memory_sizes]).tolist()))


BIAS = {"gyro_bias_std0": "gyro", "accel_bias_std0": "accel"}


def start_values(part: Part) -> Mapping[str, float]:
    """Start values of parameters that the part knows: how far its biases may lie from the nominal.

    Where scale factors and misalignments are no states, what gravity makes of them is a bias.
    """
    found, unasked = {}, replace(part, estimate=frozenset())
    for name, kind in BIAS.items():
        key = (kind, "turn_on_bias", "b0")
        std = open_std(unasked, key, 0.0)
        found |= {f"{name}[{i + 1}]": float(v) for i, v in enumerate(std) if v > 0}
    return found
