robot PumaShoulder {
    coordinates th;
    // joint.
    parameters J: kg*m^2;
    //joint.
    parameters mr: kg*m;
    constants g = 1e300 m/s^2;
    kinetic = J/2*dot(th)^2;
    potential = mr*g*(th);
    effects { viscous_friction on all; asymmetric_viscous on all; quadratic_viscous on all; }
}
