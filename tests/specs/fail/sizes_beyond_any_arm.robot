// In kilograms and kilogram square meters, as bare numbers are.
robot R {
    gravity = [0, 0, -9.81e12];
    convention = origin;
    joint turn: revolute { xyz = [0, 0, 0]; axis = [0, 0, 1]; link = hand; velocity = 1e20; torque = 1e15; }
    link hand { mass = 2e7; com = [0, 0, 0]; inertia = [1e12, 0, 0, 1e12, 0, 1e12]; }
}
