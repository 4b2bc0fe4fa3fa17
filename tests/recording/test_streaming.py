"""Logs read in pieces: the same bits as read whole, however they are cut, in memory that does not
grow with the file.
"""

import gzip
import os
import re
import time
import tracemalloc
from itertools import islice, pairwise
from pathlib import Path

import log_files
import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyarrow import csv as pacsv
from pyarrow import parquet

import pyimu.recording.formats.parquet
from pyimu.errors import UserError
from pyimu.recording.formats.text import CsvReader
from pyimu.recording.log import HEAD, open_log, read_recording
from pyimu.recording.recording import join

HEADER = (
    "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],accel_x [g],accel_y [g],accel_z "
    "[g],temperature [K],ref_q_w [1],ref_q_x [1],ref_q_y [1],ref_q_z [1]"
)
FRAME = (
    '[frame]\nbody = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]]\nworld = "ned"\nq = '
    '"bn"\n'
)


def faulty_rows(n=4000, seed=3):
    """Rows (n, 12) with everything that is reported: repeats, gaps, missing cells, odd norms."""
    rng = np.random.default_rng(seed)
    rows = np.column_stack(
        [
            np.cumsum(
                rng.choice([0.01, 0.01, 0.01, 0.0, 0.05], n, p=[0.9, 0.03, 0.03, 0.03, 0.01])
            ),
            rng.standard_normal((n, 11)),
        ]
    )
    rows[:, 8:] = [1, 0, 0, 0] + rng.standard_normal((n, 4)) * 0.003
    rows[rng.random(n) < 0.01, 3] = np.nan
    same = np.flatnonzero(np.diff(rows[:, 0]) == 0)[::2]
    rows[same + 1] = rows[same]
    return rows


def text_of(rows):
    return (
        HEADER
        + "\n"
        + "".join(
            ",".join("" if np.isnan(v) else repr(float(v)) for v in row) + "\n" for row in rows
        )
    )


@pytest.fixture(scope="module")
def faulty(tmp_path_factory):
    """A folder with the faulty log as CSV, gzipped CSV and Parquet of odd row groups, and a column
    map.
    """
    folder = tmp_path_factory.mktemp("faulty")
    rows = faulty_rows()
    (folder / "log.csv").write_text(text_of(rows))
    (folder / "log.csv.gz").write_bytes(gzip.compress(text_of(rows).encode()))
    parquet.write_table(
        pa.table([pa.array(c, from_pandas=True) for c in rows.T], names=HEADER.split(",")),
        folder / "log.parquet",
        row_group_size=777,
    )
    (folder / "map.toml").write_text(FRAME)
    return folder


def same(a, b):
    return list(a.groups) == list(b.groups) and all(
        np.array_equal(x, y, equal_nan=True)
        for x, y in zip([a.time, *a.groups.values()], [b.time, *b.groups.values()])
    )


# The same bits


@settings(max_examples=25, deadline=None)
@given(
    rows=st.integers(20, 5000),
    batch=st.integers(10, 1000),
    name=st.sampled_from(["log.csv", "log.csv.gz", "log.parquet"]),
    mapped=st.booleans(),
)
def test_pieces_joined_are_the_whole(faulty, rows, batch, name, mapped):
    columns = faulty / "map.toml" if mapped else None
    whole = read_recording(faulty / "log.csv", columns)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pyimu.recording.formats.parquet, "BATCH", batch)
        log = open_log(faulty / name, columns)
        pieces = list(log.pieces(rows))
    assert same(join([piece for piece, _ in pieces]), whole)
    assert [len(piece) for piece, _ in pieces[:-1]] == [rows] * (len(pieces) - 1) and 1 <= len(
        pieces[-1][0]
    ) <= rows
    assert log.findings == whole.findings
    assert {f.kind for f in whole.findings} == {
        "repeated_rows",
        "repeated_time",
        "missing_cells",
        "reference_norm",
        "gaps",
    }


@pytest.mark.parametrize(
    "kind", ["csv.gz", "parquet", "mat", "mat73", "hdf5", "folder", "mcap", "bag"]
)
def test_pieces_of_every_format_joined_are_the_whole(kind, tmp_path, monkeypatch):
    pytest.importorskip(
        {
            "mat73": "h5py",
            "hdf5": "h5py",
            "folder": "rosbags",
            "mcap": "rosbags",
            "bag": "rosbags",
        }.get(kind, "numpy")
    )
    for module in ("bag", "datasets", "parquet"):
        monkeypatch.setattr(f"pyimu.recording.formats.{module}.BATCH", 37)
    path, columns = log_files.written(tmp_path, kind, log_files.arrays(500))
    log, whole = open_log(path, columns), read_recording(path, columns)
    assert (
        same(join([piece for piece, _ in log.pieces(23)]), whole) and log.findings == whole.findings
    )
    assert (
        log.groups == tuple(whole.groups)
        and log.count in (500, None)
        and (log.count is None) == (kind == "csv.gz")
    )


