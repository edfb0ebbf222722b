//! Names and order of the standard parameters: the only place where either is decided.

use crate::model::{Body, Chain, Energies, Inertial, Model, Monomial};

/// One of a link's ten inertial parameters, about the origin of the link frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InertialElement {
    /// Mass, kg.
    M,
    /// First moments, kg m.
    Mx,
    /// First moment along y.
    My,
    /// First moment along z.
    Mz,
    /// Inertia, kg m^2.
    Ixx,
    /// Product of inertia (the matrix entry, not its negative).
    Ixy,
    /// Product of inertia.
    Ixz,
    /// Inertia about y.
    Iyy,
    /// Product of inertia.
    Iyz,
    /// Inertia about z.
    Izz,
}

impl InertialElement {
    /// The order of the ten, everywhere.
    pub const ALL: [Self; 10] = [
        Self::M,
        Self::Mx,
        Self::My,
        Self::Mz,
        Self::Ixx,
        Self::Ixy,
        Self::Ixz,
        Self::Iyy,
        Self::Iyz,
        Self::Izz,
    ];

    /// Name after the link's: `m`, `mx`, .. `izz`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::M => "m",
            Self::Mx => "mx",
            Self::My => "my",
            Self::Mz => "mz",
            Self::Ixx => "ixx",
            Self::Ixy => "ixy",
            Self::Ixz => "ixz",
            Self::Iyy => "iyy",
            Self::Iyz => "iyz",
            Self::Izz => "izz",
        }
    }
}

/// A parameter of the linear form `tau = Y * standard`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StandardParameter {
    /// `LINK.izz` or `JOINT.EFFECT.PARAMETER`.
    pub name: String,
    /// What it is a parameter of.
    pub owner: Owner,
    /// Whether it is identified.
    pub status: Status,
}

/// What a standard parameter belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Owner {
    /// An inertial parameter of the link of joint `link`.
    Link {
        /// Index into [`Chain::links`].
        link: usize,
        /// Which of the ten.
        element: InertialElement,
    },
    /// A product of powers of the unknown constants of a robot that is described by its energies: index into
    /// [`Energies::monomials`].
    Monomial(usize),
    /// A linear parameter of a declared effect.
    Effect {
        /// Index into [`Model::effects`].
        effect: usize,
        /// Index into the definition's linear parameters.
        parameter: usize,
    },
}

/// Whether a parameter is identified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Status {
    /// To be identified; no value known.
    Unknown,
    /// To be identified; the spec has a CAD value.
    Nominal(f64),
    /// Known exactly.
    Fixed(f64),
}

impl Model {
    /// The standard parameters in their order: ten a link from base to tip, then the effects' in the order of the spec.
    #[must_use]
    pub fn standard_parameters(&self) -> Vec<StandardParameter> {
        let rigid = match &self.body {
            Body::Chain(chain) => link_parameters(chain),
            Body::Energies(energies) => monomial_parameters(energies),
        };
        let effects = self
            .effects
            .iter()
            .enumerate()
            .flat_map(|(effect, declared)| {
                let prefix = self.effect_name(effect);
                declared
                    .definition
                    .linear
                    .iter()
                    .enumerate()
                    .map(move |(parameter, linear)| StandardParameter {
                        name: format!("{prefix}.{}", linear.name),
                        owner: Owner::Effect { effect, parameter },
                        status: Status::Unknown,
                    })
            });
        rigid.into_iter().chain(effects).collect()
    }

    /// Whether a parameter is one of the rigid body: of a link, of an energy, or of a body that an effect adds to a link.
    #[must_use]
    pub fn is_rigid(&self, parameter: &StandardParameter) -> bool {
        match parameter.owner {
            Owner::Link { .. } | Owner::Monomial(_) => true,
            Owner::Effect { effect, parameter } => {
                self.effects[effect].definition.is_of_body(parameter)
            }
        }
    }

    /// Whether no arm has a parameter below zero: masses, moments of inertia, and what effects declare so. The signs of unknown
    /// constants of energies are not known.
    #[must_use]
    pub fn is_nonnegative(&self, parameter: &StandardParameter) -> bool {
        match parameter.owner {
            Owner::Link { element, .. } => matches!(
                element,
                InertialElement::M
                    | InertialElement::Ixx
                    | InertialElement::Iyy
                    | InertialElement::Izz
            ),
            Owner::Effect { effect, parameter } => {
                self.effects[effect].definition.linear[parameter].nonnegative
            }
            Owner::Monomial(_) => false,
        }
    }

