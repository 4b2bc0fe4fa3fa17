"""``python -m pyimu``: the command line."""

from pyimu.cli import main

main()
