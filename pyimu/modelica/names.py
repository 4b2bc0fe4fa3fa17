"""Names as Modelica has them: packages and blocks in PascalCase, all else in camelCase."""

from __future__ import annotations

import re

KEYWORDS = frozenset(
    "algorithm and annotation assert block break class connect connector constant "
    "constrainedby der discrete each else elseif elsewhen encapsulated end enumeration equation "
    "expandable extends external false final flow for function if import impure in initial inner "
    "input loop model not operator or outer output package parameter partial protected public pure "
    "record redeclare replaceable return stream then time true type when while within".split()
)
"""Words of the language, and ``time``, which it defines (Modelica specification 3.6, 2.3.3)."""


BUILTIN = frozenset(
    "abs acos asin atan atan2 cardinality cat ceil change cos cosh cross delay diagonal div edge "
    "exp fill floor homotopy identity integer linspace log log10 matrix max min mod noEvent ones "
    "outerProduct pre product rem reinit sample scalar semiLinear sign sin sinh size skew smooth "
    "sqrt String sum symmetric tan tanh terminal terminate transpose vector zeros Boolean Integer "
    "Real Modelica PyImu".split()
)
"""Names that mean something everywhere (Modelica specification 3.6, chapters 3 and 10), and those
of the two libraries."""

RESERVED = frozenset({"x", "y", "y0", "following", "broken", "samplePeriod"})
"""Names that the blocks of effects give a meaning."""


def pascal(name: str) -> str:
    """``g_sensitivity`` as ``GSensitivity``; what is no letter or digit parts words."""
    words = [word for word in re.split(r"[^0-9A-Za-z]+", name) if word]
    text = "".join(word[0].upper() + word[1:] for word in words)
    return text if text[:1].isalpha() else f"Part{text}"


def camel(name: str) -> str:
    """``g_sensitivity`` as ``gSensitivity``."""
    text = pascal(name)
    return text[0].lower() + text[1:]


def identifier(name: str) -> str:
    """The name of an effect's argument as one of Modelica."""
    return f"{name}_" if name in KEYWORDS | RESERVED | BUILTIN else name


def indexed(name: str, index: tuple[int, ...]) -> str:
    """The element of an array whose index counts from 0."""
    return f"{name}[{','.join(str(i + 1) for i in index)}]" if index else name


def string(text: str) -> str:
    """Text between the quotes of a Modelica string."""
    return text.replace("\\", "\\\\").replace('"', '\\"')
