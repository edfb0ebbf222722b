// Sines and cosines of all angles of a state, in rad. With -DROBOT_MODEL_SINES_COSINES=NAME this calls a function NAME of these
// arguments, which may compute them side by side; libm's take more time than the rest of an arm's equations.
#ifdef ROBOT_MODEL_SINES_COSINES
#ifdef __cplusplus
extern "C"
#endif
void ROBOT_MODEL_SINES_COSINES(int count, const double *angles, double *sines, double *cosines);
#endif

static void robot_sines_cosines(int count, const double *angles, double *sines, double *cosines) {
#ifdef ROBOT_MODEL_SINES_COSINES
    ROBOT_MODEL_SINES_COSINES(count, angles, sines, cosines);
#else
    for (int k = 0; k < count; ++k) {
        const double angle = angles[k];
        sines[k] = sin(angle);
        cosines[k] = cos(angle);
    }
#endif
}
