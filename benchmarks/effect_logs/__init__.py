"""Logs of a sensor with one effect, or two, that its part does not declare, of a stated size.

Plain numpy and scipy: each effect's equation stands here once more, and so does the whitening by
which its size is stated; nothing comes from the package that these logs try. The conventions are
those of ``generators``.
"""
