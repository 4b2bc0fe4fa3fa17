"""Process noise of the attitude error and the gyro bias over one sample period."""

from __future__ import annotations

import casadi as ca


def process_noise(n, k, h):
    """Covariance (6, 6) that a period ``h`` s adds to the attitude error (rad, body axes) and the gyro bias (rad/s).

    ``n`` (3,) rad/sqrt(s) is each axis's angle random walk, ``k`` (3,) rad/s/sqrt(s) its rate random walk::

        [ (N^2 h + K^2 h^3 / 3) I    -K^2 h^2 / 2 I ]
        [ -K^2 h^2 / 2 I              K^2 h I       ]

    Exact for a body that does not turn during ``h`` (Crassidis and Markley 2003, eq. 27; Hidalgo 2012, eq. of Q_k, where
    the print has lost the minus signs: the bias is subtracted from the rate, so its growth turns the attitude back).
    """
    n2, k2 = n * n, k * k
    attitude, cross, bias = n2 * h + k2 * h ** 3 / 3, -k2 * h ** 2 / 2, k2 * h
    return ca.vertcat(ca.horzcat(ca.diag(attitude), ca.diag(cross)), ca.horzcat(ca.diag(cross), ca.diag(bias)))
