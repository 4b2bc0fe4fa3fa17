"""The error model of a part: effects, the chain and the sensor that they make, part files."""
