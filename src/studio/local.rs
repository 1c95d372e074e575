//! Local hands (部分の手直し): genga that are frozen, found again in a part, copied; the other sheet of a take.

use egui::Ui;

use super::Studio;
use super::column::Column;
use super::command::Command;
use super::copied::{self, Pasted};
use super::corrections::Correction;
use super::take::Results;

impl Studio {
    pub(super) fn freeze(&mut self) {
        let Some(take) = &mut self.take else { return };
        match take.freeze() {
            Ok(true) => self.tell(
                "Every genga is frozen: knobs time them and find no others. W thaws them.",
                "原画をすべて凍結しました。つまみを回しても選び直しません。W で解除。",
            ),
            Ok(false) => self.message = None,
            Err(error) => self.fail(error.to_string()),
        }
    }

    pub(super) fn find_again(&mut self) {
        let (Some(take), Some(koma)) = (&mut self.take, self.player.range.clone()) else {
            return self.tell(
                "Mark a part with I and O first: its genga are found again, all others stay.",
                "先に I と O で範囲を決めてください。その中の原画だけを選び直します。",
            );
        };
        if let Err(error) = take.find_again(&koma) {
            self.fail(error.to_string());
        }
    }

    pub(super) fn take_other(&mut self) {
        let Some(take) = &mut self.take else { return };
        let is_first = take.letter().is_none();
        take.take_other();
        if is_first {
            self.tell(
                "This sheet is kept as A, and you work on B. X goes from one to the other.",
                "いまのシートを A として控えました。B で作業します。X で行き来します。",
            );
        }
    }

    pub(super) fn copy_keys(&mut self, ui: &Ui) {
        let Some(take) = &mut self.take else { return };
        let columns = Column::all(&take.results().breakdown);
        let column = &columns[self.chosen.min(columns.len() - 1)];
        ui.ctx().copy_text(copied::text(column, self.player.range.as_ref()));
        self.tell(
            "The genga are copied; paste them in another column or another take.",
            "原画をコピーしました。別のセルやテイクに貼り付けられます。",
        );
    }

    pub(super) fn paste_keys(&mut self, text: &str) {
        let Some(take) = &mut self.take else { return };
        let Results { breakdown, wanted, .. } = take.results();
        let columns = Column::all(&breakdown);
        let column = &columns[self.chosen.min(columns.len() - 1)];
        let clock = column.clock;
        let edits = wanted.edits.of_layer(column.name);
        let set = edits.pins.iter().map(|pin| pin.frame);
        let set = set.chain(edits.moves.iter().map(|moved| moved.to));
        let taken: Vec<usize> = set.map(|frame| clock.koma_from_frame(frame)).collect();
        match copied::pins(text, clock, breakdown.clip.last(), &taken) {
            Ok(Pasted { pins, left_out }) => {
                let count = pins.len();
                self.change(Command::Correct(Correction::Paste(pins)));
                let (english, japanese) = (
                    format!("{count} genga pasted, {left_out} had no room."),
                    format!("原画{count}枚を貼り付けました。{left_out}枚は入りませんでした。"),
                );
                self.tell(&english, &japanese);
            }
            Err(error) => self.fail(format!("what was copied is no genga: {error}")),
        }
    }
}
