"""What the shell completes: the names that an option takes, where these are known beforehand.

They stand here once more, beside what defines them: a shell waits for each, and loading a filter or
a campaign takes seconds. A test holds them to their definitions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from importlib.resources import files

NAMES: dict[str, tuple[str, ...]] = {
    "--to": ("kalibr", "openvins", "vins", "gazebo", "isaac", "ros2", "matlab", "px4"),
    "--fmu": ("sensor", "ukf", "hidalgo2012", "heading", "rover", "low-pass", "ins"),
    "--fmi": ("2", "3", "block"),
    "--platform": (
        "host",
        "all",
        "x86_64-linux",
        "aarch64-linux",
        "x86_64-windows",
        "x86_64-darwin",
        "aarch64-darwin",
    ),
    "--ssp": ("straight", "obstacle", "ackermann", "turn_on_spot", "free"),
    "plan --sensor": ("gyro", "accel"),
    "--settings": ("ukf", "hidalgo2012"),
    "navigate --method": ("paper", "strapdown", "filter", "smoother", "all"),
    "--zupt": ("auto", "live", "foot", "declared", "off"),
    "heading --method": ("integrate", "self-calibration", "threshold", "paper", "filter", "all"),
    "heading --reference": ("heading", "rate"),
    "--drive": ("turn-on-spot", "straight", "obstacle", "ackermann", "sol"),
    "--faults": ("lost-axis", "stuck", "saturating", "heading-lost", "heading-wrong"),
    "--body": ("Earth", "Mars", "Moon"),
}
"""By option the names that it takes; with its command where another has one of that name."""

Complete = Callable[[str], list[str]]
"""From what is typed of a word to what the whole may be."""


def one_of(key: str) -> Complete:
    """Completes an option of ``NAMES`` that takes one name."""

    def complete(incomplete: str) -> list[str]:
        return _begun(NAMES[key], incomplete)

    return complete


def some_of(key: str) -> Complete:
    """Completes an option of ``NAMES`` that takes several, separated by commas."""

    def complete(incomplete: str) -> list[str]:
        return _last_of_several(NAMES[key], incomplete)

    return complete


def complete_part(incomplete: str) -> list[str]:
    """Names of built-in parts for the shell, without loading the package's model."""
    names = (f.name for f in files("pyimu.model").joinpath("parts").iterdir())
    return _begun(sorted(n.removesuffix(".toml") for n in names if n.endswith(".toml")), incomplete)


def complete_effect(incomplete: str) -> list[str]:
    """Names of effects, the last of several that commas separate."""
    from pyimu.model.catalogue import CATALOGUE

    return _last_of_several(sorted(CATALOGUE), incomplete)


def _begun(names: Iterable[str], incomplete: str) -> list[str]:
    return [name for name in names if name.startswith(incomplete)]


def _last_of_several(names: Iterable[str], incomplete: str) -> list[str]:
    before, comma, last = incomplete.rpartition(",")
    given = before.split(",")
    return [before + comma + name for name in _begun(names, last) if name not in given]
