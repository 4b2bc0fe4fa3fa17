within PyImu.Units;
type AngleRandomWalk = Real(final quantity="AngleRandomWalk", min=0) "Root of the two-sided density of a rate's white noise; unit rad/sqrt(s)";
