"""Columns that are made of a file's own: one time of several, or of the steps from row to row, a
force of its two parts, an attitude of a rotation matrix, numbers with a sign of words without one.
"""

from __future__ import annotations

from pyimu.recording.apple import with_whole_force
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.formats.digit_time import with_time_of_digits
from pyimu.recording.formats.matrix_attitude import with_attitude
from pyimu.recording.formats.one_unit import with_one_unit
from pyimu.recording.formats.reader import Reader
from pyimu.recording.formats.signed import with_signs
from pyimu.recording.formats.split_time import with_one_time
from pyimu.recording.formats.steps import with_summed_steps


def with_made_columns(reader: Reader, foreign: ForeignMap) -> tuple[Reader, ForeignMap]:
    """``reader`` with the columns that are made of others, and the map with the time among them."""
    own = with_signs(with_one_unit(reader, foreign.topics.get("imu", "")))
    timed = with_one_time(with_attitude(with_whole_force(own)), foreign)
    return with_summed_steps(*with_time_of_digits(*timed))
