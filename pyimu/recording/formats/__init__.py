"""Readers of the files that hold recordings, one module a format; each gives a ``Table`` that is
read in pieces.

``pyimu.recording.formats.suffix.open_table`` picks the reader by the file's suffix. A format whose
library is an extra of the package imports it only when such a file is opened.
"""
