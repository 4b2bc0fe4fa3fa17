"""What rests may hide of a body that has been seen to creep, until now."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import casadi as ca

from pyimu.ins.filter.kept import Kept
from pyimu.ins.shoves import CREEP

HIDDEN = 0.7
"""Of the slowest creep that was seen: standard deviation, along each axis, of the speed that a rest
may hide. Chosen: by what came before alone more creeps are missed, and one whose end is taken for a
beginning, than beside what comes after (0.4 in ``pyimu.ins.creeps``)."""


@dataclass(frozen=True)
class Hidden(Kept):
    """What is kept of it: the square of the slowest ``creep`` m^2/s^2 that was seen, 0 without; for
    how long the ``present`` rest lasts, s, and the sum of the ``squares`` of those before it, s^2;
    and the variance of the position that was ``admitted`` for them, m^2.
    """

    SIZES: ClassVar = (1, 1, 1, 1)

    creep: ca.SX
    present: ca.SX
    squares: ca.SX
    admitted: ca.SX

    def after(self, fastest, found, measured, h) -> tuple[Hidden, ca.SX]:
        """What is kept after a sample, and by how much the variance of the position grows in it.

        ``fastest`` m^2/s^2 is the square of the speed of a drive that ends, 0 without; ``found``
        says whether the body is at a rest that was found, and ``measured`` whether a position or
        a speed is, 0 or 1: beside one nothing is hidden. The rests before the first creep that was
        seen are of a body that creeps, too.
        """
        slower = (fastest > 0) * (fastest < CREEP**2)
        slower = slower * ca.fmax(self.creep <= 0, fastest < self.creep)
        creep, alone = ca.if_else(slower, fastest, self.creep), 1 - measured
        present = alone * found * (self.present + h)
        squares = alone * (self.squares + (1 - found) * self.present**2)
        before = alone * self.admitted
        admitted = ca.fmax(before, HIDDEN**2 * creep * (squares + present**2))
        return Hidden(creep, present, squares, admitted), admitted - before
