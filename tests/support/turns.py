"""The attitudes of a body that turns step by step."""

from scipy.spatial.transform import Rotation


def turned(steps: Rotation, first: Rotation | None = None) -> Rotation:
    """The attitude ``first`` and those after each of the steps (n,), each about the body's axes.

    Products of two, of four and so on: the loop over rows would take a second for some ten
    thousand.
    """
    attitudes = Rotation.concatenate([first or Rotation.identity(), steps])
    reach = 1
    while reach < len(attitudes):
        before, now = attitudes[:-reach], attitudes[reach:]
        attitudes = Rotation.concatenate([attitudes[:reach], before * now])
        reach *= 2
    return attitudes
