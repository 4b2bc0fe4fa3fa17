"""The scalars of a block, grouped into the arrays that their names say they are.

``G[1,1]`` to ``G[3,3]`` are a matrix ``G``, ``N[1]`` to ``N[3]`` a vector ``N``; a block lists the
elements row by row, and FMI's arrays are row by row, so nothing is turned. What is not a whole
array of one kind stays as it is: a matrix without its diagonal, and a vector whose elements have
different units, which an FMI array cannot have.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import prod
from os.path import commonprefix

import numpy as np

from pyimu.block.variables import Variable

_ELEMENT = re.compile(r"(?P<base>.+)\[(?P<index>\d+(?:,\d+)*)\]")


@dataclass(frozen=True)
class Array:
    """Some scalars that stand side by side, and the shape that they make; () for one by itself."""

    name: str
    elements: tuple[Variable, ...]
    shape: tuple[int, ...] = ()


def split_name(name: str) -> tuple[str, tuple[int, ...]]:
    """The array and the index, from one, that a name like ``G[1,2]`` says.

    It is ``(name, ())`` for other names.
    """
    found = _ELEMENT.fullmatch(name)
    return (
        (found["base"], tuple(int(i) for i in found["index"].split(","))) if found else (name, ())
    )


def scalars(variables: Iterable[Variable]) -> list[Array]:
    """Every variable by itself."""
    return [Array(v.name, (v,)) for v in variables]


def grouped(variables: Sequence[Variable]) -> list[Array]:
    """The variables in their order, neighbours that are one whole array as such."""
    groups: list[list[Variable]] = []
    for v in variables:
        base, index = split_name(v.name)
        if (
            groups
            and index
            and base == split_name(groups[-1][0].name)[0]
            and split_name(groups[-1][0].name)[1]
        ):
            groups[-1].append(v)
        else:
            groups.append([v])
    return [array for group in groups for array in _as_array(group)]


def _as_array(group: Sequence[Variable]) -> list[Array]:
    """One array where these are its elements, row by row, and of one kind; else each by itself."""
    base, _ = split_name(group[0].name)
    indices = [split_name(v.name)[1] for v in group]
    shape = indices[-1]
    alike = len({(v.unit, v.kind, v.minimum, v.maximum, v.fixed) for v in group}) == 1
    if (
        shape
        and alike
        and prod(shape) == len(group)
        and indices == [tuple(i + 1 for i in at) for at in np.ndindex(*shape)]
    ):
        return [Array(base, tuple(group), shape)]
    return scalars(group)


def description(array: Array) -> str:
    """The common part of the elements' descriptions.

    Where they differ ("rate, axis x") it ends before its last comma.
    """
    texts = [v.description for v in array.elements]
    common = commonprefix(texts)
    return common if len(set(texts)) == 1 else common.rpartition(",")[0]
