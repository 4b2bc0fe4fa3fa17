"""Every library that the package imports is declared: as a dependency where it is always there, in
an extra where what needs it says so in a line. One that another library happens to bring is not.
"""

import ast
import re
import sys
import tomllib
from functools import cache
from importlib.metadata import packages_distributions
from typing import NamedTuple

import pytest
from places import CHECKOUT

PACKAGE = CHECKOUT / "pyimu"


class Used(NamedTuple):
    """A top-level module that a file imports; ``extra`` is "" where it may be any, None where the
    import is not guarded.
    """

    module: str
    where: str
    extra: str | None


def plain(name):
    """A distribution's name as pip compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()


@pytest.fixture(scope="module")
def project():
    return tomllib.loads((CHECKOUT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def names(requirements):
    return {plain(re.match(r"[\w.-]+", line)[0]) for line in requirements}


@cache
def installed():
    """Distributions by the modules that they bring; it takes a second to ask."""
    return packages_distributions()


def distributions(module):
    return {plain(name) for name in installed().get(module, [module])}


def used(tree, where):
    """What a file imports, but for what only types need."""
    yield from _used(tree, where, None)


def _used(node, where, extra):
    if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
        children = node.orelse
    elif isinstance(node, ast.Try) and any(map(_catches_missing, node.handlers)):
        for child in node.body:
            yield from _used(child, where, "")
        children = [*node.handlers, *node.orelse, *node.finalbody]
    else:
        children = list(ast.iter_child_nodes(node))
    for module, own in _named(node):
        top = module.partition(".")[0]
        if top not in sys.stdlib_module_names and top != "pyimu":
            yield Used(top, f"{where}:{node.lineno}", own if own is not None else extra)
    for child in children:
        yield from _used(child, where, extra)


def _catches_missing(handler):
    return handler.type is not None and "ImportError" in ast.unparse(handler.type)


def _named(node):
    """Modules that a node imports by itself, each with the extra that it names."""
    if isinstance(node, ast.Import):
        return [(alias.name, None) for alias in node.names]
    if isinstance(node, ast.ImportFrom) and node.level == 0:
        return [(node.module, None)]
    if isinstance(node, ast.Call):
        called = ast.unparse(node.func).rpartition(".")[2]
        texts = [a.value if isinstance(a, ast.Constant) else "" for a in node.args]
        if called == "need" and texts[0]:
            return [(texts[0], texts[1])]
        if called == "find_spec" and texts[0]:
            return [(texts[0], "")]
        if called == "import_module" and texts[0]:
            return [(texts[0], None)]
    return []


def undeclared(found, project):
    """What is wrong with the imports ``found``."""
    runtime = names(project["dependencies"])
    extras = {k: names(v) for k, v in project["optional-dependencies"].items()}
    for k in ("test", "lint", "docs", "bench"):
        extras.pop(k)  # for those who work on the package
    for module, where, extra in found:
        own = distributions(module)
        if own & runtime:
            continue
        offered = set().union(*extras.values()) if extra == "" else extras.get(extra, set())
        if not own & offered:
            yield f"{where}: {module}"


@pytest.fixture(scope="module")
def found():
    return [
        each
        for path in sorted(PACKAGE.rglob("*.py"))
        for each in used(ast.parse(path.read_text("utf-8")), path.relative_to(CHECKOUT))
    ]


def test_every_import_is_declared(found, project):
    assert not list(undeclared(found, project))


def test_every_dependency_is_imported(found, project):
    """What is installed for everyone is needed; ``control`` and the like are imported late."""
    imported = set().union(*(distributions(each.module) for each in found))
    assert names(project["dependencies"]) <= imported


def test_every_extra_of_users_is_imported(found, project):
    imported = set().union(*(distributions(each.module) for each in found))
    apart = {"test", "lint", "docs", "bench", "simulators"}
    for extra, lines in project["optional-dependencies"].items():
        assert extra in apart or names(lines) <= imported, extra


@pytest.mark.parametrize(
    "text, wrong",
    [
        ("import lxml", True),
        ("def f():\n    from lxml import etree", True),
        ("import numpy.linalg", False),
        ("import pandas", True),
        ("try:\n    import pandas\nexcept ImportError:\n    pandas = None", False),
        ("try:\n    import pandas\nexcept ValueError:\n    pass", True),
        ("try:\n    import lxml\nexcept ImportError:\n    lxml = None", True),
        ("try:\n    pass\nexcept ImportError:\n    import pandas", True),
        ("if TYPE_CHECKING:\n    import lxml", False),
        ("if TYPE_CHECKING:\n    pass\nelse:\n    import lxml", True),
        ("need('h5py', 'hdf5', path)", False),
        ("need('h5py', 'ros', path)", True),
        ("need('h5py', extra, path)", False),
        ("importlib.import_module('pytest')", True),
    ],
)
def test_what_counts_as_undeclared(text, wrong, project):
    assert bool(list(undeclared(used(ast.parse(text), "x.py"), project))) == wrong
