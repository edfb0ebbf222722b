//! What a struct of links is made of: inertial parameters, and the parameters of effects beside them.

use nalgebra::{Matrix3, Matrix4, Vector3};

/// The ten inertial parameters of a link, about the origin of the link's frame.
///
/// # Examples
/// ```
/// use robot_model::Inertial;
/// // A point of 2 kg at x = 0.5 m.
/// let point = Inertial::about_com(2.0, [0.5, 0.0, 0.0], [0.0; 6]);
/// assert_eq!(point.first_moments, [1.0, 0.0, 0.0]);
/// assert_eq!(point.inertia, [0.0, 0.0, 0.0, 0.5, 0.0, 0.5]);
/// assert_eq!(Inertial::from(<[f64; 10]>::from(point)), point);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Inertial {
    /// Mass, kg.
    pub mass: f64,
    /// First moments `m * c`, kg m: mass times the center of mass in the link's frame.
    pub first_moments: [f64; 3],
    /// `[ixx, ixy, ixz, iyy, iyz, izz]` **about the origin of the link's frame**, kg m^2; `ixy` is the entry of the matrix.
    pub inertia: [f64; 6],
}

impl Inertial {
    /// From the inertia about the center of mass, as CAD programs and URDF give it: `I = I_com + m (|c|^2 1 - c c^T)`.
    ///
    /// `mass` in kg, `com` in m in the link's frame, `inertia` in kg m^2 along the axes of the link's frame.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Inertial;
    /// // A rod of 1.2 kg and 0.4 m, held at its end: m l^2 / 3.
    /// let rod = Inertial::about_com(1.2, [0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.016, 0.0, 0.016]);
    /// assert!((rod.inertia[5] - 1.2 * 0.16 / 3.0).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn about_com(mass: f64, com: [f64; 3], inertia: [f64; 6]) -> Self {
        let [x, y, z] = com;
        let steiner = [
            y * y + z * z,
            -x * y,
            -x * z,
            x * x + z * z,
            -y * z,
            x * x + y * y,
        ];
        let mut about_origin = inertia;
        for (entry, term) in about_origin.iter_mut().zip(steiner) {
            *entry += mass * term;
        }
        Self {
            mass,
            first_moments: [mass * x, mass * y, mass * z],
            inertia: about_origin,
        }
    }

    /// Center of mass in the link's frame, m; `None` where the mass is zero, as it is after regrouping.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Inertial;
    /// let link = Inertial { mass: 2.0, first_moments: [1.0, 0.0, -0.5], ..Inertial::default() };
    /// assert_eq!(link.com(), Some([0.5, 0.0, -0.25]));
    /// // Base parameters may have no mass left.
    /// assert_eq!(Inertial { mass: 0.0, ..link }.com(), None);
    /// ```
    #[must_use]
    pub fn com(&self) -> Option<[f64; 3]> {
        (self.mass != 0.0).then(|| self.first_moments.map(|moment| moment / self.mass))
    }

    /// Second moments of mass about the center of mass, `S - m c c^T`, kg m^2: how far the body extends along each direction.
    /// `None` where the mass is zero.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Inertial;
    /// let rod = Inertial::about_com(1.2, [0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.016, 0.0, 0.016]);
    /// let extent = rod.second_moments().expect("it has a mass");
    /// assert!((extent[(0, 0)] - 0.016).abs() < 1e-12 && extent[(1, 1)].abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn second_moments(&self) -> Option<Matrix3<f64>> {
        let about_origin = self.pseudo_inertia();
        let moments = about_origin.fixed_view::<3, 3>(0, 0);
        let first = Vector3::from(self.first_moments);
        (self.mass != 0.0).then(|| moments - first * first.transpose() / self.mass)
    }

    /// The pseudo-inertia `[[S, h], [h^T, m]]` with the second moments of mass `S = tr(I)/2 1 - I` (kg m^2), the first ones `h`
    /// (kg m) and the mass `m`, all about the origin of the link's frame. A body can have these parameters where it is
    /// positive semidefinite, and only there.
    ///
    /// Source: Wensing, Kim, Slotine 2018, Linear matrix inequalities for physically consistent inertial parameter
    /// identification.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Inertial;
    /// let rod = Inertial::about_com(1.2, [0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.016, 0.0, 0.016]);
    /// let least = |inertial: Inertial| inertial.pseudo_inertia().symmetric_eigenvalues().min();
    /// assert!(least(rod) > -1e-12);
    /// // Twice the moment about x that any spread along y and z could give.
    /// let impossible = Inertial { inertia: [0.1, 0.0, 0.0, 0.016, 0.0, 0.016], ..rod };
    /// assert!(least(impossible) < -0.01);
    /// ```
    #[must_use]
    pub fn pseudo_inertia(&self) -> Matrix4<f64> {
        let [ixx, ixy, ixz, iyy, iyz, izz] = self.inertia;
        let [hx, hy, hz] = self.first_moments;
        let half = 0.5 * (ixx + iyy + izz);
        Matrix4::new(
            half - ixx,
            -ixy,
            -ixz,
            hx,
            -ixy,
            half - iyy,
            -iyz,
            hy,
            -ixz,
            -iyz,
            half - izz,
            hz,
            hx,
            hy,
            hz,
            self.mass,
        )
    }
}

