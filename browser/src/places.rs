//! Lists the named parts of the screen (画面の部品): a canvas has no elements that a program could query.

use std::cell::RefCell;

use eframe::egui::accesskit::{Node, NodeId, TreeUpdate};
use eframe::egui::{Context, FullOutput, Plugin};
use js_sys::Array;
use wasm_bindgen::prelude::wasm_bindgen;

thread_local! {
    /// The context of the studio on this page, and the tree it drew last.
    static SEEN: RefCell<Option<(Context, Option<TreeUpdate>)>> = const { RefCell::new(None) };
}

/// A plugin that observes the output. The accessibility tree is built only once somebody asks for it.
pub(crate) struct Places;

impl Plugin for Places {
    fn debug_name(&self) -> &'static str {
        "places"
    }

    fn setup(&mut self, context: &Context) {
        SEEN.set(Some((context.clone(), None)));
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        if let Some(update) = output.platform_output.accesskit_update.take() {
            SEEN.set(Some((context.clone(), Some(update))));
        }
    }
}

/// Returns every drawn part that has a name, as `[name, role, left, top, width, height]` in the page's pixels. The
/// first call returns an empty list and turns the recording on.
#[wasm_bindgen]
pub fn places() -> Array {
    SEEN.with_borrow(|seen| {
        let Some((context, update)) = seen else { return Array::new() };
        context.enable_accesskit();
        context.request_repaint();
        let zoom = f64::from(context.zoom_factor());
        let nodes = update.as_ref().map_or(&[][..], |update| &update.nodes);
        nodes.iter().filter_map(|(_, node)| place(node, nodes, zoom)).collect()
    })
}

fn place(node: &Node, all: &[(NodeId, Node)], zoom: f64) -> Option<Array> {
    let bounds = node.bounds()?;
    let labels = all.iter().filter(|(id, _)| node.labelled_by().contains(id));
    let labelled = || labels.filter_map(|(_, label)| label.value().or(label.label())).next();
    let name = node.label().or_else(labelled).or(node.value())?;
    let place = Array::of2(&name.into(), &format!("{:?}", node.role()).into());
    for length in [bounds.x0, bounds.y0, bounds.x1 - bounds.x0, bounds.y1 - bounds.y0] {
        place.push(&(length * zoom).into());
    }
    Some(place)
}
