within PyImu.Units;
type RateRandomWalk = Real(final quantity="RateRandomWalk", min=0) "Root of the two-sided density of a rate's derivative; unit rad/s/sqrt(s)";
