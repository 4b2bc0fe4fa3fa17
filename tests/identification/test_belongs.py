"""Whether a reference belongs to its sensor, by trials of the benchmark's traps."""

import traps

from pyimu.identification.close import undeclared
from pyimu.identification.fit.trials import gyro_trial
from pyimu.identification.logs.trials import aligned_trials
from pyimu.identification.reference.belongs import misfit
from pyimu.recording.recording import Recording


def test_numbers_of_another_size_are_said_where_no_clock_is_found():
    """Of a rate 57 times too large no clock was seen, and the other log's reference was blamed."""
    columns = traps.case("degrees_in_one", 30010, 1).logs[1]
    recording = Recording.from_arrays("log1", **columns)
    sensor = undeclared(recording.sample_rate).gyro
    ((trial,), _) = aligned_trials(sensor, gyro_trial, [recording], [], None)
    assert trial.clock is None
    assert misfit([trial]).startswith("the reference of log1 is too small by 57.3: its numbers are")
