"""The table of an FMU's variables, the one source of its C, descriptions and documentation."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import accumulate

import casadi as ca

from pyimu.block.block import Block
from pyimu.block.cost import operations
from pyimu.block.variables import Variable
from pyimu.fmu.arrays import Array, description, grouped, scalars, split_name
from pyimu.fmu.unit_definitions import display_units

DEFAULT_SEED = 0
"""Stands for the instance's name, so that two sensors of a system to which nobody gave seeds do not
share their noise unseen. Every other seed gives the bits of ``pyimu.simulate`` under it; under 0
these are the ones of an instance that is called as its model is, as fmpy's are. A number and no
state of its own, because tools hand start values back to the unit."""

SEED = Variable(
    "seed",
    "1",
    "seed of the noise: other seeds, independent noise; 0: that of the instance's name",
    start=DEFAULT_SEED,
    minimum=0.0,
)

BLOCK_SIZE = "block_size"
"""The name of the parameter that the block form alone has."""

MOST_SAMPLES = 2**24
"""In a step at most, whatever the block: 4 h at 976 Hz are 14 million."""

MOST_OPERATIONS = 15 * 10**9
"""In a step at most, which nothing can break off: about ten seconds of the block that takes longest
for each of its operations (``RoverDrive``, 0.6 ns)."""

OF_A_NORMAL = 20
"""Operations that a number of the noise stands for."""

MOST_BY_DEFAULT = 2**15
"""Samples in a block at most unless another size is set. The start values of each stand in the
model description; the fastest parts on the market have 32 kHz."""

_CAUSALITY = {
    "time": {"causality": "independent", "variability": "continuous"},
    "input": {"causality": "input", "variability": "continuous"},
    "tunable": {"causality": "parameter", "variability": "tunable", "initial": "exact"},
    "fixed": {"causality": "parameter", "variability": "fixed", "initial": "exact"},
    "sampling": {"causality": "parameter", "variability": "fixed", "initial": "exact"},
    "structural": {"causality": "structuralParameter", "variability": "fixed", "initial": "exact"},
    "output": {"causality": "output", "variability": "discrete", "initial": "calculated"},
}

_TYPES = {
    "real": ("Real", "Float64"),
    "boolean": ("Boolean", "Boolean"),
    "integer": ("Integer", "Int32"),
    "unsigned": ("Integer", "UInt64"),
}

PARAMETERS = ("tunable", "fixed")
"""Roles of the block's own parameters, which can be set during a run or only before it. Sample
period and seed, which no function of the block takes for a parameter, have the role "sampling".
"""

_ROLE_TEXTS = {
    "time": "independent",
    "input": "input",
    "tunable": "parameter, tunable",
    "fixed": "parameter, fixed",
    "sampling": "parameter, fixed",
    "output": "output",
    "structural": "structural parameter",
}

_LINE = 150
"""Characters in a line of a list of start values, about."""


@dataclass(frozen=True)
class Entry:
    """One row of the table of variables.

    ``reference`` is its place there and its value reference.

    Its elements are columns of the block's inputs, parameters or outputs, from column ``first``
    on. ``rows`` is None but for the inputs and outputs of the block form, which have so many at
    start.
    """

    reference: int
    role: str
    kind: str
    array: Array
    first: int = 0
    rows: int | None = None
    rows_reference: int | None = None
    """Value reference of the parameter that says how many rows there are."""
    initial_dependencies: tuple[int, ...] = ()
    """Value references of inputs and parameters that an output's value before the first sample
    follows from."""
    sample_dependencies: tuple[str, ...] = ()
    """Names of the inputs that an output's value at a sample follows from."""
    display_unit: str | None = None
    """The unit in which people say it, where it is another."""
    causality: dict[str, str] = field(init=False)

    def __post_init__(self) -> None:
        causality = dict(_CAUSALITY[self.role])
        # A block of samples is no signal that an importer might interpolate.
        if self.role == "input" and (self.kind != "real" or self.rows is not None):
            causality["variability"] = "discrete"
        object.__setattr__(self, "causality", causality)

    @property
    def name(self) -> str:
        return self.array.name

    @property
    def variable(self) -> Variable:
        """The first element, which stands for all in unit, kind and bounds."""
        return self.array.elements[0]

    @property
    def count(self) -> int:
        return len(self.array.elements)

    @property
    def minimum(self) -> float:
        return -math.inf if self.variable.minimum is None else self.variable.minimum

    @property
    def maximum(self) -> float:
        return math.inf if self.variable.maximum is None else self.variable.maximum

    @property
    def description(self) -> str:
        return description(self.array)

    @property
    def unit(self) -> str | None:
        return self.variable.unit if self.kind == "real" else None

    @property
    def member(self) -> str:
        """Its name in the terminal that it belongs to."""
        name = self.variable.member or self.variable.name
        return split_name(name)[0] if self.array.shape else name

    @property
    def role_text(self) -> str:
        return _ROLE_TEXTS[self.role]

    @property
    def kind_text(self) -> str:
        return "integer" if self.kind == "unsigned" else self.kind

    @property
    def dimensions(self) -> list[dict[str, int]]:
        """The XML attributes of each dimension of an array, rows first."""
        first = self.rows_reference
        rows = [] if first is None else [{"valueReference": first}]
        return rows + [{"start": size} for size in self.array.shape]

    @property
    def shape_text(self) -> str:
        sizes = (["block_size"] if self.rows is not None else []) + [
            str(size) for size in self.array.shape
        ]
        return f"[{', '.join(sizes)}]" if sizes else ""

    @property
    def start(self) -> str | None:
        """The start values of one row; one value where all are the same."""
        if self.role in ("time", "output"):
            return None
        values = [self._text(v.start) for v in self.array.elements]
        return values[0] if len(set(values)) == 1 else " ".join(values)

    @property
    def bounds(self) -> dict[str, str]:
        v = self.variable
        bounds = {} if self.kind == "boolean" else {"min": v.minimum, "max": v.maximum}
        return {name: self._text(value) for name, value in bounds.items() if value is not None}

    @property
    def attributes(self) -> dict[str, str]:
        """The XML attributes of the variable's type: unit, bounds, start value.

        An array's start is a list of all its elements, row by row, or one value that all of them
        have.
        """
        start = self.start
        if start is not None and " " in start:
            start = textwrap.fill(
                " ".join([start] * (self.rows or 1)),
                _LINE,
                break_long_words=False,
                break_on_hyphens=False,
            )
        return (
            ({"unit": self.unit} if self.unit else {})
            | ({"displayUnit": self.display_unit} if self.display_unit else {})
            | self.bounds
            | ({} if start is None else {"start": start})
        )

    def _text(self, value: float) -> str:
        if self.kind == "boolean":
            return "true" if value else "false"
        return xml_number(value) if self.kind == "real" else str(int(value))

    def type(self, version: int) -> str:
        return _TYPES[self.kind][version - 2]


