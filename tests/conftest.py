"""What holds for every test: numerics on one thread, as the workers already share the cores.

The libraries read this when numpy is first imported. On arrays of some thousand rows their threads
only wait for each other, and a sum's bits would follow the number of cores.
"""

import gc
import os
import sys

import pytest
from hypothesis import settings

# No test depends on the clock: a loaded machine may take seconds for any example.
settings.register_profile("untimed", deadline=None)
settings.load_profile("untimed")

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(name, "1")


def pytest_collection_finish():
    """What has been loaded until now stays: looking through all of it for garbage again and again
    takes a twentieth of the time.
    """
    gc.collect()
    gc.freeze()


@pytest.fixture
def pyimu(monkeypatch, capsys, tmp_path):
    """Runs the command line in this process, in an empty folder.

    It gives exit status, stdout and stderr.
    """
    from pyimu.cli import main

    monkeypatch.chdir(tmp_path)

    def run(*words):
        monkeypatch.setattr(sys, "argv", ["pyimu", *map(str, words)])
        with pytest.raises(SystemExit) as end:
            main()
        return (end.value.code, *capsys.readouterr())

    return run


@pytest.fixture
def uncompiled(monkeypatch):
    """FMUs with empty libraries, as compiling takes seconds, for tests of what else is written."""
    monkeypatch.setattr(
        "pyimu.fmu.build._compile", lambda name, texts, forms, *_: {form: b"" for form in forms}
    )


@pytest.fixture
def undrawn(monkeypatch):
    """Pictures are made and not drawn, which is two thirds of what a page takes; tests of each page
    draw them.
    """
    empty = '<svg viewBox="0 0 1 1" width="1pt" height="1pt"></svg>'
    monkeypatch.setattr("pyimu.report.figures._drawn", lambda figure: empty)
