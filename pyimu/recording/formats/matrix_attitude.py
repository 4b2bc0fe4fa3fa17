"""An attitude that a file has as the nine numbers of a rotation matrix.

Qualisys Track Manager writes them column by column, ``Rot[0]`` to ``Rot[8]``, of the rotation from
the body to the world (its manual, "TSV file formats").
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from pyimu.errors import Finding
from pyimu.recording.formats.reader import Columns, Reader, ReaderOver

_ELEMENT = re.compile(r"(.*) Rot\[([0-8])\]")

ORTHOGONAL = 0.01
"""By how much an element of R^T R may be off the unit matrix's: elements of three digits."""


@dataclass(frozen=True)
class MatrixAttitudeReader(ReaderOver):
    """What ``reader`` reads, and behind it the attitude w, x, y, z of each body of ``bodies``: its
    name, and the positions of its nine columns.
    """

    reader: Reader
    bodies: tuple[tuple[str, tuple[int, ...]], ...]

    @property
    def header(self) -> list[str]:  # type: ignore[override]
        return [
            *self.reader.header,
            *(f"{body} attitude {a}" for body, _ in self.bodies for a in "wxyz"),
        ]

    @property
    def findings(self) -> tuple[Finding, ...]:  # type: ignore[override]
        said = f"the attitude is that of {self.bodies[0][0]} Rot[0] to Rot[8], column by column"
        return (*self.reader.findings, Finding("layout", "ref_q", 1, {"read_as": said}))

    def batches(self, positions: Sequence[int], long: int) -> Iterator[tuple[Columns, float]]:
        width = len(self.reader.header)
        made = {p: divmod(p - width, 4) for p in positions if p >= width}
        theirs = [p for p in positions if p < width]
        theirs += [
            k for body in dict.fromkeys(b for b, _ in made.values()) for k in self.bodies[body][1]
        ]
        asked = list(dict.fromkeys(theirs))
        for columns, share in self.reader.batches(asked, long if long in asked else asked[0]):
            of = dict(zip(asked, columns, strict=True))
            bodies = {b for b, _ in made.values()}
            turned = {b: attitudes([of[k] for k in self.bodies[b][1]]) for b in bodies}
            yield (
                [of[p] if p < width else turned[made[p][0]][:, made[p][1]] for p in positions],
                share,
            )

    def count(self, long: int) -> int | None:
        return self.reader.count(min(long, len(self.reader.header) - 1))

    def numeric(self) -> list[int]:
        width, theirs = len(self.reader.header), self.reader.numeric()
        whole = [b for b, (_, at) in enumerate(self.bodies) if set(at) <= set(theirs)]
        return [*theirs, *(width + 4 * b + k for b in whole for k in range(4))]


def attitudes(elements: Sequence[np.ndarray]) -> np.ndarray:
    """Quaternions (n, 4), scalar first, of nine columns (n,): a matrix column by column.

    NaN where they are no rotation, as zeros are where a body was not seen.
    """
    matrix = np.column_stack(elements).astype(float).reshape(-1, 3, 3).transpose(0, 2, 1)
    matrix[~(np.abs(matrix) < 2).all(axis=(1, 2))] = 0.0  # of a rotation none is beyond 1
    product = np.einsum("nji,njk->nik", matrix, matrix)
    off = np.max(np.abs(product - np.eye(3)), axis=(1, 2))
    seen = (off < ORTHOGONAL) & (np.linalg.det(matrix) > 0)
    found = np.full((len(matrix), 4), np.nan)
    if seen.any():
        found[seen] = Rotation.from_matrix(matrix[seen]).as_quat(scalar_first=True)
    return found


def elements(header: Sequence[str]) -> set[int]:
    """Positions of the columns that are elements of a rotation."""
    return {k for k, cell in enumerate(header) if _ELEMENT.fullmatch(cell)}


def with_attitude(reader: Reader) -> Reader:
    """``reader`` with the attitudes of the bodies of which it has all nine elements."""
    found: dict[str, dict[int, int]] = {}
    for position, cell in enumerate(reader.header):
        match = _ELEMENT.fullmatch(cell)
        if match:
            found.setdefault(match[1], {})[int(match[2])] = position
    whole = {body: at for body, at in found.items() if len(at) == 9}
    if not whole or isinstance(reader, MatrixAttitudeReader):
        return reader
    ordered = ((body, tuple(at[k] for k in range(9))) for body, at in whole.items())
    return MatrixAttitudeReader(reader, tuple(ordered))
