"""Time a sample of each unit in Python, compiled: ``python benchmarks/unit_speed.py [samples]``.

The units are those of the reference part: the rover's motion, the sensor with its noise, the
low-pass and the attitude filter, each run alone by ``Block.run`` over arrays, which is the unit's
own C in a loop. Each round times all of them one after the other; the ratio is to the sensor.
"""

import sys
import time
from statistics import median

import numpy as np

from pyimu.block.block import Block
from pyimu.fmu.generate import REFERENCE, reference_blocks

SAMPLES = 200_000
ROUNDS = 7


def seconds(block: Block, u: np.ndarray) -> float:
    begin = time.process_time()  # the machine may have other work
    block.run(u, seed=1)
    return time.process_time() - begin


def main(n: int) -> None:
    blocks = reference_blocks()
    inputs = [np.tile(block.start_inputs, (n, 1)) for block in blocks]
    for block, u in zip(blocks, inputs, strict=True):
        block.run(u)  # compiled from here on
    rounds = [[seconds(b, u) for b, u in zip(blocks, inputs, strict=True)] for _ in range(ROUNDS)]
    sensor = [b.name for b in blocks].index("ImuSensor")
    print(f"{n} samples of the units of {REFERENCE}, median of {ROUNDS} rounds")
    print(f"{'unit':12} {'ns a sample':>11} {'samples/s':>12} {'of the sensor':>14}")
    for i, block in enumerate(blocks):
        own = median(times[i] for times in rounds) / n
        ratio = median(times[i] / times[sensor] for times in rounds)
        print(f"{block.name:12} {1e9 * own:11.0f} {1 / own:12.3g} {ratio:14.1f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else SAMPLES)
