"""The magnetometer in the loop: what it shows against a field that is the same everywhere."""
