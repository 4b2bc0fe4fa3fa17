"""The shaping filters of the noises in continuous time, with spectrum and Allan deviation."""

from __future__ import annotations

import html
from collections.abc import Mapping
from dataclasses import dataclass

from pyimu.model.catalogue import CATALOGUE
from pyimu.model.effects.noise import DECADES, POLES, end_weight
from pyimu.model.law import Law
from pyimu.modelica.bounds import bound_asserts
from pyimu.modelica.effect_functions import effect_functions
from pyimu.modelica.names import pascal
from pyimu.modelica.text import GENERATED, comment, number, rendered, wrapped
from pyimu.modelica.unit_names import modelica_unit
from pyimu.shaping.continuous import has_filter


@dataclass(frozen=True)
class Filter:
    """Equations of a filter from white noises ``u`` of density 1 to the noise ``y``."""

    equations: tuple[str, ...]
    hidden: tuple[str, ...] = ()
    size: str = ""


def _flicker() -> Filter:
    """The sum of Gauss-Markov processes of ``bias_instability``, each with its own white noise."""
    low, high = (f"{10**d}" for d in DECADES)
    base, slope = end_weight(float("inf")), end_weight(1.0) - end_weight(float("inf"))
    return Filter(
        (
            f"for k in 1:{POLES} loop",
            "  der(b[k]) = -rate[k]*b[k] + strength[k]*u[k];",
            "end for;",
            "y = sum(b);",
        ),
        (
            f"parameter Real spacing = log(min(max(f_high/f_low, {low}), {high}))/{POLES - 1}",
            '  "Of the rates, in the natural logarithm";',
            f"parameter Real rate[{POLES}] = {{2*Modelica.Constants.pi*f_low*exp((k - 1)*spacing)",
            f'  for k in 1:{POLES}}} "1/s";',
            f"parameter Real strength[{POLES}] = {{B*sqrt(2*rate[k]*spacing/Modelica.Constants.pi",
            f"  *(if k == 1 or k == {POLES} then {number(base)} + {slope:.12g}/spacing else 1))",
            f"  for k in 1:{POLES}}};",
            f"Real b[{POLES}](each start=0, each fixed=true);",
        ),
        f"[{POLES}]",
    )


_MARKOV = Filter(("der(b) = -b/tau + q*u;", "y = b;"), ("Real b(start=0, fixed=true);",))

FILTERS: Mapping[str, Filter] = {
    "angle_random_walk": Filter(("y = N*u;",)),
    "rate_random_walk": Filter(("der(b) = K*u;", "y = b;"), ("Real b(start=0, fixed=true);",)),
    "gauss_markov": _MARKOV,
    "second_gauss_markov": _MARKOV,
    "bias_instability": _flicker(),
    "rate_dependent_noise": Filter(("y = k*abs(x)*u;",)),
}
"""Every noise in continuous time, by the name of its effect."""


def filter_texts() -> dict[str, str]:
    """Name to text of the filter of each noise that has one."""
    have = {e.name for e in CATALOGUE.values() if has_filter(e.law)}
    if have != set(FILTERS):
        raise ValueError(f"shaping filters: {', '.join(have ^ set(FILTERS))} without equations")
    return {pascal(name): _text(name, found) for name, found in FILTERS.items()}


def _text(name: str, found: Filter) -> str:
    e = CATALOGUE[name]
    parameters, asserts = [], []
    for n, q in e.parameters.items():
        asserts += bound_asserts(name, n, False, q.minimum, q.maximum)
        unit = None if "{" in q.unit else modelica_unit(q.unit)
        shown = f'(unit="{unit}")' if unit else ""
        start = q.start or 1.0
        said = q.description + ("" if unit else f" [{q.unit}]")
        parameters.append(f"parameter Real {n}{shown} = {number(start)}{comment(said)};")
    for text, broken in effect_functions(e).limits.items():
        call = f"PyImu.Effects.{pascal(name)}.{broken.call({})}"
        asserts += wrapped(f'assert(not {call}, "{name}: {text}");')
    if e.law.needs("x"):
        parameters.append('parameter Real x = 1 "Input of the axis";')
    return GENERATED + rendered(
        "filter.mo",
        name=pascal(name),
        effect=e,
        parameters=parameters,
        size=found.size,
        hidden=found.hidden,
        equations=(*asserts, *found.equations),
        documentation=_documentation(e.law),
    )


def _documentation(law: Law) -> str:
    rows = {
        "transfer function": law.transfer,
        "poles": law.poles,
        "two-sided density of the samples": law.psd,
        "Allan deviation": law.allan,
    }
    lines = [f"<li>{what}: <code>{html.escape(text)}</code></li>" for what, text in rows.items()]
    note = [f"<p>{html.escape(law.note)}</p>"] if law.note else []
    units = "<p>In LaTeX; {y} is the unit of the output, {Y} that of its integral.</p>"
    return "\n".join(["<ul>", *lines, "</ul>", units, *note])
