"""The documentation as a site: ``python docs/build/docs_site.py [FOLDER]``.

It is built into ``out/site`` where no folder is named.

The pages are README and ``docs`` as they stand; this puts them where mkdocs finds them (the README
is the first page), sets equations as MathML, notebooks as pages, and what a link into the sources
leads to beside them. Nothing is loaded from elsewhere, neither to build it nor to read it. Needs
``pip install -e '.[docs]'``.
"""

from __future__ import annotations

import json
import os
import posixpath
import re
import shutil
import subprocess
import sys
from pathlib import Path

from latex2mathml.converter import convert
from pages import DOCS

CHECKOUT = DOCS.parent

ROOT = ("CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff", "LICENSE")
"""Files beside the README that are in the site as well."""

LINK = re.compile(r"(!?\[[^\]]*\]\()([^)\s#]+)(#[^)\s]*)?\)")
CODE = re.compile(r"(^```.*?^```|`[^`\n]+`)", re.MULTILINE | re.DOTALL)
MATH = re.compile(r"\$([^$\n]+)\$")


def build(out: Path) -> None:
    """Build the site into ``out``; what mkdocs warns of is an error."""
    source = out / "pages"
    shutil.rmtree(out, ignore_errors=True)
    assemble(source)
    shutil.copy(CHECKOUT / "mkdocs.yml", out / "mkdocs.yml")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
    quiet = os.environ | {"NO_MKDOCS_2_WARNING": "1"}
    subprocess.run([*command, "--site-dir", "site"], cwd=out, check=True, env=quiet)


def assemble(source: Path) -> None:
    """The pages in a folder of their own."""
    skipped = shutil.ignore_patterns("build", "__pycache__")
    shutil.copytree(DOCS, source, ignore=skipped)
    shutil.copy(CHECKOUT / "README.md", source / "index.md")
    for name in ROOT:
        shutil.copy(CHECKOUT / name, source / name)
    for notebook in source.rglob("*.ipynb"):
        notebook.with_suffix(".md").write_text(as_page(notebook), encoding="utf-8")
        notebook.unlink()
    for page in source.rglob("*.md"):
        page.write_text(_adapted(page, source), encoding="utf-8")


def as_page(notebook: Path) -> str:
    """A notebook as Markdown, its code in fences."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    parts = []
    for cell in cells:
        text = "".join(cell["source"])
        parts.append(text if cell["cell_type"] == "markdown" else f"```python\n{text}\n```")
    return "\n\n".join(parts) + "\n"


def _adapted(page: Path, source: Path) -> str:
    """A page with its links and equations as the site has them; code stays as it is."""
    at_root = page.parent == source and page.name in ("index.md", *ROOT)
    folder = "" if at_root else f"docs/{page.parent.relative_to(source).as_posix()}"

    def moved(match: re.Match) -> str:
        begin, target, anchor = match[1], match[2], match[3] or ""
        if re.match(r"\w+:", target):
            return match[0]
        return f"{begin}{_target(target, folder, page, source)}{anchor})"

    parts = CODE.split(page.read_text(encoding="utf-8"))
    parts[::2] = [LINK.sub(moved, MATH.sub(_mathml, text)) for text in parts[::2]]
    return "".join(parts)


def _target(target: str, folder: str, page: Path, source: Path) -> str:
    """Where a link leads in the site; a file of the sources is put there."""
    path = posixpath.normpath(posixpath.join(folder, target))
    if path == "README.md":
        place = "index.md"
    elif path.startswith("docs/"):
        place = re.sub(r"\.ipynb$", ".md", path.removeprefix("docs/"))
    else:
        # A folder that begins with a dot is none of a site's.
        place = path if path in ROOT else f"sources/{path.replace('.github', 'github')}"
        (source / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(CHECKOUT / path, source / place)
    return posixpath.relpath(place, page.parent.relative_to(source).as_posix())


def _mathml(match: re.Match) -> str:
    # In a span, as a line that begins with an element of its own would be a paragraph.
    return f"<span>{convert(match[1].replace(chr(92) + chr(124), chr(124)))}</span>"


if __name__ == "__main__":
    build(Path(sys.argv[1]) if len(sys.argv) > 1 else CHECKOUT / "out" / "site")
