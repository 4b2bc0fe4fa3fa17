"""Attitude kinematics and process noise as casadi expressions.

Filters, simulations and derivations take them from here.

Every function takes and returns casadi matrices of one kind, symbolic (``SX``) or numeric (``DM``);
vectors are columns. Quaternions are Hamilton, scalar first, body to world (``q_nb``); the world is
east-north-up, the body forward-left-up. Only ``van_loan`` works on numpy arrays.
"""

from pyimu.symbolic import earth, linear, mrp, quaternion, series
from pyimu.symbolic import process_noise as noise

__all__ = ["earth", "linear", "mrp", "noise", "quaternion", "series"]
