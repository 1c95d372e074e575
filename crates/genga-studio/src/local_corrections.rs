//! Local corrections (部分の手直し): freezing genga, finding them again in a part, copying them, and the other sheet of a
//! take.

use egui::Ui;

use super::Studio;
use super::clipboard::{self, Pasted};
use super::column::Column;
use super::command::Command;
use super::corrections::Correction;
use super::open_take::Results;

impl Studio {
    pub(super) fn freeze(&mut self) {
        let Some(take) = &mut self.take else { return };
        match take.freeze() {
            Ok(true) => self.tell(
                "All genga are frozen: settings change only their timing. W unfreezes.",
                "原画をすべて凍結しました。設定を変えても選び直しません。W で解除。",
            ),
            Ok(false) => self.message = None,
            Err(error) => self.fail(error.to_string()),
        }
    }

    pub(super) fn find_again(&mut self) {
        let (Some(take), Some(koma)) = (&mut self.take, self.player.range.clone()) else {
            return self.tell(
                "Mark a range with I and O first. Only its genga are found again.",
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
                "This sheet is kept as A; you now edit B. X switches between them.",
                "このシートを A として残し、B を編集します。X で切り替えます。",
            );
        }
    }

    pub(super) fn copy_keys(&mut self, ui: &Ui) {
        let Some(take) = &mut self.take else { return };
        let columns = Column::all(&take.results().breakdown);
        let column = &columns[self.chosen.min(columns.len() - 1)];
        ui.ctx().copy_text(clipboard::text(column, self.player.range.as_ref()));
        self.tell(
            "Genga copied. Paste them into another column or take.",
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
        match clipboard::pins(text, clock, breakdown.clip.last(), &taken) {
            Ok(Pasted { pins, left_out }) => {
                let count = pins.len();
                self.change(Command::Correct(Correction::Paste(pins)));
                let (english, japanese) = (
                    format!("{count} genga pasted, {left_out} did not fit."),
                    format!("原画{count}枚を貼り付けました。{left_out}枚は入りませんでした。"),
                );
                self.tell(&english, &japanese);
            }
            Err(error) => self.fail(format!("the clipboard has no genga: {error}")),
        }
    }
}
