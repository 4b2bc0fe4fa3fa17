"""A body that rolls to and fro, as logs of many layouts show it."""

import numpy as np


def rolls(time):
    """Rate rad/s and the up of the body (n, 3) at ``time`` (n,) s: 1.2 rad to either side."""
    roll, none = 1.2 * np.sin(2 * np.pi * 0.3 * time), 0 * time
    rate = np.column_stack([np.gradient(roll, time), none, none])
    return rate, np.column_stack([none, np.sin(roll), np.cos(roll)])
