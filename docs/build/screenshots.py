"""Pages as people see them: ``python docs/build/screenshots.py FOLDER PAGE...``.

Of each page (a file or a URL) the folder gets ``NAME.desktop.png``, ``NAME.dark.png``,
``NAME.phone.png`` and ``NAME.print.pdf``. What is wrong with one that a program can tell is
printed: errors in its console, and a page that is wider than a phone. The rest wants eyes. Needs
Chromium or Chrome on PATH.
"""

from __future__ import annotations

import sys
from pathlib import Path

from browser import DARK, DESKTOP, PHONE, Browser, address, program

OVERHANG = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
"""Pixels by which a page is wider than its window: it then scrolls sideways as a whole."""


def shots(browser: Browser, page: str | Path, name: Path) -> list[str]:
    """Write the four shots of a page and give what is wrong with it."""
    wrong: dict[str, None] = {}
    for seen, view in (("phone", PHONE), ("dark", DARK), ("desktop", DESKTOP)):
        browser.open(address(page), view)  # anew, as a page may ask for the colours only once
        name.with_name(f"{name.name}.{seen}.png").write_bytes(browser.screenshot())
        wide = browser.value(OVERHANG)
        wrong |= dict.fromkeys(
            [*browser.errors, *([f"{seen}: {wide} pixels too wide"] if wide > 0 else [])]
        )
    name.with_name(f"{name.name}.print.pdf").write_bytes(browser.pdf())
    return list(wrong)


def main(folder: str, *pages: str) -> None:
    command = program()
    if command is None:
        sys.exit("No browser: screenshots need chromium or google-chrome on PATH.")
    out = Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    with Browser(command) as browser:
        print(browser.version)
        for page in pages:
            wrong = shots(browser, page, out / Path(page).stem)
            print(f"{page}: {'; '.join(wrong) or 'four shots'}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
