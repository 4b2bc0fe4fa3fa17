"""What a log of a sensor at rest says about it: ``pyimu.characterize(recording)``, and the pieces that it is made of.

The package is called like the function (``run.characterize``), and can be called as it.  Deviations are in ``allan``, the band in which those of
a known noise lie in ``allan_band``, coefficients in ``coefficients`` and ``noise_fit``, spectra in ``psd`` and ``lines``, the effect of temperature
in ``thermal``.
"""

import sys
from types import ModuleType

from pyimu.characterize.allan import hadamard_deviation, log_clusters, modified_deviation, octave_clusters, overlapping_deviation
from pyimu.characterize.allan_band import AllanLaw, allan_band, allan_laws

__all__ = ["AllanLaw", "allan_band", "allan_laws", "hadamard_deviation", "log_clusters", "modified_deviation", "octave_clusters",
           "overlapping_deviation"]


class _Package(ModuleType):
    def __call__(self, *args, **kwargs):
        from pyimu.characterize.run import characterize  # loaded only where it is called: it reads logs and draws
        return characterize(*args, **kwargs)


sys.modules[__name__].__class__ = _Package
