//! Figs 1, 2 and 8: SSD into each koma, which drawings are left out, doubled and held, and bars of the koma that have
//! their own drawing.

use genga_plot::SsdPlot;

use crate::Outcome;
use crate::kitamura::at_once::koma;
use crate::kitamura::table_1::ACTIONS;
use crate::ones::counts;
use crate::part::Part;
use crate::table::Table;

/// Makes a picture per action and a table of where its drawings are.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let mut table = Table::new(&[
        "action",
        ">largest SSD into koma",
        ">koma left out",
        ">koma doubled (times)",
        ">own drawings in the faster half",
        ">in the slower half",
    ]);
    for action in ACTIONS {
        let ones = action.ones()?;
        let done = ones.omit(&counts(action.naka_nashi, action.koma_dori))?;
        let source: Vec<usize> = (0..ones.koma()).collect();
        let steps = ones.steps(&source);
        let mut by_speed = source.clone();
        by_speed.sort_by(|a, b| steps[*b].total_cmp(&steps[*a]));
        let (fast, slow) = by_speed.split_at(by_speed.len() / 2);
        let own = |half: &[usize]| half.iter().filter(|koma| done.shown.contains(koma)).count();
        let of = |half: &[usize]| format!("{} of {}", own(half), half.len());
        let doubled =
            done.sheet.layers[0].drawings.iter().filter(|drawing| drawing.why.lengthened > 0);
        let doubled = doubled.map(|drawing| {
            let koma = ones.sheet.clock.koma_from_place(drawing.source.place()) + 1;
            format!("{koma} ({})", drawing.why.lengthened)
        });
        table.row(&[
            action.name.into(),
            (by_speed[0] + 1).to_string(),
            koma(&done.left_out()),
            doubled.collect::<Vec<_>>().join(", "),
            of(fast),
            of(slow),
        ]);
        if action.sample == "pitch" {
            let picture = SsdPlot::default().draw(&ones.clip, &ones.sheet, &done.sheet)?;
            part.picture("fig-1-2-8-pitch", picture);
        }
    }
    part.table("curve", table);
    Ok(())
}
