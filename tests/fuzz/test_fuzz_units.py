"""A short run of the fuzzer of units, and that it finds faults which are put in."""

import shutil
import subprocess
import sys

import pytest
from places import CHECKOUT, program

from pyimu.plant.low_pass import low_pass

FUZZER = CHECKOUT / "fuzz" / "units.py"


def sanitizers():
    """Whether there is a gcc whose sanitizers work."""
    if shutil.which("gcc") is None:
        return False
    made = subprocess.run(
        ["gcc", "-fsanitize=address,undefined", "-x", "c", "-", "-o", "/dev/null"],
        input="int main(void) { return 0; }",
        text=True,
        capture_output=True,
        check=False,
    )
    return made.returncode == 0


pytestmark = pytest.mark.skipif(not sanitizers(), reason="needs gcc with its sanitizers")


def test_the_fuzzer_finds_nothing():
    """Steps, values, states and refusals ten thousand calls, in every form."""
    command = [sys.executable, FUZZER, "--calls", "10000", "--units", "ImuSensor"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = done.stdout.splitlines()
    assert [line.partition(",")[0] for line in lines] == [
        f"ImuSensor.{form}" for form in (2, 3, "block")
    ]
    for line in lines:
        figures = {name: int(n) for n, name in (w.split()[:2] for w in line.split(", ")[2:6])}
        assert figures["refused"] > 500 and figures["instances"] > 50 and figures["messages"] > 500


FAULTS = {
    "steps past the stop time": (
        "block.c",
        "time + step > now->stop_time + forgiven(now)",
        "time + step < forgiven(now) - 1e300",
        "a step while stepping gave 0, not 3",
    ),
    "states of others": (
        "block_saved.c",
        "return head[0] == STATE_LAYOUT && head[1] == block_model();",
        "return head[0] != head[1];",
        "AddressSanitizer",
    ),
    "memory that stays": (
        "block.c",
        "        free(block->now);\n        free(block);",
        "        free(block);",
        "LeakSanitizer",
    ),
}


@pytest.fixture(scope="module")
def fuzzer():
    return program("fuzz/units.py")


@pytest.mark.parametrize("fault", FAULTS)
def test_the_fuzzer_finds_a_fault(fuzzer, tmp_path, monkeypatch, capfd, fault):
    file, right, wrong, said = FAULTS[fault]
    sources = fuzzer.source_files

    def faulty(generated, form):
        files = sources(generated, form)
        assert files[file].count(right.encode()) == 1
        return files | {file: files[file].replace(right.encode(), wrong.encode())}

    monkeypatch.setattr(fuzzer, "source_files", faulty)
    assert not fuzzer.fuzz(fuzzer.compiled(low_pass(0.01), 2, tmp_path), 1, 20_000)
    out = capfd.readouterr().out
    assert "FAILED" in out and any(words in out for words in said.split("|")), out
