//! §3.4: naka-nashi before koma-dori, or after.

use std::collections::BTreeSet;

use genga::timing::{Amount, Omission, Order};

use crate::Outcome;
use crate::kitamura::Window;
use crate::kitamura::table_1::ACTIONS;
use crate::ones::{Done, Ones, counts};
use crate::part::Part;
use crate::table::{Table, number, percent, spread};

/// What the paper found usual: so many left out, and a third held.
const LEFT_OUT: usize = 4;

/// Both orders of one clip.
struct Orders {
    koma: usize,
    paper: Done,
    other: Done,
    /// Koma that show another drawing where the length is let go.
    shorter: usize,
    peak: f64,
}

impl Orders {
    fn of(ones: &Ones, settings: &Omission) -> Outcome<Self> {
        let other =
            |settings: &Omission| ones.omit(&Omission { order: Order::KomaDoriFirst, ..*settings });
        let shorter = Omission { keep_length: false, ..*settings };
        Ok(Self {
            koma: ones.koma(),
            paper: ones.omit(settings)?,
            other: other(settings)?,
            shorter: apart(&ones.omit(&shorter)?, &other(&shorter)?)
                .filter(|koma| *koma > 0)
                .count(),
            peak: ones.peak(),
        })
    }

    /// Koma that show another drawing.
    fn differ(&self) -> usize {
        apart(&self.paper, &self.other).filter(|koma| *koma > 0).count()
    }

    /// Drawings that this order has and the other has not.
    fn new_drawings(&self) -> usize {
        let of = |done: &Done| done.shown.iter().copied().collect::<BTreeSet<_>>();
        of(&self.other).difference(&of(&self.paper)).count()
    }

    /// Whether both leave the same koma out.
    fn leaves_out_the_same(&self) -> bool {
        self.paper.left_out() == self.other.left_out()
    }

    fn row(&self, table: &mut Table, name: &str) {
        let share = |count: usize| percent(count as f64 / self.koma as f64);
        let drawings = self.other.sheet.layers[0].drawings.len();
        table.row(&[
            name.into(),
            self.koma.to_string(),
            format!("{} ({})", self.differ(), share(self.differ())),
            apart(&self.paper, &self.other).max().unwrap_or(0).to_string(),
            format!("{} of {drawings}", self.new_drawings()),
            if self.leaves_out_the_same() { "yes" } else { "no" }.into(),
            number(self.paper.peak / self.peak, 1),
            number(self.other.peak / self.peak, 1),
            format!("{} ({})", self.shorter, share(self.shorter)),
        ]);
    }
}

/// How many koma of the source each koma of two results lies apart.
fn apart(a: &Done, b: &Done) -> impl Iterator<Item = usize> {
    a.shown.iter().zip(&b.shown).map(|(a, b)| a.abs_diff(*b))
}

fn table() -> Table {
    Table::new(&[
        "clip",
        ">koma",
        ">koma that show another drawing",
        ">koma apart at most",
        ">drawings the paper's order has not",
        "the same left out",
        ">peak SSD, times",
        ">the other way round",
        ">another drawing, length let go",
    ])
}

/// The four actions.
pub(super) fn add_samples(part: &mut Part) -> Outcome<()> {
    let mut table = table();
    let mut same = 0;
    for action in ACTIONS {
        let settings = counts(action.naka_nashi, action.koma_dori);
        let orders = Orders::of(&action.ones()?, &settings)?;
        same += usize::from(orders.leaves_out_the_same());
        orders.row(&mut table, action.name);
    }
    part.table("order-samples", table);
    part.number("km.order.samples", ACTIONS.len());
    part.number("km.order.samples.same", same);
    Ok(())
}

/// Every real clip.
pub(super) fn add(part: &mut Part, windows: &[Window<'_>]) -> Outcome<()> {
    let usual = Omission { koma_dori: Amount::Share(1.0 / 3.0), ..counts(LEFT_OUT, 0) };
    let orders = windows.iter().map(|window| Orders::of(&window.ones, &usual));
    let orders = orders.collect::<Outcome<Vec<_>>>()?;
    let mut table = table();
    windows.iter().zip(&orders).for_each(|(window, orders)| orders.row(&mut table, window.name));
    part.table("order", table);
    part.number("km.order.left-out", LEFT_OUT);
    part.number("km.order.clips", windows.len());
    let same = orders.iter().filter(|orders| orders.leaves_out_the_same()).count();
    part.number("km.order.same", same);
    part.number("km.order.not-same", windows.len() - same);
    let furthest = orders.iter().flat_map(|orders| apart(&orders.paper, &orders.other)).max();
    part.number("km.order.furthest", furthest.unwrap_or(0));
    let mut shares = |name: &str, of: fn(&Orders) -> usize| {
        let share = |orders: &Orders| 100.0 * of(orders) as f64 / orders.koma as f64;
        let [least, middle, most] = spread(orders.iter().map(share));
        for (word, value) in [("least", least), ("middle", middle), ("most", most)] {
            part.number(&format!("km.order.{name}.{word}"), number(value, 0));
        }
    };
    shares("differ", Orders::differ);
    shares("shorter", |orders| orders.shorter);
    Ok(())
}
