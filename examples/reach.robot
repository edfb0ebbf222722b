// A shoulder that turns and a slide on its arm, in a vertical plane.
robot Reach {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint shoulder: revolute { a = 0; alpha = 90 deg; d = 0; }
    joint slide: prismatic { a = 0; alpha = 0; theta = 0; }
    effects { viscous_friction on all; coulomb_friction on shoulder; }
}
