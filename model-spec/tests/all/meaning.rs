//! What a spec means: frames, units, effects, and the tree that a derive builds.
use robot_model_spec::ast::{self, DeclaredEffect, Setting};
use robot_model_spec::model::{
    BinaryOp, Convention, EffectLeaf, EnergyLeaf, Expr, Inertial, JointKind, Placement, Signal,
    Transform,
};
use robot_model_spec::{Ast, Model, check, load};

fn spec(settings: &str) -> Model {
    let text = format!("robot Arm {{ gravity = [0, 0, -9.81]; {settings} }}");
    load("folder/arm.robot", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Pose of link `i` in link `i - 1` at `q`.
fn pose(placement: &Placement, kind: JointKind, q: f64) -> Transform {
    let q = q + placement.offset;
    let [x, y, z] = placement.axis;
    let motion = match kind {
        JointKind::Prismatic => Transform {
            translation: [x * q, y * q, z * q],
            ..Transform::IDENTITY
        },
        JointKind::Revolute => {
            // Rodrigues.
            let (s, c) = q.sin_cos();
            let v = 1.0 - c;
            let rotation = [
                [x * x * v + c, x * y * v - z * s, x * z * v + y * s],
                [x * y * v + z * s, y * y * v + c, y * z * v - x * s],
                [x * z * v - y * s, y * z * v + x * s, z * z * v + c],
            ];
            Transform {
                rotation,
                translation: [0.0; 3],
            }
        }
    };
    placement.before.then(&motion).then(&placement.after)
}

/// `Rz(theta) Tz(d) Tx(a) Rx(alpha)`, written out.
fn standard_dh(theta: f64, d: f64, a: f64, alpha: f64) -> Transform {
    let ((st, ct), (sa, ca)) = (theta.sin_cos(), alpha.sin_cos());
    Transform {
        rotation: [
            [ct, -st * ca, st * sa],
            [st, ct * ca, -ct * sa],
            [0.0, sa, ca],
        ],
        translation: [a * ct, a * st, d],
    }
}

/// `Rx(alpha) Tx(a) Rz(theta) Tz(d)`, written out.
fn modified_dh(theta: f64, d: f64, a: f64, alpha: f64) -> Transform {
    let ((st, ct), (sa, ca)) = (theta.sin_cos(), alpha.sin_cos());
    Transform {
        rotation: [
            [ct, -st, 0.0],
            [st * ca, ct * ca, -sa],
            [st * sa, ct * sa, ca],
        ],
        translation: [a, -sa * d, ca * d],
    }
}

fn assert_near(found: &Transform, wanted: &Transform) {
    let entries = |t: &Transform| [t.rotation.as_flattened(), &t.translation].concat();
    for (x, y) in entries(found).iter().zip(entries(wanted)) {
        assert!((x - y).abs() < 1e-14, "{found:?}\n{wanted:?}");
    }
}

#[test]
fn dh_rows_are_the_books_matrices() {
    type Row = fn(f64, f64, f64, f64) -> Transform;
    let rows: [(&str, Row); 2] = [("standard_dh", standard_dh), ("modified_dh", modified_dh)];
    for (convention, row) in rows {
        let model = spec(&format!(
            "convention = {convention};
             joint turn: revolute {{ a = 0.3; alpha = 40 deg; d = -0.2; offset = 0.7; }}
             joint slide: prismatic {{ a = -0.1; alpha = -1.1; theta = 25 deg; offset = 60 mm; }}"
        ));
        let [turn, slide] = model.joints.as_slice() else {
            panic!("two joints")
        };
        let links = &model.chain().unwrap().links;
        let written = "a = 0.3; alpha = 40 deg; d = -0.2; offset = 0.7";
        assert_eq!(links[0].frame, written);
        for q in [-2.0, 0.0, 0.9] {
            let turned = row(q + 0.7, -0.2, 0.3, 40f64.to_radians());
            assert_near(&pose(&links[0].placement, turn.kind, q), &turned);
            let slid = row(25f64.to_radians(), q + 0.06, -0.1, -1.1);
            assert_near(&pose(&links[1].placement, slide.kind, q), &slid);
        }
    }
}

#[test]
fn origin_frames_move_about_their_axis() {
    let model = spec(
        "convention = origin;
         joint j: revolute { xyz = [1, 2, 3]; rpy = [0, 0, 90 deg]; axis = [0, 0, 5]; }",
    );
    assert_eq!(model.chain().unwrap().convention, Convention::Origin);
    let at = pose(
        &model.chain().unwrap().links[0].placement,
        JointKind::Revolute,
        0.4,
    );
    let wanted = standard_dh(0.4 + std::f64::consts::FRAC_PI_2, 3.0, 0.0, 0.0);
    assert_near(
        &at,
        &Transform {
            translation: [1.0, 2.0, 3.0],
            ..wanted
        },
    );
}

#[test]
fn numbers_are_in_si_units_and_power_binds_tightest() {
    let number = |text: &str| {
        spec(&format!(
            "convention = standard_dh; joint j: revolute {{ a = {text}; alpha = 0; d = 0; }}"
        ))
        .chain()
        .unwrap()
        .links[0]
            .placement
            .after
            .translation[0]
    };
    let cases = [
        ("12 mm", 0.012),
        ("12mm", 0.012),
        ("1.5 cm + 0.5", 0.515),
        ("2^3^2/64", 8.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("1 + 2*3^2/6 - 4", 0.0),
        ("8 - 3 - 2", 3.0),
        ("8/4/2", 1.0),
        ("(2 m)^2/4 m", 1.0),
        ("sqrt(16)*cos(60 deg)", 2.0),
        ("6 m/s^2 * (0.5 s)^2", 1.5),
        ("1e-3", 0.001),
    ];
    for (text, wanted) in cases {
        assert!(
            (number(text) - wanted).abs() < 1e-15,
            "{text} is {}",
            number(text)
        );
    }
}

#[test]
fn inertials_are_moved_to_the_links_origin() {
    let model = spec(
        "convention = standard_dh; joint j: revolute { a = 0; alpha = 0; d = 0; link = arm; }
         link arm: fixed { mass = 2; com = [1, 2, 3]; inertia = [10, 0.1, 0.2, 20, 0.3, 30]; }",
    );
    assert_eq!(model.chain().unwrap().links[0].name, "arm");
    let wanted = [2.0, 2.0, 4.0, 6.0, 36.0, -3.9, -5.8, 40.0, -11.7, 40.0];
    let Inertial::Fixed(found) = model.chain().unwrap().links[0].inertial else {
        panic!("fixed")
    };
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-12);
    }
}

const TWO: &str = "convention = standard_dh;
    joint a: revolute { a = 1; alpha = 0; d = 0; }
    joint b: revolute { a = 1; alpha = 0; d = 0; }";

#[test]
fn effects_are_instances_with_names_of_their_own() {
    let model = spec(&format!(
        "{TWO} effects {{ viscous_friction on all; stribeck on b; gear_coupling on (a, b), (b, a); stribeck(vs = 0.2) on b; }}"
    ));
    let names: Vec<String> = (0..model.effects.len())
        .map(|k| model.effect_name(k))
        .collect();
    assert_eq!(
        names,
        [
            "a.viscous_friction",
            "b.viscous_friction",
            "b.stribeck",
            "a.gear_coupling",
            "b.gear_coupling",
            "b.stribeck2"
        ]
    );
    assert_eq!(model.effects[5].shapes, [Some(0.2)]);
    assert_eq!(model.effects[4].joints, [1, 0]);
    assert_eq!(model.source, "arm.robot");
    let parameters = model.standard_parameters();
    assert_eq!(parameters.len(), 20 + 2 + 1 + 3 + 3 + 1);
    let mut unique: Vec<&str> = parameters
        .iter()
        .map(|parameter| parameter.name.as_str())
        .collect();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), parameters.len());
}

