"""FMUs that several tests take, built once in a run of all tests, whichever process asks first."""

import hashlib
import os
from pathlib import Path

from pyimu.block.block import Block
from pyimu.fmu import FORMS, build_fmus, texts
from pyimu.fmu.sources import Form


def built(block: Block, tmp_path_factory) -> dict[Form, Path]:
    """The FMUs of a block by form; nobody may change them."""
    own = tmp_path_factory.getbasetemp()
    common = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    generated = "\0".join(f"{name}\0{text}" for name, text in sorted(texts(block).items()))
    folder = common / f"{block.name}-{hashlib.sha256(generated.encode()).hexdigest()[:16]}"
    if not folder.exists():
        made = tmp_path_factory.mktemp("built")
        build_fmus(block, made, FORMS)
        try:
            made.rename(folder)
        except OSError:
            if not folder.exists():  # else another process was faster
                raise
    return {form: _of(form, folder) for form in FORMS}


def _of(form: Form, folder: Path) -> Path:
    (path,) = folder.glob(f"*.{form if form == 'block' else f'fmi{form}'}.fmu")
    return path
