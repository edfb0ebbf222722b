//! Other programs that compute the same arm: which are installed, and how their code becomes a contender.
//!
//! The programs that call them are ours, `benches/peers`: textbook recursions (`dynamics.py`, `regressors.py`) over the symbols of
//! a code generator, a function in several ways where it is not known which is the fastest (`ways.py`). The system's compiler gets
//! the code with `-O3 -march=native`, and again with `-ffast-math`.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::arm::{Arm, workspace};
use crate::report::Form;
use crate::{Error, build, failed};

/// Peers that are known, as they are asked for.
pub const NAMES: [&str; 3] = ["casadi", "symforce", "pinocchio"];

/// In how many ways a peer may compute a function; the fastest counts.
pub const WAYS: usize = 3;

/// Name of a peer's case: `gravity`, in its second way `gravity~2`, with sines and cosines given `gravity~2/given`.
#[must_use]
pub fn case(function: &str, way: usize, given: bool) -> String {
    let way = if way == 0 {
        String::new()
    } else {
        format!("~{}", way + 1)
    };
    let given = if given { "/given" } else { "" };
    format!("{function}{way}{given}")
}

/// A program that is compiled from C or C++ for an arm.
#[derive(Debug)]
pub struct Contender {
    /// The peer, with what sets one of its programs apart from another.
    pub name: String,
    /// Set where it is no peer, but one of our forms in C.
    pub ours: Option<Form>,
    /// Its program.
    pub executable: PathBuf,
}

/// Tools of this machine, by the variables that name them and what is taken without.
fn tool(variable: &str, otherwise: &str) -> String {
    let named = env::var(variable).ok().filter(|name| !name.is_empty());
    named.unwrap_or_else(|| otherwise.to_owned())
}

/// The compiler of C.
pub(crate) fn cc() -> String {
    tool("CC", "cc")
}

/// The compiler of C++.
pub(crate) fn cxx() -> String {
    tool("CXX", "c++")
}

fn python() -> String {
    tool("PYTHON", "python3")
}

/// How a peer is installed.
fn help(packages: &str) -> String {
    format!(
        "install it with `python3 -m venv VENV && VENV/bin/pip install {packages}` and set `PYTHON=VENV/bin/python`"
    )
}

/// The version and the folder of a Python package.
fn package(module: &str, packages: &str) -> Result<(String, PathBuf), Error> {
    let (python, missing) = (python(), help(packages));
    let script = format!("import {module} as m; print(m.__version__); print(m.__file__)");
    let said = build::run(Command::new(&python).args(["-c", &script]))
        .map_err(|_| Error::new(format!("no module `{module}` in `{python}`: {missing}")))?;
    let mut lines = said.lines();
    match (
        lines.next(),
        lines.next().map(Path::new).and_then(Path::parent),
    ) {
        (Some(version), Some(folder)) => Ok((version.to_owned(), folder.to_owned())),
        _ => Err(Error::new(format!(
            "`{python}` does not say where `{module}` is: {missing}"
        ))),
    }
}

/// Programs of a peer for an arm; the error says why there are none, and what to do.
///
/// # Errors
/// It is not installed, or one of the tools on the way fails.
pub fn contenders(peer: &str, folder: &Path, arm: &Arm) -> Result<Vec<Contender>, Error> {
    let folder = folder.join("peers").join(arm.name);
    let description = folder.join("arm.json");
    fs::create_dir_all(&folder)
        .and_then(|()| fs::write(&description, arm.to_json().to_string()))
        .map_err(|error| failed("write", &description, error))?;
    match peer {
        "casadi" => casadi(&folder, arm),
        "symforce" => symforce(&folder, arm),
        "pinocchio" => pinocchio(&folder, arm),
        _ => Err(Error::new(format!("`{peer}` is not known"))),
    }
}

fn sources() -> PathBuf {
    workspace().join("benches/peers")
}

