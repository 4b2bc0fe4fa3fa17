within PyImu.Units;
type AccelerationRandomWalk = Real(final quantity="AccelerationRandomWalk", min=0) "Root of the two-sided density of a specific force's derivative; unit m/s^2/sqrt(s)";
