//! §3.4: naka-nashi before koma-dori, or after.

use genga::timing::{Amount, Omission, Order};

use crate::Outcome;
use crate::kitamura::Window;
use crate::kitamura::table_1::ACTIONS;
use crate::ones::{Done, Ones, counts};
use crate::part::Part;
use crate::table::{Table, number, percent, spread};

/// The paper's usual amount: this many left out, and a third held.
const LEFT_OUT: usize = 4;

/// Both orders of one clip.
struct Orders {
    koma: usize,
    paper: Done,
    other: Done,
    /// Number of koma that show another drawing if the length may change.
    shorter: usize,
}

impl Orders {
    fn new(ones: &Ones, settings: &Omission) -> Outcome<Self> {
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
        })
    }

    /// Number of koma that show another drawing.
    fn differ(&self) -> usize {
        apart(&self.paper, &self.other).filter(|koma| *koma > 0).count()
    }

    /// Whether both orders leave out the same koma.
    fn leaves_out_the_same(&self) -> bool {
        self.paper.left_out() == self.other.left_out()
    }

    fn row(&self, table: &mut Table, name: &str) {
        let share = |count: usize| percent(count as f64 / self.koma as f64);
        table.row(&[
            name.into(),
            share(self.differ()),
            apart(&self.paper, &self.other).max().unwrap_or(0).to_string(),
            share(self.shorter),
            if self.leaves_out_the_same() { "yes" } else { "no" }.into(),
        ]);
    }
}

/// Distance, in koma of the source, between two results on each koma.
fn apart(a: &Done, b: &Done) -> impl Iterator<Item = usize> {
    a.shown.iter().zip(&b.shown).map(|(a, b)| a.abs_diff(*b))
}

fn table() -> Table {
    Table::new(&[
        "clip",
        ">koma that differ",
        ">koma apart at most",
        ">differ, length let go",
        "the same left out",
    ])
}

/// Compares the orders on the paper's four actions.
pub(super) fn add_samples(part: &mut Part) -> Outcome<()> {
    let mut table = table();
    let mut same = 0;
    for action in ACTIONS {
        let settings = counts(action.naka_nashi, action.koma_dori);
        let orders = Orders::new(&action.ones()?, &settings)?;
        same += usize::from(orders.leaves_out_the_same());
        orders.row(&mut table, action.name);
    }
    part.table("order-samples", table);
    part.number("km.order.samples", ACTIONS.len());
    part.number("km.order.samples.same", same);
    Ok(())
}

/// Compares the orders on every real clip.
pub(super) fn add(part: &mut Part, windows: &[Window<'_>]) -> Outcome<()> {
    let usual = Omission { koma_dori: Amount::Share(1.0 / 3.0), ..counts(LEFT_OUT, 0) };
    let orders = windows.iter().map(|window| Orders::new(&window.ones, &usual));
    let orders = orders.collect::<Outcome<Vec<_>>>()?;
    let mut table = table();
    windows.iter().zip(&orders).for_each(|(window, orders)| orders.row(&mut table, window.name));
    part.table("order", table);
    part.number("km.order.left-out", LEFT_OUT);
    part.number("km.order.clips", windows.len());
    let not_same = orders.iter().filter(|orders| !orders.leaves_out_the_same()).count();
    part.number("km.order.not-same", not_same);
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
