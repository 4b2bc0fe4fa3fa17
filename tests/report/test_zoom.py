"""The script that zooms into pictures, under fingers: node runs it on a page of a few objects."""

import base64
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from places import CHECKOUT

pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="needs node")

SCRIPT = (CHECKOUT / "pyimu/report/vendor/zoom.js").read_text(encoding="utf-8")
WIDTH = 400

PAGE = Path(__file__).with_name("zoom_page.js").read_text(encoding="utf-8")


def after(gesture, x, log):
    """The abscissae (min, max) that two panels show after a gesture on the first."""
    rows = "\n".join(["x,y,x,y", *(f"{v},1,{v},2" for v in x)])
    panel = {"xlabel": "", "ylabel": "", "xlog": log, "ylog": False}
    line = {"label": "y", "colour": "red", "dashed": False}
    panels = [panel | {"x": k, "series": [line | {"column": k + 1}]} for k in (0, 2)]
    given = {
        "SCRIPT": SCRIPT,
        "WIDTH": str(WIDTH),
        "TABLE": json.dumps("data:," + base64.b64encode(rows.encode()).decode()),
        "PANELS": json.dumps(json.dumps(panels)),
        "GESTURE": json.dumps(gesture),
    }
    program = PAGE
    for name, text in given.items():
        program = program.replace(name, text)
    done = subprocess.run(["node", "-"], input=program, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    shown = [(u["min"], u["max"]) for u in json.loads(done.stdout)]
    assert shown[0] == shown[1]
    return shown[0]


SPREAD = [("touchstart", 100, 200), ("touchmove", 50, 250)]
"""Two fingers, 100 pixels of 400 apart, then twice as far."""


def test_two_fingers_keep_what_is_under_them():
    """From 0 to 40 over 400 pixels: 10 and 20 come to lie at 50 and 250, 20 pixels a unit."""
    np.testing.assert_allclose(after(SPREAD, [0.0, 20.0, 40.0], False), (7.5, 27.5))


def test_two_fingers_on_a_logarithmic_axis():
    np.testing.assert_allclose(after(SPREAD, [1.0, 1e2, 1e4], True), (10**0.75, 10**2.75))


def test_one_finger_moves_what_is_seen():
    moved = after([("touchstart", 100), ("touchmove", 60)], [0.0, 20.0, 40.0], False)
    np.testing.assert_allclose(moved, (4.0, 44.0))


def test_a_finger_that_joins_or_leaves_moves_nothing():
    gesture = [("touchstart", 100), ("touchmove", 90, 300), ("touchend", 90), ("touchmove", 90)]
    np.testing.assert_allclose(after(gesture, [0.0, 20.0, 40.0], False), (0.0, 40.0))
