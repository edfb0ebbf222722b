//! `robot Name { settings, joints, links, effects }`; what energies are made of is in [`super::energies`].

use syn::parse::{Parse, ParseStream};
use syn::{Ident, Token};

use super::{
    Sink, block, doc_comment, energies, log, name, semicolon, statements, with_sink, word,
};
use crate::ast::{
    DeclaredEffect, Effects, Energies, Expr, Joint, Limits, Link, Robot, Setting, Target, Targets,
    Value, join,
};

/// Behind the word `robot`.
pub(super) fn robot(input: ParseStream, errors: &mut Sink) -> syn::Result<Robot> {
    let name = name(input, "the robot's name")?;
    let (content, close) = block(input, "`{` and the robot's description")?;
    let mut robot = Robot {
        name,
        settings: vec![],
        joints: vec![],
        links: vec![],
        energies: Energies::default(),
        effects: vec![],
        logs: vec![],
        close,
    };
    statements(&content, errors, |input, errors| {
        let doc = doc_comment(input)?;
        if input.peek(Token![let]) {
            input.parse::<Token![let]>()?;
            robot.energies.bindings.push(energies::binding(input)?);
            return semicolon(input);
        }
        if input.peek2(Token![=]) || input.peek2(Token![:]) {
            robot.settings.push(statement_setting(input)?);
            return Ok(());
        }
        let keyword = word(input, "a setting, `joint`, `link` or `effects`")?;
        match keyword.to_string().as_str() {
            "joint" => robot.joints.push(joint(input, errors)?),
            "link" => robot.links.push(link(input, errors)?),
            "effects" => robot.effects.push(effects(input, &keyword, errors)?),
            "log" => robot.logs.push(log::log(input, &keyword, errors)?),
            "limits" => robot.energies.limits.push(limits(input, errors)?),
            "coordinates" | "parameters" | "constants" | "point" => {
                energies::statement(input, &keyword.to_string(), &doc, &mut robot.energies)?;
                semicolon(input)?;
            }
            "effect" => {
                return Err(crate::diagnostic::syn_error(
                    keyword.span(),
                    "an effect is declared inside a robot",
                    Some(
                        "write it after the robot's last `}`, and declare where it acts in the robot: `effects { name() on joint; }`",
                    ),
                ));
            }
            _ => {
                return Err(crate::diagnostic::syn_error(
                    keyword.span(),
                    &format!("a robot has no `{keyword}`"),
                    Some(
                        "write `gravity = ..;`, `convention = ..;`, `joint name: kind { .. }`, `link name { .. }`, `effects { .. }` or `log \
                         { .. }`; or define its energies: `coordinates ..;`, `parameters ..;`, `constants ..;`, `let ..;`, `kinetic = ..;`, \
                         `potential = ..;`",
                    ),
                ));
            }
        }
        Ok(())
    });
    Ok(robot)
}

fn joint(input: ParseStream, errors: &mut Sink) -> syn::Result<Joint> {
    let name = name(input, "the joint's name")?;
    if !input.peek(Token![:]) {
        return Err(crate::diagnostic::syn_error(
            input.span(),
            &format!("joint `{name}` has no kind"),
            Some(&format!(
                "write `joint {name}: revolute {{ .. }}` or `joint {name}: prismatic {{ .. }}`"
            )),
        ));
    }
    input.parse::<Token![:]>()?;
    let kind = word(input, "`revolute` or `prismatic`")?;
    Ok(Joint {
        name,
        kind,
        settings: settings(input, errors)?,
    })
}

fn link(input: ParseStream, errors: &mut Sink) -> syn::Result<Link> {
    let name = name(input, "the link's name")?;
    let status = if input.peek(Token![:]) {
        input.parse::<Token![:]>()?;
        Some(word(input, "`nominal` or `fixed`")?)
    } else {
        None
    };
    Ok(Link {
        name,
        status,
        settings: settings(input, errors)?,
    })
}

