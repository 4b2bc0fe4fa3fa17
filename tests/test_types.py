"""What the package offers by its own names: each is there, and says its types completely."""

import inspect
import typing
from functools import cached_property
from types import FunctionType, ModuleType

import pytest
from places import CHECKOUT

import pyimu

NAMES = [name for name in pyimu.__all__ if not isinstance(getattr(pyimu, name), ModuleType)]


def functions_of(thing):
    """The functions by which a user reaches a function or a class: name to function."""
    if isinstance(thing, FunctionType):
        return {thing.__name__: thing}
    found = {}
    for owner in thing.__mro__:
        for name, member in vars(owner).items():
            if owner.__module__.startswith("pyimu") and not name.startswith("_"):
                found.setdefault(f"{thing.__name__}.{name}", plain_function(member))
    return {name: function for name, function in found.items() if function is not None}


def plain_function(member):
    """The function behind a method or a property; None of anything else."""
    if isinstance(member, property):
        return member.fget
    if isinstance(member, cached_property):
        return member.func
    if isinstance(member, (classmethod, staticmethod)):
        return member.__func__
    return member if isinstance(member, FunctionType) else None


@pytest.mark.parametrize("name", NAMES)
def test_a_public_function_says_all_its_types(name):
    for called, function in functions_of(getattr(pyimu, name)).items():
        signature = inspect.signature(function)
        silent = [
            p.name
            for p in signature.parameters.values()
            if p.annotation is p.empty and p.name not in ("self", "cls")
        ]
        assert not silent and signature.return_annotation is not signature.empty, (called, silent)


@pytest.mark.parametrize("name", NAMES)
def test_a_public_name_is_described(name):
    assert (getattr(pyimu, name).__doc__ or "").strip()


def test_the_types_are_announced():
    """PEP 561: without the marker a checker of the user's code looks at none of them."""
    assert (CHECKOUT / "pyimu" / "py.typed").is_file()


def test_help_shows_arguments():
    """``pyimu.close`` is the function itself, not something that is called in its place."""
    for name in ("close", "characterize", "build", "simulate"):
        assert isinstance(getattr(pyimu, name), FunctionType)
        assert typing.get_type_hints(getattr(pyimu, name))["return"] is not None