/// What the generators share.
const SHARED: [&str; 4] = ["dynamics.py", "regressors.py", "ways.py", "table.py"];

/// The clock that peers' programs are linked with.
const CLOCK: [&str; 2] = ["contender.c", "contender.h"];

/// Text of our sources, which a program depends on.
fn text(names: &[&str]) -> Result<String, Error> {
    let read = |name: &&str| {
        let path = sources().join(name);
        fs::read_to_string(&path).map_err(|error| failed("read", &path, error))
    };
    names.iter().map(read).collect()
}

/// Runs a generator on `arm.json`.
fn generate(
    script: &str,
    folder: &Path,
    product: &str,
    version: &str,
    arm: &Arm,
) -> Result<PathBuf, Error> {
    let product = folder.join(product);
    let input = format!(
        "{version}\n{}\n{}{}",
        arm.to_json(),
        text(&SHARED)?,
        text(&[script])?
    );
    build::made(&product, &input, || {
        build::run(
            Command::new(python())
                // No traces beside the sources.
                .env("PYTHONDONTWRITEBYTECODE", "1")
                .arg(sources().join(script))
                .arg(folder.join("arm.json"))
                .arg(folder),
        )
        .map(drop)
    })?;
    Ok(product)
}

/// Names of the variants of a program, and their flags.
type Variants = [(&'static str, Option<&'static str>)];

const PRECISE: [(&str, Option<&str>); 1] = [("", None)];
const BOTH: [(&str, Option<&str>); 2] = [("", None), ("-fast-math", Some("-ffast-math"))];

/// Compiles generated code and links it with the clock, as it is and with fast mathematics.
fn compile(
    peer: &str,
    compiler: &str,
    source: &Path,
    flags: &[String],
) -> Result<Vec<Contender>, Error> {
    compile_with(peer, compiler, source, flags, &BOTH)
}

fn compile_with(
    peer: &str,
    compiler: &str,
    source: &Path,
    flags: &[String],
    variants: &Variants,
) -> Result<Vec<Contender>, Error> {
    let folder = source.parent().unwrap_or(Path::new("."));
    let clock = folder.join("contender.o");
    let said = |path: &Path| fs::read_to_string(path).map_err(|error| failed("read", path, error));
    let cc = cc();
    build::made(&clock, &text(&CLOCK)?, || {
        let mut command = Command::new(&cc);
        command.args(["-std=c11", "-D_POSIX_C_SOURCE=200809L", "-O2", "-c"]);
        command
            .arg(sources().join("contender.c"))
            .arg("-o")
            .arg(&clock);
        build::run(&mut command).map(drop)
    })?;
    let mut contenders = Vec::new();
    for &(suffix, more) in variants {
        let name = format!("{peer}{suffix}");
        let executable = folder.join(&name);
        let mut command = Command::new(compiler);
        command
            .args(["-O3", "-march=native"])
            .args(more)
            .args(flags);
        command.arg("-I").arg(sources());
        command
            .arg(source)
            .arg(&clock)
            .arg("-lm")
            .arg("-o")
            .arg(&executable);
        let input = format!("{command:?}\n{}\n{}", said(source)?, text(&CLOCK)?);
        build::made(&executable, &input, || build::run(&mut command).map(drop))?;
        contenders.push(Contender {
            name,
            ours: None,
            executable,
        });
    }
    Ok(contenders)
}

/// One program of ours, by the flags that peers get.
pub(crate) fn compile_one(
    name: &str,
    compiler: &str,
    source: &Path,
    flags: &[String],
    ours: Option<Form>,
) -> Result<Contender, Error> {
    let made = compile_with(name, compiler, source, flags, &PRECISE)?;
    let mut made = made.into_iter().map(|made| Contender { ours, ..made });
    made.next()
        .ok_or_else(|| failed("build", source, "nothing was made"))
}

