//! The search for a number of genga (原画の枚数を探す): as far as it comes in a frame, and on in the next, so that neither
//! window nor page stands still.

use egui::Ui;
use web_time::Instant;

use super::Studio;
use super::command::Command;
use super::document::Document;
use super::focus::Part;
use super::notice::Message;
use super::words::Words;
use genga::error::Error;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::target::{Met, Outcome, Search};

/// Seconds of a search in its first frame, and in each further one. A search that ends in the first is repeated during a
/// drag.
pub(super) const PATIENT: f64 = 0.12;
const FURTHER: f64 = 0.03;

/// A search that goes on from frame to frame.
pub(super) struct GengaSearch {
    count: usize,
    search: Search,
    /// The document of which it was asked.
    wanted: Document,
    /// An engine of its own, so that the results on screen stay.
    engine: Engine,
}

impl GengaSearch {
    /// Creates a search from a recipe, with the corrections of a document.
    pub(super) fn new(engine: Engine, of: &Recipe, wanted: &Document, count: usize) -> Self {
        let search = Search::new(of, &wanted.edits, count);
        Self { count, search, wanted: wanted.clone(), engine }
    }

    /// Searches for some seconds, at least one step. `None` if there is more to do.
    fn go_on(&mut self, seconds: f64) -> Option<Result<Met, Error>> {
        let begin = Instant::now();
        loop {
            let met = self.search.step(&mut self.engine);
            if met.is_some() || begin.elapsed().as_secs_f64() >= seconds {
                return met;
            }
        }
    }

    /// Shows how far the search is, with a button that ends it.
    pub(super) fn show(&self, ui: &mut Ui, words: Words, commands: &mut Vec<Command>) {
        let (count, counts) = (self.count, self.search.counts());
        ui.horizontal(|ui| {
            ui.spinner();
            ui.label(match words.is_japanese() {
                true => format!("原画{count}枚の設定を探しています: シート{counts}通り"),
                false => format!("searching settings for {count} genga: {counts} sheets counted"),
            });
            let stop = ui.button(words.say("Stop searching", "探すのをやめる"));
            Part::Notices.begins(&stop);
            if stop.clicked() {
                commands.push(Command::StopSearch);
            }
        });
    }
}

impl Studio {
    /// Asks for a number of genga. During a drag it is asked of the recipe that the drag began with.
    pub(super) fn ask_keys(&mut self, ui: &Ui, count: usize) {
        let Some(take) = &self.take else { return };
        if ui.input(|input| input.pointer.any_down()) {
            self.held.get_or_insert_with(|| take.wanted.clone());
        }
        self.asked = Some(count);
    }

    /// Searches for the settings of the number of genga that was asked for. A slow search waits until the pointer is
    /// released.
    pub(super) fn answer_keys(&mut self, ui: &Ui, is_held: bool) {
        let Some(take) = &mut self.take else { return };
        let is_slow = take.is_slow_to_ask;
        let asked = self.asked.take_if(|_| !(is_held && is_slow));
        if let Some(count) = asked {
            let of = self.held.as_ref().unwrap_or(&take.wanted).recipe.clone();
            self.searching = Some(take.search(&of, count));
        }
        // What is changed meanwhile is meant instead.
        self.searching.take_if(|search| search.wanted != take.wanted);
        let Some(search) = &mut self.searching else { return };
        let met = search.go_on(if asked.is_some() { self.patience } else { FURTHER });
        if asked.is_some() {
            take.is_slow_to_ask = met.is_none();
        }
        ui.ctx().request_repaint();
        let Some(met) = met else { return };
        self.searching = None;
        self.message = match met {
            Ok(met) => {
                take.wanted.recipe = met.recipe;
                met.outcomes.iter().find(|outcome| outcome.shortfall.is_some()).map(missed)
            }
            Err(error) => Some(Message::failure(error.to_string())),
        };
    }
}

/// Says why there are not as many genga as were asked for.
fn missed(outcome: &Outcome) -> Message {
    Message { text: outcome.to_string(), japanese: Some(outcome.japanese()), is_failure: false }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use super::*;
    use crate::{ClipsAlone, Language};
    use egui::{Context, RawInput};
    use genga::edits::Edits;
    use genga::motion::bvh;
    use genga::target::{Target, meet};

    fn frame(context: &Context, studio: &mut Studio, work: impl FnOnce(&mut Studio, &Ui)) {
        let mut work = Some(work);
        let mut output = context.run_ui(RawInput::default(), |ui| {
            if let Some(work) = work.take() {
                work(studio, ui);
            }
            studio.ui(ui);
        });
        // Nothing is shown, so the font textures are dropped on purpose.
        output.textures_delta.clear();
    }

    /// A studio with a kick, in which a search takes one step a frame.
    fn studio(context: &Context) -> Studio {
        let desk = ClipsAlone(|_: &Path| {
            let read = bvh::read(bvh::KICK.as_bytes());
            read.map(|read| read.clip).map_err(|error| error.to_string())
        });
        let mut studio = Studio::new(Arc::new(desk), Language::English);
        studio.patience = 0.0;
        studio.open(Path::new("kick.bvh"), None);
        while studio.take.is_none() {
            frame(context, &mut studio, |_, _| ());
        }
        studio
    }

    #[test]
    fn a_slow_search_goes_on_from_frame_to_frame_and_comes_to_the_programs_result() {
        let context = Context::default();
        let mut studio = studio(&context);
        frame(&context, &mut studio, |studio, ui| studio.ask_keys(ui, 8));
        assert!(studio.searching.is_some() && studio.take.as_ref().unwrap().is_slow_to_ask);
        assert_eq!(studio.document().unwrap().recipe, Recipe::default());
        while studio.searching.is_some() {
            frame(&context, &mut studio, |_, _| ());
        }
        let clip = bvh::read(bvh::KICK.as_bytes()).unwrap().clip;
        let mut engine = Engine::new(clip).unwrap();
        let met =
            meet(&mut engine, &Recipe::default(), &Edits::default(), &[Target::Keys(8)]).unwrap();
        assert_eq!(studio.document().unwrap().recipe, met.recipe);
        let difference = studio.difference.as_ref().expect("what the search changed is shown");
        assert_eq!(difference.before.genga, 13);
        assert_eq!(studio.message, None);
    }

    #[test]
    fn a_search_can_be_left_and_one_that_falls_short_says_why_in_both_languages() {
        let context = Context::default();
        let mut studio = studio(&context);
        frame(&context, &mut studio, |studio, ui| studio.ask_keys(ui, 8));
        frame(&context, &mut studio, |studio, ui| studio.act(ui, Command::StopSearch));
        assert!(studio.searching.is_none());
        assert_eq!(studio.document().unwrap().recipe, Recipe::default());
        frame(&context, &mut studio, |studio, ui| studio.ask_keys(ui, 8));
        studio.turn("spacing.on", "3").unwrap();
        frame(&context, &mut studio, |_, _| ());
        assert!(studio.searching.is_none(), "another change is meant instead");
        studio.patience = 1e9;
        frame(&context, &mut studio, |studio, ui| studio.ask_keys(ui, 90));
        let message = studio.message.clone().unwrap();
        assert!(message.text.starts_with("90 genga were asked for"), "{}", message.text);
        assert!(message.japanese.unwrap().starts_with("原画90枚の指定に対して"));
    }
}
