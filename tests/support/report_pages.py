"""What a report's page may hold."""

import re

SCRIPT = re.compile(r"<script>(.*?)</script>", re.DOTALL)


def alone(page: str) -> str:
    """The page without its script, sure that neither loads anything or makes code of text."""
    (found,) = SCRIPT.findall(page) or ("",)
    for call in ("fetch(", "XMLHttpRequest", "import(", "WebSocket", "innerHTML", "eval(", "src="):
        assert call not in found, call
    rest = SCRIPT.sub("", page)
    assert "<script" not in rest and "http" not in rest and "@import" not in rest
    assert not re.search(r'(src|href)="(?!#|data:)', rest)
    return rest
