"""A folder with two arrays of NumPy and no suffix, ``t`` and ``value``: the times of samples, and
the samples, as comma2k19 has one for each of its sensors.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.recording.formats.datasets import DatasetReader, columns_of
from pyimu.recording.formats.numpy_arrays import array_header
from pyimu.recording.formats.streams import reading

TIME, VALUE = "t", "value"


def is_timed_array(folder: Path) -> bool:
    """Whether a folder is one."""
    return all((folder / name).is_file() for name in (TIME, VALUE))


class TimedArrayReader(DatasetReader):
    """The arrays are columns ``t`` and ``value[0]``, ``value[1]`` and so on."""

    crowded = False

    @classmethod
    def open(cls, folder: Path) -> TimedArrayReader:
        """Raises UserError for files that are no such arrays."""
        columns = []
        for name in (TIME, VALUE):
            with reading(folder / name, "NPY"), (folder / name).open("rb") as stream:
                columns += columns_of(name, *array_header(folder / name, stream))
        return cls(folder, columns)

    @contextmanager
    def opened(self) -> Iterator[Mapping[str, Any]]:
        with reading(self.path, "NPY"):
            yield {
                name: np.load(self.path / name, mmap_mode="r", allow_pickle=False)
                for name in (TIME, VALUE)
            }
