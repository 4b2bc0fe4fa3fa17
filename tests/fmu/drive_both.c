/* Two units in one program, step by step in turn. */
void ImuSensor_begin(void), ImuSensor_step(double, double);
void AttitudeUkf_begin(void), AttitudeUkf_step(double, double);
int main(void) {
    ImuSensor_begin();
    AttitudeUkf_begin();
    for (int k = 0; k < STEPS; k++) {
        ImuSensor_step(k * SIZE, SIZE);
        AttitudeUkf_step(k * SIZE, SIZE);
    }
}
