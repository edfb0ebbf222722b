robot Pendulum {
    coordinates th;
    parameters m, l, s;
    constants g = 9.81 m/s^2;
    let height = l*cos(th);
    kinetic = 0.5 m*l^2*dot(th)^2 + 0.5m^2*dot(th)^2;
    potential = m*(2 g)*height + 3 th + 2 s + 4 height;
}
