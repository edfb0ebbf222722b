robot Link {
    coordinates th;
    parameters p0, p1, p2, p3, p4, p5, p6, p7, p8, p9, p10, p11;
    let s = p0 + p1 + p2 + p3 + p4 + p5 + p6 + p7 + p8 + p9 + p10 + p11;
    kinetic = s^16*dot(th)^2;
    potential = 0;
}