def default_block_size(block: Block) -> int:
    """Samples in a block unless another size is set: those of a second, within bounds."""
    return min(max(round(1 / block.sample_period), 1), MOST_BY_DEFAULT)


def entries(block: Block, in_blocks: bool) -> list[Entry]:
    """The table of variables: time, inputs, parameters, outputs, sample period.

    With noise it has the seed, in blocks their size, too.
    """
    rows = _rows(block, in_blocks)
    size: dict[str, int] = {}
    if in_blocks:
        reference = next(i for i, r in enumerate(rows) if r.role == "structural")
        size = {"rows": default_block_size(block), "rows_reference": reference}
    parameters = [i for i, r in enumerate(rows) if r.role in PARAMETERS for _ in r.array.elements]
    inputs = [i for i, r in enumerate(rows) if r.role == "input" for _ in r.array.elements]
    initial = [
        [*(inputs[i] for i in of_inputs), *(parameters[i] for i in of_parameters)]
        for of_inputs, of_parameters in zip(
            *(_dependencies(block.initial, 1, argument) for argument in (0, 1)), strict=True
        )
    ]
    sample = _dependencies(block.step, 1, 1)
    shown = display_units([*block.inputs, *block.parameters, *block.outputs])
    return [
        Entry(
            reference,
            row.role,
            row.kind,
            row.array,
            row.first,
            **(size if row.role in ("input", "output") else {}),
            initial_dependencies=_unique(i for c in row.outputs for i in initial[c]),
            sample_dependencies=_unique(
                rows[inputs[i]].array.name for c in row.outputs for i in sample[c]
            ),
            display_unit=shown.get(row.array.elements[0].name) if row.kind == "real" else None,
        )
        for reference, row in enumerate(rows)
    ]


