"""The logs that the fuzzer of recordings damages are of every layout that is known."""

import random
from pathlib import Path

import pytest
from places import program

from pyimu.errors import UserError
from pyimu.recording.column_map import ForeignMap
from pyimu.recording.formats.oxts import oxts_in
from pyimu.recording.formats.suffix import READERS, open_reader
from pyimu.recording.known import FORMATS, recognised
from pyimu.recording.log import read_recording, read_reference
from pyimu.recording.made import with_made_columns

pytest.importorskip("h5py")
pytest.importorskip("rosbags")


@pytest.fixture(scope="module")
def fuzzer():
    program("fuzz/harness.py")
    return program("fuzz/recordings.py")


@pytest.fixture(scope="module")
def seeds(fuzzer, tmp_path_factory):
    folder = tmp_path_factory.mktemp("seeds")
    fuzzer.seeds(folder)
    return sorted(folder.iterdir())


def tables(seeds):
    """Every file that a reader reads; rows of binary numbers (.raw) need their map for that."""
    inside = [p for s in seeds for p in ([s] if s.is_file() else sorted(s.rglob("*")))]
    return [p for p in inside if p.is_file() and p.suffix not in (".toml", ".yaml", ".raw")]


def test_there_is_a_log_of_every_reader_and_every_known_layout(seeds):
    paths = tables(seeds)
    suffixes = {suffix for suffix in READERS if any(p.name.endswith(suffix) for p in paths)}
    assert {READERS[suffix] for suffix in suffixes} == set(READERS.values())
    folders = [s for s in map(oxts_in, filter(Path.is_dir, seeds)) if s is not None]
    found = [open_reader(path) for path in (*paths, *folders)]
    made = [with_made_columns(reader, ForeignMap())[0] for reader in found]
    known = {known[0] for reader in made if (known := recognised(reader))}
    assert {name for name, _ in FORMATS} <= known


def test_there_is_every_kind_of_folder(seeds):
    """A bag of ROS 2, a sequence with its ground truth, and phones of each system and program."""
    folders = [s for s in seeds if s.is_dir()]
    assert any((f / "metadata.yaml").is_file() for f in folders)
    assert any((f / "mav0").is_dir() for f in folders)
    told = [f / "Metadata.csv" for f in folders if (f / "Gyroscope.csv").is_file()]
    texts = {path.read_text() if path.is_file() else "phyphox" for path in told}
    assert all(any(word in text for text in texts) for word in ("android", "ios", "phyphox"))
    assert any((f / "GyroscopeUncalibrated.csv").is_file() for f in folders)


def test_every_log_is_read_before_it_is_damaged(fuzzer, seeds):
    """So that damage, and nothing else, is what a log is refused for; but for what only a map
    tells, which is there with one, too.
    """
    for path in seeds:
        without = ("mat-", "mat73-", "hdf5-", *fuzzer.GUESSED)
        if path.suffix != ".toml" and not path.name.startswith(without):
            truth = path.name.startswith(("nclt_truth", "nclt_fog", "posed"))
            found = (read_reference if truth else read_recording)(*fuzzer._given(path))
            assert len(found) >= fuzzer.ROWS - 1, path.name


def test_of_a_folder_one_file_is_damaged(fuzzer, seeds, tmp_path):
    """The others, and the folder that it is copied from, stay as they are."""
    (seed,) = [s for s in seeds if s.name.startswith("android_uncalibrated")]
    before = {p.name: p.read_bytes() for p in seed.iterdir()}
    rng, changes = random.Random(1), []
    for _ in range(30):
        made: Path = fuzzer.mutate(seed, tmp_path, rng)
        after = {p.name: p.read_bytes() for p in made.iterdir()}
        changes.append(sum(after.get(name) != data for name, data in before.items()))
    assert max(changes) == 1 and sum(changes) > 20
    assert {p.name: p.read_bytes() for p in seed.iterdir()} == before


def test_a_missing_file_is_a_refusal_to_the_fuzzer(fuzzer, tmp_path):
    assert fuzzer.try_one(tmp_path / "missing.csv") == "refused"
    with pytest.raises(UserError):
        read_recording(tmp_path / "missing.csv")
