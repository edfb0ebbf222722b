//! Every example runs; its assertions are its claims.

#[path = "../examples/build_script.rs"]
mod build_script;
#[path = "../examples/close_the_loop.rs"]
mod close_the_loop;
#[path = "../examples/derive.rs"]
mod derive;

#[test]
fn build_script() {
    build_script::main();
}

#[test]
fn derive() {
    derive::main();
}

#[test]
fn close_the_loop() {
    close_the_loop::main().unwrap_or_else(|error| panic!("{error}"));
}
