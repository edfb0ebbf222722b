use super::*;

const ARM: &str = "
    #[robot(convention = standard_dh, gravity = [0, -9.81, 0])]
    struct Arm {
        #[joint(revolute, a = 0.5, alpha = 0, d = 0, position = -90 deg .. 90 deg)]
        #[effects(stribeck(vs = 0.1))]
        shoulder: Link<(ViscousFriction, Stribeck)>,
        #[joint(revolute, a = 0, alpha = 0, d = 0, link = fore)]
        #[inertial(fixed, mass = 1.2, com = [0.2, 0, 0], inertia = [0, 0, 0, 0, 0, 0.01])]
        elbow: (),
        #[on(shoulder, elbow)]
        coupling: GearCoupling,
    }";

const PENDULUM: &str = "robot Pendulum {
    gravity = [0, -9.81, 0];
    convention = standard_dh;
    joint pivot: revolute { a = 0.5; alpha = 0; d = 0; }
    effects { viscous_friction on pivot; }
}";

fn derived(text: &str) -> String {
    let read = |name: &str| match name {
        "pendulum.robot" => Ok(PENDULUM.to_owned()),
        "wrong.robot" => Ok(PENDULUM.replace("alpha = 0;", "")),
        _ => Err(io::Error::new(io::ErrorKind::NotFound, "no such file")),
    };
    derive(text.parse().expect("tokens"), &read).to_string()
}

#[test]
fn a_struct_of_links_becomes_an_implementation() {
    let tokens = derived(ARM);
    assert!(
        tokens.contains("RobotModel <") && tokens.contains("for Arm"),
        "{tokens}"
    );
    assert!(
        tokens.contains("self . shoulder . effects . 1 . fs"),
        "{tokens}"
    );
    assert!(
        !tokens.contains("__comment") && !tokens.contains("compile_error"),
        "{tokens}"
    );
    syn::parse_str::<syn::File>(&tokens).expect("items");
}

#[test]
fn a_file_is_described_in_itself_and_tracked() {
    let tokens = derived(
        "#[robot(file = \"pendulum.robot\")] struct Pendulum { pivot: Link<ViscousFriction> }",
    );
    assert!(tokens.contains("for Pendulum"), "{tokens}");
    assert!(
        tokens.contains("include_bytes") && !tokens.contains("compile_error"),
        "{tokens}"
    );
    syn::parse_str::<syn::File>(&tokens).expect("items");
}

#[test]
fn mistakes_of_a_file_have_their_place_in_it() {
    let tokens = derived(
        "#[robot(file = \"wrong.robot\")] struct Pendulum { pivot: Link<ViscousFriction> }",
    );
    assert!(tokens.contains("wrong.robot:4:"), "{tokens}");
    assert!(tokens.contains("include_bytes"), "{tokens}");
}

#[test]
fn types_of_effects_hold_linear_and_shape_parameters() {
    let tokens = types::standard().to_string();
    assert!(tokens.contains("pub struct ViscousFriction"), "{tokens}");
    assert!(tokens.contains("pub vs : f64"), "{tokens}");
    syn::parse_str::<syn::File>(&tokens).expect("items");
}
