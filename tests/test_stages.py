"""What a bar shows of a search that does not know how many rounds it takes, and of a filter."""

import numpy as np
import pytest

import pyimu
from pyimu.attitude.smoothing import SEGMENT
from pyimu.cli.stages import Stages
from pyimu.derivations import DERIVATIONS, derive
from pyimu.recording.recording import Recording


def said(texts, sensors):
    """The shares that are heard."""
    heard = []
    stages = Stages(lambda text, share: heard.append(share), sensors)
    for text in texts:
        stages(text)
    return heard


def search(sensor, rounds):
    return [
        f"{sensor}: fitting the model as declared",
        *(f"{sensor}: {k} added, trying 30 candidates" for k in range(rounds)),
        f"{sensor}: is anything left that depends on inputs",
    ]


@pytest.mark.parametrize("rounds", (1, 2, 5))
def test_the_share_rises_and_ends_short_of_all(rounds):
    texts = ["quality of the raw samples", *search("accel", 1), *search("gyro", rounds)]
    shares = said([*texts, "compiling the FMUs", "drawing the report"], ["gyro", "accel"])
    assert shares[0] == 0 and np.all(np.diff(shares) >= 0)
    assert shares[len(texts) - 1] > shares[len(texts) // 2] and 0.5 < shares[-1] < 1


def test_a_text_that_is_no_stage_keeps_the_share():
    assert len(set(said(["quality of the raw samples", "something", "else"], ["gyro"]))) == 1


@pytest.mark.parametrize("smooth", (False, True))
def test_the_filter_says_how_far_it_is(smooth):
    """From nothing to nearly all, a smoother's two passes counted as one."""
    n, shares = 2 * SEGMENT + 7, []
    rest = np.tile([0.0, 0.0, 9.80665], (n, 1))
    log = Recording("rest", time=0.01 * np.arange(n), gyro=np.zeros((n, 3)), accel=rest)
    pyimu.attitude.run(log, smooth=smooth, heard=shares.append)
    assert shares[0] == 0 and np.all(np.diff(shares) >= 0) and shares[-1] < 1
    assert not smooth or len(shares) > 2


def test_a_build_says_how_far_the_compiler_is(tmp_path, monkeypatch):
    """Of two units, the first ends where the second begins; nothing was compiled before."""
    monkeypatch.setenv("PYIMU_CACHE", str(tmp_path / "cache"))
    heard = []
    out, units = tmp_path / "out", ["low-pass", "sensor"]
    pyimu.build("imt30", out, units, [2, 3], say=lambda text, share: heard.append((text, share)))
    texts, shares = zip(*heard, strict=True)
    assert list(dict.fromkeys(texts)) == ["compiling LowPass", "compiling ImuSensor"]
    assert shares[0] == 0 and shares[-1] == 1 and np.all(np.diff(shares) >= 0)
    assert shares[texts.index("compiling ImuSensor")] == 0.5 and len(set(shares)) > 10


def test_derivations_say_which_share_is_checked(monkeypatch):
    monkeypatch.setattr("pyimu.derivations.DERIVATIONS", DERIVATIONS[:3])
    shares = []
    derive(lambda text, share: shares.append(share))
    assert shares == [0, 1 / 3, 2 / 3]
