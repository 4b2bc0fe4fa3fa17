"""MEMS inertial sensors, from a measured log to a system simulator and back.

Conventions, everywhere in the package:

* SI and radians; degrees, hours, g only where a file is read or a person is shown something.
  Temperature is in degC.
* World frame east-north-up, body frame forward-left-up (REP 103). Quaternions are Hamilton, scalar
  first, body to world: ``q_nb`` = Rz(yaw) Ry(pitch) Rx(roll). Yaw and heading run
  counter-clockwise from east; nose up is negative pitch.
* ``f_b`` is a vector in body axes, ``R_nb`` a matrix from body to world. A gyro measures rate
  against inertial space, an accelerometer specific force: +g on z at rest.
* White noise is given by the root of its two-sided density, N in rad/sqrt(s). A function that
  returns a density says one-sided or two-sided.
* Arrays are (n, 3), a sample a row, time first.

The names below are the package for most uses; ``help(pyimu.close)`` is where to start.
"""

import lazy_loader

__version__ = "0.1.0"

# What is asked for is loaded only then, as casadi and scipy take seconds; ``__init__.pyi`` says
# where.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
