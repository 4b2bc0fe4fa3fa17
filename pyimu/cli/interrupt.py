"""Ctrl-C ends the work, whatever it is doing.

Python raises ``KeyboardInterrupt`` in the code that happens to run. In a callback of a C library,
in a destructor, and in code that takes every exception for its own, it is lost: the work goes on,
or ends with another error. So it is raised again until it has come through.
"""

from __future__ import annotations

import _thread
import atexit
import signal
import sys
import threading
import time
import weakref
from functools import cache
from queue import SimpleQueue
from types import FrameType, TracebackType
from typing import Any, Self

LOOK = 0.05
"""s between two looks at what has become of an interrupt."""


class Interrupt(KeyboardInterrupt):
    """An interrupt that can be watched: it exists as long as somebody handles it."""


class Interrupts:
    """Within this context Ctrl-C raises ``Interrupt`` until one arrives at its end.

    ``asked`` says afterwards whether there was one: an error may then be its consequence. Outside
    the main thread, which alone hears of signals, the context does nothing.
    """

    def __init__(self) -> None:
        self.asked = False
        self._over = False
        self._raised: weakref.ref[Interrupt] | None = None
        self._tell: SimpleQueue[None] = SimpleQueue()  # which a handler of signals may use
        self._previous: tuple[Any, Any] | None = None

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            handler = signal.signal(signal.SIGINT, self._handle)
            self._previous, sys.unraisablehook = (handler, sys.unraisablehook), self._lost
            threading.Thread(target=self._watch, daemon=True).start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._over = True
        self._tell.put(None)
        if self._previous:
            handler, sys.unraisablehook = self._previous
            signal.signal(signal.SIGINT, handler)

    def _handle(self, number: int, frame: FrameType | None) -> None:
        self.asked = True
        self._tell.put(None)
        raise self._new()

    def _new(self) -> Interrupt:
        # A variable of the handler would hold the exception, and it the handler's frame.
        error = Interrupt()
        self._raised = weakref.ref(error)
        return error

    def _watch(self) -> None:
        """Raise an interrupt again that is gone while the context is not."""
        while self._tell.get() is None and not self._over:
            time.sleep(LOOK)
            while not self._over and self._raised is not None and self._raised() is not None:
                time.sleep(LOOK)
            if not self._over:
                _thread.interrupt_main()

    def _lost(self, unraisable: Any) -> None:
        """Without a word where it is an interrupt, as it comes again."""
        if not isinstance(unraisable.exc_value, Interrupt) and self._previous:
            self._previous[1](unraisable)


@cache
def ignore_at_exit() -> None:
    """Once Python ends, Ctrl-C does nothing: the work is done, and the process keeps its status."""
    atexit.register(_ignore)


def _ignore() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Python would end by the signal, without a status, where an interrupt once came out of a text
    # that was run as code, as in making a dataclass; the next such text makes it forget that.
    exec("")