def test_reading_again_gives_the_same(faulty):
    log = open_log(faulty / "log.csv")
    first = [piece for piece, _ in log.pieces(1000)]
    found = log.findings
    assert (
        all(
            same(a, b) for a, b in zip(first, (piece for piece, _ in log.pieces(1000)), strict=True)
        )
        and log.findings == found
    )


@pytest.mark.parametrize("name", ["log.csv", "log.csv.gz", "log.parquet"])
def test_shares_grow_to_one(name, faulty, monkeypatch):
    """Parquet tells exactly; of text some 32 MB are read ahead."""
    monkeypatch.setattr(pyimu.recording.formats.parquet, "BATCH", 100)
    shares = [share for _, share in open_log(faulty / name).pieces(50)]
    assert all(0 < a <= b for a, b in pairwise(shares)) and shares[-1] == 1
    assert name != "log.parquet" or len(set(shares)) == 40


def test_clock_with_an_origin_runs_on_from_piece_to_piece(tmp_path):
    log = log_files.arrays(400)
    log_files.csv(tmp_path / "log.csv", log)
    pieces = [piece for piece, _ in open_log(tmp_path / "log.csv").pieces(150)]
    assert np.array_equal(np.concatenate([p.time for p in pieces]), (log[0] - log[0][0]) * 1e-9)


# Gaps


