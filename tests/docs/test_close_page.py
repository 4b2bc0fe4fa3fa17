"""The page on closing the loop: its verdicts are the package's, and its code runs."""

import re

import numpy as np
import pytest
from places import CHECKOUT

from pyimu import Recording
from pyimu.cli.logs import EXIT_CODES
from pyimu.identification.fit.trial import HELD_OUT
from pyimu.identification.noise.choose import MOST
from pyimu.identification.search.screen import FALSE_ALARM, SHARE
from pyimu.identification.verdict.verdict import FAR, VERDICTS

TEXT = (CHECKOUT / "docs" / "close.md").read_text(encoding="utf-8")
TABLE = re.search(r"<!-- verdicts -->\n(.*?)<!-- end -->", TEXT, re.DOTALL).group(1)


def test_every_verdict_is_in_the_table_with_its_exit_status():
    rows = [re.match(r"\| `(\w+)` \| (\d+) \| .+ \| .+ \|$", r) for r in TABLE.splitlines()[2:]]
    assert {r.group(1): int(r.group(2)) for r in rows} == EXIT_CODES
    assert {r.group(1) for r in rows} == {*VERDICTS}


@pytest.mark.parametrize(
    "said",
    [
        f"within {FAR:.0f} times the noise",
        f"the last {HELD_OUT:.0%}".replace("%", " %"),
        f"once in {1 / (SHARE * FALSE_ALARM):.0f} searches",
        f"1 to {MOST} kinds of noise",
    ],
)
def test_its_numbers_are_the_packages(said):
    assert said in TEXT


def test_its_python_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rng, time = np.random.default_rng(0), 0.01 * np.arange(6000)
    rate = np.sin(time[:, None] * [0.7, 1.1, 1.9])
    gyro = rate * [1.0, 1.0, 1.02] + rng.normal(0, 1e-3, rate.shape)
    Recording.from_arrays(time=time, gyro=gyro, ref_rate=rate).write(tmp_path / "drive.csv")
    (code,) = re.findall(r"^```python\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
    exec(compile(code, "close.md", "exec"), {})
    assert capsys.readouterr().out.split()[0] in VERDICTS
    assert (tmp_path / "out" / "drive" / "report.html").is_file()
