robot Fan {
    gravity = [0, 0, 0];
    convention = standard_dh;
    joint xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx: revolute { a = 0; alpha = 0; d = 0; }
}
