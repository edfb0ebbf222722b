robot Pendulum {
    coordinates th;
    parameters j: kg*m^2, k: N*m;
    kinetic = j * dot(th)^2 / 2;
    potential = if th > 0 { k * th } else { 0 };
}
