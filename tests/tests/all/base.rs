//! What the torque depends on is found whatever its unit, its scale and where its effects wake up.

use robot_model_codegen::base::RankStatus;
use robot_model_codegen::{Compiled, compile_model};
use robot_model_tests::base_map::largest_difference;
use robot_model_tests::evaluate::Interpreter;
use robot_model_tests::states::{self, State};

fn compiled(text: &str) -> Compiled {
    let model = robot_model_spec::load("base.robot", text).unwrap_or_else(|e| panic!("{e}"));
    compile_model(&model)
}

fn planar(effects: &str, definitions: &str) -> Compiled {
    compiled(&format!(
        "{definitions}
        robot Planar {{
            gravity = [0, -9.81, 0]; convention = standard_dh;
            joint a: revolute {{ a = 0.5; alpha = 0; d = 0; }}
            joint b: revolute {{ a = 0.4; alpha = 0; d = 0; }}
            effects {{ {effects} }}
        }}"
    ))
}

fn names(compiled: &Compiled) -> Vec<&str> {
    compiled.base.names.iter().map(String::as_str).collect()
}

/// Effects that sleep at usual states: a threshold far out, a velocity far below.
#[test]
fn effects_with_a_scale_of_their_own_are_seen() {
    for (effects, definitions, wanted) in [
        (
            "stribeck(vs = 0.005) on all;",
            "",
            vec!["a.stribeck.fs", "b.stribeck.fs"],
        ),
        ("torque_saturation(limit = 30, v0 = 4) on all;", "", vec![]),
        (
            "warm on a;",
            "effect warm(j) { linear k; input temperature; torque(j) = k*max(0, temperature - 40)*dq(j); }",
            vec!["a.warm.k"],
        ),
        (
            "stop on a;",
            "effect stop(j) { linear s; torque(j) = s*max(0, abs(q(j)) - 3.1)*sign(q(j)); }",
            vec!["a.stop.s"],
        ),
        (
            "fast on b;",
            "effect fast(j) { linear f; torque(j) = if abs(dq(j)) > 2.5 { f } else { 0 }; }",
            vec!["b.fast.f"],
        ),
        (
            "far on b;",
            "effect far(j) { linear f; torque(j) = f*max(0, abs(dq(j)) - 3e5); }",
            vec!["b.far.f"],
        ),
        (
            "coulomb_friction on a; smooth on a;",
            "effect smooth(j) { linear f; torque(j) = f*tanh(dq(j)/0.001); }",
            vec!["a.coulomb_friction.fc", "a.smooth.f"],
        ),
        (
            "viscous_friction on a; lost on a;",
            "effect lost(j) { linear f; torque(j) = if abs(dq(j)) > 1e-4 { f*(dq(j) - 1e-4*sign(dq(j))) } else { 0 }; }",
            vec!["a.lost.f"],
        ),
        (
            "early on a; late on a;",
            "effect early(j) { linear f; torque(j) = if abs(dq(j)) > 2.4 { f } else { 0 }; }
             effect late(j) { linear f; torque(j) = if abs(dq(j)) > 2.5 { f } else { 0 }; }",
            vec!["a.early.f", "a.late.f"],
        ),
    ] {
        let compiled = planar(effects, definitions);
        assert!(
            compiled.base.rank.is_clear(),
            "{effects}: {}",
            compiled.base.rank
        );
        let effects_parameters = compiled.model.rigid_parameters()..compiled.standard.len();
        for k in effects_parameters {
            assert!(
                compiled.base.kept.contains(&k),
                "{effects}: {} is not kept",
                compiled.standard[k].name
            );
        }
        for name in wanted {
            assert!(
                names(&compiled).contains(&name),
                "{effects}: {:?}",
                names(&compiled)
            );
        }
        assert_eq!(
            compiled.base.remarks(&compiled.standard),
            [""; 0],
            "{effects}"
        );
    }
}

#[test]
fn an_effect_that_nothing_wakes_is_kept_and_told() {
    let compiled = planar(
        "asleep on a;",
        "effect asleep(j) { linear f; torque(j) = f*max(0, -abs(dq(j))); }",
    );
    assert!(names(&compiled).contains(&"a.asleep.f"));
    let remarks = compiled.base.remarks(&compiled.standard);
    assert!(
        remarks[0].contains("`a.asleep.f` was zero at every tested state"),
        "{remarks:?}"
    );
}

/// What is one law in two ways stays one base parameter.
#[test]
fn laws_that_are_one_are_one() {
    let compiled = planar(
        "coulomb_friction on a; again on a; sum on a;",
        "effect again(j) { linear g; torque(j) = if dq(j) > 0 { g } else if dq(j) < 0 { -g } else { 0 }; }
         effect sum(j) { linear s; torque(j) = s*(ddq(j) + 3*sign(dq(j))); }",
    );
    let name = |k: usize| compiled.standard[k].name.as_str();
    let combination = |own: &str| {
        let k = names(&compiled)
            .iter()
            .position(|name| *name == own)
            .expect(own);
        let terms = compiled.base.combinations[k].iter();
        terms.map(|&(k, c)| (name(k), c)).collect::<Vec<_>>()
    };
    assert_eq!(
        combination("a.coulomb_friction.fcr"),
        [
            ("a.coulomb_friction.fc", 1.0),
            ("a.again.g", 1.0),
            ("a.sum.s", 3.0)
        ]
    );
}

fn beam(energies: &str) -> Compiled {
    compiled(&format!(
        "robot Beam {{
            coordinates x: m;
            parameters E, m, k;
            constants L = 0.01, I = 3.14e-12, J = 3.14e-8, c = 1, d = 1e-20;
            kinetic = m/2*dot(x)^2;
            potential = {energies};
        }}"
    ))
}

