//! Reads numbers through an accessor, its buffer view and its buffer.

use super::buffers::Buffers;
use super::document::{Accessor, Document};
use super::wrong;
use genga::error::Error;

/// Suffix of the extensions that compress the data of a view.
const PACKED: &str = "meshopt_compression";

/// A table of numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Numbers {
    /// Numbers per row: 1 for SCALAR, 3 for VEC3.
    pub(super) width: usize,
    pub(super) values: Vec<f64>,
}

/// The location and layout of rows of numbers.
struct Rows {
    view: usize,
    offset: usize,
    component: Component,
    width: usize,
    count: usize,
}

/// The encoding of a number.
#[derive(Debug, Clone, Copy)]
struct Component {
    code: u32,
    normalized: bool,
}

impl Component {
    fn bytes(self) -> Option<usize> {
        match self.code {
            5120 | 5121 => Some(1),
            5122 | 5123 => Some(2),
            5125 | 5126 => Some(4),
            _ => None,
        }
    }

    /// Decodes a number from its bytes. Normalized integers are shares of the largest value.
    fn number(self, bytes: &[u8]) -> f64 {
        let word = |from: usize| bytes.get(from).copied().unwrap_or_default();
        let two = [word(0), word(1)];
        let four = [word(0), word(1), word(2), word(3)];
        let (number, most) = match self.code {
            5120 => (f64::from(word(0) as i8), 127.0),
            5121 => (f64::from(word(0)), 255.0),
            5122 => (f64::from(i16::from_le_bytes(two)), 32767.0),
            5123 => (f64::from(u16::from_le_bytes(two)), 65535.0),
            5125 => (f64::from(u32::from_le_bytes(four)), 4294967295.0),
            _ => return f64::from(f32::from_le_bytes(four)),
        };
        if self.normalized { (number / most).max(-1.0) } else { number }
    }
}

/// Reads an accessor; `part` names the place that refers to it.
pub(super) fn read(
    document: &Document,
    buffers: &mut Buffers<'_>,
    at: usize,
    part: &str,
) -> Result<Numbers, Error> {
    let Some(accessor) = document.accessors.get(at) else {
        return Err(wrong(part, format!("there is no accessor {at}")));
    };
    let part = format!("accessors[{at}]");
    let width = width(accessor, &part)?;
    let Accessor { component, normalized, count, offset, view, .. } = *accessor;
    let component = Component { code: component, normalized };
    let mut values = match view {
        Some(view) => {
            Rows { view, offset, component, width, count }.read(document, buffers, &part)?
        }
        None => zeros(accessor, width, &part)?,
    };
    if let Some(sparse) = &accessor.sparse {
        let (count, indices) = (sparse.count, &sparse.indices);
        let code = Component { code: indices.component, normalized: false };
        let (view, offset) = (indices.view, indices.offset);
        let indices = Rows { view, offset, component: code, width: 1, count };
        let indices = indices.read(document, buffers, &format!("{part}.sparse.indices"))?;
        let (view, offset) = (sparse.values.view, sparse.values.offset);
        let others = Rows { view, offset, component, width, count };
        let others = others.read(document, buffers, &format!("{part}.sparse.values"))?;
        for (index, row) in indices.iter().zip(others.chunks_exact(width)) {
            let row_at = *index as usize * width;
            let Some(place) = values.get_mut(row_at..row_at + width) else {
                return Err(wrong(&part, format!("sparse: there is no row {index}")));
            };
            place.copy_from_slice(row);
        }
    }
    Ok(Numbers { width, values })
}

/// Rows of zeros, to be filled by sparse values alone; their number is bounded.
fn zeros(accessor: &Accessor, width: usize, part: &str) -> Result<Vec<f64>, Error> {
    const MOST: usize = 1 << 20;
    if accessor.sparse.is_none() || accessor.count > MOST {
        return Err(wrong(part, "it has no numbers: its bufferView is missing"));
    }
    Ok(vec![0.0; accessor.count * width])
}

fn width(accessor: &Accessor, part: &str) -> Result<usize, Error> {
    match accessor.kind.as_str() {
        "SCALAR" => Ok(1),
        "VEC2" => Ok(2),
        "VEC3" => Ok(3),
        "VEC4" => Ok(4),
        other => Err(wrong(part, format!("expected SCALAR to VEC4, found {other:?}"))),
    }
}

impl Rows {
    fn read(
        &self,
        document: &Document,
        buffers: &mut Buffers<'_>,
        part: &str,
    ) -> Result<Vec<f64>, Error> {
        let Some(view) = document.views.get(self.view) else {
            return Err(wrong(part, format!("there is no bufferView {}", self.view)));
        };
        if let Some(packed) = view.extensions.keys().find(|name| name.ends_with(PACKED)) {
            let message = format!(
                "its numbers are packed by {packed}, which genga does not unpack; export the file without compression"
            );
            return Err(wrong(format!("bufferViews[{}]", self.view), message));
        }
        let Some(size) = self.component.bytes() else {
            return Err(wrong(part, format!("there is no componentType {}", self.component.code)));
        };
        let row = size * self.width;
        let stride = view.stride.unwrap_or(row).max(row);
        let buffer = buffers.get(view.buffer)?;
        let end = view.offset.saturating_add(view.length).min(buffer.len());
        let bytes = buffer.get(view.offset..end).and_then(|view| view.get(self.offset..));
        let bytes = bytes.unwrap_or_default();
        // The last row needs no padding after it.
        let room = (bytes.len() + stride).saturating_sub(row) / stride;
        if room < self.count {
            let count = self.count;
            return Err(wrong(part, format!("it says {count} rows, and there is room for {room}")));
        }
        let rows = bytes.chunks(stride).take(self.count);
        let number = |bytes: &[u8]| self.component.number(bytes);
        Ok(rows
            .flat_map(|bytes| bytes[..row.min(bytes.len())].chunks_exact(size).map(number))
            .collect())
    }
}
