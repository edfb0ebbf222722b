//! Where the robot is described: in the struct's attributes, or in a file.

use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use quote::{quote, quote_spanned};
use robot_model_spec::library::effect_definitions;
use robot_model_spec::{Ast, Diagnostic, Diagnostics, Model};
use syn::Ident;
use syn::spanned::Spanned;

use super::ReadFile;
use super::fields::{FileName, Robot, RobotField};
use super::holds::{Holds, type_name};
use super::mistake::{Errors, mistake};

/// The checked model.
pub fn model(robot: &Robot, read: ReadFile<'_>) -> syn::Result<Model> {
    match &robot.file {
        Some(file) => in_file(robot, file, read),
        None => in_attributes(robot, read),
    }
}

fn in_file(robot: &Robot, file: &FileName, read: ReadFile<'_>) -> syn::Result<Model> {
    let mut errors = Errors::default();
    let elsewhere = |what: &str, here: &str| {
        let file = &file.name;
        format!("{what} is in `{file}`: remove {here}")
    };
    for entry in &robot.settings {
        let what = elsewhere("the robot's description", "this entry");
        errors.mistake(entry.span(), what);
    }
    if let Some(effects) = &robot.effects {
        let what = elsewhere("the definition of effects", "`effects = ..`");
        errors.mistake(effects.span, what);
    }
    for field in &robot.fields {
        if field.joint.is_some() {
            let what = elsewhere("the description of joints", "`#[joint(..)]`");
            errors.mistake(field.name.span(), what);
        }
        if field.inertial.is_some() {
            let what = elsewhere("what is known of links", "`#[inertial(..)]`");
            errors.mistake(field.name.span(), what);
        }
        for effect in field.holds.effects() {
            if let Some(shapes) = &effect.shapes {
                let what = elsewhere("a value of a shape parameter", "`#[effects(..)]`");
                errors.mistake(shapes.span(), what);
            }
        }
    }
    errors.finish(())?;
    let text = read_file(file, read)?;
    with_places(|| robot_model_spec::load(&file.name, &text))
        .map_err(|mistakes| mistaken(file, &mistakes))
}

fn in_attributes(robot: &Robot, read: ReadFile<'_>) -> syn::Result<Model> {
    let mut ast = robot_model_spec::parse_tokens(spec(robot)?)?;
    if let Some(file) = &robot.effects {
        ast.effects = own_effects(file, read)?.effects;
    }
    robot_model_spec::check(&ast, &robot.name.to_string()).map_err(|mistakes| {
        let mut errors = Errors::default();
        for one in &mistakes {
            errors.keep::<()>(Err(in_rust(one)));
        }
        let nothing = || mistake(robot.name.span(), "the spec has mistakes");
        errors.finish(()).err().unwrap_or_else(nothing)
    })
}

/// What the language writes as a setting or a declaration, and what attributes write.
const IN_RUST: [(&str, &str); 5] = [
    (
        "`gravity = [0, 0, -9.81];`",
        "`#[robot(gravity = [0, 0, -9.81])]`",
    ),
    (
        "`convention = standard_dh;`",
        "`#[robot(convention = standard_dh)]`",
    ),
    (
        "`joint name: revolute { .. }`",
        "a field `name: Link` with `#[joint(revolute, ..)]`",
    ),
    (
        "beside the robot",
        "in a file that `#[robot(effects = \"..\")]` names",
    ),
    // Settings of joints and links stand between commas.
    (";`", "`"),
];

/// A mistake in the words of attributes.
fn in_rust(said: &Diagnostic) -> syn::Error {
    let mut message = said.message().to_owned();
    let mut help = said.help_text().unwrap_or_default().to_owned();
    for (language, rust) in IN_RUST {
        help = help.replace(language, rust);
    }
    if message.starts_with("unknown effect `") {
        (message, help) = (with_types(&message), with_types(&help));
    }
    if let Some(fields) = in_a_field(&message) {
        (message, help) = (with_types(&message), fields);
    }
    let text = if help.is_empty() {
        message
    } else {
        format!("{message}\nhelp: {help}")
    };
    mistake(said.span(), text)
}

/// How a field declares an effect that stands on other joints than it can act on.
fn in_a_field(message: &str) -> Option<String> {
    let (effect, count) = message.strip_prefix("effect `")?.split_once("` acts on ")?;
    let holds = type_name(effect);
    let own = |on: &str| format!("give it its own field: `#[on({on})] {effect}: {holds}`");
    Some(match count {
        "the arm as a whole" => own(""),
        "one joint" => format!("write it into the type of its joint: `Link<{holds}>`"),
        "two joints together" => own("first_joint, second_joint"),
        _ => own("first_joint, .."),
    })
}

/// Names of effects in backticks as their types.
fn with_types(text: &str) -> String {
    let parts = text.split('`').enumerate();
    let parts = parts.map(|(k, part)| {
        let is_name = part.chars().all(|c| c.is_ascii_lowercase() || c == '_');
        if k % 2 == 1 && is_name {
            type_name(part)
        } else {
            part.to_owned()
        }
    });
    parts.collect::<Vec<_>>().join("`")
}

/// Effects defined in a file; a robot beside them is not looked at.
fn own_effects(file: &FileName, read: ReadFile<'_>) -> syn::Result<Ast> {
    let text = read_file(file, read)?;
    // First with places in the file, then as tokens of this compilation.
    with_places(|| effect_definitions(&file.name, &text))
        .map_err(|mistakes| mistaken(file, &mistakes))?;
    let unreadable =
        |error: &dyn std::fmt::Display| mistake(file.span, format!("`{}`: {error}", file.name));
    let tokens: TokenStream = text.parse().map_err(|error| unreadable(&error))?;
    robot_model_spec::parse_tokens(tokens).map_err(|error| unreadable(&error))
}

