//! Calls to the browser. Errors have the browser's own messages.

use genga_read::FORMATS;
use js_sys::{Array, Uint8Array};
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::spawn_local;
use web_sys::{
    Blob, BlobPropertyBag, Document, File, HtmlAnchorElement, HtmlInputElement, Storage, Url,
};

/// Whether the browser's language has the given code.
pub(crate) fn speaks(code: &str) -> bool {
    let language = web_sys::window().and_then(|window| window.navigator().language());
    language.is_some_and(|language| language.starts_with(code))
}

pub(crate) fn set_title(title: &str) {
    if let Some(document) = document() {
        document.set_title(title);
    }
}

/// The storage that the browser keeps from one visit to the next.
pub(crate) fn storage() -> Result<Storage, String> {
    let window = web_sys::window().ok_or("the page has no window")?;
    let storage = window.local_storage().map_err(said)?;
    storage.ok_or_else(|| "this browser gives this page no storage".into())
}

/// Lets a person choose files. Each is passed on with its bytes once it was read.
pub(crate) fn choose(take: impl Fn(String, Result<Vec<u8>, String>) + Clone + 'static) {
    let Some(input) = make::<HtmlInputElement>("input") else { return };
    input.set_type("file");
    let endings = FORMATS.iter().flat_map(|format| format.endings).chain(&["toml"]);
    let endings: Vec<String> = endings.map(|ending| format!(".{ending}")).collect();
    input.set_accept(&endings.join(","));
    let chosen = input.clone();
    let read = Closure::once_into_js(move || {
        let files = chosen.files();
        for file in
            files.iter().flat_map(|files| (0..files.length()).filter_map(|at| files.get(at)))
        {
            let take = take.clone();
            spawn_local(async move { take(file.name(), bytes(&file).await) });
        }
    });
    input.set_onchange(Some(read.unchecked_ref()));
    input.click();
}

async fn bytes(file: &File) -> Result<Vec<u8>, String> {
    let buffer = wasm_bindgen_futures::JsFuture::from(file.array_buffer()).await;
    buffer.map(|buffer| Uint8Array::new(&buffer).to_vec()).map_err(said)
}

/// Hands a file to the person as a download.
pub(crate) fn give(name: &str, bytes: &[u8]) -> Result<(), String> {
    let parts = Array::of1(&Uint8Array::from(bytes));
    let kind = BlobPropertyBag::new();
    kind.set_type("application/octet-stream");
    let blob = Blob::new_with_u8_array_sequence_and_options(&parts, &kind).map_err(said)?;
    let address = Url::create_object_url_with_blob(&blob).map_err(said)?;
    let link = make::<HtmlAnchorElement>("a").ok_or("the page cannot create a link")?;
    link.set_href(&address);
    link.set_download(name);
    link.click();
    // The browser has taken the file by now.
    Url::revoke_object_url(&address).map_err(said)
}

fn make<T: JsCast>(element: &str) -> Option<T> {
    document()?.create_element(element).ok()?.dyn_into().ok()
}

fn document() -> Option<Document> {
    web_sys::window()?.document()
}

/// The browser's message for a failure.
pub(crate) fn said(error: JsValue) -> String {
    let message = error.dyn_ref::<js_sys::Error>().map(|error| String::from(error.message()));
    message.unwrap_or_else(|| "unknown browser error".into())
}