fn states(compiled: &Compiled) -> Vec<State> {
    let mut random = states::generator(4);
    (0..20)
        .map(|_| states::state(&mut random, compiled.dof()))
        .collect()
}

/// A modulus of elasticity beside a moment of area: eleven powers of ten up, eleven down.
#[test]
fn coefficients_are_not_cut_by_their_size() {
    for energies in [
        "3*E*I/L^3/2*x^2 + k*x",
        "3*E*I/L^3/2*x^2 + k/2*x^2",
        "3*E*J/L^3/2*x^2 + k/2*x^2",
        "3*E*I/L^3/2*x^2 + c*k/4*x^4 + d*E*x^4",
    ] {
        let compiled = beam(energies);
        assert!(compiled.base.rank.is_clear());
        assert!(compiled.base.unidentifiable.is_empty(), "{energies}");
        let (difference, name) =
            largest_difference(&Interpreter::new(compiled.clone()), &states(&compiled));
        assert!(difference < 1e-11, "{energies}: {name} {difference:.1e}");
    }
    let compiled = beam("3*E*I/L^3/2*x^2 + k/2*x^2");
    let mut standard = vec![0.0; compiled.standard.len()];
    let e = compiled.standard.iter().position(|p| p.name == "E");
    standard[e.expect("a parameter of the spec")] = 2.1e11;
    let state = State {
        q: vec![1e-7],
        ..states(&compiled).remove(0)
    };
    let torque = Interpreter::new(compiled)
        .forms(&standard, &state)
        .inverse_dynamics[0];
    // 3 E I / L^3 x
    let wanted = 3.0 * 2.1e11 * 3.14e-12 / 1e-6 * 1e-7;
    assert!((torque / wanted - 1.0).abs() < 1e-12, "{torque} {wanted}");
}

/// Columns are looked at where they are numbers.
#[test]
fn columns_are_sampled_where_they_are_numbers() {
    let root = compiled(
        "effect soft(j) { linear k; torque(j) = k*sqrt(q(j)); }
        effect warm(j) { linear c; input temperature; torque(j) = c*sqrt(temperature)*dq(j); }
        robot Lift {
            gravity = [0, 0, -9.81]; convention = standard_dh;
            joint lift: prismatic { a = 0; alpha = 0; theta = 0; position = 0.1 .. 1.2; }
            effects { soft on lift; warm on lift; }
        }",
    );
    assert!(root.base.rank.is_clear(), "{}", root.base.rank);
    for name in ["lift.soft.k", "lift.warm.c"] {
        assert!(names(&root).contains(&name), "{:?}", names(&root));
    }
    let crank = |limits: &str| {
        compiled(&format!(
            "robot Crank {{
                coordinates x: m;
                parameters m, k;
                constants L = 1, g = 9.81;
                let s = sqrt(L^2 - x^2);
                kinetic = m/2*dot(x)^2 + m/2*dot(s)^2;
                potential = k*x^1.5 + m*g*s;
                {limits}
            }}"
        ))
    };
    let inside = crank("limits x { position = 0.3 .. 0.9; }");
    assert!(inside.base.rank.is_clear(), "{}", inside.base.rank);
    assert_eq!(names(&inside), ["m", "k"]);
}

#[test]
fn where_there_is_no_number_the_way_out_is_said() {
    let nowhere = planar(
        "never on a;",
        "effect never(j) { linear k; torque(j) = k*sqrt(-1 - q(j)^2); }",
    );
    assert!(matches!(nowhere.base.rank, RankStatus::NoNumber(_)));
    let words = nowhere.base.rank.to_string();
    assert!(
        words.contains("`a.never.k`") && words.contains("`position = LOW .. HIGH;`"),
        "{words}"
    );
    assert!(words.contains("a = ") && words.contains("b = "), "{words}");
}

#[test]
fn names_of_base_parameters_are_unique() {
    for text in [
        "robot Names {
            coordinates x: m, y: m;
            parameters J, Jr, K;
            kinetic = (J + K)/2*dot(x)^2 + Jr/2*dot(y)^2;
            potential = 0*x;
        }",
        "robot Names {
            coordinates x: m, y: m;
            parameters m, c1, c1r, K;
            kinetic = (m*c1 + K)/2*dot(x)^2 + c1r/2*dot(y)^2;
            potential = 0*x;
        }",
        "effect two(j) { linear k; linear kr; torque(j) = k*dq(j) + kr*sign(dq(j)); }
        effect again(j) { linear k; torque(j) = k*dq(j); }
        robot Names {
            gravity = [0, 0, -9.81]; convention = standard_dh;
            joint a: revolute { a = 0; alpha = 0; d = 0; }
            effects { two on a; again on a; }
        }",
    ] {
        let compiled = compiled(text);
        let mut all: Vec<&str> = names(&compiled);
        for (k, parameter) in compiled.standard.iter().enumerate() {
            let own = compiled.base.combinations.iter().zip(&compiled.base.kept);
            let is_base = own
                .into_iter()
                .any(|(c, kept)| *kept == k && *c == [(k, 1.0)]);
            if !is_base {
                all.push(&parameter.name);
            }
        }
        if let Some(energies) = compiled.model.energies() {
            let names = energies.parameters.iter().map(|p| p.name.as_str());
            let regrouped = compiled.base.names.iter().zip(&compiled.base.combinations);
            for (name, _) in regrouped.filter(|(_, c)| c.len() > 1) {
                let last = name.rsplit('*').next().expect("a name");
                assert!(names.clone().all(|other| other != last), "{name}");
            }
        }
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count, "{:?}", compiled.base.names);
    }
}
