"""The data that the functions of an attitude filter's step exchange, and their sizes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import casadi as ca

from pyimu.attitude.filter import late_heading
from pyimu.attitude.filter.compensation import Compensation
from pyimu.attitude.filter.field import FIELD
from pyimu.attitude.filter.memory import ESTIMATE, MOTION, WORKING, memory_sizes
from pyimu.attitude.filter.tolerances import of_motion, start_values
from pyimu.attitude.filter.variables import INPUTS, OWN_PARAMETERS
from pyimu.block.variables import Variable

GRAVITY = 21
"""Numbers of a ``GravityMeasurement``."""


@dataclass(frozen=True)
class GravityMeasurement:
    """A force that stands for gravity, as the update by gravity takes it.

    ``force`` (3,) m/s^2 in body axes; ``variance`` (3,) (m/s^2)^2 by which it is weighed;
    ``sample_variance`` (3,), that of one sample, by which the innovation is normalised;
    ``magnitude`` of gravity in m/s^2; the sample ``period`` in s. Where the velocity is measured
    instead: ``motion`` (2,) (m/s)^2 is its variance across and along the vertical, ``lasting`` how
    many samples a value of it lasts, ``coloured`` (m/s)^2 what a sample's variance has in it
    because the acceleration lasts. ``plausible`` says whether the force may be gravity,
    ``contradicts`` whether it then contradicts the tilt. ``false_rate`` rad/s and
    ``upright`` (3,) are those of ``unscented.doubt``.
    """

    force: ca.SX
    variance: ca.SX
    sample_variance: ca.SX
    magnitude: ca.SX
    period: ca.SX
    motion: ca.SX
    lasting: ca.SX
    coloured: ca.SX
    plausible: ca.SX
    contradicts: ca.SX
    false_rate: ca.SX
    upright: ca.SX

    def pack(self) -> ca.SX:
        return ca.densify(ca.vertcat(*vars(self).values()))

    @classmethod
    def unpack(cls, column) -> GravityMeasurement:
        ends = [0, 3, 6, 9, 10, 11, 13, 14, 15, 16, 17, 18, 21]
        return cls(*ca.vertsplit(column, ends))


CALIBRATED = 5
"""More in ``Flags.which`` where the gyro's scale factors have no part in any error."""

EVERY = 8
"""Of ``Flags.which``: any of the updates."""

FLAGS = 19
"""Numbers of ``Flags``."""


@dataclass(frozen=True)
class Flags:
    """What the prediction says to the updates.

    ``which`` updates are needed, 0: none, 1: the velocity's, and with it 2: a zero rate's, 3: the
    magnetic field's, 4: both; 5 to 7: as 0 to 2, ``CALIBRATED``; ``EVERY``: any. Whether
    ``gravity`` corrects, whether the ``velocity`` does, whether the body is ``quasi_static``,
    whether its attitude may be ``lost``,
    whether a ``heading`` and a zero rate (``stationary`` by its input, ``resting`` as found)
    correct, whether there is ``doubt`` of the rest that was found, the variance (rad/s)^2 that
    ``sway`` then adds to that of a sample, whether an input was ``missing``, whether a magnetometer
    has been seen (``field``), which share of the measured turn is one (``moving``). Whether a
    ``speed`` corrects, whether the body is ``driven``, and whether its velocity begins ``anew``.
    ``faults`` are the other bits of the status; ``constant`` rad^2 is the variance of the tilt by a
    constant error of the accelerometer; ``vertical_noise`` is that of ``Memory``.
    """

    which: ca.SX
    gravity: ca.SX
    velocity: ca.SX
    quasi_static: ca.SX
    lost: ca.SX
    heading: ca.SX
    stationary: ca.SX
    resting: ca.SX
    doubt: ca.SX
    sway: ca.SX
    missing: ca.SX
    faults: ca.SX
    speed: ca.SX
    driven: ca.SX
    anew: ca.SX
    field: ca.SX
    moving: ca.SX
    constant: ca.SX
    vertical_noise: ca.SX

    @property
    def rest(self):
        """``resting``, ``doubt`` and ``sway`` (3,), as the update by a zero rate takes them."""
        return ca.vertcat(self.resting, self.doubt, self.sway)

    @property
    def at_rest(self):
        """Whether the body is at rest without doubt, 0 or 1."""
        return self.stationary + self.resting * (1 - self.doubt) > 0

    def with_speed(self, speed, driven, anew) -> Flags:
        """The flags of a body that may be driven: it is then none that stays in its place."""
        velocity = self.velocity * (1 - driven)
        changed, asked = driven + anew + speed > 0, (self.which > 1) + anew + speed > 0
        which = self.which + changed * (asked * EVERY - self.which)
        return replace(self, which=which, velocity=velocity, speed=speed, driven=driven, anew=anew)

    def pack(self) -> ca.SX:
        return ca.densify(ca.vertcat(*vars(self).values()))

    @classmethod
    def unpack(cls, column) -> Flags:
        *flags, _ = ca.vertsplit(column)
        # The last one by itself keeps the generated C of the fast filter as it was.
        return cls(*flags, column[-1])


@dataclass(frozen=True)
class Layout:
    """How many numbers each argument of the step's functions has, for the sensors of a part."""

    compensation: Compensation

    @cached_property
    def inputs(self) -> tuple[Variable, ...]:
        return (*INPUTS, *self.compensation.extra_inputs)

    @cached_property
    def parameters(self) -> tuple[Variable, ...]:
        part = self.compensation.part
        start = start_values(part)
        start |= of_motion(start.get("rate_noise", 0.0))
        own = (replace(v, start=start.get(v.name, v.start)) for v in OWN_PARAMETERS)
        return (*own, *part.gyro.variables, *part.accel.variables)

    @cached_property
    def motion(self) -> int:
        """Where in the state what is known of the motion begins, with which the memory ends."""
        return self.rings - MOTION

    @cached_property
    def rings(self) -> int:
        """Where in the state the two rings of past yaws and past ``vertical_noise`` begin."""
        return ESTIMATE + sum(memory_sizes(self.compensation))

    @cached_property
    def field(self) -> int:
        """Where in the state the memory of the magnetic field begins."""
        return self.rings + 2 * late_heading.SLOTS

    @cached_property
    def sizes(self) -> dict[str, int]:
        """The size of each argument by name.

        The ``estimate`` and the ``memory`` that follows it in the state ``s``, with the ``motion``
        that this ends with; the working estimate ``x``, the inputs ``u``, the parameters ``p``, the
        sample period ``h``; the compensated ``rate``, the force that stands for ``gravity``, the
        ``flags``, ``vertical_noise``.
        """
        return {
            "estimate": ESTIMATE,
            "memory": self.rings - ESTIMATE,
            "motion": MOTION,
            "s": self.field + FIELD,
            "x": WORKING,
            "u": len(self.inputs),
            "p": len(self.parameters),
            "h": 1,
            "rate": 3,
            "gravity": GRAVITY,
            "flags": FLAGS,
            "vertical_noise": 1,
        }

    def symbols(self, kind: type[ca.SX | ca.MX], names: str) -> list:
        """A symbol for each of ``names``, which spaces separate."""
        return [kind.sym(name, self.sizes[name]) for name in names.split()]
