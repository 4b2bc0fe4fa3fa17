"""What a speed that came up in a rest, before it was seen, does to the estimate.

The zero velocities of that time have taken the velocity away, and have taken the push for a change
of the resting force. Both are undone. With strong zero velocities what is learned of the resting
force r is the mean of the measured one, whose noise has the density N^2: a push that gains g has
moved every error x by P_xr / N^2 g, and each second has taken P_xr P_rx / N^2 from their
covariance.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from pyimu.attitude.filter.settings import Settings
from pyimu.ins.filter.layout import POSITION, RESTING, VELOCITY, Layout, State
from pyimu.ins.filter.rest_hidden import HIDDEN
from pyimu.ins.filter.rest_judged import ANEW, SHOVED, Left
from pyimu.ins.shoves import CREEP
from pyimu.symbolic import quaternion


def corrected(
    layout: Layout, x: State, transition, left: Left, settings: Settings
) -> tuple[ca.SX, State, ca.SX]:
    """The error (n,) that is to be added to the estimate, the estimate with its covariance, and the
    transition (n, n) that led to it, for the kinds ``ANEW`` and ``SHOVED``.

    Where creeps are so slow that their beginnings are missed, a shove may be the end of one: then
    the body rests now, and what is known of the resting force is wrong by that gain as well.
    """
    shoved = left.kind > (ANEW + SHOVED) / 2
    axes = quaternion.to_matrix(x.q)
    known = ca.mmax(ca.diag(x.covariance[RESTING, RESTING]))
    noise = ca.sum1(settings.accel.white**2) / 3
    # no more than all that these seconds can have told
    learned = x.covariance[:, RESTING] / ca.fmax(noise, ca.fmax(left.seconds * known, 1e-30))
    taken = left.gain - x.velocity
    change = -shoved * learned @ taken
    change[VELOCITY] = shoved * left.gain - x.velocity
    change[POSITION] = shoved * taken * left.seconds / 2
    missed = shoved * HIDDEN**2 * ca.fmin(left.gain**2, CREEP**2)
    settled = (1 - shoved) * (left.gain**2 + x.velocity**2)
    more = learned @ x.covariance[RESTING, :] * left.seconds
    more[VELOCITY, :] = 0
    more[:, VELOCITY] = 0
    keep = ca.SX.eye(layout.errors)
    keep[VELOCITY, VELOCITY] = 0
    p = keep @ x.covariance @ keep + more
    p[VELOCITY, VELOCITY] = ca.diag(
        ca.diag(axes @ ca.diag(left.variance) @ axes.T) + missed + settled
    )
    p[RESTING, RESTING] = p[RESTING, RESTING] + ca.diag(missed) / ca.fmax(left.age, 1) ** 2
    p[POSITION, POSITION] = p[POSITION, POSITION] + ca.diag((taken * left.seconds) ** 2 / 16)
    return change, replace(x, covariance=p), keep @ transition
