within PyImu.Units;
type VelocityRandomWalk = Real(final quantity="VelocityRandomWalk", min=0) "Root of the two-sided density of a specific force's white noise; unit m/s/sqrt(s)";
