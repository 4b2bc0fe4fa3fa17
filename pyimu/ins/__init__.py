"""Position by an inertial unit alone: strapdown integration, and a filter that knows of rests."""

from pyimu.ins.filter.ins_block import strapdown_ins
from pyimu.ins.result import NavigationResult
from pyimu.ins.run import run
from pyimu.ins.strapdown import strapdown, strapdown_wongwirat
from pyimu.ins.track import Reference, Track

__all__ = [
    "NavigationResult",
    "Reference",
    "Track",
    "run",
    "strapdown",
    "strapdown_ins",
    "strapdown_wongwirat",
]
