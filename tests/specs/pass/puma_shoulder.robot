// The shoulder of a PUMA alone, the angle taken from the upright: J ddth - m g r sin(th) + friction = u.
robot PumaShoulder {
    coordinates th;
    /// Inertia about the joint.
    parameters J: kg*m^2;
    /// Mass times the distance of its center from the joint.
    parameters mr: kg*m;
    constants g = 9.81 m/s^2;
    kinetic = J/2*dot(th)^2;
    potential = mr*g*cos(th);
    effects { viscous_friction on all; asymmetric_viscous on all; quadratic_viscous on all; }
}
