"""Pages in a real browser: Chromium without a window, in its DevTools protocol through a pipe.

https://chromedevtools.github.io/devtools-protocol says what the commands and events are.
"""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")

PATIENCE = 60.0
"""Seconds without a word from the browser after which it counts as hung."""

A4 = {"paperWidth": 8.27, "paperHeight": 11.69, "preferCSSPageSize": True}  # inches


@dataclass(frozen=True)
class View:
    """How a page is looked at: width and height of the window, dots a pixel, and the colours."""

    width: int
    height: int
    dots: float = 1.0
    dark: bool = False


DESKTOP, DARK, PHONE = View(1280, 900), View(1280, 900, dark=True), View(390, 844, dots=2.0)


def program() -> str | None:
    """The browser on PATH, None where there is none that is spoken to through files 3 and 4."""
    found = (shutil.which(name) for name in PROGRAMS) if os.name == "posix" else ()
    return next((path for path in found if path), None)


class Browser:
    """A running browser with one page; it ends with the block that it is opened for."""

    def __init__(self, command: str) -> None:
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self._asked, self._rest = 0, b""
        self.errors: list[str] = []
        """What the open page has raised, told its console as an error, or not found to load."""
        self._start(command)
        target = self._ask("Target.createTarget", url="about:blank")["targetId"]
        attached = self._ask("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.ask(f"{domain}.enable")

    def _start(self, command: str) -> None:
        """Two named pipes as its files 3 and 4, which no other way gives a process everywhere."""
        pipes = [os.path.join(self._folder.name, name) for name in ("commands", "answers")]
        for pipe in pipes:
            os.mkfifo(pipe)
        profile = os.path.join(self._folder.name, "profile")
        # The pages are our own, and a container lets no browser build its sandbox.
        options = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"]
        options += ["--remote-debugging-pipe", f"--user-data-dir={profile}", "--hide-scrollbars"]
        shell = 'commands=$1; answers=$2; shift 2; exec "$@" 3<"$commands" 4>"$answers"'
        self._process = subprocess.Popen(
            ["sh", "-c", shell, "sh", *pipes, command, *options],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self._to = open(pipes[0], "wb", buffering=0)
        self._from = open(pipes[1], "rb", buffering=0)

    def __enter__(self) -> Browser:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._to.close()
        self._from.close()
        self._process.terminate()
        self._process.wait()
        self._folder.cleanup()

    @property
    def version(self) -> str:
        """Name and version of the browser."""
        return self._ask("Browser.getVersion")["product"]

    def open(self, page: str, view: View) -> None:
        """Open a page (a URL) and wait until all of it is loaded."""
        self.look(view)
        self.errors.clear()
        self.ask("Page.navigate", url=page)
        while self._next().get("method") != "Page.loadEventFired":
            pass
        self.value("new Promise(done => requestAnimationFrame(() => setTimeout(done, 300)))")

    def look(self, view: View) -> None:
        """See the page in another way."""
        size = {"width": view.width, "height": view.height, "deviceScaleFactor": view.dots}
        self.ask("Emulation.setDeviceMetricsOverride", mobile=view.dots > 1, **size)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if view.dark else "light"}
        self.ask("Emulation.setEmulatedMedia", features=[scheme])

    def value(self, expression: str) -> Any:
        """What a JavaScript expression is in the page."""
        found = self.ask(
            "Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True
        )
        return found["result"].get("value")

    def screenshot(self) -> bytes:
        """The whole page as it is seen, as PNG."""
        return self._file("Page.captureScreenshot", captureBeyondViewport=True)

    def pdf(self) -> bytes:
        """The page as it is printed on A4, as PDF."""
        return self._file("Page.printToPDF", **A4)

    def ask(self, method: str, **given: Any) -> dict[str, Any]:
        """The answer to a command to the page."""
        return self._ask(method, self._session, **given)

    def _file(self, method: str, **given: Any) -> bytes:
        return base64.b64decode(self.ask(method, **given)["data"])

    def _ask(self, method: str, session: str | None = None, **given: Any) -> dict[str, Any]:
        self._asked += 1
        message = {"id": self._asked, "method": method, "params": given}
        addressed = message if session is None else message | {"sessionId": session}
        self._to.write(json.dumps(addressed).encode() + b"\0")
        while (answer := self._next()).get("id") != self._asked:
            pass
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def _next(self) -> dict[str, Any]:
        """The next answer or event; an event that tells of an error is noted."""
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._from], [], [], PATIENCE)
            more = os.read(self._from.fileno(), 1 << 20) if ready else b""
            if not more:
                raise RuntimeError("the browser has ended" if ready else "the browser hangs")
            self._rest += more
        text, self._rest = self._rest.split(b"\0", 1)
        message = json.loads(text)
        self.errors += _errors(message.get("method"), message.get("params", {}))
        return message


def _errors(event: str | None, told: dict[str, Any]) -> list[str]:
    if event == "Runtime.exceptionThrown":
        thrown = told["exceptionDetails"]
        return [thrown.get("exception", {}).get("description", thrown["text"])]
    if event == "Runtime.consoleAPICalled" and told["type"] in ("error", "assert"):
        return [" ".join(str(a.get("value", a.get("description"))) for a in told["args"])]
    if event == "Log.entryAdded" and told["entry"]["level"] == "error":
        return [f"{told['entry']['text']} {told['entry'].get('url', '')}".strip()]
    return []


def address(page: str | Path) -> str:
    """The URL of a file; a URL is one already."""
    return str(page) if "://" in str(page) else Path(page).resolve().as_uri()
