//! Copies the parts of a document that some nodes refer to, and what those refer to.

use std::collections::{BTreeSet, HashMap};

use serde_json::{Map, Value, json};

use super::super::buffers::Buffers;
use super::super::document::Document;
use super::super::wrong;
use genga::error::Error;

/// The extension of lights, and the array of its document part.
pub(super) const LIGHTS: &str = "KHR_lights_punctual";

/// A copy of parts of a document, in which every index is that of the copy.
pub(super) struct Parts<'a, 'b> {
    raw: &'a Value,
    document: &'a Document,
    buffers: &'a mut Buffers<'b>,
    copied: HashMap<(&'static str, usize), usize>,
    arrays: Map<String, Value>,
    bytes: Vec<u8>,
}

impl<'a, 'b> Parts<'a, 'b> {
    pub(super) fn new(
        raw: &'a Value,
        document: &'a Document,
        buffers: &'a mut Buffers<'b>,
    ) -> Self {
        let (copied, arrays, bytes) = (HashMap::new(), Map::new(), Vec::new());
        Self { raw, document, buffers, copied, arrays, bytes }
    }

    /// Copies what a node refers to, and makes the node refer to the copies. On an error, it has no shape.
    pub(super) fn adopt(&mut self, node: &mut Map<String, Value>) -> Result<(), Error> {
        node.remove("children");
        if node.remove("skin").is_some() {
            // Without its bones the shape would stand stiff.
            ["mesh", "weights"].iter().for_each(|member| drop(node.remove(*member)));
        }
        let lights =
            node.remove("extensions").and_then(|mut all| all.get_mut(LIGHTS).map(Value::take));
        if let Some(light) = lights.as_ref().and_then(|light| index(light.get("light")?)) {
            let light = self.light(light);
            node.insert("extensions".into(), json!({ LIGHTS: { "light": light } }));
        }
        if let Some(camera) = node.get("camera").and_then(index) {
            node.insert("camera".into(), self.copy("cameras", camera)?.into());
        }
        if let Some(mesh) = node.remove("mesh").as_ref().and_then(index) {
            match self.copy("meshes", mesh) {
                Ok(mesh) => drop(node.insert("mesh".into(), mesh.into())),
                Err(error) => {
                    node.remove("weights");
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    /// Returns the arrays and the buffer.
    pub(super) fn finish(mut self) -> (Map<String, Value>, Vec<u8>) {
        let mut used = BTreeSet::new();
        of_members(&self.arrays, &mut used);
        let needed = self.raw["extensionsRequired"].as_array().into_iter().flatten();
        let is_used = |name: &&Value| name.as_str().is_some_and(|name| used.contains(name));
        let needed: Vec<&Value> = needed.filter(is_used).collect();
        for (list, names) in
            [("extensionsUsed", json!(used)), ("extensionsRequired", json!(needed))]
        {
            if names.as_array().is_some_and(|names| !names.is_empty()) {
                self.arrays.insert(list.into(), names);
            }
        }
        (self.arrays, self.bytes)
    }

    /// Copies an element of an array once, and returns its index in the copy.
    fn copy(&mut self, array: &'static str, at: usize) -> Result<usize, Error> {
        if let Some(copied) = self.copied.get(&(array, at)) {
            return Ok(*copied);
        }
        let mut element = self.raw[array][at].clone();
        if !element.is_object() {
            return Err(wrong(format!("{array}[{at}]"), "there is none"));
        }
        match array {
            "meshes" => self.adopt_mesh(&mut element)?,
            "materials" => self.adopt_textures(&mut element)?,
            "textures" => self.adopt_texture(&mut element)?,
            "images" => self.adopt_image(&mut element, at)?,
            "accessors" => self.adopt_accessor(&mut element, at)?,
            "bufferViews" => self.adopt_view(&mut element, at)?,
            _ => {}
        }
        let copies = self.array(array);
        copies.push(element);
        let copied = copies.len() - 1;
        self.copied.insert((array, at), copied);
        Ok(copied)
    }

    fn array(&mut self, name: &str) -> &mut Vec<Value> {
        let array = self.arrays.entry(name).or_insert_with(|| json!([]));
        array.as_array_mut().expect("every entry of arrays that is asked for is one")
    }

    /// Replaces the index in a member, if there is one.
    fn refer(
        &mut self,
        element: &mut Value,
        member: &str,
        array: &'static str,
    ) -> Result<(), Error> {
        match element.get(member).and_then(index) {
            Some(at) => {
                element[member] = self.copy(array, at)?.into();
                Ok(())
            }
            None => Ok(()),
        }
    }

    fn adopt_mesh(&mut self, mesh: &mut Value) -> Result<(), Error> {
        let primitives = mesh["primitives"].as_array_mut();
        for primitive in primitives.into_iter().flatten() {
            let others = primitive.as_object_mut().and_then(|own| own.remove("extensions"));
            let mut others = others.iter().filter_map(Value::as_object).flat_map(Map::keys);
            if others.any(|name| name.contains("compression")) {
                return Err(wrong("meshes", "it is compressed"));
            }
            self.refer(primitive, "indices", "accessors")?;
            self.refer(primitive, "material", "materials")?;
            self.adopt_attributes(primitive.get_mut("attributes"))?;
            let targets = primitive.get_mut("targets").and_then(Value::as_array_mut);
            for target in targets.into_iter().flatten() {
                self.adopt_attributes(Some(target))?;
            }
        }
        Ok(())
    }

    fn adopt_attributes(&mut self, attributes: Option<&mut Value>) -> Result<(), Error> {
        let attributes = attributes.and_then(Value::as_object_mut);
        for accessor in attributes.into_iter().flat_map(Map::values_mut) {
            if let Some(at) = index(accessor) {
                *accessor = self.copy("accessors", at)?.into();
            }
        }
        Ok(())
    }

    /// Copies the textures of a material: the members whose name ends so, extensions included.
    fn adopt_textures(&mut self, value: &mut Value) -> Result<(), Error> {
        let members = value.as_object_mut();
        for (name, member) in members.into_iter().flatten() {
            if name.ends_with("Texture") {
                self.refer(member, "index", "textures")?;
            }
            self.adopt_textures(member)?;
        }
        Ok(())
    }

    fn adopt_texture(&mut self, texture: &mut Value) -> Result<(), Error> {
        self.refer(texture, "sampler", "samplers")?;
        self.refer(texture, "source", "images")?;
        let others = texture.get_mut("extensions").and_then(Value::as_object_mut);
        for other in others.into_iter().flat_map(Map::values_mut) {
            self.refer(other, "source", "images")?;
        }
        Ok(())
    }

    /// Copies an image. One in a file of its own goes into the buffer, because a GLB stands alone.
    fn adopt_image(&mut self, image: &mut Value, at: usize) -> Result<(), Error> {
        let Some(uri) = image.get("uri").and_then(Value::as_str).map(str::to_owned) else {
            return self.refer(image, "bufferView", "bufferViews");
        };
        let bytes = self.buffers.load_uri(&uri, &format!("images[{at}]"))?;
        let kind = match bytes.get(..4) {
            Some([0x89, b'P', b'N', b'G']) => "image/png",
            Some([0xff, 0xd8, ..]) => "image/jpeg",
            Some(b"RIFF") => "image/webp",
            _ => return Err(wrong(format!("images[{at}]"), "is neither PNG nor JPEG")),
        };
        let view = self.add_view(json!({}), &bytes);
        image.as_object_mut().map(|image| image.remove("uri"));
        image["bufferView"] = view.into();
        image["mimeType"] = kind.into();
        Ok(())
    }

    fn adopt_accessor(&mut self, accessor: &mut Value, at: usize) -> Result<(), Error> {
        if accessor.get("bufferView").is_none() && accessor.get("sparse").is_none() {
            return Err(wrong(format!("accessors[{at}]"), "it has no numbers"));
        }
        self.refer(accessor, "bufferView", "bufferViews")?;
        for part in ["indices", "values"] {
            if let Some(part) = accessor.get_mut("sparse").and_then(|sparse| sparse.get_mut(part)) {
                self.refer(part, "bufferView", "bufferViews")?;
            }
        }
        Ok(())
    }

    fn adopt_view(&mut self, view: &mut Value, at: usize) -> Result<(), Error> {
        let part = || format!("bufferViews[{at}]");
        let data = &self.document.views[at];
        if !data.extensions.is_empty() {
            return Err(wrong(part(), "it is compressed"));
        }
        let buffer = self.buffers.get(data.buffer)?;
        let bytes = buffer.get(data.offset..data.offset.saturating_add(data.length));
        let Some(bytes) = bytes.map(<[u8]>::to_vec) else {
            return Err(wrong(part(), "it ends after its buffer"));
        };
        let offset = self.put(&bytes);
        view["buffer"] = 0.into();
        view["byteOffset"] = offset.into();
        Ok(())
    }

    /// Adds bytes as a view.
    fn add_view(&mut self, mut view: Value, bytes: &[u8]) -> usize {
        let offset = self.put(bytes);
        view["buffer"] = 0.into();
        view["byteOffset"] = offset.into();
        view["byteLength"] = bytes.len().into();
        let views = self.array("bufferViews");
        views.push(view);
        views.len() - 1
    }

    /// Adds bytes to the buffer, where any number may begin.
    fn put(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len().next_multiple_of(4);
        self.bytes.resize(offset, 0);
        self.bytes.extend(bytes);
        offset
    }

    /// Copies a light, which lies in the part that its extension has of the document.
    fn light(&mut self, at: usize) -> usize {
        let light = self.raw["extensions"][LIGHTS]["lights"][at].clone();
        let all =
            self.arrays.entry("extensions").or_insert_with(|| json!({ LIGHTS: { "lights": [] } }));
        let lights = all[LIGHTS]["lights"].as_array_mut().expect("it was made so");
        lights.push(light);
        lights.len() - 1
    }
}

fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// Collects the names of extensions.
fn of_members(members: &Map<String, Value>, names: &mut BTreeSet<String>) {
    for (name, member) in members {
        if name == "extensions" {
            names.extend(member.as_object().into_iter().flat_map(Map::keys).cloned());
        }
        of_value(member, names);
    }
}

fn of_value(value: &Value, names: &mut BTreeSet<String>) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| of_value(value, names)),
        Value::Object(members) => of_members(members, names),
        _ => {}
    }
}
