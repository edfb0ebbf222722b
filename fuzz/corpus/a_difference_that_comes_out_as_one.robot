robot MountedArm {
  gravity = [0, 0, 9.81];
  convention = modified_dh;
  joint lift: revolute { alpha = deg; a = 0.1; d = 16; }
  joint reach: prismatic { alpha = deg; a = 0; theta = 0; position = 0.2 .. 0.8; }
  joint slide: prismatic { a = 0; alpha = deg; theta = 0; }
  link reach: fixed { mass = 1e9; com = [100, 100, 0]; inertia = [1, 0.02, 0.01, 0, 0, 0]; }
}
