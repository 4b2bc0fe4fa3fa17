"""The attitude filters that ``pyimu.attitude.run`` knows by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from pyimu.attitude.filter.hidalgo2012 import attitude_hidalgo2012
from pyimu.attitude.filter.ukf import attitude_ukf
from pyimu.block.block import Block
from pyimu.errors import UserError
from pyimu.model.part import Part
from pyimu.units import did_you_mean

Settings = str | Mapping[str, float | str] | None
"""A filter's name, or values of its parameters by name, with ``filter`` for another filter."""

FILTERS: dict[str, Callable[[Part], Block]] = {
    "ukf": attitude_ukf,
    "hidalgo2012": attitude_hidalgo2012,
}
"""The package's own, and the one that Hidalgo 2012 published."""

OF_LOGS: dict[str, Callable[[Part], Block]] = FILTERS | {
    "ukf": partial(attitude_ukf, shows_now=False)
}
"""The same with the estimates of the instants at which the samples were taken."""

OWN = "ukf"

UNUSED = {"hidalgo2012": ("heading", "stationary", "mag", "speed")}
"""Columns of a recording that a filter knows no update for."""


def chosen(settings: Settings) -> tuple[str, dict[str, float | str]]:
    """The name of the filter, and the values of its parameters.

    Raises UserError for a name that is not known.
    """
    given = {"filter": settings} if isinstance(settings, str) else dict(settings or {})
    name = given.pop("filter", OWN)
    if name not in FILTERS:
        raise UserError(
            f"settings '{str(name)[:40]}': no attitude filter has that name, known are "
            f"{', '.join(FILTERS)}{did_you_mean(str(name), FILTERS)}"
        )
    return str(name), given
