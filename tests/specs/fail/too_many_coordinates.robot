robot Snake {
    coordinates q1, q2, q3, q4, q5, q6, q7, q8, q9, q10, q11, q12, q13, q14, q15, q16, q17, q18, q19, q20, q21, q22, q23, q24, q25;
    parameters J: kg*m^2;
    kinetic = J/2*(dot(q1)^2 + dot(q2)^2 + dot(q3)^2 + dot(q4)^2 + dot(q5)^2 + dot(q6)^2 + dot(q7)^2 + dot(q8)^2 + dot(q9)^2 + dot(q10)^2 + dot(q11)^2 + dot(q12)^2 + dot(q13)^2 + dot(q14)^2 + dot(q15)^2 + dot(q16)^2 + dot(q17)^2 + dot(q18)^2 + dot(q19)^2 + dot(q20)^2 + dot(q21)^2 + dot(q22)^2 + dot(q23)^2 + dot(q24)^2 + dot(q25)^2);
    potential = 0;
}
