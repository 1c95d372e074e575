//! The binary half of a GLB and the views into it.

use serde_json::{Value, json};

/// What the values of an accessor are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::deliver) enum Use {
    /// Times, keys and matrices.
    Data,
    /// Vertices of a mesh.
    Vertices,
    /// Which vertices make the triangles.
    Triangles,
}

impl Use {
    /// The view's target, a number that glTF took over from OpenGL.
    fn target(self) -> Option<u32> {
        match self {
            Self::Data => None,
            Self::Vertices => Some(34962),
            Self::Triangles => Some(34963),
        }
    }
}

/// A type of number that a buffer can hold.
pub(in crate::deliver) trait Component: Copy {
    /// glTF's number for the type.
    const TYPE: u32;
    fn put(self, bytes: &mut Vec<u8>);
}

impl Component for f32 {
    const TYPE: u32 = 5126;
    fn put(self, bytes: &mut Vec<u8>) {
        // Adding 0 makes 0 of −0, which would differ in bytes and in nothing else.
        bytes.extend((self + 0.0).to_le_bytes());
    }
}

impl Component for u8 {
    const TYPE: u32 = 5121;
    fn put(self, bytes: &mut Vec<u8>) {
        bytes.push(self);
    }
}

impl Component for u16 {
    const TYPE: u32 = 5123;
    fn put(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

impl Component for u32 {
    const TYPE: u32 = 5125;
    fn put(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

/// The bytes, and the views and accessors that say what they are.
#[derive(Debug, Default)]
pub(in crate::deliver) struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    /// Adds values of one shape, such as `VEC3`; gives the number of their accessor.
    pub(in crate::deliver) fn add<C: Component, const N: usize>(
        &mut self,
        usage: Use,
        shape: &str,
        values: &[[C; N]],
    ) -> usize {
        let offset = self.bytes.len();
        values.iter().flatten().for_each(|value| value.put(&mut self.bytes));
        let mut view =
            json!({ "buffer": 0, "byteOffset": offset, "byteLength": self.bytes.len() - offset });
        if let Some(target) = usage.target() {
            view["target"] = target.into();
        }
        // Every value has to begin at a multiple of its size, and none is larger than 4 bytes.
        pad(&mut self.bytes, 0);
        self.accessors.push(json!({
            "bufferView": self.views.len(),
            "componentType": C::TYPE,
            "count": values.len(),
            "type": shape,
        }));
        self.views.push(view);
        self.accessors.len() - 1
    }

    /// The same for floats that a reader wants the bounds of: times and positions.
    pub(in crate::deliver) fn add_bounded<const N: usize>(
        &mut self,
        usage: Use,
        shape: &str,
        values: &[[f32; N]],
    ) -> usize {
        let accessor = self.add(usage, shape, values);
        let bound = |start: f32, further: fn(f32, f32) -> f32| -> Value {
            let along = |axis: usize| values.iter().map(|value| value[axis]).fold(start, further);
            // As f64: the shortest decimal of an f32 is read as another f64 than the value itself.
            (0..N).map(|axis| f64::from(along(axis) + 0.0)).collect()
        };
        self.accessors[accessor]["min"] = bound(f32::INFINITY, f32::min);
        self.accessors[accessor]["max"] = bound(f32::NEG_INFINITY, f32::max);
        accessor
    }

    /// The whole file: header, the document with the buffer's parts entered, the bytes.
    pub(in crate::deliver) fn into_glb(self, mut document: Value) -> Vec<u8> {
        document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        document["bufferViews"] = Value::Array(self.views);
        document["accessors"] = Value::Array(self.accessors);
        let mut text = document.to_string().into_bytes();
        pad(&mut text, b' ');
        let mut glb = b"glTF".to_vec();
        let length = 12 + 8 + text.len() + 8 + self.bytes.len();
        [2, length].into_iter().for_each(|number| put_length(&mut glb, number));
        for (kind, chunk) in [(b"JSON", text), (b"BIN\0", self.bytes)] {
            put_length(&mut glb, chunk.len());
            glb.extend(kind);
            glb.extend(chunk);
        }
        glb
    }
}

fn put_length(bytes: &mut Vec<u8>, length: usize) {
    bytes.extend((length as u32).to_le_bytes());
}

/// Fills up to a multiple of 4 bytes.
fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), with);
}