/// What a peer says of its version.
///
/// # Errors
/// It is not installed.
pub(crate) fn version(peer: &str) -> Result<String, Error> {
    let packages = match peer {
        "casadi" => "casadi",
        "symforce" => "symforce casadi",
        _ => "pin casadi",
    };
    package(peer, packages).map(|(version, _)| version)
}

fn casadi(folder: &Path, arm: &Arm) -> Result<Vec<Contender>, Error> {
    let (version, _) = package("casadi", "casadi")?;
    let source = generate("casadi_peer.py", folder, "casadi.c", &version, arm)?;
    compile("casadi", &cc(), &source, &[])
}

fn symforce(folder: &Path, arm: &Arm) -> Result<Vec<Contender>, Error> {
    let (version, _) = package("symforce", "symforce casadi")?;
    let eigen = eigen()?;
    let source = generate("symforce_peer.py", folder, "symforce.cpp", &version, arm)?;
    let flags = ["-std=c++17".to_owned(), "-I".to_owned(), eigen];
    compile("symforce", &cxx(), &source, &flags)
}

fn pinocchio(folder: &Path, arm: &Arm) -> Result<Vec<Contender>, Error> {
    let (version, package) = package("pinocchio", "pin casadi")?;
    let eigen = eigen()?;
    generate("pinocchio_peer.py", folder, "arm.txt", &version, arm)?;
    // `VENV/lib/python3/site-packages/cmeel.prefix/lib/python3/site-packages/pinocchio`: its headers are under the prefix.
    let prefix = package
        .ancestors()
        .find(|path| path.join("include/pinocchio").is_dir());
    let include = prefix.map(|prefix| prefix.join("include")).ok_or_else(|| {
        Error::new(format!(
            "no headers beside `{}`: {}",
            package.display(),
            help("pin casadi")
        ))
    })?;
    // One program serves all arms: it takes a minute to compile.
    let shared = folder.parent().unwrap_or(folder).join("pinocchio.cpp");
    let source = text(&["pinocchio.cpp"])?;
    fs::write(&shared, source).map_err(|error| failed("write", &shared, error))?;
    let flags = [
        "-std=c++17",
        "-DNDEBUG",
        "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
        "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
        "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
        "-DBOOST_FUSION_INVOKE_MAX_ARITY=12",
        "-I",
        &include.display().to_string(),
        "-I",
        &eigen,
    ]
    .map(str::to_owned);
    let made = compile_with("pinocchio", &cxx(), &shared, &flags, &PRECISE)?;
    made.into_iter()
        .map(|contender| {
            let executable = folder.join(&contender.name);
            fs::copy(&contender.executable, &executable)
                .map_err(|error| failed("write", &executable, error))?;
            Ok(Contender {
                executable,
                ..contender
            })
        })
        .collect()
}

/// Folder of Eigen's headers: the package `casadi` has them, and some systems.
fn eigen() -> Result<String, Error> {
    let bundled = package("casadi", "casadi").map(|(_, folder)| folder.join("include/eigen3"));
    let folders = bundled
        .into_iter()
        .chain([PathBuf::from("/usr/include/eigen3")]);
    let found = folders
        .into_iter()
        .find(|folder| folder.join("Eigen/Core").exists());
    found
        .map(|folder| folder.display().to_string())
        .ok_or_else(|| {
            Error::new(format!(
                "no headers of Eigen, which CasADi's package has: {}",
                help("casadi")
            ))
        })
}

#[cfg(test)]
mod tests {
    use super::{case, help};

    #[test]
    fn ways_have_names() {
        assert_eq!(case("gravity", 0, false), "gravity");
        assert_eq!(case("gravity", 1, true), "gravity~2/given");
    }

    #[test]
    fn what_is_missing_is_told_with_the_way_to_it() {
        let said = help("casadi");
        assert!(
            said.contains("pip install casadi") && said.contains("PYTHON="),
            "{said}"
        );
    }
}
