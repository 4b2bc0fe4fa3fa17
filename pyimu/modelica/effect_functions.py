"""The functions of an effect: its output, the next value of each state, the limits it keeps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca
import numpy as np

from pyimu.errors import UserError
from pyimu.model.chain import Chain, chain_of
from pyimu.model.effect import Effect
from pyimu.model.kinds import KINDS, OWN_RATE
from pyimu.model.signals import SIGNALS
from pyimu.modelica.functions import Argument, Function, array, function
from pyimu.modelica.names import camel, identifier

OUTPUT = "y"
"""The output of an effect."""

STARTED = "started"
"""Whether there has been a sample before this one."""


@dataclass(frozen=True)
class EffectFunctions:
    """The functions of an effect; ``following`` by the state whose next value they give,
    ``limits`` by the text of what is broken where they are true.

    A next value that is the output is not computed again, and the output is one of next values
    (arguments ``b_next``) where that makes its function shorter.
    """

    effect: Effect
    output: Function
    following: Mapping[str, Function]
    limits: Mapping[str, Function]
    waits: bool

    @property
    def all(self) -> list[Function]:
        """Those that are called."""
        return [
            f for f in (self.output, *self.following.values(), *self.limits.values()) if not f.plain
        ]

    def uses(self, name: str) -> bool:
        """Whether output or states depend on an argument."""
        return any(
            a.name == name for f in (self.output, *self.following.values()) for a in f.arguments
        )


def signal_of(e: Effect, argument: str, kind: str) -> str:
    """The name in ``SIGNALS`` of what an effect's environment argument is."""
    signal = e.environment[argument]
    return KINDS[kind].own_rate if signal == OWN_RATE else signal


def effect_functions(e: Effect) -> EffectFunctions:
    """Print an effect. Raises UserError where an operation cannot be said in Modelica."""
    kind = _kind(e)
    chain, what = chain_of(kind, (e,)), f"effect {e.name}"
    started = ca.SX.sym(STARTED) if chain.waits else None
    arguments = _arguments(chain, e, kind, started)
    y, after = chain.apply(e, chain.x, chain.noises[e.name], started)
    name = camel(e.name)
    positive = {n for n, q in e.parameters.items() if q.minimum and q.minimum > 0} | {"h"}
    following, at, known = {}, 0, []
    for state, q in e.states.items():
        given = array(next_of(state), q.shape, after[at : at + int(np.prod(q.shape))])
        at += int(np.prod(q.shape))
        following[state] = _next(name, state, given, arguments, y, what, positive)
        known += [] if following[state].plain else [given]
    outputs = [
        function(f"{name}Output", e.term, arguments, y, (3,), what, positive=positive, known=k)
        for k in ((), known)
    ]
    output = min(outputs, key=lambda f: len(f.lines) + len(f.variables))
    limits = {
        text: function(
            f"{name}Broken{i + 1}",
            f"True unless {text.replace('must', 'does', 1)}",
            arguments,
            ca.SX(broken(chain.h, **chain.parameters[e.name])),
            (),
            what,
            result="broken",
            boolean=True,
            positive=positive,
        )
        for i, (text, broken) in enumerate(e.limits.items())
    }
    return EffectFunctions(e, output, following, limits, chain.waits)


def next_of(state: str) -> str:
    """What the next value of a state is called among the arguments of the output."""
    return f"{identifier(state)}_next"


def _next(
    name: str,
    state: str,
    given: Argument,
    arguments: list[Argument],
    y: ca.SX,
    what: str,
    positive: set[str],
) -> Function:
    """The function of the next value ``given`` of a state; it is ``plain`` where that is the output
    ``y``, too.
    """
    forms = [
        function(
            f"{name}Next{state[0].upper()}{state[1:]}",
            f"{state} of the next sample",
            arguments,
            given.symbols,
            given.shape,
            what,
            result="following",
            positive=positive,
            known=known,
        )
        for known in ([array(OUTPUT, (3,), y)], ())
    ]
    return forms[0] if forms[0].plain == OUTPUT else forms[1]


def _kind(e: Effect) -> str:
    """A kind of sensor that has the effect and for which no signal is its own input."""
    for kind in e.sensors:
        if KINDS[kind].own not in e.environment.values():
            return kind
    raise UserError(
        f"effect {e.name}: an effect that names its own input as a signal has no Modelica form; "
        "use x"
    )


def _arguments(chain: Chain, e: Effect, kind: str, started: ca.SX | None) -> list[Argument]:
    """All that the effect's function may depend on, in the order of its definition."""
    slots = list(zip(ca.vertsplit(chain.p), chain.slots)) if chain.slots else []
    found = [array("x", (3,), chain.x)]
    for name, q in e.parameters.items():
        mine = [(symbol, slot.index) for symbol, slot in slots if slot.parameter == name]
        found.append(
            Argument(
                identifier(name),
                q.shape,
                ca.vertcat(*(symbol for symbol, _ in mine)),
                tuple(index for _, index in mine),
            )
        )
    for name in e.environment:
        signal = signal_of(e, name, kind)
        size = SIGNALS[signal].size
        shape = (size,) if size > 1 else ()
        found.append(array(identifier(name), shape, chain.signals[signal]))
    for name, q in e.states.items():
        found.append(array(identifier(name), q.shape, chain.states[e.name][name]))
    if started is not None:
        found.append(Argument(STARTED, (), started, ((),), boolean=True))
    for name, w in e.noises.items():
        found.append(array(identifier(name), (w.size,), chain.noises[e.name][name]))
    if e.period:
        found.append(array(identifier(e.period), (), chain.h))
    return found
