"""The law of a noise, apart from how it is sampled: what its coefficients mean."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

PARTS = ("white", "walk", "markov", "rounding", "ramp")
"""What a law can be made of."""


@dataclass(frozen=True)
class Law:
    """The noise of an effect on one axis.

    Spectra, Allan deviations, shaping filters, the attitude filter's Q, the page on noise with its
    pictures and the tests of the noise are all made from it.

    Each function takes the coefficients that it names, and of ``h`` (sample period, s), ``x`` (the
    axis's own input) and ``slope`` (its rate) what it names; numbers and casadi expressions alike.

    * ``white``: two-sided density of white noise. One that needs ``h`` belongs to the sample: it is
      no noise in continuous time.
    * ``walk``: two-sided density of a random walk's derivative.
    * ``markov``: pairs (variance, correlation time [s]) of independent Gauss-Markov processes, each
      of them stationary from the first sample on.
    * ``rounding``: root mean square of the independent error of the output's integral at each
      sample; the output has its differences over h.
    * ``ramp``: growth per second; no noise, yet in the field's tables of noises.
    * ``floor``: level of the Allan deviation where it is flat.

    ``transfer``, ``poles``, ``psd`` and ``allan`` are the field's formulas in LaTeX, without the
    dollars, ``note`` what else a reader should know, and ``shown`` coefficients for a picture in
    place of typical ones.
    """

    white: Callable[..., Any] | None = None
    walk: Callable[..., Any] | None = None
    markov: Callable[..., Any] | None = None
    rounding: Callable[..., Any] | None = None
    ramp: Callable[..., Any] | None = None
    floor: Callable[..., Any] | None = None
    transfer: str = ""
    poles: str = "none"
    psd: str = ""
    allan: str = ""
    note: str = ""
    shown: Mapping[str, float] = field(default_factory=dict)

    def __repr__(self) -> str:
        """``Law(white: N^2)``: what it is made of, and its density."""
        return f"Law({', '.join(self.parts) or 'nothing'}: {self.psd or 'no density'})"

    def value(self, part: str, coefficients: Mapping[str, Any], **conditions: Any) -> Any:
        """A part of the law for these coefficients and conditions; None where there is none."""
        function = getattr(self, part)
        if function is None:
            return None
        given = {**conditions, **coefficients}
        return function(**{name: given[name] for name in inspect.signature(function).parameters})

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of what the law is made of."""
        return tuple(part for part in PARTS if getattr(self, part) is not None)

    def needs(self, condition: str) -> bool:
        """Whether the white noise depends on ``h``, ``x`` or ``slope``."""
        return self.white is not None and condition in inspect.signature(self.white).parameters

    def is_plain(self, part: str) -> bool:
        """Whether the law is this part alone, under no condition."""
        return self.parts == (part,) and not any(map(self.needs, ("h", "x", "slope")))

    @property
    def sampled(self) -> bool:
        """Whether the noise belongs to the sample and not to time."""
        return self.needs("h") or self.rounding is not None
