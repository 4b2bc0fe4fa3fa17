"""An attitude filter as a block: what the filters have in common of names, start and step."""

from __future__ import annotations

import casadi as ca

from pyimu.attitude.filter import late_heading
from pyimu.attitude.filter.ahead import headings_of_the_sample, shown_now
from pyimu.attitude.filter.compensation import NOT_UNDONE, left_in
from pyimu.attitude.filter.layout import Layout
from pyimu.attitude.filter.memory import ESTIMATE, start
from pyimu.attitude.filter.updates import outputs
from pyimu.attitude.filter.variables import OUTPUTS
from pyimu.block.block import Block
from pyimu.block.plain import plain_function
from pyimu.block.prepared import Prepared
from pyimu.block.variables import Variable
from pyimu.model.part import Part


def filter_block(
    name: str,
    title: str,
    layout: Layout,
    step: ca.Function | Prepared,
    names: tuple[Variable, ...] = OUTPUTS,
) -> Block:
    """The block ``name`` of a filter with this ``step``; ``title`` begins its description.

    ``names`` are its outputs; other ones than those of the unit show nothing before the first
    sample.
    """
    part = layout.compensation.part
    p = ca.SX.sym("p", len(layout.parameters))
    estimate, state = start(layout.compensation, p)
    u = ca.SX.sym("u", len(layout.inputs))
    shown = outputs(estimate, 0, 0, 0, 0) if names is OUTPUTS else ca.SX.zeros(len(names))
    initial = plain_function("initial", [u, p], [state, shown], ["u", "p"], ["s", "y"])
    return Block(
        name=name,
        description=f"{title} of the part {part.name}{left_in_words(part)}",
        step=step.whole if isinstance(step, Prepared) else step,
        prepared=step if isinstance(step, Prepared) else None,
        initial=initial,
        inputs=layout.inputs,
        parameters=layout.parameters,
        outputs=names,
        noise=(),
        sample_period=1.0 / part.sample_rate,
    )


def left_in_words(part: Part, delayed: bool = False) -> str:
    """Which of the sensors' errors the filter leaves in, for the description.

    Delays are among them where the outputs are ``delayed``.
    """
    left = left_in(part, delayed=delayed)
    return f"; {NOT_UNDONE}: {', '.join(left)}" if left else ""


def inputs_of_the_sample(layout: Layout, symbols: list[ca.MX]) -> ca.MX:
    """The inputs as they were at the estimate's instant; ``symbols`` are s, u, p and h."""
    s, u, p, h = symbols
    if not layout.compensation.shows_now:
        return u
    return headings_of_the_sample(layout)(s[:ESTIMATE], s[ESTIMATE : layout.rings], u, p, h)


def step_function(
    layout: Layout,
    symbols: list[ca.MX],
    estimate,
    memory,
    motion,
    yaw,
    field,
    y,
    c: ca.MX | None = None,
) -> ca.Function:
    """The step ``(s, u, p, w, h) -> (s_next, y)`` of the block, without noise.

    ``symbols`` are s, u, p and h. ``estimate``, ``memory``, ``motion`` and ``field`` are the
    columns after the sample; its ``yaw`` and its variance about the vertical take their slot in the
    rings. Where they depend on constants ``c``, these are a last argument.
    """
    s, u, p, h = symbols
    if layout.compensation.shows_now:
        y = shown_now(layout)(estimate, ca.vertcat(memory, motion), y, p, h)
    vertical_noise, slot = memory[-4], memory[-3]
    rings = s[layout.rings : layout.field]
    rings.nz[slot + ca.DM([0, late_heading.SLOTS])] = ca.vertcat(yaw, vertical_noise)
    return plain_function(
        "step",
        [s, u, p, ca.MX.sym("w", 0, 1), h, *([] if c is None else [c])],
        [ca.vertcat(estimate, memory, motion, rings, field), y],
        ["s", "u", "p", "w", "h", *([] if c is None else ["c"])],
        ["s_next", "y"],
    )