fn limits(input: ParseStream, errors: &mut Sink) -> syn::Result<Limits> {
    Ok(Limits {
        name: name(input, "the coordinate's name")?,
        settings: settings(input, errors)?,
    })
}

/// `{ key = value; .. }`
fn settings(input: ParseStream, errors: &mut Sink) -> syn::Result<Vec<Setting>> {
    let (content, _) = block(input, "`{` and settings")?;
    let mut settings = Vec::new();
    statements(&content, errors, |input, _| {
        doc_comment(input)?;
        settings.push(statement_setting(input)?);
        Ok(())
    });
    Ok(settings)
}

fn statement_setting(input: ParseStream) -> syn::Result<Setting> {
    let setting = input.parse()?;
    semicolon(input)?;
    Ok(setting)
}

fn effects(input: ParseStream, keyword: &Ident, errors: &mut Sink) -> syn::Result<Effects> {
    let (content, close) = block(input, "`{` and effects")?;
    let mut declared = Vec::new();
    statements(&content, errors, |input, _| {
        doc_comment(input)?;
        declared.push(input.parse()?);
        semicolon(input)
    });
    Ok(Effects {
        keyword: keyword.span(),
        declared,
        close,
    })
}

impl Parse for Robot {
    /// Behind the word `robot`.
    fn parse(input: ParseStream) -> syn::Result<Self> {
        with_sink(|errors| robot(input, errors))?
    }
}

impl Parse for Setting {
    /// `key = value`
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let key = word(input, "the name of a setting")?;
        if !input.peek(Token![=]) {
            return Err(crate::diagnostic::syn_error(
                input.span(),
                &format!("expected `=` after `{key}`{}", super::found(input)),
                Some(&format!("write `{key} = value;`")),
            ));
        }
        input.parse::<Token![=]>()?;
        Ok(Self {
            key,
            value: input.parse()?,
        })
    }
}

impl Parse for Value {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        if input.peek(syn::token::Bracket) {
            let content;
            let bracket = syn::bracketed!(content in input);
            let items = content.parse_terminated(Expr::parse, Token![,])?;
            return Ok(Self::List(items.into_iter().collect(), bracket.span.join()));
        }
        let low: Expr = input.parse()?;
        if !input.peek(Token![..]) {
            return Ok(Self::Scalar(low));
        }
        input.parse::<Token![..]>()?;
        Ok(Self::Range(low, input.parse()?))
    }
}

impl Parse for DeclaredEffect {
    /// `name(shape = value) on targets`, or without targets
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let name = name(input, "the name of an effect")?;
        let shapes = if input.peek(syn::token::Paren) {
            let content;
            syn::parenthesized!(content in input);
            content
                .parse_terminated(Setting::parse, Token![,])?
                .into_iter()
                .collect()
        } else {
            Vec::new()
        };
        let on = input.fork();
        let targets = if word(&on, "`on`").is_ok_and(|on| on == "on") {
            word(input, "`on`")?;
            input.parse()?
        } else {
            Targets::Arm
        };
        Ok(Self {
            name,
            shapes,
            targets,
        })
    }
}

impl Parse for Targets {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let mut targets = vec![input.parse::<Target>()?];
        while input.peek(Token![,]) {
            input.parse::<Token![,]>()?;
            targets.push(input.parse()?);
        }
        Ok(match targets.as_slice() {
            [only] if only.joints.len() == 1 && only.joints[0] == "all" => Self::All(only.span),
            _ => Self::Each(targets),
        })
    }
}

impl Parse for Target {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        if input.peek(syn::token::Paren) {
            let content;
            let paren = syn::parenthesized!(content in input);
            let joints =
                content.parse_terminated(|input| name(input, "a joint's name"), Token![,])?;
            return Ok(Self {
                joints: joints.into_iter().collect(),
                span: paren.span.join(),
            });
        }
        let joint = name(input, "a joint's name, `(first, second)` or `all`")?;
        Ok(Self {
            span: join(joint.span(), joint.span()),
            joints: vec![joint],
        })
    }
}
