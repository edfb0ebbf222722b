// itself.
robot Phantom {
    coordinates th1, th2, th3;
    //axes.
    parameters Ibase_yy: kg*m^2, Ibe_xx: kg*m^2, Ibe_yy: kg*m^2, Ibe_zz: kg*m^2, Ic_xx: kg*m^2, Ic_yy: kg*m^2, Ic_zz: kg*m^2,
        Ia_xx: kg*m^2, Ia_yy: kg*m^2, Ia_zz: kg*m^2, Idf_xx: kg*m^2, Idf_yy: kg*m^2, Idf_zz: kg*m^2;
    // body.
    parameters m_a, m_c, m_be, m_df;
    constants L1 = mm, L2 = mm, L3 = 32.5 mm, L5 = mm, L6 = mm, g = m/s^2;

    // c.
    let r_a = L1*cos(th2) + L2/2*sin(th3);
    let z_a = L1*sin(th2) - L2/2*cos(th3);
    let r_c = L1/2*cos(th2) + L3*sin(th3);
    let z_c = L1/2*sin(th2) - L3*cos(th3);

    let about_vertical = Ibase_yy + (Ibe_yy + Ic_yy)*cos(th2)^2 + (Ibe_zz + Ic_zz)*sin(th2)^2
        + (Ia_yy + Idf_yy)*cos(th3)^2 + (Ia_zz + Idf_zz)*sin(th3)^2 + m_a*r_a^2 + m_c*r_c^2;
    kinetic = (about_vertical*dot(th1)^2 + (Ibe_xx + Ic_xx)*dot(th2)^2 + (Ia_xx + Idf_xx)*dot(th3)^2
        + m_a*(dot(r_a)^2 + dot(z_a)^2) + m_c*(dot(r_c)^2 + dot(z_c)^2))/1e9 ;
    potential = g*(m_a*z_c + m_be*sin(th2) + m_df*cos(th3));

    point tip = [(L1*(th2) + L2*(th3))*(th1), L2 *(th3) + L1*(th2), (L1*(th2) *(th3))*(th1) - L1];
    effects { viscous_friction on all; }
}
