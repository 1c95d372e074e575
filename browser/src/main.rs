//! Builds the studio as a page, one file that any browser opens, and serves it if asked to.

#[cfg(not(target_family = "wasm"))]
mod build;
#[cfg(not(target_family = "wasm"))]
mod serve;

#[cfg(not(target_family = "wasm"))]
fn main() -> std::process::ExitCode {
    program::main()
}

#[cfg(target_family = "wasm")]
fn main() {}

#[cfg(not(target_family = "wasm"))]
mod program {
    use std::env;
    use std::path::PathBuf;
    use std::process::ExitCode;

    use super::{build, serve};

    const USAGE: &str =
        "usage: cargo run -p genga-browser -- [--out FOLDER] [--quick] [--serve] [--port N]

  --out FOLDER   folder for index.html [default: dist/browser]
  --quick        compile in half the time, for testing only
  --serve        serve the page to this machine only, until Ctrl-C
  --port N       port for --serve [default: 8124; 0: any free port]";

    /// The command line.
    struct Asked {
        out: PathBuf,
        is_quick: bool,
        port: Option<u16>,
    }

    impl Asked {
        fn new(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
            let mut asked = Self { out: "dist/browser".into(), is_quick: false, port: None };
            while let Some(word) = words.next() {
                match &*word {
                    "--out" => asked.out = words.next().ok_or(USAGE)?.into(),
                    "--quick" => asked.is_quick = true,
                    "--serve" => asked.port = asked.port.or(Some(8124)),
                    "--port" => {
                        let port = words.next().and_then(|word| word.parse().ok());
                        asked.port = Some(port.ok_or(USAGE)?);
                    }
                    _ => return Err(USAGE.into()),
                }
            }
            Ok(asked)
        }
    }

    fn run() -> Result<(), String> {
        let asked = Asked::new(env::args().skip(1))?;
        let page = build::page(&asked.out, asked.is_quick)?;
        asked.port.map_or(Ok(()), |port| serve::serve(&page, port))
    }

    pub(super) fn main() -> ExitCode {
        match run() {
            Ok(()) => ExitCode::SUCCESS,
            Err(message) => {
                eprintln!("genga-browser: {message}");
                ExitCode::FAILURE
            }
        }
    }
}
