r"""Low-passes that sensors have, by the frequency f_c at which they let half of the power through.

Of a filter before the samples are taken (``analog``), the spectrum of the samples has what sampling
folds back as well: the sum of |H|^2 at f + k f_s over whole numbers k. A digital filter has the
sample rate f_s itself and folds nothing. With w = 2 pi f / f_s:

* ``analog``, Butterworth's: |H|^2 = 1 / (1 + (f / f_c)^(2 n))
* ``digital``, Butterworth's by the bilinear transform, as ``scipy.signal.butter`` makes it:
  1 / (1 + (tan(w / 2) / tan(w_c / 2))^(2 n))  (Oppenheim and Schafer, Discrete-Time Signal
  Processing, 7.2)
* ``exponential`` average y += (1 - a) (x - y): (1 - a)^2 / (1 - 2 a cos w + a^2)
* ``moving`` average of M samples, n times over: (sin(M w / 2) / (M sin(w / 2)))^(2 n)
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.optimize import brentq

FOLDS = np.arange(-4, 5).reshape(-1, 1, 1)
"""Multiples of the sample rate from which noise is folded back. What comes from beyond, of a filter
of first order one part in twenty, is level."""

HIGHEST = 0.499
"""Highest f_c, as a share of the sample rate, of a filter that runs at that rate."""

STARTS = 6
"""Corners that the fit of a low-pass without zeros begins at."""

LONGEST = 64
"""Samples of the longest moving average that a fit begins at."""

ORDINALS = ("first", "second", "third", "fourth")


@dataclass(frozen=True)
class LowPass:
    """A kind of low-pass and its order; ``power(f, corner)`` is |H|^2, frequencies over f_s."""

    kind: str
    order: int
    power: Callable[[np.ndarray, float], np.ndarray]

    def corners(self, low: float, high: float) -> np.ndarray:
        """Corners between ``low`` and ``high`` to begin a fit at, the nearest to the true one.

        Those of a moving average are of whole numbers of samples: its zeros make a valley of each.
        """
        if self.kind == "moving":
            whole = _whole_averages(self.order)
            found = whole[(whole > low) & (whole < high)]
            return found if len(found) else whole[:1]
        return np.geomspace(low, high, STARTS)

    @property
    def words(self) -> str:
        """What it is called, with its order."""
        if self.kind == "exponential":
            return "an exponential average of the samples"
        if self.kind == "moving":
            times = ("", " twice over", " three times over")[self.order - 1]
            return f"a moving average of the samples{times}"
        article = {"analog": "an analog", "digital": "a digital"}[self.kind]
        return f"{article} low-pass of {ORDINALS[self.order - 1]} order"


def _analog(order: int) -> Callable[[np.ndarray, float], np.ndarray]:
    def power(f: np.ndarray, corner: float) -> np.ndarray:
        return np.sum(1 / (1 + ((f + FOLDS) / corner) ** (2 * order)), axis=0)

    return power


def _digital(order: int) -> Callable[[np.ndarray, float], np.ndarray]:
    def power(f: np.ndarray, corner: float) -> np.ndarray:
        bent = np.tan(np.pi * f) / np.tan(np.pi * min(corner, HIGHEST))
        return 1 / (1 + bent ** (2 * order))

    return power


def _exponential(f: np.ndarray, corner: float) -> np.ndarray:
    # Half the power at w_c: a^2 - 2 a (2 - cos w_c) + 1 = 0.
    b = 2 - np.cos(2 * np.pi * min(corner, HIGHEST))
    a = b - np.sqrt(b**2 - 1)
    return (1 - a) ** 2 / (1 - 2 * a * np.cos(2 * np.pi * f) + a**2)


def _moving(order: int) -> Callable[[np.ndarray, float], np.ndarray]:
    def power(f: np.ndarray, corner: float) -> np.ndarray:
        return kernel(f, samples_averaged(corner, order)) ** (2 * order)

    return power


def kernel(f: np.ndarray | float, samples: float) -> np.ndarray | float:
    """The response of a moving average over so many ``samples``, at ``f`` > 0 over the rate."""
    return np.sin(samples * np.pi * f) / (samples * np.sin(np.pi * f))


def samples_averaged(corner: float, order: int = 1) -> float:
    """Samples of the moving average, ``order`` times over, that is down by 3 dB at ``corner``."""
    wanted = 0.5 ** (1 / (2 * order))
    corner = min(corner, HIGHEST)
    # Over one sample nothing is lost, over a period of the corner everything.
    low, high = 1.0, 1 / corner
    if kernel(corner, high) > wanted or kernel(corner, low) < wanted:
        return low
    return float(brentq(lambda m: kernel(corner, m) - wanted, low, high, xtol=1e-9))


@cache
def _whole_averages(order: int) -> np.ndarray:
    """Corners of moving averages over 2, 3, ... ``LONGEST`` samples."""
    wanted = 0.5 ** (1 / (2 * order))
    return np.array(
        [brentq(lambda f, m=m: kernel(f, m) - wanted, 1e-9, 1 / m) for m in range(2, LONGEST + 1)]
    )


LOW_PASSES = (
    *(LowPass("analog", n, _analog(n)) for n in range(1, 5)),
    *(LowPass("digital", n, _digital(n)) for n in range(1, 5)),
    LowPass("exponential", 1, _exponential),
    *(LowPass("moving", n, _moving(n)) for n in range(1, 4)),
)
"""Those that are tried; of two that fit alike the first."""