#[test]
fn own_effects_stand_beside_the_standard_ones() {
    let text = format!(
        "robot Arm {{ gravity = [0, 0, 0]; {TWO} effects {{ drag on b; }} }}
         /// Drag.
         ///   Indented.
         effect drag(j) {{ /** Size. */ linear c >= 0, d; torque(j) = -c * dq(j)^3 + d; }}"
    );
    let model = load("arm.robot", &text).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(
        model.definitions.len(),
        robot_model_spec::standard_effects().len() + 1
    );
    let drag = &model.effects[0].definition;
    assert_eq!(drag.doc, "Drag.\n  Indented.");
    assert_eq!(
        (drag.linear[0].nonnegative, drag.linear[1].nonnegative),
        (true, false)
    );
    assert_eq!(drag.linear[1].doc, "Size.");
    assert!(matches!(
        drag.torques[0].value,
        Expr::Binary(BinaryOp::Add, ..)
    ));
}

/// A spring does; a gap is crossed at once, and another zero is where it is.
#[test]
fn links_give_way_to_their_load_at_springs() {
    let text = format!(
        "robot Arm {{ gravity = [0, 0, 0]; {TWO} effects {{ soft on b; }} }}
         /// Soft.
         effect soft(j) {{
             /// N m/rad.
             shape k in 1 .. 100;
             let load = rigid_torque(j);
             position(j) = -2 * load / k;
         }}"
    );
    let model = load("arm.robot", &text).unwrap_or_else(|errors| panic!("{errors}"));
    let all = model.definitions.iter().filter(|one| one.gives_way());
    let names: Vec<&str> = all.map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["joint_elasticity", "soft"]);
}

