//! Merges several columns of drawings into one.

use crate::sheet::{Drawing, Exposure, Layer, Role, Source, Why};

/// Builds a column with a new drawing wherever one of the layers has one, as long as the longest layer. Also returns,
/// for each new drawing, the source shown by each layer.
pub(super) fn flattened(layers: &[&Layer]) -> (Layer, Vec<Vec<Source>>) {
    let length = layers.iter().map(|layer| layer.length()).max().unwrap_or(0);
    let mut begins: Vec<usize> =
        layers.iter().flat_map(|layer| layer.timed().map(|(begin, _)| begin)).collect();
    begins.sort_unstable();
    begins.dedup();
    let columns: Vec<Vec<(usize, Exposure)>> =
        layers.iter().map(|layer| layer.timed().collect()).collect();
    let ends = begins.iter().skip(1).copied().chain(std::iter::once(length));
    let mut flat = Layer {
        name: name(layers),
        joints: Vec::new(),
        drawings: Vec::with_capacity(begins.len()),
        exposures: Vec::with_capacity(begins.len()),
        gone: vec![],
    };
    let mut sources = Vec::with_capacity(begins.len());
    for (&begin, end) in begins.iter().zip(ends) {
        let shown: Vec<(usize, &Drawing)> = layers
            .iter()
            .zip(&columns)
            .map(|(layer, column)| shown(layer, column, begin))
            .collect();
        sources.push(shown.iter().map(|(_, drawing)| drawing.source).collect());
        let new = shown.iter().filter(|(first, _)| *first == begin).map(|(_, drawing)| *drawing);
        // `min_by_key` returns the first of equal ranks.
        let lead = new.min_by_key(|drawing| rank(drawing.role)).expect("some layer begins here");
        flat.exposures.push(Exposure { drawing: flat.drawings.len(), koma: end - begin });
        flat.drawings.push(Drawing::new(lead.source, lead.role, of_all(&lead.why)));
    }
    (flat, sources)
}

/// Returns the drawing of a layer on a koma, and the koma on which it began.
fn shown<'a>(layer: &'a Layer, column: &[(usize, Exposure)], koma: usize) -> (usize, &'a Drawing) {
    let after = column.partition_point(|(begin, _)| *begin <= koma);
    let (begin, exposure) = column[after - 1];
    (begin, &layer.drawings[exposure.drawing])
}

/// Copies the reasons, but without omissions and holds: these concern one layer alone.
fn of_all(why: &Why) -> Why {
    Why { lengthened: 0, omitted_before: 0, held_for: 0, ..why.clone() }
}

/// Precedence of a role when several layers begin a drawing on one koma; the lowest leads.
fn rank(role: Role) -> usize {
    match role {
        Role::Genga => 0,
        Role::End => 1,
        Role::Inbetween => 2,
    }
}

/// Joins the names of the first and the last column.
fn name(layers: &[&Layer]) -> String {
    match layers {
        [first, .., last] => format!("{}-{}", first.name, last.name),
        _ => layers.iter().map(|layer| layer.name.clone()).collect(),
    }
}
