effect drag(j) { linear c; torque(j) = c * dq(j); }
