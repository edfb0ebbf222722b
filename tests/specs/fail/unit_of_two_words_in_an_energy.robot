robot Slider {
    coordinates x: m;
    parameters mc: kg;
    kinetic = mc/2*(dot(x) + 1 m/s)^2;
    potential = 0;
}