def gapped(tmp_path, n=900):
    time = np.arange(n) * 0.01 + np.repeat([0, 0.5, 30], n // 3)
    (tmp_path / "log.csv").write_text(
        text_of(np.column_stack([time, np.random.default_rng(0).standard_normal((n, 11))]))
    )
    return tmp_path / "log.csv"


@pytest.mark.parametrize("rows", [7, 100, 300, 10_000])
def test_segments_of_a_log_are_those_of_the_recording(rows, tmp_path):
    path = gapped(tmp_path)
    whole, log = read_recording(path), open_log(path)
    found = {}
    for segment, piece, _ in log.segments(rows):
        assert piece.segments == [(0, len(piece))] and piece.sample_period == log.sample_period
        found.setdefault(segment, []).append(piece)
    assert [
        same(join(found[k]), whole.slice(*edges)) for k, edges in enumerate(whole.segments)
    ] == [True] * 3 and len(found) == 3
    (gaps,) = (f for f in log.findings if f.kind == "gaps")
    assert gaps.count == 2 and gaps.detail["longest"] == pytest.approx(29.51)


@pytest.mark.parametrize("rows", [1, 7, 100, 1000, 10_000])
def test_pieces_know_the_gaps_that_late_stamps_hide(rows, tmp_path):
    """Stamps with a latency, 1 sample in 100 lost: segments and quality are those of the whole,
    though pieces end beside late stamps.
    """
    n = 3000
    rng = np.random.default_rng(7)
    time = (0.01 * (np.arange(n) + np.minimum(rng.exponential(0.2, n), 0.9)))[rng.random(n) > 0.01]
    path = tmp_path / "log.csv"
    path.write_text(text_of(np.column_stack([time, rng.standard_normal((len(time), 11))])))
    whole, log = read_recording(path), open_log(path)
    pieces = [piece for piece, _ in log.pieces(rows)]
    late = np.count_nonzero(np.diff(whole.time) > whole.cadence.longest) - len(whole.segments) + 1
    assert late > 50 and same(join(pieces), whole) and log.findings == whole.findings
    assert (
        join(pieces).segments == whole.segments
        and join(pieces).slice(5, -5).segments == whole.slice(0, len(whole)).slice(5, -5).segments
    )
    lengths = {}
    for segment, piece, _ in log.segments(rows):
        lengths[segment] = lengths.get(segment, 0) + len(piece)
    assert list(lengths.values()) == [b - a for a, b in whole.segments] and len(lengths) > 10


# Errors and interruption


def test_error_comes_where_it_stands(tmp_path):
    n = 200_000
    rows = [f"{k / 100},1,2,3" for k in range(n)]
    rows[180_000] = "17.0,1,2,3"
    (tmp_path / "log.csv").write_text(
        "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s]\n" + "\n".join(rows) + "\n"
    )
    pieces = open_log(tmp_path / "log.csv").pieces(50_000)
    read = 0
    with pytest.raises(
        UserError, match=re.escape("row 180002: the time runs backwards, 17 s follows 1799.99 s")
    ):
        for piece, _ in pieces:
            read += len(piece)
    assert read == 150_000


@pytest.mark.parametrize(
    "rows, says", [(0, "this one has 0"), (2, "needs at least 3 rows of data, this one has 2")]
)
def test_too_short_log_is_refused_when_opened(rows, says, tmp_path):
    (tmp_path / "log.csv").write_text(text_of(faulty_rows()[:rows]))
    with pytest.raises(UserError, match=says):
        open_log(tmp_path / "log.csv")


def test_three_samples_are_a_log(tmp_path):
    (tmp_path / "log.csv").write_text(text_of(np.column_stack([np.arange(3.0), np.ones((3, 11))])))
    log = open_log(tmp_path / "log.csv")
    assert [(len(piece), share) for piece, share in log.pieces()] == [
        (3, 1)
    ] and log.sample_period == 1


def test_pieces_of_no_rows(faulty):
    with pytest.raises(ValueError, match="pieces of 0 rows"):
        next(open_log(faulty / "log.csv").pieces(0))


@pytest.mark.skipif(
    not Path("/proc/self/fd").exists(), reason="counts the open files of the process"
)
@pytest.mark.parametrize(
    "kind", ["csv", "csv.gz", "parquet", "mat73", "hdf5", "folder", "mcap", "bag"]
)
def test_leaving_early_closes_the_file(kind, tmp_path):
    pytest.importorskip(
        {
            "mat73": "h5py",
            "hdf5": "h5py",
            "folder": "rosbags",
            "mcap": "rosbags",
            "bag": "rosbags",
        }.get(kind, "numpy")
    )
    path, columns = log_files.written(tmp_path, kind, log_files.arrays(500))

    def held():
        return [
            target
            for target in (
                os.path.realpath(f"/proc/self/fd/{fd}") for fd in os.listdir("/proc/self/fd")
            )
            if str(tmp_path) in target
        ]

    pieces = open_log(path, columns).pieces(10)
    next(pieces)
    pieces.close()
    for _ in range(3000):  # a text is closed by the last of Arrow's threads
        if not held():
            break
        time.sleep(0.01)
    assert held() == []


class Watched:
    """A file that counts what is still read of it once it was closed."""

    def __init__(self, path):
        self.file, self.closed, self.late = open(path, "rb"), False, 0

    def read(self, size):
        data = self.file.read(size)
        time.sleep(0.001)  # another thread's turn
        self.late += self.closed
        return data

    def tell(self):
        return self.file.tell()

    def seek(self, *place):
        return self.file.seek(*place)

    def close(self):
        self.closed = True


@pytest.mark.parametrize("packed", [False, True])
def test_no_file_is_closed_while_it_is_read(packed, tmp_path, monkeypatch):
    """Else the next one that is opened has its number, and is read with a piece missing."""
    path, opened = tmp_path / "log.csv", []
    numbers = np.random.default_rng(1).integers(10**9, size=50_000)
    rows = b"".join(b"%09d,0.5\n" % number for number in numbers) * 13

    def watched(name):
        opened.append(Watched(name))
        return pa.PythonFile(opened[-1], mode="r")

    path.write_bytes(b"time [s],gyro_x [rad/s]\n" + rows)
    if packed:
        path.write_bytes(gzip.compress(path.read_bytes(), 1))
    monkeypatch.setattr(pa, "OSFile", watched)
    reader = CsvReader.open(path)
    for asked in (1, 3, None):
        batches = reader.batches([0, 1], 0)
        left = list(islice(batches, asked))
        batches.close()
        assert len(left) == (asked or 9)
    time.sleep(0.1)  # for what might still be asked for
    assert [file.late for file in opened] == [0, 0, 0]


# Memory


def _peak(path, rows):
    """Bytes of numpy's arrays at their peak while ``path`` is read in pieces, and of arrow's at the
    end of each.
    """
    arrow = []
    tracemalloc.start()
    try:
        for piece, _ in open_log(path).pieces(rows):
            arrow.append(pa.total_allocated_bytes())
            del piece
        return tracemalloc.get_traced_memory()[1], max(arrow)
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    "name, group", [("log.csv", 0), ("log.parquet", 600_000), ("log.parquet", 10_000)]
)
def test_memory_does_not_grow_with_the_file(name, group, tmp_path):
    """Of doubles in 12 columns numpy holds at most: a batch five times (as read, in SI, its kept
    rows, its groups, turned), the pieces that wait for a whole one and that one (three pieces), and
    the times of the head twice. Arrow reads some 32 blocks of 1 MiB of text ahead, which are there
    as text and as numbers in turn; of each column of Parquet it holds what is read ahead, a page (1
    MiB each), the page's values, and a batch. What grew with the file would be 55 MiB.
    """
    rows, batch, peaks = 20_000, 1 << 16, []
    values = np.random.default_rng(0).standard_normal((1000, 11)).round(3)
    for n in (150_000, 600_000):
        table = pa.table(
            [np.arange(n) * 0.01, *np.tile(values, (n // 1000, 1)).T], names=HEADER.split(",")
        )
        if name == "log.csv":
            pacsv.write_csv(table, tmp_path / name, pacsv.WriteOptions(quoting_style="none"))
        else:
            parquet.write_table(table, tmp_path / name, row_group_size=group, use_dictionary=False)
        del table
        peaks.append(_peak(tmp_path / name, rows))
    (short, _), (held, arrow) = peaks
    row = 12 * 8
    assert held < (5 * batch + 3 * rows) * row + 2 * 8 * (HEAD + batch)
    assert held < short + rows * row
    assert arrow < ((2 * 32 + 1) * 2**20 if name == "log.csv" else 12 * (3 * 2**20 + 8 * batch))
