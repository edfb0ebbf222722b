// A level slide: no gravity, no Coriolis force, and a regressor that is zero but for one entry.
robot LoneSlide {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint rail: prismatic { a = 0; alpha = 90 deg; theta = 0; }
    link rail { mass = 2; com = [0, 0, 0]; inertia = [0, 0, 0, 0, 0, 0]; }
}