/// In the order `m mx my mz ixx ixy ixz iyy iyz izz`.
impl From<[f64; 10]> for Inertial {
    fn from([mass, mx, my, mz, inertia @ ..]: [f64; 10]) -> Self {
        Self {
            mass,
            first_moments: [mx, my, mz],
            inertia,
        }
    }
}

/// In the order `m mx my mz ixx ixy ixz iyy iyz izz`.
impl From<Inertial> for [f64; 10] {
    fn from(inertial: Inertial) -> Self {
        let [mx, my, mz] = inertial.first_moments;
        let [ixx, ixy, ixz, iyy, iyz, izz] = inertial.inertia;
        [inertial.mass, mx, my, mz, ixx, ixy, ixz, iyy, iyz, izz]
    }
}

/// A link of an arm, with the effects of its joint: `Link`, `Link<ViscousFriction>`, `Link<(ViscousFriction, Stribeck)>`.
///
/// # Examples
/// ```
/// use robot_model::Link;
/// // 1.2 kg with its center of mass in the middle of a rod of 0.4 m.
/// let rod = Link::new(1.2, [-0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.016, 0.0, 0.016]);
/// assert_eq!(rod.inertial.com(), Some([-0.2, 0.0, 0.0]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Link<Effects = ()> {
    /// Mass, first moments, inertia.
    pub inertial: Inertial,
    /// Parameters of the effects on the joint that moves the link.
    pub effects: Effects,
}

impl Link {
    /// A link from its mass (kg), center of mass (m) and inertia about it (kg m^2), see [`Inertial::about_com`].
    ///
    /// # Examples
    /// ```
    /// use robot_model::Link;
    /// // 1.2 kg in the middle of a rod of 0.4 m, whose frame is at its end: 0.016 kg m^2 about the middle.
    /// let rod = Link::new(1.2, [-0.2, 0.0, 0.0], [0.0, 0.0, 0.0, 0.016, 0.0, 0.016]);
    /// assert!((rod.inertial.inertia[5] - (0.016 + 1.2 * 0.2_f64.powi(2))).abs() < 1e-12); // izz about the frame's origin
    /// ```
    #[must_use]
    pub fn new(mass: f64, com: [f64; 3], inertia: [f64; 6]) -> Self {
        Self::from(Inertial::about_com(mass, com, inertia))
    }

    /// The same link with effects on its joint.
    ///
    /// # Examples
    /// ```
    /// use robot_model::Link;
    /// struct Friction { fv: f64 }
    /// let link = Link::new(1.2, [-0.2, 0.0, 0.0], [0.0; 6]).with(Friction { fv: 0.6 });
    /// assert_eq!((link.effects.fv, link.inertial.mass), (0.6, 1.2));
    /// ```
    #[must_use]
    pub fn with<Effects>(self, effects: Effects) -> Link<Effects> {
        Link {
            inertial: self.inertial,
            effects,
        }
    }
}

impl From<Inertial> for Link {
    fn from(inertial: Inertial) -> Self {
        Self {
            inertial,
            effects: (),
        }
    }
}
