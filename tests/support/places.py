"""Where the checkout lies, its programs, and the measured recordings that some tests take."""

import importlib.util
import os
import sys
from pathlib import Path
from types import ModuleType

import pytest

CHECKOUT = Path(__file__).resolve().parents[2]

DATA = Path(os.environ.get("PYIMU_DATA") or CHECKOUT.parent / "shared" / "data")
"""The folder of the measured recordings."""


def measured(name: str) -> Path:
    """The measured recording of this name; the test is skipped, and says so, where it is not
    there.
    """
    path = DATA / f"{name}.csv.gz"
    if not path.exists():
        pytest.skip(f"the measured recording {path.name} is not here (the folder is PYIMU_DATA)")
    return path


def linked(link: Path, to: Path) -> Path:
    """The symbolic link ``link``; the test is skipped, and says so, where none may be made."""
    try:
        link.symlink_to(to)
    except OSError as error:  # on Windows a right that few accounts have
        pytest.skip(f"no symbolic links here ({error.strerror})")
    return link


def program(path: str) -> ModuleType:
    """An example or a benchmark of the checkout, by its path there, as a module."""
    file = CHECKOUT / path
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # a dataclass looks its own module up by name
    spec.loader.exec_module(module)
    return module


def same_path() -> dict[str, str]:
    """The environment for another Python that is to import what this one can."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
