"""MAT files: version 7.3 is HDF5, older ones are read whole by scipy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

import numpy as np

from pyimu.errors import UserError
from pyimu.recording.formats.datasets import DatasetReader, columns_of, skipped, stated_rate
from pyimu.recording.formats.hdf5 import Hdf5Reader
from pyimu.recording.formats.mat_tags import MOST, check_tags
from pyimu.recording.formats.streams import reading

FEW = 16
"""Structures of an array up to which each may be one of a sensor, and numbers of a field up to
which each is of a sample."""

_HDF5 = b"\x89HDF\r\n\x1a\n"


class MatReader(DatasetReader):
    """A MAT file of version 4 to 7.2, in memory."""

    def __init__(
        self,
        path: Path,
        arrays: Mapping[str, np.ndarray],
        skipped: Sequence[str] = (),
        rate: float | None = None,
    ) -> None:
        super().__init__(
            path,
            [
                c
                for name, array in arrays.items()
                for c in columns_of(name, array.shape, array.dtype)
            ],
            skipped,
            rate,
        )
        self.arrays = arrays

    @classmethod
    def open(cls, path: Path) -> MatReader | Hdf5Reader:
        """Open a MAT file; structures become folders, ``log/gyro[0]``.

        Raises UserError for a file that is not a MAT file, or is too large to be read whole.
        """
        if _is_hdf5(path):
            return Hdf5Reader.open(path, "mat")
        if path.stat().st_size > MOST:
            raise UserError(
                f"{path}: MAT files before version 7.3 are read whole and may have {MOST >> 20} "
                f"MiB, this has {path.stat().st_size >> 20}; save it with -v7.3"
            )
        items = dict(_items("", _load(path)))
        return cls(
            path,
            {name: item for name, item in items.items() if isinstance(item, np.ndarray)},
            [said for name, item in items.items() for said in _skipped(name, item)],
            stated_rate(items),
        )

    def opened(self) -> AbstractContextManager[Mapping[str, np.ndarray]]:
        return nullcontext(self.arrays)


def _is_hdf5(path: Path) -> bool:
    """Whether HDF5's signature is at the start or after MATLAB's user block of 512 bytes."""
    with path.open("rb") as file:
        head = file.read(512 + len(_HDF5))
    return _HDF5 in (head[: len(_HDF5)], head[512:])


def _load(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat

    check_tags(path)
    with reading(path, "MAT"):  # in MATLAB's own types
        return loadmat(path, simplify_cells=True, mat_dtype=True)


def _items(folder: str, items: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for name, item in items.items():
        if isinstance(item, Mapping):
            yield from _items(f"{folder}{name}/", item)
        elif _is_structures(item):
            yield from _of_structures(folder + name, item)
        elif isinstance(item, (np.ndarray, list, int, float)) and not name.startswith("__"):
            yield folder + name, item


def _is_structures(item: Any) -> bool:
    """Whether an ``item`` is an array of structures, which comes as a list."""
    return isinstance(item, list) and bool(item) and all(isinstance(x, Mapping) for x in item)


def _of_structures(name: str, items: Sequence[Mapping[str, Any]]) -> Iterator[tuple[str, Any]]:
    """What an array of structures holds: an array for each field that has as many numbers in all of
    them, each a sample; else of a few structures the arrays of each, ``imu(1)/gyro``.
    """
    fields = [key for key in items[0] if all(key in item for item in items)]
    values = {key: [np.asarray(item[key]) for item in items] for key in fields}
    samples = {
        key: np.stack([v.ravel() for v in each])
        for key, each in values.items()
        if each[0].dtype.kind in "iufb"
        and each[0].size <= FEW
        and all(v.dtype.kind in "iufb" and v.size == each[0].size for v in each)
    }
    single = all(v.shape[1] == 1 for v in samples.values())
    if samples and (len(items) > FEW or single):
        yield from (
            (f"{name}/{key}", v[:, 0] if v.shape[1] == 1 else v) for key, v in samples.items()
        )
    elif len(items) <= FEW:
        for k, item in enumerate(items, 1):
            yield from _items(f"{name}({k})/", item)
    else:
        yield name, list(items)


def _skipped(name: str, item: Any) -> list[str]:
    """What of an ``item`` has no columns.

    Arrays of structures come as lists, cells as lists or as arrays of objects.
    """
    if isinstance(item, (int, float)):
        return []
    if isinstance(item, list) and item and isinstance(item[0], Mapping):
        return [f"{name} ({len(item)} structures without numbers, save arrays)"]
    if isinstance(item, list) or item.dtype.kind == "O":
        return [f"{name} (cells, save arrays)"]
    return skipped(name, item.shape, item.dtype)
