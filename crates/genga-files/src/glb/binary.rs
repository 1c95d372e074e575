//! The binary chunk of a GLB, and the buffer views and accessors into it.

use serde_json::{Map, Value, json};

/// The use of an accessor's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// Times, keys and matrices.
    Data,
    /// Vertices of a mesh.
    Vertices,
    /// Vertex indices of triangles.
    Triangles,
}

impl Use {
    /// The buffer view's target, a constant that glTF took over from OpenGL.
    fn target(self) -> Option<u32> {
        match self {
            Self::Data => None,
            Self::Vertices => Some(34962),
            Self::Triangles => Some(34963),
        }
    }
}

/// A component type of a buffer.
pub(crate) trait Component: Copy {
    /// glTF's number of the type.
    const TYPE: u32;
    fn put(self, bytes: &mut Vec<u8>);
}

impl Component for f32 {
    const TYPE: u32 = 5126;
    fn put(self, bytes: &mut Vec<u8>) {
        // Adding 0 turns −0 into 0: the values are equal, and so should the bytes be.
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

/// The binary chunk, with the views and accessors that describe it.
#[derive(Debug, Default)]
pub(crate) struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    /// Begins with the buffer of another document, and with its views and accessors.
    pub(crate) fn of(bytes: &[u8], parts: &Map<String, Value>) -> Self {
        let list = |name: &str| parts.get(name).and_then(Value::as_array).cloned();
        let [views, accessors] =
            ["bufferViews", "accessors"].map(|name| list(name).unwrap_or_default());
        let mut bytes = bytes.to_vec();
        pad(&mut bytes, 0);
        Self { bytes, views, accessors }
    }

    /// Adds values of one shape, such as `VEC3`, and returns the index of their accessor.
    pub(crate) fn add<C: Component, const N: usize>(
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
        // Alignment: an accessor must begin at a multiple of its component size, which is at most 4 bytes.
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

    /// Adds floats whose bounds a reader needs: times and positions.
    pub(crate) fn add_bounded<const N: usize>(
        &mut self,
        usage: Use,
        shape: &str,
        values: &[[f32; N]],
    ) -> usize {
        let accessor = self.add(usage, shape, values);
        let bound = |start: f32, further: fn(f32, f32) -> f32| -> Value {
            let along = |axis: usize| values.iter().map(|value| value[axis]).fold(start, further);
            // Converted to f64 because the shortest decimal of an f32 parses as a different f64.
            (0..N).map(|axis| f64::from(along(axis) + 0.0)).collect()
        };
        self.accessors[accessor]["min"] = bound(f32::INFINITY, f32::min);
        self.accessors[accessor]["max"] = bound(f32::NEG_INFINITY, f32::max);
        accessor
    }

    /// Assembles the file: header, the JSON chunk with the buffer entries filled in, and the binary chunk.
    pub(crate) fn into_glb(self, mut document: Value) -> Vec<u8> {
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

/// Pads to a multiple of 4 bytes.
fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), with);
}
