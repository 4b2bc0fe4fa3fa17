"""Arrays of numpy, and tables in JSON whose names stand apart from their rows."""

import io
import json
import resource
import zipfile

import log_arrays
import numpy as np
import pytest
from turned_logs import agrees, turned

from pyimu import inspect
from pyimu.errors import UserError
from pyimu.recording.formats import numpy_arrays


@pytest.fixture(scope="module")
def log():
    return turned()


@pytest.mark.parametrize("make", (*log_arrays.ARRAYS, *log_arrays.JSONS))
def test_a_log_in_arrays_or_json(make, log, tmp_path):
    agrees(inspect(make(tmp_path, log)).recording, log)


def test_what_states_units_and_times_needs_no_map(log, tmp_path):
    assert inspect(log_arrays.named_columns(tmp_path, log)).kind == "own"
    found = inspect(log_arrays.edge_impulse(tmp_path, log))
    assert found.kind == "known" and found.recording.sample_rate == pytest.approx(100)


def bytes_of(shape, dtype="<f8", behind=b""):
    """An array's header, whatever stands behind it."""
    stream = io.BytesIO()
    of = {"descr": dtype, "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(stream, of)
    return stream.getvalue() + behind


def bomb(path):
    """96 MB of zeros in 94 kB."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        with archive.open("gyro.npy", "w") as stream:
            stream.write(bytes_of((4_000_000, 3)))
            for _ in range(96):
                stream.write(bytes(1_000_000))


def zipped(path, content, name="gyro.npy"):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, content)


def of_objects(path):
    with path.open("wb") as stream:
        np.lib.format.write_array(stream, np.array([{}, {}]), allow_pickle=True)


DAMAGED = {
    "none.npy": lambda p: p.write_bytes(b""),
    "noise.npy": lambda p: p.write_bytes(b"\x93NUMPY\x01\x00\xff\xff" + bytes(100)),
    "long.npy": lambda p: p.write_bytes(bytes_of((10**12, 3), behind=bytes(1000))),
    "negative.npy": lambda p: p.write_bytes(bytes_of((-1, 3), behind=bytes(1000))),
    "cube.npy": lambda p: np.save(p, np.zeros((30, 20, 3))),
    "texts.npy": lambda p: np.save(p, np.array(["a", "b"])),
    "objects.npy": of_objects,
    "none.npz": lambda p: p.write_bytes(b""),
    "long.npz": lambda p: zipped(p, bytes_of((10**12, 3), behind=bytes(1000))),
    "short.npz": lambda p: zipped(p, bytes_of((10, 3))),
    "no_arrays.npz": lambda p: zipped(p, b"x", "readme.txt"),
    "empty.npz": lambda p: np.savez(p, gyro=np.zeros((0, 3))),
}


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_array_is_refused_in_one_line(name, tmp_path):
    DAMAGED[name](tmp_path / name)
    with pytest.raises(UserError) as error:
        inspect(tmp_path / name)
    assert str(tmp_path / name) in str(error.value) and "\n" not in str(error.value)


def test_an_archive_is_unpacked_no_further_than_its_bound(monkeypatch, tmp_path):
    bomb(tmp_path / "bomb.npz")
    monkeypatch.setattr(numpy_arrays, "MOST", 1 << 26)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(UserError, match="more than 64 MiB unpacked"):
        inspect(tmp_path / "bomb.npz")
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 60 << 10


def test_a_changed_byte_in_an_archive_is_seen(log, tmp_path):
    path = log_arrays.arrays(tmp_path, log)
    content = bytearray(path.read_bytes())
    content[3000] ^= 255
    path.write_bytes(content)
    with pytest.raises(UserError, match="CRC"):
        inspect(path)


@pytest.mark.parametrize(
    "change, said",
    [
        ({"values": [[1, 2, 3, 4, 5, 6], [1, 2]]}, "sample 2: 2 values, expected 6"),
        ({"values": [3]}, "sample 1: no list, expected 6"),
        ({"values": None}, "payload.values"),
        ({"sensors": [1, 2]}, "payload.sensors"),
    ],
)
def test_a_damaged_acquisition_of_edge_impulse_is_refused(change, said, log, tmp_path):
    path = log_arrays.edge_impulse(tmp_path, [part[:50] for part in log])
    data = json.loads(path.read_text())
    data["payload"] |= change
    with pytest.raises(UserError, match=said):
        inspect(log_arrays.as_json(path, data))
