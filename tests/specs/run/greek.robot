// Names in letters that languages of code do not take, and such as their functions have.
effect oil(j) {
    /// Drag at 0 degrees, N m s/rad.
    linear μ >= 0;
    input 温;
    torque(j) = μ * exp(-0.05 * 温) * dq(j);
}

robot Greek {
    coordinates θ, φ, y: m;
    parameters mθ: kg*m^2, mφ: kg*m^2, m1: kg, λ: kg*m;
    constants g = 9.81 m/s^2, ℓ = 0.5 m;
    kinetic = mθ/2*dot(θ)^2 + mφ/2*(dot(θ) + dot(φ))^2 + m1/2*(dot(y) + ℓ*cos(θ + φ)*(dot(θ) + dot(φ)))^2;
    potential = λ*g*sin(θ + φ) + m1*g*y;
    effects { oil on θ, φ; viscous_friction on y; }
}
