"""Words of 16 bits whose sign was lost: -1 is 65535 in them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from pyimu.errors import Finding, UserError
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver
from pyimu.recording.naming.name import named

WORD = 1 << 16

SMOOTHER = 8.0
"""Times as large as with a sign the mean step of a column must be without: each step across zero is
one of the whole word then. A counter that begins anew steps as far either way."""

LEAST_ROWS = 100
"""Rows that tell it."""


@dataclass(frozen=True)
class SignedReader(ReaderOver):
    """What ``reader`` reads, where the columns at ``signed`` are words in two's complement."""

    reader: Reader
    signed: frozenset[int]

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        detail = {"columns": ", ".join(self.header[k] for k in sorted(self.signed))}
        return (*self.reader.findings, Finding("sign_lost", "", len(self.signed), detail))

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        for columns, share in self.reader.batches(positions, long):
            pairs = zip(positions, columns, strict=True)
            yield [with_sign(c) if k in self.signed else c for k, c in pairs], share

    def count(self, long: int) -> int | None:
        return self.reader.count(long)

    def numeric(self) -> list[int]:
        return self.reader.numeric()


def with_sign(words: np.ndarray) -> np.ndarray:
    """Words (n,) in two's complement as numbers with their sign."""
    return np.where(words >= WORD // 2, words - WORD, words)


def with_signs(reader: Reader) -> Reader:
    """``reader`` with the sign of vectors of whole numbers without one, of which a column steps
    across zero in the first rows.
    """
    if reader.crowded or reader.in_memory:
        return reader
    at = [k for k in reader.numeric() if named(reader.header[k]).axis]
    if len(at) < 3:
        return reader
    try:
        found = [columns for columns, _ in islice(reader.batches(at, -1), 1)]
    except UserError:  # it is said where the log is read
        return reader
    words = {k: c for k, c in zip(at, found[0], strict=True) if _are_words(c)} if found else {}
    stems = {named(reader.header[k]).words for k, c in words.items() if _lost(c)}
    signed = frozenset(k for k in words if named(reader.header[k]).words in stems)
    return SignedReader(reader, signed) if signed else reader


def _are_words(column: np.ndarray) -> bool:
    known = column[np.isfinite(column)]
    if len(known) < LEAST_ROWS or known.min() < 0 or known.max() >= WORD:
        return False
    return bool(np.all(known == np.rint(known)))


def _lost(column: np.ndarray) -> bool:
    """Whether a column is much smoother with a sign."""
    known = column[np.isfinite(column)]
    without, with_it = (float(np.abs(np.diff(c)).mean()) for c in (known, with_sign(known)))
    return known.max() >= WORD // 2 and without > SMOOTHER * with_it > 0
