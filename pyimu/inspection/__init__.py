"""What is in a log: ``pyimu inspect``."""
