"""The Earth's rate, and the rate that a filter makes of a measured one."""

from __future__ import annotations

import casadi as ca
import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.derivations.cases import rounds, vectors
from pyimu.derivations.independent import largest
from pyimu.derivations.kinematics.quaternions import ROUNDING
from pyimu.derivations.model import Check, Derivation, Equation, Table, call
from pyimu.derivations.sources import HIDALGO
from pyimu.symbolic.earth import EARTH_RATE, earth_rate

# Earth rate


def _check_earth(d: Derivation) -> list[Check]:
    printed = d.function(("omega_enu", "omega_nwu"), ("lat", "omega_ie"))
    rng, moved, papers, same = np.random.default_rng(8), [], [], []
    for _ in rounds():
        latitude, longitude, turn = rng.uniform(-1.5, 1.5), rng.uniform(-3, 3), rng.uniform(0.1, 1)
        east_north_up, north_west_up = call(printed, latitude, 1.0)
        before, after = (_axes(latitude, longitude + angle) for angle in (0, turn))
        moved.append((east_north_up, (before.inv() * after).as_rotvec() / turn))
        papers.append((north_west_up, east_north_up[[1, 0, 2]] * [1, -1, 1]))
        same.append(
            (call(printed, latitude, EARTH_RATE)[0], np.array(earth_rate(ca.DM(latitude))).ravel())
        )
    return [
        Check.of_pairs(
            "the frame carried round by the Earth in scipy: its turn between two instants, by the "
            "angle of the Earth",
            moved,
            ROUNDING,
        ),
        Check.of_pairs(
            "the paper's axes north, west, up turned into east, north, up", papers, ROUNDING
        ),
        Check(
            "earth.earth_rate, which the filter computes with, relative to the Earth's rate",
            len(same),
            largest(same) / EARTH_RATE,
            ROUNDING,
        ),
    ]


def _axes(latitude: float, longitude: float) -> Rotation:
    """East, north, up in axes of the Earth's centre, z towards the north pole."""
    up = np.array(
        [
            np.cos(latitude) * np.cos(longitude),
            np.cos(latitude) * np.sin(longitude),
            np.sin(latitude),
        ]
    )
    east = np.array([-np.sin(longitude), np.cos(longitude), 0])
    return Rotation.from_matrix(np.column_stack([east, np.cross(up, east), up]))


EARTH = Derivation(
    "earth_rate",
    "Earth rate by latitude",
    "Rate of the Earth-fixed world frame against inertial space, in the package's axes east, "
    "north, up and in the paper's north, west, up.",
    f"{HIDALGO}, section 4.2, the Earth rotation vector (its exponent is lost in the text: "
    "7.292115e-5 rad/s, WGS 84); Groves 2013, eq. 2.123",
    (
        Equation("omega_enu", "blocks([0], [omega_ie*cos(lat)], [omega_ie*sin(lat)])"),
        Equation(
            "omega_nwu", "blocks([omega_ie*cos(lat)], [0], [omega_ie*sin(lat)])", "the paper's"
        ),
    ),
    _check_earth,
)


# The compensated rate


def _check_rate(d: Derivation) -> list[Check]:
    exact, orders = d.function(("omega_hat",), ("M", "omega_m", "beta")), _orders(d)
    rng, solved, first, second = np.random.default_rng(9), [], [], []
    for rate, bias in zip(vectors(rng, 0.1, 1), vectors(rng, 0.01, 0.1)):
        m = rng.uniform(-0.1, 0.1, (3, 3))
        measured = rate + m @ rate + bias
        solved.append((call(exact, m, measured, bias)[0], rate))
        *lower, coefficient, leading = call(orders, m, measured, bias)
        first += [(order, np.zeros(3)) for order in lower]
        second.append((coefficient, leading))
    return [
        Check.of_pairs("the sensor's equation: the true rate comes back", solved, ROUNDING),
        Check.of_pairs(
            "casadi's derivatives: `omega_1 - omega_hat` vanishes to first order where `M` and "
            "`beta` are small alike",
            first,
            ROUNDING,
            each=2,
        ),
        Check.of_pairs("casadi's derivatives: its second order is `e_1`", second, ROUNDING),
    ]


def _orders(d: Derivation) -> ca.Function:
    """Taylor coefficients 0, 1 and 2 of omega_1 - omega_hat, and e_1.

    The expansion is by a small factor on both M and beta.
    """
    small, m, measured, beta = (
        ca.SX.sym("small"),
        ca.SX.sym("M", 3, 3),
        ca.SX.sym("omega_m", 3),
        ca.SX.sym("beta", 3),
    )
    first, exact = d.function(("omega_1", "omega_hat"), ("M", "omega_m", "beta"))(
        small * m, measured, small * beta
    )
    orders = [first - exact]
    orders += [ca.jacobian(orders[0], small)]
    orders += [ca.jacobian(orders[1], small) / 2]
    leading = d.function(("e_1",), ("M", "omega_m", "beta"))(m, measured, beta)
    at_zero = [ca.densify(ca.substitute(order, small, 0)) for order in orders]
    return ca.Function("orders", [m, measured, beta], [*at_zero, leading])


def _cost(d: Derivation) -> list[Table]:
    both, rows = d.function(("omega_hat", "omega_1"), ("M", "omega_m", "beta")), []
    for rate, scale, bias in ((140, 0.03, 0.0), (140, 0.03, 0.5), (1.15, 0.03, 0.0)):
        measured = np.array([0, 0, (1 + scale) * rate + bias])
        exact, first = call(both, scale * np.eye(3), measured, [0, 0, bias])
        wrong = first[2] - exact[2]
        rows.append(
            (f"{rate:g}", f"{scale:.0%}", f"{bias:g}", f"{wrong:.4f}", f"{wrong / rate * 180:.3f}")
        )
    return [
        Table(
            "What the first-order form costs",
            (
                "rate [deg/s]",
                "scale factor",
                "bias [deg/s]",
                "rate error [deg/s]",
                "after 180 deg [deg]",
            ),
            tuple(rows),
        )
    ]


RATE = Derivation(
    "compensated_rate",
    "The rate without the sensor's errors: exact, and as the paper prints it",
    "The measured rate is `omega_m = (I_3 + M)@omega + beta` and noise. The package solves for the "
    "rate against inertial space, `omega_hat`; the "
    "paper prints `omega_1`, which is its first order and wrong by `e_1` to second order. Less the "
    "Earth's rate in body axes, "
    "`T(R_nb)@omega_enu`, either is the rate against the world.",
    f"{HIDALGO}, section 4.2, equation of the post-update angular velocity",
    (
        Equation("omega_hat", "inv(I_3 + M)@(omega_m - beta)"),
        Equation("omega_1", "omega_m - M@omega_m - beta", "the paper's"),
        Equation(
            "e_1",
            "-M**2@omega_m - M@beta",
            "`= omega_1 - omega_hat` to second order in `M` and `beta`",
        ),
    ),
    _check_rate,
    tables=_cost,
)
