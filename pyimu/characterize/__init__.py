"""What a log says about its sensor: Allan deviations (``allan``) and the band in which those of a known noise lie (``allan_band``)."""

from pyimu.characterize.allan import hadamard_deviation, log_clusters, modified_deviation, octave_clusters, overlapping_deviation
from pyimu.characterize.allan_band import AllanLaw, allan_band, allan_laws

__all__ = ["AllanLaw", "allan_band", "allan_laws", "hadamard_deviation", "log_clusters", "modified_deviation", "octave_clusters",
           "overlapping_deviation"]
