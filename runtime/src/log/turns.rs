//! How slowly a joint has to move for its dry friction to have a direction.

use super::Log;

impl Log {
    /// The log of an arm whose dry friction acts in full from these speeds on, one a joint, rad/s or m/s: `sign(dq)` counts as `tanh(dq / w)`.
    /// [`Identify::turn_speeds`](crate::identify::Identify::turn_speeds) finds them; without them it is the encoder's steps that say what has
    /// a direction.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..900).map(|k| 0.01 * f64::from(k)).collect();
    /// let log = Log::from_samples("a plant", time, vec![vec![0.0; 900]], vec![vec![0.0; 900]])?;
    /// assert_eq!(log.with_turn_speeds(vec![0.002]).turn_speeds, [0.002]);
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn with_turn_speeds(mut self, speeds: Vec<f64>) -> Self {
        self.turn_speeds = speeds;
        self
    }

    /// [`Self::with_turn_speeds`] of several logs of one arm.
    ///
    /// # Examples
    /// ```
    /// # use robot_model::log::Log;
    /// let time: Vec<f64> = (0..900).map(|k| 0.01 * f64::from(k)).collect();
    /// let log = Log::from_samples("a plant", time, vec![vec![0.0; 900]], vec![vec![0.0; 900]])?;
    /// let logs = Log::all_with_turn_speeds(&[log.clone(), log], &[0.002]);
    /// assert!(logs.iter().all(|log| log.turn_speeds == [0.002]));
    /// # Ok::<(), robot_model::log::LogError>(())
    /// ```
    #[must_use]
    pub fn all_with_turn_speeds(logs: &[Self], speeds: &[f64]) -> Vec<Self> {
        let logs = logs.iter();
        logs.map(|log| log.clone().with_turn_speeds(speeds.to_vec()))
            .collect()
    }
}