#[test]
fn a_derive_builds_the_same_tree_from_tokens() {
    let word = |text: &str| syn::parse_str::<syn::Ident>(text).unwrap();
    let setting = |text: &str| syn::parse_str::<Setting>(text).unwrap();
    let robot = ast::Robot {
        name: word("Arm"),
        settings: vec![
            setting("gravity = [0, -9.81, 0]"),
            setting("convention = standard_dh"),
        ],
        joints: vec![ast::Joint {
            name: word("shoulder"),
            kind: word("revolute"),
            settings: ["a = 0.615", "alpha = 0", "d = 0"].map(setting).to_vec(),
        }],
        links: vec![],
        energies: ast::Energies::default(),
        logs: vec![],
        effects: vec![ast::Effects {
            keyword: word("effects").span(),
            declared: vec![
                syn::parse_str::<DeclaredEffect>("viscous_friction on shoulder").unwrap(),
            ],
            close: word("effects").span(),
        }],
        close: word("Arm").span(),
    };
    let mut ast = Ast {
        robots: vec![robot],
        effects: vec![],
    };
    let model = check(&ast, "lib.rs").unwrap();
    assert_eq!(model.effect_name(0), "shoulder.viscous_friction");

    ast.robots[0].settings.pop();
    let errors = check(&ast, "lib.rs").unwrap_err();
    assert_eq!(
        errors[0].to_syn_error().to_string(),
        "the robot does not define its frame convention\nhelp: write `convention = standard_dh;`, `modified_dh` or `origin`; there is no \
         default"
    );
}

