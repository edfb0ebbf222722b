robot Arm;
