"""What the C library does with memory that is freed."""

from __future__ import annotations

import ctypes
from contextlib import suppress

TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3
"""Numbers of glibc's parameters (malloc.h): bytes free at the end of the heap above which they are
given back to the system, and from which on an array is memory of its own."""

KEPT, LARGEST = 1 << 30, 32 << 20
"""Bytes; glibc takes no more for the second."""


def keep_freed() -> None:
    """Let an array take the memory that another left: by glibc's own numbers most of it goes back
    to the system, which clears it anew for each array, a tenth of a command's time. Another C
    library is left as it is.
    """
    with suppress(AttributeError, OSError, TypeError):
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(MMAP_THRESHOLD, LARGEST)
        mallopt(TRIM_THRESHOLD, KEPT)
