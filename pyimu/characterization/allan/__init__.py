"""Allan deviations of a record, their expected values and their distribution."""

from pyimu.characterization.allan.deviation import (
    hadamard_deviation,
    log_clusters,
    modified_deviation,
    octave_clusters,
    overlapping_deviation,
)

__all__ = [
    "hadamard_deviation",
    "log_clusters",
    "modified_deviation",
    "octave_clusters",
    "overlapping_deviation",
]
