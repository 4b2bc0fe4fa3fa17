"""The pictures of the report of ``characterize``, as SVG."""
