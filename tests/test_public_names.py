"""The names of the package as ``help`` and a notebook show them: true signatures, short values."""

import inspect
import re
from functools import cached_property
from types import ModuleType

import numpy as np
import pytest
from shown_files import driven, indoors, square, still

import pyimu
from pyimu.display.brief import in_short
from pyimu.display.silent import silent

LONGEST = 420
"""Characters of a ``repr``: a part with all effects of a specimen."""

INSIDE = re.compile(r"<(?!factory>)|\bat 0x|np\.float|\b_[a-z]\w+")
"""What a reader cannot type: objects by their address, private names."""


def called(owner: str, thing: object):
    """Functions, classes and methods of a public name, each with how it is called."""
    if isinstance(thing, ModuleType):
        for name in getattr(thing, "__all__", ()):
            yield from called(f"{owner}.{name}", getattr(thing, name))
    elif callable(thing):
        yield owner, thing
    if inspect.isclass(thing):
        for name, member in inspect.getmembers(thing):
            if not name.startswith("_") and inspect.isroutine(member):
                if not isinstance(member, cached_property):
                    yield f"{owner}.{name}", member


CALLED = [
    pair
    for name in sorted(pyimu.__all__)
    if not name.startswith("_")
    for pair in called(f"pyimu.{name}", getattr(pyimu, name))
]


@pytest.mark.parametrize(("name", "thing"), CALLED, ids=lambda v: v if isinstance(v, str) else "")
def test_a_signature_shows_what_can_be_typed(name, thing):
    try:
        signature = inspect.signature(thing)
    except ValueError:  # of a builtin, as an exception's
        return
    for parameter in signature.parameters.values():
        assert not parameter.name.startswith("_"), parameter
        if parameter.default is not parameter.empty:
            assert not INSIDE.search(repr(parameter.default)), parameter
    shown = getattr(thing, "__qualname__", name)
    assert not shown.rpartition(".")[2].startswith("_"), shown


def test_a_frame_s_constructor_goes_by_its_own_name():
    assert "from_frame(frame" in pyimu.Recording.from_frame.__qualname__ + str(
        inspect.signature(pyimu.Recording.from_frame)
    )
    assert "_from_frame" not in inspect.getsource(pyimu.Recording.from_frame)


def test_who_need_not_be_told_is_silent():
    default = inspect.signature(pyimu.close).parameters["say"].default
    assert default is silent and repr(default) == "silent" and default("text", share=0.1) is None


@pytest.fixture(scope="module")
def values():
    """A value of each public class that people come to hold."""
    part, log = pyimu.part("mpu6050"), driven(3000)
    closed = pyimu.close(log, "mpu6050")
    characterized = pyimu.characterize(still(2000))
    return {
        "part": part.specimen(3),
        "sensor": part.specimen(3).gyro,
        "tolerance": part.tolerances[0],
        "effect": part.gyro.effects[0],
        "law": part.gyro.effect("angle_random_walk").law,
        "recording": log,
        "closed": closed,
        "added": closed.added[0],
        "errors": closed.errors["gyro"],
        "log": closed.recordings[0],
        "exhibits": closed.exhibits["gyro"],
        "characterization": characterized,
        "of a log": characterized.logs[0],
        "of a sensor": characterized.logs[0].sensors["gyro"],
        "channel": next(characterized.logs[0].channels),
        "attitude": pyimu.attitude.run(log),
        "navigation": pyimu.ins.run(square()),
        "heading": pyimu.heading.run(indoors(0)),
        "plan": pyimu.plan("mpu6050", "g_sensitivity"),
    }


def test_a_value_is_shown_in_a_line(values):
    for name, value in values.items():
        shown = repr(value)
        assert shown.startswith(type(value).__name__ + "("), (name, shown)
        assert "\n" not in shown and len(shown) <= LONGEST, (name, len(shown), shown[:200])
        assert not INSIDE.search(shown) and "array([" not in shown, (name, shown)


def test_what_a_short_value_says(values):
    assert repr(values["sensor"]).startswith("Sensor('gyro': lag, misalignment, scale_factor")
    assert "effect='scale_factor'" in repr(values["added"])
    assert repr(values["plan"]) == "Plan('mpu6050': gyro g_sensitivity; 1 log)"
    assert in_short(np.zeros((4000, 3))) == "array (4000, 3)"
    assert in_short(np.array([1.0, 2.0, 1 / 3])) == "[1, 2, 0.3333]"
    assert in_short(("a", "b", "c", "d", "e")) == "('a', 'b', 'c', 2 more)"
