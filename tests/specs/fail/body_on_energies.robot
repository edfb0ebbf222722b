robot Swing {
    coordinates th;
    parameters i: kg*m^2;
    kinetic = i * dot(th)^2 / 2;
    potential = 0;
    effects { payload on th; base_tilt; }
}
