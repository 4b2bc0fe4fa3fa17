"""The parameters of the attitude filter's block as its equations use them."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.attitude import marginal
from pyimu.attitude.compensation import Compensation, Noise, coefficient, noise_of
from pyimu.attitude.variables import OWN_PARAMETERS
from pyimu.symbolic import quaternion
from pyimu.symbolic.earth import earth_rate


@dataclass(frozen=True)
class Settings:
    """The block's own parameters by name; ``earth`` (3,) rad/s the Earth's rate in the world frame,
    as far as the part does not add it itself, zero where the ``latitude`` in rad is not ``known``;
    the sensors' coefficients and their noise.
    """

    scalar: dict[str, ca.SX]
    earth: ca.SX
    latitude: ca.SX
    known: ca.SX
    gyro_p: ca.SX
    accel_p: ca.SX
    gyro: Noise
    accel: Noise

    @classmethod
    def of(cls, compensation: Compensation, p) -> Settings:
        part = compensation.part
        scalar = {v.name: p[i] for i, v in enumerate(OWN_PARAMETERS)}
        gyro, accel = ca.vertsplit(
            p[len(OWN_PARAMETERS) :], [0, len(part.gyro.slots), p.numel() - len(OWN_PARAMETERS)]
        )
        known = ca.fabs(scalar["latitude"]) <= np.pi / 2
        latitude = ca.if_else(known, scalar["latitude"], 0)
        # Where the part itself adds the Earth's rate, its compensation has subtracted that share.
        left = 1 - coefficient(part.gyro, gyro, "earth_rate", "k")[0]
        # North and up at a latitude are those at the equator, turned about east: cheaper than a
        # sine and a cosine of the libm.
        earth = quaternion.rotate(
            marginal.turn(ca.vertcat(latitude, 0, 0))[0], earth_rate(ca.SX(0))
        )
        return cls(
            scalar,
            left * known * earth,
            latitude,
            known,
            gyro,
            accel,
            *(
                noise_of(sensor, own, 1 / part.sample_rate)
                for sensor, own in ((part.gyro, gyro), (part.accel, accel))
            ),
        )