    /// How many standard parameters, from the first, are those of links or energies and not of effects.
    #[must_use]
    pub fn rigid_parameters(&self) -> usize {
        match &self.body {
            Body::Chain(chain) => InertialElement::ALL.len() * chain.links.len(),
            Body::Energies(energies) => energies.monomials.len(),
        }
    }

    /// Columns of the log that the declared effects read beside positions and torques: each once, in the order of the spec.
    #[must_use]
    pub fn inputs(&self) -> Vec<String> {
        let mut columns = Vec::new();
        for effect in &self.effects {
            for input in &effect.definition.inputs {
                let column = input.column(&effect.joints);
                if !columns.contains(&column) {
                    columns.push(column);
                }
            }
        }
        columns
    }

    /// Names of the internal states of the declared effects, `JOINT.EFFECT.STATE`, in the order of the spec.
    #[must_use]
    pub fn states(&self) -> Vec<String> {
        let effects = self.effects.iter().enumerate();
        effects
            .flat_map(|(index, effect)| {
                let prefix = self.effect_name(index);
                let states = effect.definition.states.iter();
                states.map(move |state| format!("{prefix}.{}", state.name))
            })
            .collect()
    }

    /// `JOINT.EFFECT`, the first joint's name where there are several, `EFFECT` where there is none; a second instance on the
    /// same joints is `JOINT.EFFECT2`.
    #[must_use]
    pub fn effect_name(&self, effect: usize) -> String {
        let declared = &self.effects[effect];
        let joint = declared.joints.first();
        let joint = joint.map_or_else(String::new, |&k| format!("{}.", self.joints[k].name));
        let name = &declared.definition.name;
        if declared.instance == 1 {
            format!("{joint}{name}")
        } else {
            format!("{joint}{name}{}", declared.instance)
        }
    }
}

fn link_parameters(chain: &Chain) -> Vec<StandardParameter> {
    let links = chain.links.iter().enumerate();
    links
        .flat_map(|(link, body)| {
            InertialElement::ALL
                .into_iter()
                .enumerate()
                .map(move |(k, element)| StandardParameter {
                    name: format!("{}.{}", body.name, element.name()),
                    owner: Owner::Link { link, element },
                    status: match body.inertial {
                        Inertial::Unknown => Status::Unknown,
                        Inertial::Nominal(value) => Status::Nominal(value[k]),
                        Inertial::Fixed(value) => Status::Fixed(value[k]),
                    },
                })
        })
        .collect()
}

fn monomial_parameters(energies: &Energies) -> Vec<StandardParameter> {
    let monomials = energies.monomials.iter().enumerate();
    monomials
        .map(|(k, monomial)| StandardParameter {
            name: energies.monomial_name(monomial),
            owner: Owner::Monomial(k),
            status: energies.monomial_status(monomial),
        })
        .collect()
}

impl Energies {
    /// `m2*l1*c2`, `m1*c1^2`; the product of nothing is `known`: what the spec gives in numbers.
    #[must_use]
    pub fn monomial_name(&self, monomial: &Monomial) -> String {
        if monomial.factors.is_empty() {
            return "known".to_owned();
        }
        let factors = monomial.factors.iter().map(|&(k, exponent)| {
            let name = &self.parameters[k].name;
            if exponent == 1 {
                name.clone()
            } else {
                format!("{name}^{exponent}")
            }
        });
        factors.collect::<Vec<_>>().join("*")
    }

    fn monomial_status(&self, monomial: &Monomial) -> Status {
        if monomial.factors.is_empty() {
            return Status::Fixed(1.0);
        }
        let values = monomial.factors.iter().map(|&(k, exponent)| {
            let value = self.parameters[k].nominal?;
            Some(value.powi(exponent))
        });
        match values.product::<Option<f64>>() {
            // Of numbers that no parameter has, as over one that is zero, nothing is known.
            Some(value) if !value.is_finite() => Status::Unknown,
            Some(value) => Status::Nominal(value),
            None => Status::Unknown,
        }
    }
}
