"""The notebooks run, one after the other in one kernel, each with the names of its own alone."""

import json
import os
import sys

import nbformat
import pytest
from jupyter_client.kernelspec import KernelSpecManager
from jupyter_client.manager import KernelManager
from nbclient import NotebookClient
from places import CHECKOUT

FOLDER = CHECKOUT / "docs" / "notebooks"
NAMES = sorted(p.stem for p in FOLDER.glob("*.ipynb"))


@pytest.fixture(scope="module")
def kernel(tmp_path_factory):
    """This interpreter as a kernel, with this checkout's package, that writes nothing at home."""
    folder = tmp_path_factory.mktemp("kernels")
    spec = {
        "argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
        "display_name": "here",
        "language": "python",
    }
    (folder / "here").mkdir()
    (folder / "here" / "kernel.json").write_text(json.dumps(spec))
    manager = KernelManager(kernel_name="here")
    manager.kernel_spec_manager = KernelSpecManager(kernel_dirs=[str(folder)])
    path = os.pathsep.join(filter(None, (str(CHECKOUT), os.environ.get("PYTHONPATH"))))
    home = {"IPYTHONDIR": str(folder), "JUPYTER_RUNTIME_DIR": str(folder)}
    manager.start_kernel(env={**os.environ, "PYTHONPATH": path, **home}, cwd=str(folder))
    yield manager
    manager.shutdown_kernel(now=True)


def test_there_are_notebooks_for_the_four_things_people_do():
    assert NAMES == ["cosimulation", "moving_log", "own_effect", "still_log"]


@pytest.mark.parametrize("name", NAMES)
def test_the_notebook_runs_and_shows_what_it_says(kernel, name):
    notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "clear the outputs"
    notebook.cells.insert(0, nbformat.v4.new_code_cell("%reset -f"))
    NotebookClient(notebook, km=kernel, timeout=120).execute(cleanup_kc=False)
    code = [cell for cell in notebook.cells[1:] if cell.cell_type == "code"]
    assert all(cell.outputs for cell in code)
    shown = [output.get("data", {}) for cell in code for output in cell.outputs]
    if name in ("still_log", "moving_log"):
        assert sum("text/html" in data for data in shown) >= 2
    if name == "moving_log":
        assert "image/png" in shown[0]
