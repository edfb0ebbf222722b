// No axis is parallel or perpendicular to another, to the frames or to gravity: no term of the equations vanishes by luck.
robot Skew {
    gravity = [1.2, -3.4, -9.1];
    convention = origin;

    joint first:  revolute  { xyz = [0.1, 0.2, 0.3];   rpy = [20 deg, -35 deg, 50 deg];  axis = [1, 2, 3]; }
    joint second: prismatic { xyz = [-0.2, 0.1, 0.15]; rpy = [-70 deg, 15 deg, 110 deg]; axis = [2, -1, 0.5]; }
    joint third:  revolute  { xyz = [0.05, -0.3, 0.2]; rpy = [40 deg, 25 deg, -65 deg];  axis = [-1, 1, 2]; }

    effects {
        viscous_friction on all;
        coulomb_friction on second;
    }
}
