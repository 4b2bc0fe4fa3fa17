"""What becomes of the cases of ``effect_logs``: the loop closed on them, judged, and counted."""
