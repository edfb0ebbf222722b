// PHANTOM Premium 1.5A by equation (4) of Taati et al. as it is printed: in the row of pi4 the torque of joint 3 has
// + dtheta2^2 cos(theta2 - theta3) / 2. Lagrange's equations have a minus there, so no energy has this row, and it is an effect.
effect parallelogram(i, j, k) {
    /// Lumped parameter, kg m^2.
    linear pi4;
    let c23 = cos(q(j) - q(k));
    let s23 = sin(q(j) - q(k));
    torque(i) = pi4*(ddq(i)*cos(q(j))*sin(q(k)) - dq(i)*dq(j)*sin(q(j))*sin(q(k)) + dq(i)*dq(k)*cos(q(j))*cos(q(k)));
    torque(j) = pi4*(-ddq(k)*s23/2 + dq(i)^2*sin(q(j))*sin(q(k))/2 + dq(k)^2*c23/2);
    torque(k) = pi4*(-ddq(j)*s23/2 - dq(i)^2*cos(q(j))*cos(q(k))/2 + dq(j)^2*c23/2);
}

robot Phantom {
    coordinates theta1, theta2, theta3;
    parameters pi1: kg*m^2, pi2: kg*m^2, pi3: kg*m^2, pi5: kg*m^2, pi6: kg*m^2, pi7: Nm, pi8: Nm;
    kinetic = ((pi1 + pi2*cos(2*theta2) + pi3*cos(2*theta3))*dot(theta1)^2 + pi5*dot(theta2)^2 + pi6*dot(theta3)^2)/2;
    potential = pi7*sin(theta2) - pi8*cos(theta3);
    effects { parallelogram on (theta1, theta2, theta3); viscous_friction on all; coulomb_friction on all; }
}
