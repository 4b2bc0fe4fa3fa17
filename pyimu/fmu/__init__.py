"""Blocks as FMI co-simulation units.

``sources`` (block to texts), ``build`` (texts to .fmu), ``run`` and ``blocks`` (through fmpy).
"""

from pyimu.block.compiled import source_folder
from pyimu.fmu.blocks import simulate_blocks, stream_blocks
from pyimu.fmu.build import FORMS, PLATFORMS, build_fmu, build_fmus, host_platform
from pyimu.fmu.run import simulate
from pyimu.fmu.sources import texts, write_generated

__all__ = [
    "FORMS",
    "PLATFORMS",
    "build_fmu",
    "build_fmus",
    "host_platform",
    "simulate",
    "simulate_blocks",
    "source_folder",
    "stream_blocks",
    "texts",
    "write_generated",
]
