"""A part in the files of other projects: their noise parameters, in their conventions.

``pyimu.export.write(part, "kalibr")`` and ``pyimu export PART --to kalibr`` write the file of one.
"""

from pyimu.export.targets import TARGETS, Exported, Target, export, known, write

__all__ = ["TARGETS", "Exported", "Target", "export", "known", "write"]
