"""What a function is given that need not say how far it is."""

from __future__ import annotations


class Silent:
    """Takes what it is told, and does nothing; ``help`` shows it by this name."""

    def __call__(self, *told: object, **more: object) -> None:
        """Nothing."""

    def __repr__(self) -> str:
        return "silent"


silent = Silent()
