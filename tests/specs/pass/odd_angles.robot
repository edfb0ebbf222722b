// Frames at 45 and 30 degrees, whose sines are numbers that lints know by name; called as a trait of the runtime is.
robot Scalar {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint first: revolute { a = 0.3; alpha = 45 deg; d = 0.2; }
    joint second: revolute { a = 0; alpha = 30 deg; d = 0.1; }
    joint third: prismatic { a = 0.1; alpha = 60 deg; theta = 45 deg; }
    effects { load_dependent_friction on second; torque_ripple(k = 3) on first; }
}
