"""What the samples show of the body's motion, gathered over a short time.

How much a body moves, and how it is pushed, is followed over seconds
(``pyimu.attitude.filter.velocity``, ``slow_motion``, ``long_push``). A fast log has hundreds of
samples in such a time: what they show is added up, and looked at once in ``LOOK`` of the velocity's
correlation time. Of what changes over that time or longer, the mean has all but some thousandths,
and a vibration averages out as it does in the samples. A log with longer periods is looked at with
each sample.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import casadi as ca

from pyimu.symbolic.linear import reciprocal

LOOK = 0.01
"""Correlation times of the velocity from one look at its samples to the next."""

TINY = 1e-12
"""s; stands for no time where it is divided by."""


@dataclass(frozen=True)
class Gathered:
    """Integrals over a ``span`` in s, and over that of the forces, ``pushed_for`` s.

    ``level`` (2,) m is that of the velocity east and north, ``squares`` (2,) (m/s)^2 s that of what
    its squares across and along the vertical have beyond the filter's own variance, which is
    ``own`` (m/s)^2 s across. ``force`` (2,) m/s is that of the force east and north.
    """

    level: ca.SX
    squares: ca.SX
    own: ca.SX
    span: ca.SX
    force: ca.SX
    pushed_for: ca.SX

    @classmethod
    def start(cls) -> Gathered:
        return cls(*(ca.SX.zeros(size) for size in SIZES))

    def pack(self) -> tuple:
        return tuple(getattr(self, f.name) for f in fields(self))

    def with_sample(self, level, squares, own, force, used, pushes, goes_on, may, h) -> Gathered:
        """The same with one more sample, which stands for ``h`` s.

        ``used`` and ``pushes``, 0 or 1, say whether its velocity and its force count; where the
        motion does not go on (``goes_on``), or the body may not be pushed (``may``), nothing is
        left of what was gathered of it.
        """
        one, other = used * h, pushes * h
        return Gathered(
            goes_on * self.level + one * level,
            goes_on * self.squares + one * squares,
            goes_on * self.own + one * own,
            goes_on * self.span + one,
            may * self.force + other * force,
            may * self.pushed_for + other,
        )

    def is_due(self, time, h):
        """Whether it is to be looked at before the next sample, of period ``h`` s, 0 or 1; ``time``
        s is the correlation time of the velocity.
        """
        span = ca.fmax(self.span, self.pushed_for)
        return (span + h / 2 >= LOOK * time) * (span > 0)

    def means(self) -> tuple:
        """The means of ``level``, ``squares``, ``own`` and ``force``; zero where there is none."""
        share, other = (reciprocal(t + TINY) for t in (self.span, self.pushed_for))
        return self.level * share, self.squares * share, self.own * share, self.force * other


SIZES = (2, 2, 1, 1, 2, 1)
"""Of what ``Gathered.pack`` gives."""
