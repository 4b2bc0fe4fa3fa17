"""The random numbers of a campaign, as a hash of its seed, the run's number and what is drawn.

A number therefore depends on nothing that was drawn before it: run 123 is the same alone, on
another machine and in a campaign with more factors.
"""

from __future__ import annotations

import hashlib

import numpy as np
from scipy.special import ndtri


def drawn(seed: int, run: int, what: str) -> int:
    """A number from 0 to 2^63 - 1: the first 63 bits of the BLAKE2b digest of the arguments."""
    text = f"{seed}/{run}/{what}".encode()
    return int.from_bytes(hashlib.blake2b(text, digest_size=8).digest()) >> 1


def uniform(seed: int, run: int, what: str, low: float = 0.0, high: float = 1.0) -> float:
    """A number between ``low`` and ``high``, neither of which it is."""
    return low + (high - low) * ((drawn(seed, run, what) >> 11) + 0.5) / 2**52


def normal(seed: int, run: int, what: str, size: int = 0) -> np.ndarray:
    """A standard normal, or ``size`` of them."""
    if not size:
        return ndtri(uniform(seed, run, what))
    return ndtri([uniform(seed, run, f"{what}[{i + 1}]") for i in range(size)])


def among(seed: int, run: int, what: str, count: int) -> int:
    """A number from 0 to ``count`` - 1."""
    return drawn(seed, run, what) % count
