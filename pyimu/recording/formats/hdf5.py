"""HDF5 files, MAT files of version 7.3 among them, read in slices by h5py."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import Any

from pyimu.recording.formats.datasets import Column, DatasetReader, columns_of, skipped, stated_rate
from pyimu.recording.formats.reader import need
from pyimu.recording.formats.streams import must_be_held, reading
from pyimu.recording.spelling import unit_of

CACHE = 1 << 25
"""Bytes of decompressed chunks kept for each array: a slice may end inside of a chunk, which the
next slice then needs."""

UNITS = ("units", "unit", "Units", "Unit", "UNITS", "UNIT")
"""Attributes that say the unit of an array, the first by the conventions of netCDF (CF)."""

NUMERIC = (
    "double",
    "single",
    "logical",
    *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
)
"""MATLAB's classes of numbers; a char array is stored as integers too, and is none."""


class Hdf5Reader(DatasetReader):
    """An HDF5 file; ``extra`` is the extra of the package that its reader is asked under.

    The ``units`` of arrays by their names stand behind those of their columns.
    """

    def __init__(
        self,
        path: Path,
        columns: list[Column],
        extra: str,
        skipped: Sequence[str] = (),
        rate: float | None = None,
        units: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        super().__init__(path, columns, skipped, rate)
        self.header = [
            f"{c.name} ({units[c.array]})" if c.array in units else c.name for c in columns
        ]
        self.extra = extra

    @classmethod
    def open(cls, path: Path, extra: str = "hdf5") -> Hdf5Reader:
        """Raises UserError for a file that is none, and where h5py is not installed."""
        with _file(path, extra) as file:
            arrays: list[tuple] = []
            single, units = dict(file.attrs), {}
            file.visititems(lambda name, item: arrays.extend(_array(name, item)))
            file.visititems(lambda name, item: units.update(_unit(name, item)))
            file.visititems(lambda name, item: single.update(_single(name, item)))
            for name, shape, _ in arrays:
                must_be_held(path, name, max(shape))
            return cls(
                path,
                [c for array in arrays for c in columns_of(*array)],
                extra,
                [s for array in arrays for s in skipped(*array)],
                stated_rate(single),
                units,
            )

    @contextmanager
    def opened(self) -> Iterator[Any]:
        with _file(self.path, self.extra) as file:
            yield file


@contextmanager
def _file(path: Path, extra: str) -> Iterator[Any]:
    h5py = need("h5py", extra, path)
    with reading(path, "HDF5"), h5py.File(path, "r", rdcc_nbytes=CACHE) as file:
        yield file


def _single(name: str, item: Any) -> dict[str, Any]:
    """The value of an ``item`` that holds one alone, by its name, and those of its attributes."""
    found = {f"{name}/{key}": value for key, value in item.attrs.items()}
    if hasattr(item, "dtype") and item.size == 1 and item.dtype.kind in "iuf":
        found[name] = item[()]
    return found


def _unit(name: str, item: Any) -> dict[str, str]:
    """The unit of an ``item`` by its name, where an attribute says one that is known."""
    stated = next((item.attrs[key] for key in UNITS if key in item.attrs), None)
    stated = stated.decode("utf-8", "replace") if isinstance(stated, bytes) else stated
    known = isinstance(stated, str) and unit_of(stated) not in (None, "1")
    return {name: stated.strip()} if known else {}


def _array(name: str, item: Any) -> list[tuple]:
    """(name, shape, type) of an ``item`` that may be of numbers, or nothing."""
    kind = item.attrs.get("MATLAB_class", b"double")
    if (
        not hasattr(item, "dtype")
        or not item.shape
        or (bytes(kind).decode() not in NUMERIC and item.dtype.kind != "O")
    ):
        return []
    return [(name, item.shape, item.dtype)]
