"""The parameters of an attitude filter's block as its equations use them."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.attitude.filter import marginal
from pyimu.attitude.filter.compensation import (
    HORIZON,
    Compensation,
    Horizon,
    TriadNoise,
    noise_of,
    share_added,
)
from pyimu.attitude.filter.variables import OWN_PARAMETERS
from pyimu.block.variables import Variable
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate


@dataclass(frozen=True)
class Settings:
    """The parameters of a filter, taken apart.

    ``scalar`` are the block's own by name. ``earth`` (3,) rad/s is the Earth's rate in the world
    frame, as far as the part does not add it itself; zero where the ``latitude`` in rad is not
    ``known``. ``gyro_p`` and ``accel_p`` are the sensors' coefficients, ``gyro`` and ``accel``
    their noise.
    """

    scalar: dict[str, ca.SX]
    earth: ca.SX
    latitude: ca.SX
    known: ca.SX
    gyro_p: ca.SX
    accel_p: ca.SX
    gyro: TriadNoise
    accel: TriadNoise

    @classmethod
    def of(
        cls,
        compensation: Compensation,
        p,
        names: tuple[Variable, ...] = OWN_PARAMETERS,
        horizon: Horizon = HORIZON,
    ) -> Settings:
        """From the block's parameters ``p`` as a column; ``names`` are the block's own, ``horizon``
        s is that of ``noise_of``.
        """
        part, own = compensation.part, len(names)
        scalar = {v.name: p[i] for i, v in enumerate(names)}
        gyro_p, accel_p = ca.vertsplit(p[own:], [0, len(part.gyro.slots), p.numel() - own])
        known = ca.fabs(scalar["latitude"]) <= np.pi / 2
        latitude = ca.if_else(known, scalar["latitude"], 0)
        # Where the part itself adds the Earth's rate, its compensation has subtracted that share.
        left = 1 - share_added(part.gyro, gyro_p, "earth_rate")
        # North and up at a latitude are those at the equator, turned about east: this takes less
        # than a sine and a cosine of the C library.
        turned = marginal.turn(ca.vertcat(latitude, 0, 0))[0]
        earth = quaternion.rotate(turned, earth_rate(ca.SX(0)))
        period = 1 / part.sample_rate
        gyro = noise_of(part.gyro, gyro_p, period, horizon)
        accel = noise_of(part.accel, accel_p, period, horizon)
        return cls(scalar, left * known * earth, latitude, known, gyro_p, accel_p, gyro, accel)
