"""Logs of inertial sensors: reading them, their times, their quality and their reference."""
