"""A campaign: many varied drives, each a pure function of the settings and of its number.

``run`` computes one into a folder; ``Settings`` is what it is a campaign of.
"""

from pyimu.rover.campaign.campaign import run as run
from pyimu.rover.campaign.settings import Settings as Settings