@dataclass(frozen=True)
class _Row:
    """What is known of an entry before all of them are: see there."""

    role: str
    kind: str
    array: Array
    first: int

    @property
    def outputs(self) -> range:
        """Its columns among the outputs of the block."""
        return range(self.first, self.first + len(self.array.elements) * (self.role == "output"))


def _rows(block: Block, in_blocks: bool) -> list[_Row]:
    """The table's rows, in their order."""
    group = grouped if in_blocks else scalars
    time = Variable("time", "s", "simulation time")
    parts = [
        ("time", scalars([time])),
        # Before the arrays that have so many rows: readers look a dimension up as they meet it.
        ("structural", scalars([_size(block)] * in_blocks)),
        ("input", group(block.inputs)),
        ("parameter", group(block.parameters)),
        ("output", group(block.outputs)),
        ("sampling", scalars([_period(block), *[SEED] * bool(block.noise)])),
    ]
    unsigned = (SEED.name, BLOCK_SIZE)
    return [
        _Row(
            PARAMETERS[array.elements[0].fixed] if role == "parameter" else role,
            "unsigned" if array.name in unsigned else array.elements[0].kind,
            array,
            first,
        )
        for role, arrays in parts
        for array, first in _with_columns(arrays)
    ]


def _period(block: Block) -> Variable:
    return Variable(
        "sample_period", "s", "time between two samples", start=block.sample_period, minimum=0.0
    )


def most_samples(block: Block) -> int:
    """Samples that a step, or a block of the block form, has at most."""
    each = operations(block.step) + OF_A_NORMAL * len(block.noise)
    return max(MOST_BY_DEFAULT, min(MOST_SAMPLES, MOST_OPERATIONS // max(1, each)))


def _size(block: Block) -> Variable:
    return Variable(
        BLOCK_SIZE,
        "1",
        "rows of inputs and outputs: most samples in a step, row i for sample i of the step",
        start=default_block_size(block),
        minimum=1,
        maximum=most_samples(block),
    )


def _with_columns(arrays: list[Array]) -> Iterable[tuple[Array, int]]:
    """Each array with its first column."""
    return zip(arrays, accumulate((len(a.elements) for a in arrays), initial=0))


def _unique(items: Iterable) -> tuple:
    """Each item once, where it comes first."""
    return tuple(dict.fromkeys(items))


def _dependencies(function: ca.Function, output: int, argument: int) -> list[list[int]]:
    """For each row of the output, the sorted rows of the argument that it depends on."""
    depends: list[list[int]] = [[] for _ in range(function.numel_out(output))]
    if depends and function.numel_in(argument):
        for row, column in sorted(zip(*function.jac_sparsity(output, argument).get_triplet())):
            depends[row].append(column)
    return depends


def xml_number(x: float) -> str:
    """The shortest decimal that reads back as the same double.

    What is no number has XML's name.
    """
    x = float(x)
    return repr(x) if math.isfinite(x) else "NaN" if math.isnan(x) else "INF" if x > 0 else "-INF"
