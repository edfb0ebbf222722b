//! Controllers of experiments, sample by sample.

/// A linear sampled controller with limits, a law a joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Law {
    /// One a joint.
    pub joints: Vec<JointLaw>,
}

/// `u_k = sum_i a_i u_(k-1-i) + sum_i p_i q_(k-i) + sum_c sum_i c_i x_c(k-i)`, then cut off at a limit; N m or N.
///
/// `q` are the positions of the joint at samples of the log, `x_c` channels of the log such as a reference; before the first sample both
/// are as at the first one, and `u` is 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointLaw {
    /// `p`: weights of the latest position, that before it, ...
    pub position: Vec<f64>,
    /// `a`: weights of the torque before, that before it, ...
    pub torque: Vec<f64>,
    /// `c`: channels of the log.
    pub channels: Vec<Tap>,
    /// Largest size of the torque.
    pub limit: Option<f64>,
}

/// A channel of the log with its weights, of the latest value, that before it, ...
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tap {
    /// Name of the channel.
    pub channel: String,
    /// `c`
    pub weights: Vec<f64>,
    /// Whether logs without it have nothing there; else they are refused.
    pub is_optional: bool,
}

impl JointLaw {
    /// Torque at sample `k`, and whether it is cut off; `channel` has the values of each tap.
    pub(super) fn torque(
        &self,
        k: usize,
        positions: &[f64],
        torques: &[f64],
        channel: impl Fn(usize, usize) -> f64,
    ) -> (f64, bool) {
        let before = |i: usize| k.saturating_sub(i);
        let position = self.position.iter().enumerate();
        let position = position.map(|(i, weight)| weight * positions[before(i)]);
        let torque = self.torque.iter().enumerate();
        let torque = torque
            .filter(|(i, _)| *i < k)
            .map(|(i, weight)| weight * torques[k - 1 - i]);
        let channels = self.channels.iter().enumerate().flat_map(|(tap, by)| {
            let weights = by.weights.iter().enumerate();
            let channel = &channel;
            weights.map(move |(i, weight)| weight * channel(tap, before(i)))
        });
        let sum: f64 = position.chain(torque).chain(channels).sum();
        match self.limit {
            Some(limit) if sum.abs() > limit => (limit * sum.signum(), true),
            _ => (sum, false),
        }
    }
}
