"""Noise, spectrum and temperature effect of a sensor at rest: ``pyimu.characterize``."""
