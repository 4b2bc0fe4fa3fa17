"""Imports run one way: no circle, and folders only downwards, in the order of CONTRIBUTING.md."""

import ast
import re
from graphlib import CycleError, TopologicalSorter

import pytest
from places import CHECKOUT

PACKAGE = CHECKOUT / "pyimu"

ORDERED = ("pyimu", "pyimu.identification")
"""Folders of whose rooms CONTRIBUTING.md has a line each, in this order."""

LATE = {
    "pyimu.cli",
    "pyimu.cli.bugs",
    "pyimu.cli.attitude",
    "pyimu.cli.campaigns",
    "pyimu.cli.choices",
    "pyimu.cli.heading",
    "pyimu.cli.inspect",
    "pyimu.cli.logs",
    "pyimu.cli.models",
    "pyimu.cli.navigation",
    "pyimu.cli.options",
    "pyimu.block.block",
    "pyimu.block.stepping",
    "pyimu.characterization.report.magnetometer",
    "pyimu.characterization.run",
    "pyimu.model.tolerance",
    "pyimu.model.truth",
    "pyimu.recording.fixes",
}
"""Modules with imports of the package inside functions: casadi, scipy and numba take seconds, which
``pyimu --help``, a compiled run and most logs do without."""


def module_of(path):
    """``pyimu.model.part`` of its file; a folder's ``__init__`` is the folder."""
    parts = path.relative_to(CHECKOUT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def sources():
    """Module to the trees of its files; the names of the package are in ``__init__.pyi``."""
    trees = {}
    for path in sorted(PACKAGE.rglob("*.py*")):
        if path.suffix in (".py", ".pyi"):
            tree = ast.parse(path.read_text(encoding="utf-8"))
            trees.setdefault(module_of(path), []).append((path.name.startswith("__init__"), tree))
    return trees


def imported(tree, module, is_folder, known):
    """Modules of the package that a file imports: anywhere in it, for types only or not."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (a.name for a in node.names if a.name.split(".")[0] == "pyimu")
        elif isinstance(node, ast.ImportFrom):
            base = absolute(node, module, is_folder)
            if base.split(".")[0] == "pyimu":
                full = [f"{base}.{a.name}" for a in node.names]
                yield from (name if name in known else base for name in full)


def absolute(node, module, is_folder):
    """The module that ``from ... import`` names, however many dots it has."""
    if not node.level:
        return node.module
    parts = module.split(".")
    folder = parts[: len(parts) - node.level + is_folder]
    return ".".join([*folder, *([node.module] if node.module else [])])


@pytest.fixture(scope="module")
def edges():
    """Module to the modules that it imports."""
    trees = sources()
    return {
        module: {
            name
            for is_folder, tree in files
            for name in imported(tree, module, is_folder, trees)
            if name != module
        }
        for module, files in trees.items()
    }


def declared_order(folder):
    """The groups of rooms of a folder, from the bottom to the top, that CONTRIBUTING.md says."""
    text = (CHECKOUT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    lines = re.findall(r"^    (\S.* -> .*)$", text, re.MULTILINE)
    line = dict(zip(ORDERED, lines, strict=True))[folder]
    return [[room.strip() for room in group.strip(" ()").split("|")] for group in line.split("->")]


def room(module, folder):
    """The folder or the file in ``folder`` that has a module; the folder's own names have its."""
    inside = folder.rpartition(".")[2] if module == folder else module.removeprefix(f"{folder}.")
    return inside.split(".")[0]


def modules_of(edges, folder):
    """What lies in a folder; its own names are among it where they are from elsewhere."""
    return {m for m in edges if m.startswith(f"{folder}.") or (m == folder and edges[m])}


def grouped(edges, key):
    """The edges between what ``key`` says of the modules; None is left out."""
    groups = {}
    for module, names in edges.items():
        if key(module) is not None:
            found = {key(name) for name in names} - {None, key(module)}
            groups.setdefault(key(module), set()).update(found)
    return groups


def circle(groups):
    """A circle, or None."""
    try:
        TopologicalSorter(groups).prepare()
    except CycleError as error:
        return error.args[1]
    return None


@pytest.mark.parametrize("folder", ORDERED)
def test_the_order_names_every_room(edges, folder):
    rooms = [name for group in declared_order(folder) for name in group]
    assert sorted(rooms) == sorted({room(module, folder) for module in modules_of(edges, folder)})


@pytest.mark.parametrize("folder", ORDERED)
def test_rooms_import_only_downwards(edges, folder):
    level = {name: i for i, group in enumerate(declared_order(folder)) for name in group}
    modules = modules_of(edges, folder)
    upwards = [
        f"{module} imports {name}"
        for module in modules
        for name in edges[module] & modules
        if room(name, folder) != room(module, folder)
        and level[room(name, folder)] >= level[room(module, folder)]
    ]
    assert not upwards


def test_no_module_is_in_a_circle(edges):
    assert circle(edges) is None


def test_no_folder_is_in_a_circle(edges):
    """Nor is a folder with a module beside it: seen from each folder, what lies in it."""
    for folder in {module.rpartition(".")[0] for module in edges} - {""}:

        def inside(module, folder=folder):
            below = module.removeprefix(f"{folder}.")
            return None if below == module else below.split(".")[0]

        assert circle(grouped(edges, inside)) is None, folder


def test_no_import_is_hidden_in_a_function(edges):
    late = {
        module
        for module, files in sources().items()
        for is_folder, tree in files
        for function in ast.walk(tree)
        if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef))
        and any(imported(function, module, is_folder, edges))
    }
    assert late <= LATE


def test_effects_know_the_parts_of_an_effect_and_nothing_else(edges):
    """A definition is an equation: no sensor, no file, no way to run it."""
    allowed = {"pyimu.model.effect", "pyimu.model.arguments", "pyimu.model.law"}
    for module, names in edges.items():
        if module.startswith("pyimu.model.effects."):
            assert {n for n in names if not n.startswith("pyimu.model.effects.")} <= allowed, module


# What counts as an import


@pytest.mark.parametrize(
    ("text", "want"),
    [
        ("import pyimu.units", {"pyimu.units"}),
        ("from pyimu import units, close", {"pyimu.units", "pyimu"}),
        ("from pyimu.model import part\nimport numpy", {"pyimu.model.part"}),
        ("from pyimu.model.part import Part", {"pyimu.model.part"}),
        ("def f():\n    from pyimu.errors import UserError", {"pyimu.errors"}),
        ("if TYPE_CHECKING:\n    from pyimu.errors import UserError", {"pyimu.errors"}),
        ("from . import part", {"pyimu.model.part"}),
        ("from .part import Part", {"pyimu.model.part"}),
        ("from ..errors import UserError", {"pyimu.errors"}),
        ("from .. import units", {"pyimu.units"}),
    ],
)
@pytest.mark.parametrize("is_folder", [False, True])
def test_every_form_of_import_is_seen(text, want, is_folder):
    known = {"pyimu", "pyimu.units", "pyimu.errors", "pyimu.model", "pyimu.model.part"}
    module = "pyimu.model" if is_folder else "pyimu.model.sensor"
    assert set(imported(ast.parse(text), module, is_folder, known)) == want


def test_a_circle_is_found():
    assert circle({"a": {"b"}, "b": {"c"}, "c": set()}) is None
    assert set(circle({"a": {"b"}, "b": {"c"}, "c": {"a"}})) == {"a", "b", "c"}
