"""Position by an inertial unit alone: strapdown integration, and a filter that knows of rests."""

from pyimu.navigation.filter.ins_block import strapdown_ins
from pyimu.navigation.result import NavigationResult
from pyimu.navigation.run import run
from pyimu.navigation.strapdown import strapdown, strapdown_wongwirat
from pyimu.navigation.track import Reference, Track

__all__ = [
    "NavigationResult",
    "Reference",
    "Track",
    "run",
    "strapdown",
    "strapdown_ins",
    "strapdown_wongwirat",
]
