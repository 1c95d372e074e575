//! Every package that genga depends on, on any system and with any feature, has a licence compatible with ours and
//! comes from a crate registry.
//!
//! Cargo fetches packages of other systems before it can answer, so this test only runs in `.ci/full`.

use std::fs;
use std::process::Command;
use std::sync::LazyLock;

use serde_json::Value;

use crate::clips::here;

/// Prefix of a source that is a registry and not a repository or a folder.
const REGISTRY: &str = "registry+";

/// The licences of `deny.toml`, so that both checks allow the same.
static ALLOWED: LazyLock<Vec<String>> = LazyLock::new(|| {
    let text = fs::read_to_string(here("deny.toml")).unwrap();
    let table: toml::Table = toml::from_str(&text).unwrap();
    table["licenses"]["allow"].clone().try_into().unwrap()
});

/// Whether allowed licences can satisfy an SPDX expression. `AND` binds tighter than `OR`, and older packages write `/`
/// for `OR`.
fn is_allowed(expression: &str) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let mut words = spaced.split_whitespace().peekable();
    let allowed = any(&mut words);
    allowed && words.next().is_none()
}

type Words<'a, 'b> = &'b mut std::iter::Peekable<std::str::SplitWhitespace<'a>>;

fn any(words: Words<'_, '_>) -> bool {
    let mut allowed = all(words);
    while words.next_if_eq(&"OR").is_some() {
        allowed |= all(words);
    }
    allowed
}

fn all(words: Words<'_, '_>) -> bool {
    let mut allowed = one(words);
    while words.next_if_eq(&"AND").is_some() {
        allowed &= one(words);
    }
    allowed
}

fn one(words: Words<'_, '_>) -> bool {
    if words.next_if_eq(&"(").is_some() {
        return any(words) & words.next_if_eq(&")").is_some();
    }
    let mut licence = words.next().unwrap_or_default().to_owned();
    if words.next_if_eq(&"WITH").is_some() {
        licence += &format!(" WITH {}", words.next().unwrap_or_default());
    }
    ALLOWED.contains(&licence)
}

/// Describes what is wrong with a package. `None` if it is fine.
fn fault(package: &Value) -> Option<String> {
    let of = |field: &str| package[field].as_str().unwrap_or("none").to_owned();
    let name = format!("{} {}", of("name"), of("version"));
    let is_ours = package["source"].is_null()
        && package["name"].as_str().is_some_and(|name| name.starts_with("genga"));
    if !is_ours && !of("source").starts_with(REGISTRY) {
        return Some(format!("{name}: its source is {}", of("source")));
    }
    (!is_allowed(&of("license"))).then(|| format!("{name}: its licence is {}", of("license")))
}

#[test]
#[ignore = "fetches the packages of all systems: cargo test --test all licences -- --ignored"]
fn licences_and_sources_of_all_packages_are_allowed() {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["metadata", "--locked", "--all-features", "--format-version", "1"]);
    let output = cargo.current_dir(here("")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 100, "{} packages", packages.len());
    let faults: Vec<_> = packages.iter().filter_map(fault).collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn an_expression_is_allowed_if_its_licences_are() {
    for allowed in [
        "MIT",
        "MIT/Apache-2.0",
        "GPL-3.0 OR MIT",
        "(MIT OR GPL-3.0) AND OFL-1.1",
        "Apache-2.0 WITH LLVM-exception",
        "GPL-3.0 AND ISC OR MIT",
    ] {
        assert!(is_allowed(allowed), "{allowed}");
    }
    for refused in ["", "GPL-3.0", "MIT AND GPL-3.0", "(MIT", "MIT)", "MIT ISC", "MIT WITH GPL"] {
        assert!(!is_allowed(refused), "{refused}");
    }
}

#[test]
fn a_package_from_elsewhere_is_seen() {
    let package = |source: Option<&str>| serde_json::json!({ "name": "x", "version": "1", "license": "MIT", "source": source });
    assert_eq!(fault(&package(Some("registry+some-index"))), None);
    for wrong in [Some("git+some-repository"), None] {
        assert!(fault(&package(wrong)).unwrap().contains("source"), "{wrong:?}");
    }
}

#[test]
fn python_is_bound_by_a_pyo3_of_0_29_or_newer() {
    let lock: toml::Table =
        toml::from_str(&fs::read_to_string(here("Cargo.lock")).unwrap()).unwrap();
    let packages = lock["package"].as_array().unwrap();
    let of_pyo3 = packages.iter().filter(|package| package["name"].as_str() == Some("pyo3"));
    let versions: Vec<&str> = of_pyo3.map(|package| package["version"].as_str().unwrap()).collect();
    assert!(!versions.is_empty());
    for version in versions {
        let mut numbers = version.split('.').map(|number| number.parse::<u32>().unwrap());
        assert!((numbers.next(), numbers.next()) >= (Some(0), Some(29)), "pyo3 {version}");
    }
}
