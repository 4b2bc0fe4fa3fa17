"""Blocks as FMI co-simulation units: ``sources`` (block to texts), ``build`` (texts to .fmu), ``run`` (through fmpy)."""

from pyimu.fmu.build import PLATFORMS, build_fmu, build_fmus, host_platform
from pyimu.fmu.run import simulate
from pyimu.fmu.sources import source_folder, texts, write_generated

__all__ = ["PLATFORMS", "build_fmu", "build_fmus", "host_platform", "simulate", "source_folder", "texts", "write_generated"]