pub(super) fn read_file(file: &FileName, read: ReadFile<'_>) -> syn::Result<String> {
    if Path::new(&file.name).is_absolute() {
        return Err(mistake(
            file.span,
            "the path of a file is relative to the folder of Cargo.toml: write it without the folders of one machine",
        ));
    }
    read(&file.name).map_err(|error| {
        mistake(
            file.span,
            format!(
                "cannot read `{}`: {error}; the path is relative to the folder of Cargo.toml",
                file.name
            ),
        )
    })
}

/// Runs a parser whose spans count lines and columns of its own text; inside the compiler they would not.
pub(super) fn with_places<T>(parse: impl FnOnce() -> T) -> T {
    proc_macro2::fallback::force();
    let parsed = parse();
    proc_macro2::fallback::unforce();
    parsed
}

/// A derive cannot point into another file: the place is in the message.
pub(super) fn mistaken(file: &FileName, mistakes: &Diagnostics) -> syn::Error {
    let count = match mistakes.len() {
        1 => "a mistake".to_owned(),
        n => format!("{n} mistakes"),
    };
    mistake(
        file.span,
        format!("`{}` has {count}\n\n{mistakes}\n", file.name),
    )
}

/// The struct as a spec: `robot Name { .. }`.
fn spec(robot: &Robot) -> syn::Result<TokenStream> {
    let mut errors = Errors::default();
    let (mut joints, mut effects) = (TokenStream::new(), TokenStream::new());
    for field in &robot.fields {
        if let Some(joint) = errors.keep(joint(field)) {
            joints.extend(joint);
        }
        let name = field.name;
        let targets = match field.on.as_deref() {
            None => quote!(on #name),
            // The arm as a whole.
            Some([]) => quote!(),
            Some(joints) => quote_spanned!(field.span=> on (#(#joints),*)),
        };
        for effect in field.holds.effects() {
            let (effect, shapes) = (&effect.effect, &effect.shapes);
            let shapes = shapes.as_ref().map(|shapes| quote!((#shapes)));
            effects.extend(quote!(#effect #shapes #targets;));
        }
    }
    errors.finish(())?;
    let name = robot.name;
    let settings = statements(&robot.settings);
    let effects = if effects.is_empty() {
        effects
    } else {
        quote!(effects { #effects })
    };
    Ok(quote_spanned!(name.span()=> robot #name { #settings #joints #effects }))
}

/// `joint name: kind { .. }` and its link; nothing for a field of effects.
fn joint(field: &RobotField) -> syn::Result<TokenStream> {
    let name = field.name;
    match (&field.joint, &field.holds, &field.on) {
        (None, Holds::Effects(_), Some(_)) => return Ok(TokenStream::new()),
        (_, Holds::Number, _) => {
            return Err(mistake(
                field.span,
                format!(
                    "`{name}` is an unknown constant, which a chain cannot have: describe the robot by its energies with `#[robot(file = \
                     \"..\")]`, or hold `Link<..>` or effects"
                ),
            ));
        }
        (None, Holds::Link(_), Some(_)) => {
            return Err(mistake(
                field.span,
                format!("`{name}` has `#[on(..)]` and a link: write the type of the effect alone"),
            ));
        }
        (None, Holds::Link(_), None) => {
            return Err(mistake(
                field.span,
                format!(
                    "joint `{name}` has no frame: write `#[joint(revolute, a = .., alpha = .., d = ..)]`"
                ),
            ));
        }
        (None, Holds::Effects(_), None) => {
            return Err(mistake(
                field.span,
                format!(
                    "`{name}` acts on no joint: write `#[joint(..)]` if it is one, `#[on(joint, joint)]`, or `#[on()]` for the arm as a whole"
                ),
            ));
        }
        (Some(_), _, _) => {}
    }
    let mut settings = field.joint.iter().flatten();
    let first = settings.next();
    let Some(kind) = first.filter(|kind| is_one_word(kind)) else {
        return Err(mistake(
            first.map_or(name.span(), Spanned::span),
            format!(
                "joint `{name}` has no kind: write `#[joint(revolute, ..)]` or `#[joint(prismatic, ..)]`"
            ),
        ));
    };
    let settings: Vec<TokenStream> = settings.cloned().collect();
    let link = settings.iter().find_map(link_name);
    let settings = statements(&settings);
    let mut tokens = quote!(joint #name: #kind { #settings });
    if let Some(inertial) = &field.inertial {
        let (status, settings) = match inertial.split_first() {
            Some((status, rest)) if is_one_word(status) => (Some(quote!(: #status)), rest),
            _ => (None, inertial.as_slice()),
        };
        let settings = statements(settings);
        let link = link.unwrap_or_else(|| quote!(#name));
        tokens.extend(quote!(link #link #status { #settings }));
    }
    Ok(tokens)
}

/// `link = column` of a joint.
fn link_name(setting: &TokenStream) -> Option<TokenStream> {
    let mut tokens = setting.clone().into_iter();
    let is_link = matches!(tokens.next(), Some(TokenTree::Ident(key)) if key == "link");
    let is_equal = matches!(tokens.next(), Some(TokenTree::Punct(punct)) if punct.as_char() == '=');
    (is_link && is_equal).then(|| tokens.collect())
}

fn is_one_word(tokens: &TokenStream) -> bool {
    syn::parse2::<Ident>(tokens.clone()).is_ok()
}

/// `a; b; c;`
fn statements(entries: &[TokenStream]) -> TokenStream {
    entries.iter().map(|entry| quote!(#entry;)).collect()
}
