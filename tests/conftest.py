"""What holds for every test: numerics on one thread, as the workers already share the cores.

The libraries read this when numpy is first imported. On arrays of some thousand rows their threads
only wait for each other, and a sum's bits would follow the number of cores.
"""

import os

for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(name, "1")
