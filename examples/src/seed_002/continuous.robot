// The law without its jump: the viscous part begins at rest, not at `eps`.
robot Continuous {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint j: revolute { a = 0; alpha = 0; d = 0; velocity = 180 deg/s; }
    effects { rokae_continuous(eps = 0.01) on j; }
}
