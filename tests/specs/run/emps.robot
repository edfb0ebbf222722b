// EMPS: one prismatic axis, a ball screw driven by a DC motor, with an encoder on the motor.
// A. Janot, M. Gautier, M. Brunot, "Data Set and Reference Models of EMPS", 2019 Workshop on Nonlinear System Identification
// Benchmarks: tau = M ddq + Fv dq + Fc sign(dq) + offset, all on the load's side, M = 95.109 kg, Fv = 203.50 N s/m,
// Fc = 20.394 N, offset = -3.165 N. Their data show friction that differs between directions; this model leaves it out.
robot Emps {
    gravity = [0, 0, -9.81];
    convention = origin;

    // Horizontal. The logged force is the drive's voltage times 35.15 N/V, so the gain of the channel is 1.
    joint carriage: prismatic { xyz = [0, 0, 0]; axis = [1, 0, 0]; link = load; }

    effects {
        viscous_friction on all;
        coulomb_friction on all;
        // Of the drive's set point and the motor's current loop.
        torque_offset on all;
    }
}
