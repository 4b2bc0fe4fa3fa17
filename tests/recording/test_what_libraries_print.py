"""What the libraries of formats print of a damaged file is not shown: a command has lines of its
own, and with a result in JSON nothing else is on stdout.
"""

import json
import subprocess
import sys
import threading

import numpy as np
import pytest
import raw_logs
from places import same_path

from pyimu import read_recording
from pyimu.recording.formats.streams import unheard
from pyimu.units import convert


def damaged(make, folder):
    """A log with a message of no known type, a quarter into it."""
    pytest.importorskip(raw_logs.NEEDS[make.__name__])
    path = make(folder, raw_logs.still(200))
    data = bytearray(path.read_bytes())
    mark = {"dataflash": b"\xa3\x95\x81", "ulog": b"\x2a\x00D"}[make.__name__]
    data[data.index(mark, len(data) // 4) + 2] = 0
    path.write_bytes(data)
    return path


def as_a_user(*words):
    """A Python of its own, whose lines past Python, of a library's C, are seen as well."""
    command = [sys.executable, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, env=same_path(), check=False)


@pytest.mark.parametrize("make", [raw_logs.dataflash, raw_logs.ulog], ids=lambda m: m.__name__)
def test_a_damaged_log_is_read_and_said_to_be_damaged_and_nothing_else(make, tmp_path):
    path = damaged(make, tmp_path)
    done = as_a_user("-m", "pyimu", "inspect", path, "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["samples"] < 200
    assert [f.kind for f in read_recording(path).findings].count("damaged") == 1


@pytest.mark.parametrize("make", [raw_logs.dataflash, raw_logs.ulog], ids=lambda m: m.__name__)
def test_a_whole_log_is_not_called_damaged(make, tmp_path):
    pytest.importorskip(raw_logs.NEEDS[make.__name__])
    log = read_recording(make(tmp_path, raw_logs.still(200)))
    assert "damaged" not in [f.kind for f in log.findings]


def test_other_threads_are_heard(capsys):
    """A bar that shows progress is drawn by one."""
    with unheard(["bad"]) as damaged:
        print("ours")
        other = threading.Thread(target=lambda: print("bad, but theirs", file=sys.stderr))
        other.start()
        other.join()
        assert not damaged()
        print("a bad header", file=sys.stderr)
        assert damaged()
    print("after")
    assert capsys.readouterr() == ("after\n", "bad, but theirs\n")


def test_numbers_too_large_for_their_unit_are_infinite_without_a_word(pyimu, tmp_path):
    """Warnings are errors in these tests (``filterwarnings``), so that none is left here."""
    np.testing.assert_array_equal(convert([1e308, np.inf], "g", "m/s^2"), [np.inf, np.inf])
    time, gyro, accel = raw_logs.still(200)
    accel[5:7] = [[1e308] * 3, [np.inf] * 3]
    names = [f"Gyroscope {a} (deg/s)" for a in "XYZ"] + [f"Accelerometer {a} (g)" for a in "XYZ"]
    head = ",".join(["Time (s)", *names])
    raw_logs.text(tmp_path / "log.csv", [head], [time * 1e-9, *gyro.T, *accel.T])
    code, out, err = pyimu("inspect", "log.csv")
    assert (code, err) == (0, "") and "200" in out


def test_a_warning_of_a_library_is_no_line_of_a_command(tmp_path):
    """As a user runs it, where nothing else filters warnings."""
    code = (
        "import sys, warnings; from pyimu import cli; import pyimu.model.part_file as p\n"
        "names = p.part_names\n"
        "p.part_names = lambda: warnings.warn('a word', RuntimeWarning) or names()\n"
        "sys.argv = ['pyimu', 'parts']; cli.main()"
    )
    done = as_a_user("-c", code)
    assert (done.returncode, done.stderr) == (0, "") and "imt30" in done.stdout
    assert "a word" in as_a_user("-W", "default", "-c", code).stderr
