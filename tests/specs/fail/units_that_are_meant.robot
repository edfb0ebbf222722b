// In millimeters, grams and degrees, without saying so.
robot R {
    gravity = [0, 0, -9810];
    convention = origin;
    joint turn: revolute { xyz = [0, 0, 400]; axis = [0, 0, 1]; link = hand; velocity = 180; torque = 60000; }
    joint slide: prismatic { xyz = [0, 0, 0.1]; axis = [0, 0, 1]; link = tool; velocity = 250; }
    link hand { mass = 5000; com = [10, 0, 220]; inertia = [5e4, 0, 0, 5e4, 0, 5e4]; }
}
