//! How examples begin that derive an arm: code where there is a derive, and a text elsewhere.

#[cfg(feature = "derive")]
macro_rules! fence {
    () => {
        "```"
    };
}

#[cfg(not(feature = "derive"))]
macro_rules! fence {
    () => {
        "```ignore"
    };
}

/// With the two links of `tests/doc/two_link.rs`.
macro_rules! two_link {
    () => {
        concat!(
            fence!(),
            "\n# mod arms { include!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/tests/doc/two_link.rs\")); }",
            "\nuse robot_model::{RobotModel, Vector};",
        )
    };
}

/// With the pendulum of `tests/doc/warm.rs`, whose friction follows the temperature.
macro_rules! warm {
    () => {
        concat!(
            fence!(),
            "\n# mod arms { include!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \"/tests/doc/warm.rs\")); }",
            "\nuse robot_model::RobotModel;",
        )
    };
}
