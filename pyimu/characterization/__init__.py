"""What a log of a sensor at rest says about it: ``pyimu.characterize``, and the pieces that it is
made of.
"""
