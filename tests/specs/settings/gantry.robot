// The robot whose logs the files of settings beside this one are of.
robot Gantry {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint rail: prismatic { a = 0; alpha = 90 deg; theta = 0; actuator_gain = 42 N/A; }
    joint swing: revolute { a = 0.4; alpha = 0; d = 0; }
    log {
        q = "rail/pos": mm, "swing/pos": deg;
        temperature = "motor temp";
    }
    effects { temperature_viscous on swing; }
}
