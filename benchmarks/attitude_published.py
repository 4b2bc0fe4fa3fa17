"""The attitude filter of Hidalgo 2012 as published, beside the package's own, on measured logs.

``python benchmarks/attitude_published.py [--data FOLDER]``: the root mean square of the inclination
error over measured recordings (BROAD, Laidig, Caruso, Cereatti and Seel 2021), hands in motion, for
which the paper's filter was not made: as published, without its low-pass filter, and our own.
Nothing was chosen on them for the paper's filter: what the paper does not give is derived or our
own filter's (``pyimu.attitude.filter.hidalgo2012``). The paper's own test drives, table 6, are what
``pyimu rover`` shows.
"""

import numpy as np
from attitude_real import SCORED, folder, inclination, moving_rows

import pyimu
from pyimu.attitude import run
from pyimu.attitude.error import root_mean_square

WAYS = {
    "ours": "ukf",
    "as published": "hidalgo2012",
    "no low-pass": {"filter": "hidalgo2012", "low_pass": 0.0},
}


def main() -> None:
    """Print the inclination errors."""
    paths = [folder() / f"{name}.csv.gz" for name in SCORED]
    if not all(path.exists() for path in paths):
        print(f"no recordings in {folder()}: --data FOLDER says where they are")
        return
    print(
        f"{'inclination error, RMS [deg]':50s}"
        + "".join(f"{name:>14s}" for name in WAYS)
        + f"{'quasi-static':>14s}"
    )
    sizes = []
    for path in paths:
        log = pyimu.read_recording(path)
        rows = np.isfinite(log.ref_q).all(axis=1) & moving_rows(log)
        found = [run(log, settings=settings) for settings in WAYS.values()]
        rms = [root_mean_square(inclination(f.q[rows], log.ref_q[rows])) for f in found]
        sizes.append(rms)
        share = np.mean(found[1].quasi_static[rows])
        print(
            f"{path.name.split('.')[0]:50s}"
            + "".join(f"{v:14.3f}" for v in rms)
            + f"{share:14.0%}",
            flush=True,
        )
    print(f"{'mean':50s}" + "".join(f"{v:14.3f}" for v in np.mean(sizes, axis=0)))


if __name__ == "__main__":
    main()
