"""The effect of temperature on the bias: a polynomial, hysteresis and warm-up."""
