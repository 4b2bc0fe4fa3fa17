"""The harness of the fuzzers: what it takes for broken."""

import os
import signal
import time

import pytest
from places import program

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="the fuzzers fork"),
    pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning"),  # beside threads of libraries
]


class Fuzzer:
    """One that finds nothing, but for what ``what`` does."""

    NAME = "fake"
    LOADED = ()

    def __init__(self, what):
        self.what = what

    def seeds(self, folder):
        (folder / "seed").touch()

    def mutate(self, seed, folder, rng):
        path = folder / "tried"
        path.touch()
        return path

    def try_one(self, path):
        self.what()
        return "read"


def fault():
    raise ValueError("a fault")


@pytest.mark.parametrize(
    "what, said",
    [
        (lambda: os._exit(3), "ended with exit status 3 and no word"),
        (lambda: os.kill(os.getpid(), signal.SIGKILL), "ended by SIGKILL"),
        (fault, "ValueError: a fault"),
    ],
)
def test_a_child_that_ends_badly_is_broken(what, said, tmp_path):
    harness = program("fuzz/harness.py")
    until = time.monotonic() + 60
    counts, wrong = harness.Child(Fuzzer(what), [tmp_path], tmp_path, 1, until).run()
    assert not counts and said in wrong


def test_a_child_tries_one_file_at_least(tmp_path):
    """So that a run in which all is well has tried something, on a slow machine, too."""
    harness = program("fuzz/harness.py")
    good = Fuzzer(lambda: None)
    counts, wrong = harness.Child(good, [tmp_path], tmp_path, 1, time.monotonic() - 1).run()
    assert counts == {"read": 1} and wrong == ""


def test_what_was_broken_is_counted_and_kept(tmp_path, capfd):
    harness = program("fuzz/harness.py")
    assert harness.run(Fuzzer(lambda: os._exit(1)), 0.05, 1, tmp_path / "kept") > 0
    assert "fake: " in capfd.readouterr().out
    assert any((tmp_path / "kept").iterdir())
