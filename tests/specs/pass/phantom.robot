// PHANTOM Premium 1.5A: a haptic device with a parallelogram, so its energies are written. Geometry and bodies of
// Cavusoglu, Feygin and Tendick 2002; what a log can tell of them are the eight lumped parameters of Taati, Tahmasebi and Hashtrudi-Zaad,
// equation (5), which the compiler finds by itself.
robot Phantom {
    coordinates th1, th2, th3;
    /// Inertia of a body about its center of mass, along its axes.
    parameters Ibase_yy: kg*m^2, Ibe_xx: kg*m^2, Ibe_yy: kg*m^2, Ibe_zz: kg*m^2, Ic_xx: kg*m^2, Ic_yy: kg*m^2, Ic_zz: kg*m^2,
        Ia_xx: kg*m^2, Ia_yy: kg*m^2, Ia_zz: kg*m^2, Idf_xx: kg*m^2, Idf_yy: kg*m^2, Idf_zz: kg*m^2;
    /// Mass of a body.
    parameters m_a: kg, m_c: kg, m_be: kg, m_df: kg;
    constants L1 = 215 mm, L2 = 170 mm, L3 = 32.5 mm, L5 = -36.8 mm, L6 = 52.7 mm, g = 9.81 m/s^2;

    // Distance from the vertical axis, and height, of the centers of mass of a and c.
    let r_a = L1*cos(th2) + L2/2*sin(th3);
    let z_a = L1*sin(th2) - L2/2*cos(th3);
    let r_c = L1/2*cos(th2) + L3*sin(th3);
    let z_c = L1/2*sin(th2) - L3*cos(th3);

    let about_vertical = Ibase_yy + (Ibe_yy + Ic_yy)*cos(th2)^2 + (Ibe_zz + Ic_zz)*sin(th2)^2
        + (Ia_yy + Idf_yy)*cos(th3)^2 + (Ia_zz + Idf_zz)*sin(th3)^2 + m_a*r_a^2 + m_c*r_c^2;
    kinetic = (about_vertical*dot(th1)^2 + (Ibe_xx + Ic_xx)*dot(th2)^2 + (Ia_xx + Idf_xx)*dot(th3)^2
        + m_a*(dot(r_a)^2 + dot(z_a)^2) + m_c*(dot(r_c)^2 + dot(z_c)^2))/2;
    potential = g*(m_a*z_a + m_c*z_c + m_be*L5*sin(th2) + m_df*L6*cos(th3));

    point tip = [(L1*cos(th2) + L2*sin(th3))*sin(th1), L2 - L2*cos(th3) + L1*sin(th2), (L1*cos(th2) + L2*sin(th3))*cos(th1) - L1];
    effects { viscous_friction on all; coulomb_friction on all; }
}
