//! Runs the commands of a page as a reader types them.

use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::clips::here;

/// The test command of the README.
pub(super) const TESTS: &str = "cargo test --locked";

/// Commands that are not run here: they build everything anew, open a window, or serve a page until they are ended.
const ELSEWHERE: [&str; 8] = [
    TESTS,
    "cargo install --path crates/genga-cli --locked",
    "cargo install --path crates/genga-cli --features pdf --locked",
    "cargo install --path crates/genga-cli --features studio --locked",
    "cargo run --release --locked --features studio -- studio data/kick.bvh",
    "rustup target add wasm32-unknown-unknown",
    "tools/browser --serve",
    "env -u WAYLAND_DISPLAY genga studio data/kick.bvh",
];

/// Prefix of a command for somebody who has not installed the program.
pub(super) const UNINSTALLED: &str = "cargo run --release --locked -- ";

/// A reader's folder, with a link to the repository's motions.
pub(super) fn place() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    symlink(here("data"), place.path().join("data")).unwrap();
    place
}

/// Runs a command of a page in a folder, and returns stdout and stderr together.
pub(super) fn said(command: &str, place: &Path) -> Result<String, String> {
    if ELSEWHERE.contains(&command) {
        return Ok(String::new());
    }
    let program = Path::new(env!("CARGO_BIN_EXE_genga")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let command = match command.strip_prefix(UNINSTALLED) {
        Some(args) => format!("genga {args}"),
        None => command.to_owned(),
    };
    let known = ["genga ", "cp "].iter().any(|begin| command.starts_with(begin));
    if !known {
        return Err(format!("{command}: this is no command of genga's"));
    }
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("exec 2>&1\n{command}")]).env("PATH", path).current_dir(place);
    let output = shell.stdin(Stdio::null()).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    if output.status.success() { Ok(said) } else { Err(format!("{command}: {said}")) }
}
