"""Results of attitude kinematics: quaternions, Rodrigues parameters, the attitude error, rates."""
