"""Readers of the files that hold recordings, one module per format.

Each gives a ``Reader``, which reads the file in pieces.

``pyimu.recording.formats.suffix.open_reader`` picks the reader by the file's suffix. A format whose
library is an extra of the package imports it only when such a file is opened.
"""
