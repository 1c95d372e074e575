//! Builds one file with everything in it (一枚のページ), because a page opened from a disk may not read files beside it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use base64::Engine;
use base64::prelude::BASE64_STANDARD as STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";
/// The page without its program.
const PAGE: &str = include_str!("page.html");
/// Compression level: small rather than fast, since it runs once.
const LEVEL: u8 = 10;
/// Largest size of the packed program in bytes, so that nobody waits long for it.
const MOST: usize = 8_000_000;

/// Builds the page into a folder, and returns its path.
pub(super) fn page(folder: &Path, is_quick: bool) -> Result<PathBuf, String> {
    let compiled = compile(is_quick)?;
    let (glue, program) = bind(&compiled)?;
    let packed = compress_to_vec_zlib(&program, LEVEL);
    if !is_quick && packed.len() > MOST {
        return Err(format!("the packed program has {} bytes, more than {MOST}", packed.len()));
    }
    let text =
        PAGE.replace("/* glue */", &glue).replace("<!-- program -->", &STANDARD.encode(&packed));
    let page = folder.join("index.html");
    let put = || fs::create_dir_all(folder).and_then(|()| fs::write(&page, &text));
    put().map_err(failed_at(&page))?;
    let kb = |bytes: usize| bytes.div_ceil(1000);
    println!(
        "{}: {} KB; program {} KB, packed {} KB",
        page.display(),
        kb(text.len()),
        kb(program.len()),
        kb(packed.len())
    );
    Ok(page)
}

/// Compiles the page's program.
fn compile(is_quick: bool) -> Result<PathBuf, String> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let repository = here.parent().unwrap_or(here);
    let (profile, folder) = if is_quick { ("dev", "debug") } else { ("page", "page") };
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut cargo = Command::new(cargo);
    cargo.current_dir(repository).args(["build", "--locked", "--package", "genga-browser"]);
    cargo.args(["--lib", "--target", TARGET, "--profile", profile]);
    // SIMD: every browser that can run the page has it.
    cargo.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS", "-C target-feature=+simd128");
    let ended = cargo.status().map_err(|error| format!("cargo: {error}"))?;
    if !ended.success() {
        return Err(format!("compiling the page failed (try rustup target add {TARGET})"));
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = repository.join(target.unwrap_or_else(|| "target".into()));
    Ok(target.join(TARGET).join(folder).join("genga_browser.wasm"))
}

/// Returns the script that joins program and page, and the program that it joins.
fn bind(compiled: &Path) -> Result<(String, Vec<u8>), String> {
    let wrong = |error| format!("{}: {error:#}", compiled.display());
    let mut bindgen = Bindgen::new();
    bindgen.input_path(compiled).typescript(false).remove_name_section(true);
    bindgen.no_modules(true).map_err(wrong)?;
    let mut bound = bindgen.generate_output().map_err(wrong)?;
    Ok((bound.js().to_owned(), bound.wasm_mut().emit_wasm()))
}

fn failed_at(path: &Path) -> impl Fn(std::io::Error) -> String {
    move |error| format!("{}: {error}", path.display())
}
