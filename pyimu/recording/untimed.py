"""What is said of a column map that names no time."""

from __future__ import annotations

from pyimu.errors import UserError
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.formats.reader import Reader
from pyimu.recording.guess.clock_column import add_time
from pyimu.recording.guess.first_rows import Numbers
from pyimu.recording.guess.guessed import CHOICES, Proposal

OR_RATE = 'say the rate of a log without times: sample_rate = {value = 100, unit = "Hz"}'


def without_time(reader: Reader, foreign: ForeignMap) -> UserError:
    """The error for a map of ``reader``'s columns without a time: which column may be it."""
    found = Proposal(reader.path, tuple(reader.header))
    try:
        add_time(found, reader, Numbers(reader), None)
    except UserError as error:  # in its numbers something is wrong, too
        return error
    own = [g for g in found.guesses if g.cell not in foreign.columns]
    if not own:
        return UserError(f"{foreign.path}: names no column as the time, and none rises; {OR_RATE}")
    (guess,) = own
    units = [guess.unit] if guess.unit else CHOICES["time"]
    lines = " or ".join(f'"{guess.cell}" = "time [{unit}]"' for unit in units)
    more = "".join(f"; {note}" for note in found.notes)
    return UserError(
        f"{foreign.path}: names no column as the time; it may be {lines} ({guess.why}){more}; or "
        f"{OR_RATE}"
    )
