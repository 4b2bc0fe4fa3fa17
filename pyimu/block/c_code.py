"""Functions of casadi in C, with what of it costs time written anew."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

import casadi as ca

from pyimu.block.straight import straight

FASTER = {
    "casadi_copy(const casadi_real* x, casadi_int n, casadi_real* y) {": (
        "casadi_copy(const casadi_real* restrict x, casadi_int n, casadi_real* restrict y) {"
    ),
    "return fmax(x, y);": "return x >= y || y != y ? x : y;",
    "return fmin(x, y);": "return x <= y || y != y ? x : y;",
}
"""Lines of casadi's runtime and what stands for them, which gives the same bits.

What is copied never overlaps what it is copied to; a compiler that knows it copies whole blocks.
A call of fmax has the registers saved and loaded again; compared in place it takes two
instructions, and as in C the other argument stands for a NaN."""

_IF_GIVEN = re.compile(r"arg\[(\d+)\]\? (arg\[\1\]\[\d+\]) : 0;")
"""Casadi reads an argument that is not given as zeros; here every argument is given."""

_FUNCTION = re.compile(r"^(?=static int |CASADI_SYMBOL_EXPORT int )", re.MULTILINE)

_DEFINED = re.compile(
    r"(?P<head>^/\* (?P<name>\w+):.*\n(?:static|CASADI_SYMBOL_EXPORT) int .*\{\n)(?:.*\n)*?\}\n",
    re.MULTILINE,
)
"""The definition of a function, behind casadi's comment of what it takes and gives."""

_LEFT_OUT = re.compile(r"\bres\d+\[\d+\]=0;")
"""A result that a caller does not ask for."""

_COPIED = re.compile(
    r"^  (?:if \(res\[\d+\]\) )?casadi_copy\((w\d+), \d+, ((res\[\d+\])(?:\+\d+)?)\);\n",
    re.MULTILINE,
)
"""A work vector that becomes a result, or a part of one."""


_ENTRIES_SET = re.compile(
    r"^  casadi_copy\((wr\d+), (\d+), (w\d+)\);\n"
    r"(  for \(cs=.* i=\(int\) \*cr\+\+; if \(i>=0 && i<\2\)) \3\[i\] = \*cs; \}\n",
    re.MULTILINE,
)
"""A work vector that is a part of an argument but for a few entries."""


Body = Callable[[ca.Function], str | None]
"""What writes a function's body; None where casadi's stays."""


def c_code(name: str, functions: Iterable[ca.Function], body: Body = straight) -> str:
    """The C of ``functions``, as casadi writes it for a file ``name``, but for each ``body``.

    Whoever calls them gives every argument, and to every result a place that is no other's.
    """
    functions, generator = [*functions], ca.CodeGenerator(name)
    for function in functions:
        generator.add(function)
    text = generator.dump()
    for line, faster in FASTER.items():
        text = text.replace(line, faster)
    functions_in_c = _FUNCTION.split(_IF_GIVEN.sub(r"\2;", text))
    found = "".join(_in_place(function) for function in functions_in_c)
    return found if _LEFT_OUT.search(found) else _with_bodies(found, _by_name(functions), body)


def with_entries_set(text: str) -> str:
    """The C ``text`` of a step whose first result, where it is the first argument but for a few
    entries, has only these written: into both.

    It serves who begins with both alike, and gives what was the argument as the place of the next
    result. A ring of which each sample writes one entry is then never copied.
    """
    functions = _FUNCTION.split(text)
    return "".join(map(_entries_set, functions))


def _entries_set(function: str) -> str:
    found = _ENTRIES_SET.search(function)
    if found is None or not function.startswith("static int casadi_f0("):
        return function
    taken, _, made, loop = found.groups()
    source = re.search(rf"^  {taken} = (wr\d+)\+(\d+);", function, re.MULTILINE)
    if source is None:
        return function
    whole, at = source.groups()
    same = f"  {whole} = arg[0]" in function and f"*{made}=res[0] ? res[0]+{at} :" in function
    after = function.partition(found[0])[2]
    if not same or re.search(r"\bwr\d|\barg\d*\[", after):  # which may read the argument
        return function
    both = f"{loop} {made}[i] = ((casadi_real *) {taken})[i] = *cs; }}\n"
    return function.replace(found[0], both)


def _by_name(functions: Iterable[ca.Function]) -> dict[str, ca.Function]:
    """The plain lists of operations among ``functions`` and what they call, by their names; of a
    name that two have, none.
    """
    found: dict[str, dict[int, ca.Function]] = {}
    for one in functions:
        for f in (one, *one.find_functions()):
            found.setdefault(f.name(), {})[hash(f)] = f
    alone = {name: [*same.values()] for name, same in found.items()}
    return {n: f[0] for n, f in alone.items() if len(f) == 1 and f[0].is_a("SXFunction")}


def _with_bodies(text: str, functions: dict[str, ca.Function], body: Body) -> str:
    """The C ``text`` with a ``body`` of each of these ``functions`` in place of casadi's."""

    def of(match: re.Match) -> str:
        made = body(functions[match["name"]]) if match["name"] in functions else None
        return match[0] if made is None else f"{match['head']}{made}}}\n"

    return _DEFINED.sub(of, text)


def _in_place(function: str) -> str:
    """A function in C whose results are made where they belong, and not copied there.

    That is so for a work vector that becomes one result, and is only read after that. A result that
    nobody asks for has no place, and is made in the work vector.
    """
    for copy in _COPIED.finditer(function):
        vector, place, result = copy.groups()
        own = re.compile(rf"\*{vector}=(w\+\d+)(?=[,;])")
        used = rf"(?<!\w){vector}(?!\w)"
        after = function.partition(copy[0])[2]
        read = re.findall(rf"(?:cs!?=|arg\d*\[\d+\]=){used}", after)
        if own.search(function) and len(read) == len(re.findall(used, after)):
            function = function.replace(copy[0], "", 1)
            function = own.sub(rf"*{vector}={result} ? {place} : \1", function, count=1)
    return function
