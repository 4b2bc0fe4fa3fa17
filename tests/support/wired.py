"""A system of units as its blocks in Python: what every master that exchanges between steps gives.

Written without fmpy: a unit's sample k has for inputs what the others show at sample k - 1.
"""

import numpy as np

from pyimu.block.block import Block
from pyimu.fmu.system import System


def in_python(
    system: System,
    blocks: dict[str, Block],
    steps: int,
    *,
    first: float | None = None,
) -> dict[str, np.ndarray]:
    """Rows (steps + 1,) of every output by its name in the system; row 0 is before the first step.

    ``first``, if given, is what all wired inputs are in the first step; else values are exchanged
    while the units initialize, until nothing changes.
    """
    shown = _shown(system, blocks, len(blocks) if first is None else 0)
    rows = {}
    for name in _in_order(system):
        block, p, h = blocks[name], _values(system, blocks, name), _period(system, name)
        u = np.tile(block.start_inputs, (steps, 1))
        for column, source in _sources(system, block, name):
            u[0, column] = shown[source] if first is None else first
            u[1:, column] = rows[source][1:-1]
        seed = int(_component(system, name).value("seed") or 0) if block.noise else None
        y = block.run(u, p=p, seed=seed, sample_period=h)[0]
        for variable, column in zip(block.outputs, y.T, strict=True):
            full = f"{name}.{variable.name}"
            rows[full] = np.concatenate([[shown[full]], column])
    return rows


def _shown(system, blocks, passes):
    """What is shown before the first step."""
    inputs = {name: block.start_inputs.copy() for name, block in blocks.items()}
    shown: dict[str, float] = {}
    for i in range(passes + 1):
        for name, block in blocks.items() if i else ():
            for column, source in _sources(system, block, name):
                inputs[name][column] = shown[source]
        for name, block in blocks.items():
            y = np.array(block.initial(inputs[name], _values(system, blocks, name))[1]).ravel()
            shown |= {f"{name}.{v.name}": value for v, value in zip(block.outputs, y, strict=True)}
    return shown


def _component(system, name):
    return next(c for c in system.components if c.name == name)


def _values(system, blocks, name):
    bound = _component(system, name).parameters
    return np.array([float(bound.get(v.name, v.start)) for v in blocks[name].parameters])


def _period(system, name):
    return _component(system, name).value("sample_period")


def _sources(system, block, name):
    columns = {v.name: i for i, v in enumerate(block.inputs)}
    return [
        (columns[w.input.name], f"{w.start.name}.{w.output.name}")
        for w in system.wires
        if w.end.name == name
    ]


def _in_order(system):
    """The units, each after those that feed it."""
    feeds = {c.name: {w.start.name for w in system.wires if w.end is c} for c in system.components}
    order: list[str] = []
    while len(order) < len(feeds):
        order += [n for n, before in feeds.items() if n not in order and before <= set(order)]
    return order
