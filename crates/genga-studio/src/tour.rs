//! The tour (案内): the six steps from a clip to an export. The start screen lists them, and a row below the goals shows one
//! after the other while a person does them.

use egui::{Button, Label, RichText, Ui};

use super::command::Command;
use super::corrections::Correction;
use super::theme::Look;
use super::words::Words;

/// A step of the tour.
struct Step {
    english: &'static str,
    japanese: &'static str,
    /// Whether a command is what the step asks for.
    asks_for: fn(&Command) -> bool,
}

const STEPS: [Step; 6] = [
    Step {
        english: "Space plays. On the strip below, rest the pointer on a figure: it moves to the next genga.",
        japanese: "スペースで再生。下の列のポーズにポインターを置くと、次の原画まで動く。",
        asks_for: |command| matches!(command, Command::Play),
    },
    Step {
        english: "Drag How many genga until only the poses you want are left.",
        japanese: "「原画の枚数」を動かし、残したいポーズだけにする。",
        asks_for: |command| matches!(command, Command::Keys(_)),
    },
    Step {
        english: "A figure too many: point at it, and forbid it with the cross over it.",
        japanese: "いらないポーズは、ポインターを置いて上の × で禁止する。",
        asks_for: |command| matches!(command, Command::Correct(Correction::Forbid(..))),
    },
    Step {
        english: "A figure that must stay: point at it, and pin it with the pin over it. Any other koma: click it, and \
                  press L.",
        japanese: "残すポーズは、ポインターを置いて上のピンで固定する。ほかのコマは、クリックして L。",
        asks_for: |command| {
            let is_pin =
                |own: &Correction| matches!(own, Correction::PinKey(_) | Correction::Pin(_));
            match command {
                Command::Pin => true,
                Command::Correct(correction) => is_pin(correction),
                _ => false,
            }
        },
    },
    Step {
        english: "Drag How snappy. V shows before and after.",
        japanese: "「メリハリ」を動かす。V で変更前と見比べる。",
        asks_for: |command| matches!(command, Command::SetAll(_) | Command::Preset(_)),
    },
    Step {
        english: "Export: choose where it goes.",
        japanese: "書き出し: 届け先を選ぶ。",
        asks_for: |command| matches!(command, Command::Export(_)),
    },
];

/// The steps in words, in order.
pub(super) fn steps(words: Words) -> impl Iterator<Item = &'static str> {
    STEPS.iter().map(move |step| words.say(step.english, step.japanese))
}

/// Where a person is on the tour.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tour {
    /// Index of the step. `None` if there is no tour.
    at: Option<usize>,
    is_done: bool,
}

impl Tour {
    /// Begins at the first step.
    pub(super) fn begin(&mut self) {
        *self = Self { at: Some(0), is_done: false };
    }

    /// Goes some steps on or back. After the last the tour ends.
    pub(super) fn step(&mut self, by: isize) {
        let next = self.at.and_then(|at| at.checked_add_signed(by));
        *self = Self { at: next.filter(|next| *next < STEPS.len()), is_done: false };
    }

    /// Ends the tour.
    pub(super) fn end(&mut self) {
        *self = Self::default();
    }

    /// Notes whether a command is what the step asks for.
    pub(super) fn watch(&mut self, command: &Command) {
        self.is_done |= self.at.is_some_and(|at| (STEPS[at].asks_for)(command));
    }

    pub(super) fn is_shown(&self) -> bool {
        self.at.is_some()
    }

    /// Shows the step, with buttons to the next and the one before.
    pub(super) fn show(&self, ui: &mut Ui, look: &Look, words: Words, commands: &mut Vec<Command>) {
        let Some(at) = self.at else { return };
        ui.horizontal_wrapped(|ui| {
            let number = RichText::new(format!("{}/{}", at + 1, STEPS.len())).strong();
            ui.label(number.color(look.genga));
            let text = words.say(STEPS[at].english, STEPS[at].japanese);
            ui.add(Label::new(RichText::new(text).color(look.ink)).wrap());
            if self.is_done {
                ui.label(RichText::new(words.say("Done.", "できました。")).color(look.wall));
            }
            let back = ui.add_enabled(at > 0, Button::new(words.say("Back", "戻る")));
            if back.clicked() {
                commands.push(Command::TourStep(-1));
            }
            let is_last = at + 1 == STEPS.len();
            let next = if is_last {
                words.say("Finish", "終わり")
            } else {
                words.say("Next", "次へ")
            };
            if ui.add(Button::new(next).selected(self.is_done)).clicked() {
                commands.push(Command::TourStep(1));
            }
            if ui.button(words.say("End the tour", "案内を閉じる")).clicked() {
                commands.push(Command::EndTour);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_done_by_what_it_asks_for_alone_and_after_the_last_the_tour_ends() {
        let mut tour = Tour::default();
        tour.watch(&Command::Play);
        assert!(!tour.is_done, "there is no tour");
        tour.begin();
        tour.watch(&Command::Keys(9));
        assert!(!tour.is_done);
        tour.watch(&Command::Play);
        assert!(tour.is_done);
        tour.step(1);
        assert!(!tour.is_done);
        (1..STEPS.len()).for_each(|_| tour.step(1));
        assert!(!tour.is_shown());
    }
}
