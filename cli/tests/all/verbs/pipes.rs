//! Inputs that are no files: pipes and devices.

use std::process::Command;

use crate::verbs::common::{CART, Folder, cart_log};

/// A program that waits for them waits for ever.
#[test]
fn named_pipes_and_devices_are_refused_at_once() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let made = Command::new("mkfifo").arg(folder.path("pipe")).status();
    assert!(made.expect("mkfifo").success());
    for (arguments, file, what) in [
        (
            &["check", "pipe"][..],
            "pipe",
            "a named pipe, which may never be written to",
        ),
        (
            &["check", "/dev/zero"],
            "/dev/zero",
            "a device, which may never end",
        ),
        (
            &["identify", "cart.robot", "pipe"],
            "pipe",
            "a named pipe, which may never be written to",
        ),
        (
            &[
                "identify",
                "cart.robot",
                "log.csv",
                "--validate",
                "/dev/null",
            ],
            "/dev/null",
            "a device, which may never end",
        ),
        (
            &["identify", "cart.robot", "pipe", "--factor", "factor.json"],
            "pipe",
            "a named pipe, which may never be written to",
        ),
    ] {
        let said = folder.refuse(arguments);
        let wanted = format!(
            "error: cannot read `{file}`: it is {what}; save its content to a file, and name that\n"
        );
        assert!(said.ends_with(&wanted), "{arguments:?}: {said}");
    }
}

#[test]
fn what_a_shell_pipes_is_read() {
    let folder = Folder::new();
    folder.write("cart.robot", CART);
    folder.write("log.csv", &cart_log(5, 0.0, 0.0));
    let piped = Command::new("sh")
        .args(["-c", "cat log.csv | \"$0\" identify cart.robot /dev/stdin"])
        .arg(env!("CARGO_BIN_EXE_robot-model"))
        .current_dir(folder.path(""))
        .output()
        .expect("a shell");
    let said = String::from_utf8_lossy(&piped.stderr);
    assert_eq!(piped.status.code(), Some(0), "{said}");
    let read = folder.succeed(&["identify", "cart.robot", "log.csv"]);
    assert_eq!(String::from_utf8_lossy(&piped.stdout), read);
}
