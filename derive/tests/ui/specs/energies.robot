robot Rod {
    coordinates th;
    parameters m: kg, c: m;
    constants g = 9.81 m/s^2;
    let x = c*sin(th);
    let y = -c*cos(th);
    kinetic = m/2*(dot(x)^2 + dot(y)^2);
    potential = g*m*y;
    effects { viscous_friction on th; }
}