/// `2 m^2` are two square meters, with a power of one unit, of several, and inside an effect; exponents are made of numbers.
#[test]
fn a_power_behind_a_unit_is_the_units() {
    let text = include_str!("../../../tests/specs/pass/units.robot");
    let model = load("units.robot", text).unwrap_or_else(|errors| panic!("{errors}"));
    let energies = model
        .energies()
        .expect("the robot is defined by its energies");
    let (x, inertia, stiffness) = (0.7_f64, 0.3, 0.11);
    let value = energies.potential.number(&|leaf| match leaf {
        EnergyLeaf::Coordinate(0) => Some(x),
        EnergyLeaf::Coordinate(_) => Some(0.0),
        EnergyLeaf::Parameter(1) => Some(inertia),
        EnergyLeaf::Parameter(2) => Some(stiffness),
        _ => None,
    });
    let (k, area, side, inch) = (5.0, 3.0, 20e-6, 25.4e-3);
    let wanted = k * area / 2.0 * x.powi(2) + k * side / inch * x.powi(3) + stiffness;
    assert!(
        (value.unwrap() - wanted).abs() < 1e-14,
        "{value:?} {wanted}"
    );

    let torque = &model.effects[0].definition.torques[0].value;
    let value = torque.number(&|leaf| match leaf {
        EffectLeaf::Linear(0) => Some(3.0),
        EffectLeaf::Signal(Signal::Velocity, 0) => Some(0.5),
        _ => None,
    });
    assert!(
        (value.unwrap() - 3.0 * 2e-6 * 0.5).abs() < 1e-20,
        "{value:?}"
    );
}

/// Measured of a printed arm: softer bristles and more breakaway torque than a search expects.
#[test]
fn shapes_that_are_given_may_lie_outside_of_the_search() {
    let text = include_str!("../../../tests/specs/pass/lugre_link.robot").replace(
        "lugre_presliding on th",
        "lugre_presliding(d = 0.27, vs = 0.838, rise = 2.43) on th",
    );
    let model = load("lugre_link.robot", &text).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(
        model.effects[0].shapes,
        [Some(0.27), Some(0.838), Some(2.43)]
    );
}

/// Columns of logs: joints in order, units in SI, currents with a gain per ampere, inputs of the arm and of joints.
#[test]
fn a_log_says_where_its_channels_are() {
    let text = r#"
effect hot(j) { input motor_temperature(j); input room; linear a; torque(j) = a * (motor_temperature(j) - room); }
robot Arm {
    gravity = [0, 0, -9.81];
    convention = standard_dh;
    joint waist: revolute { a = 0; alpha = 90 deg; d = 0; actuator_gain = 250 mm*N/A; }
    joint slide: prismatic { a = 0; alpha = 0; theta = 0; }
    log {
        time = "stamp": ms;
        q = "pos.0": -360 deg/4096, " x ": mm;
        dq = "rate": rpm, "v";
        tau = "i0": mA, "f": kN;
        motor_temperature = "t0", "t1": 0.1;
        room = "t room";
    }
    effects { hot on all; }
}"#;
    let model = load("arm.robot", text).unwrap_or_else(|errors| panic!("{errors}"));
    let said = |columns: &[robot_model_spec::model::LogColumn]| -> Vec<(String, f64)> {
        columns
            .iter()
            .map(|own| (own.name.clone(), own.unit))
            .collect()
    };
    let named = |pairs: &[(&str, f64)]| -> Vec<(String, f64)> {
        pairs
            .iter()
            .map(|(name, unit)| ((*name).to_owned(), *unit))
            .collect()
    };
    let log = &model.log;
    let time = log.time.clone().expect("a time");
    assert_eq!(said(&[time]), named(&[("stamp", 1e-3)]));
    let count = std::f64::consts::TAU / 4096.0;
    assert_eq!(said(&log.q), named(&[("pos.0", -count), ("x", 1e-3)]));
    let rpm = std::f64::consts::TAU / 60.0;
    assert_eq!(said(&log.dq), named(&[("rate", rpm), ("v", 1.0)]));
    assert_eq!(said(&log.tau), named(&[("i0", 1e-3), ("f", 1e3)]));
    let inputs: Vec<&str> = log.inputs.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(inputs, ["motor_temperature1", "motor_temperature2", "room"]);
    let columns: Vec<_> = log.inputs.iter().map(|(_, own)| own.clone()).collect();
    assert_eq!(
        said(&columns),
        named(&[("t0", 1.0), ("t1", 0.1), ("t room", 1.0)])
    );
    assert!((model.joints[0].actuator_gain - 0.25).abs() < 1e-15);
}
