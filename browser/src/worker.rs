//! Runs an export on a worker (ワーカー): a second instance of the program, so that the page stays responsive.

use std::cell::RefCell;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga_files::Settings;
use genga_studio::{Export, Pending};
use js_sys::{Array, Function, Uint8Array};
use wasm_bindgen::closure::Closure;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsCast, JsValue};

use super::clip::Read;
use super::{clip, export, page};

#[wasm_bindgen]
extern "C" {
    /// Defined in `page.html`: lets a worker call [`archive`] and passes its messages to `hear`. Returns a function
    /// that ends the worker.
    #[wasm_bindgen(catch)]
    fn elsewhere(job: &Array, hear: &Closure<dyn FnMut(JsValue)>) -> Result<Function, JsValue>;
}

/// An archive and the names of the files in it, or an error message.
type Made = Result<(Vec<u8>, Vec<String>), String>;

/// A worker at work.
struct Job {
    end: Function,
    /// Kept alive because the worker calls it until it ends.
    _hears: Closure<dyn FnMut(JsValue)>,
    /// The format being written.
    at: String,
    made: Option<Made>,
}

thread_local! {
    /// The current export; there is only one at a time.
    static JOB: RefCell<Option<Job>> = const { RefCell::new(None) };
}

/// Begins an export of a file's bytes. `None` if the page gets no worker.
pub(crate) fn begin(
    folder: &str,
    file: &str,
    bytes: &[u8],
    export: &Export<'_>,
) -> Option<Pending> {
    let formats: Array = export.formats.iter().map(|name| JsValue::from(*name)).collect();
    let job = Array::of5(
        &folder.into(),
        &file.into(),
        &Uint8Array::from(bytes),
        &export.recipe.write(export.edits).into(),
        &formats.join(" ").into(),
    );
    job.push(&export.settings.lines().into());
    let hears = Closure::new(hear);
    let end = elsewhere(&job, &hears).ok()?;
    JOB.set(Some(Job { end, _hears: hears, at: String::new(), made: None }));
    let archive = format!("{folder}.zip");
    Some(Box::new(move |stop, tell| {
        let (bytes, names) = match look(stop, tell)? {
            Ok(made) => made,
            Err(why) => return Some(Err(why)),
        };
        Some(page::give(&archive, &bytes).map(|()| names))
    }))
}

/// Polls the worker. `None` while it works.
fn look(stop: &AtomicBool, tell: &dyn Fn(&str)) -> Option<Made> {
    let made = JOB.with_borrow_mut(|job| match job {
        Some(job) if stop.load(Ordering::Relaxed) => {
            job.made.take().or_else(|| Some(Err("stopped: nothing was written".into())))
        }
        Some(job) => {
            tell(&job.at);
            job.made.take()
        }
        None => Some(Err("no export is running".into())),
    })?;
    if let Some(job) = JOB.take() {
        // A worker that has sent its last message may be gone already.
        drop(job.end.call0(&JsValue::NULL));
    }
    Some(made)
}

/// Handles a message of the worker: its progress, its result, or its error.
fn hear(said: JsValue) {
    let said: Array = said.unchecked_into();
    let text = |at| said.get(at).as_string().unwrap_or_default();
    JOB.with_borrow_mut(|job| {
        let Some(job) = job else { return };
        match &*text(0) {
            "at" => job.at = text(1),
            "made" => {
                let names = text(2).split(' ').map(str::to_owned).collect();
                let bytes = said.get(1).unchecked_into::<Uint8Array>().to_vec();
                job.made = Some(Ok((bytes, names)));
            }
            _ => job.made = Some(Err(text(1))),
        }
    });
}

/// Runs in the worker: returns everything that a run writes, as `[archive, names of its files]`.
///
/// # Errors
/// A sentence that says why there is no archive.
#[wasm_bindgen]
pub fn archive(
    folder: &str,
    file: &str,
    bytes: &[u8],
    recipe: &str,
    formats: &str,
    settings: &str,
    tell: &Function,
) -> Result<Array, JsValue> {
    // Progress is not worth an error if nobody hears it.
    let tell = |name: &str| drop(tell.call1(&JsValue::NULL, &name.into()));
    let (archive, names) = archived(folder, file, bytes, [recipe, formats, settings], &tell)?;
    Ok(Array::of2(&Uint8Array::from(&*archive), &names.join(" ").into()))
}

fn archived(
    folder: &str,
    file: &str,
    bytes: &[u8],
    [recipe, formats, settings]: [&str; 3],
    tell: &dyn Fn(&str),
) -> Made {
    let said = |error: genga::Error| error.to_string();
    let Read { clip, mark, notes } = Read::new(file, bytes)?;
    let (clip, notes) = clip::cleaned(file, clip, notes)?;
    let (recipe, edits) = Recipe::parse(recipe).map_err(said)?;
    let formats: Vec<&'static str> = export::names(formats);
    let mut engine = Engine::new(clip).map_err(said)?;
    let breakdown = engine.run(&recipe, &edits).map_err(said)?;
    let export = Export {
        clip: Path::new(file),
        breakdown: &breakdown,
        recipe: &recipe,
        edits: &edits,
        formats: &formats,
        settings: &Settings::from_lines(settings),
        stop: &AtomicBool::new(false),
        notes: &notes,
    };
    export::archive(folder, &export, &mark, tell)
}
