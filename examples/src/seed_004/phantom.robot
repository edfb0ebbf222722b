// PHANTOM Premium 1.5A in the eight lumped parameters of equations (4) and (5) of Taati, Tahmasebi and Hashtrudi-Zaad. A
// parallelogram is no serial chain, so energies are written; equations (2), (4) and (13) follow from them.
// Position limits are a workspace that the paper does not give: the forearm hangs at theta3 = 0, the upper arm is level at
// theta2 = 0 and stands at 90 degrees.
robot Phantom {
    coordinates theta1, theta2, theta3;
    /// Inertia about the vertical axis.
    parameters pi1: kg*m^2, pi2: kg*m^2, pi3: kg*m^2;
    /// Coupling of the links, and their own inertia.
    parameters pi4: kg*m^2, pi5: kg*m^2, pi6: kg*m^2;
    /// Moments of gravity.
    parameters pi7: Nm, pi8: Nm;
    constants L1 = 216 mm, L2 = 170 mm;

    let about_vertical = pi1 + pi2*cos(2*theta2) + pi3*cos(2*theta3) + pi4*cos(theta2)*sin(theta3);
    kinetic = (about_vertical*dot(theta1)^2 + pi5*dot(theta2)^2 + pi6*dot(theta3)^2
        - pi4*sin(theta2 - theta3)*dot(theta2)*dot(theta3))/2;
    potential = pi7*sin(theta2) - pi8*cos(theta3);

    let reach = L1*cos(theta2) + L2*sin(theta3);
    point tip = [reach*sin(theta1), L1*sin(theta2) - L2*cos(theta3), reach*cos(theta1)];
    limits theta1 { position = -60 deg .. 60 deg; velocity = 3.5 rad/s; }
    limits theta2 { position = -30 deg .. 100 deg; velocity = 3.5 rad/s; }
    limits theta3 { position = -30 deg .. 75 deg; velocity = 3.5 rad/s; }
    effects { viscous_friction on all; coulomb_friction on all; }
}
