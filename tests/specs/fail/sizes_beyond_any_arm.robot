// With the units that bare numbers have.
robot R {
    gravity = [0, 0, -9.81e12 m/s^2];
    convention = origin;
    joint turn: revolute { xyz = [0, 0, 0]; axis = [0, 0, 1]; link = hand; velocity = 1e20 rad/s; torque = 1e15 Nm; }
    link hand { mass = 2e7 kg; com = [0, 0, 0]; inertia = [1e12 kg*m^2, 0, 0, 1e12 kg*m^2, 0, 1e12 kg*m^2]; }
}
