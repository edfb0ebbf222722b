// An arm that reaches along itself, balanced by a spring whose length is no sum of sines: its base parameters are found from
// the regressor, not by lumping. Part of the moving mass is known.
robot SpringArm {
    coordinates th, x: m;
    /// Inertia about the joint; mass at the tip.
    parameters J: kg*m^2, m = 1.5 kg;
    /// Stiffness of the spring.
    parameters k: N/m;
    constants a = 0.1 m, b = 0.4 m, l0 = 0.2 m, m0 = 2 kg, g = 9.81 m/s^2;
    let spring = sqrt(a^2 + b^2 + 2*a*b*cos(th));
    kinetic = (J + (m + m0)*x^2)/2*dot(th)^2 + (m + m0)/2*dot(x)^2;
    potential = (m + m0)*g*x*sin(th) + k/2*(spring - l0)^2;
    limits th { position = -60 deg .. 60 deg; velocity = 2; torque = 40; }
    limits x { position = 0.2 .. 0.8; actuator_gain = 25; }
    effects { viscous_friction on all; stribeck(vs = 0.1) on th; motor_inertia on all; }
}
