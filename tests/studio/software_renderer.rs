//! A renderer without a graphics card, which draws egui's triangles pixel by pixel. It gives the same bytes on every
//! machine.

use std::cell::RefCell;
use std::collections::HashMap;
use std::mem;
use std::rc::Rc;

use egui::epaint::{ClippedPrimitive, ImageData, Mesh, Primitive, Vertex};
use egui::{Color32, ColorImage, Pos2, Rect, TextureId, TexturesDelta};
use egui_kittest::TestRenderer;

/// The textures of a window.
#[derive(Default)]
pub(crate) struct Textures(HashMap<TextureId, ColorImage>);

/// Keeps the textures of a window up to date.
#[derive(Default, Clone)]
pub(crate) struct Soft(pub(crate) Rc<RefCell<Textures>>);

impl TestRenderer for Soft {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let (set, free) = (mem::take(&mut delta.set), mem::take(&mut delta.free));
        let textures = &mut self.0.borrow_mut().0;
        for (id, changes) in set {
            for change in changes {
                let ImageData::Color(image) = change.image;
                match (change.pos, textures.get_mut(&id)) {
                    (Some(corner), Some(whole)) => put(&image, corner, whole),
                    _ => drop(textures.insert(id, (*image).clone())),
                }
            }
        }
        for id in free {
            textures.remove(&id);
        }
    }
}

/// Puts an image into a larger one.
fn put(image: &ColorImage, [left, top]: [usize; 2], whole: &mut ColorImage) {
    let [wide, high] = image.size;
    for row in 0..high {
        let to = (top + row) * whole.size[0] + left;
        whole.pixels[to..to + wide].copy_from_slice(&image.pixels[row * wide..(row + 1) * wide]);
    }
}

/// A picture of a window.
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<Color32>,
}

impl Picture {
    /// Draws tessellated shapes.
    pub(crate) fn new(
        (size, scale): ((usize, usize), f32),
        drawn: &[ClippedPrimitive],
        textures: &Textures,
    ) -> Self {
        let [width, height] = [size.0, size.1].map(|side| (side as f32 * scale).round() as usize);
        let mut picture = Self { width, height, pixels: vec![Color32::BLACK; width * height] };
        for ClippedPrimitive { clip_rect, primitive } in drawn {
            if let Primitive::Mesh(mesh) = primitive {
                picture.mesh(mesh, *clip_rect * scale, scale, &textures.0[&mesh.texture_id]);
            }
        }
        picture
    }

    fn mesh(&mut self, mesh: &Mesh, clip: Rect, scale: f32, texture: &ColorImage) {
        for corners in mesh.indices.chunks_exact(3) {
            let corner = |at: usize| {
                let own = mesh.vertices[corners[at] as usize];
                Vertex { pos: scale * own.pos, ..own }
            };
            self.triangle([corner(0), corner(1), corner(2)], clip, texture);
        }
    }

    fn triangle(&mut self, mut corners: [Vertex; 3], clip: Rect, texture: &ColorImage) {
        let area = edge(corners[0].pos, corners[1].pos, corners[2].pos);
        if area == 0.0 {
            return;
        }
        if area < 0.0 {
            corners.swap(1, 2);
        }
        let [a, b, c] = corners.map(|corner| corner.pos);
        let low = a.min(b).min(c).max(clip.min.round());
        let high = a.max(b).max(c).min(clip.max.round());
        let pixels = |low: f32, high: f32, most: usize| {
            let from = (low - 0.5).ceil().max(0.0) as usize;
            from..((high - 0.5).ceil().max(0.0) as usize).min(most)
        };
        let area = area.abs();
        for y in pixels(low.y, high.y, self.height) {
            for x in pixels(low.x, high.x, self.width) {
                let at = Pos2::new(x as f32 + 0.5, y as f32 + 0.5);
                let weights = [edge(b, c, at), edge(c, a, at), edge(a, b, at)];
                let edges = [(b, c), (c, a), (a, b)];
                let is_inside = |(weight, (from, to)): (&f32, &(Pos2, Pos2))| {
                    *weight > 0.0 || *weight == 0.0 && is_top_left(*from, *to)
                };
                if weights.iter().zip(&edges).all(is_inside) {
                    let color = shade(&corners, weights.map(|weight| weight / area), texture);
                    let under = &mut self.pixels[y * self.width + x];
                    *under = over(color, *under);
                }
            }
        }
    }
}

/// Twice the signed area of a triangle.
fn edge(a: Pos2, b: Pos2, c: Pos2) -> f32 {
    (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
}

/// Whether a pixel exactly on an edge belongs to it, so that only one of two adjacent triangles has it.
fn is_top_left(from: Pos2, to: Pos2) -> bool {
    from.y > to.y || from.y == to.y && from.x < to.x
}

/// Premultiplied colour of a point of a triangle, each channel 0 to 1.
fn shade(corners: &[Vertex; 3], weights: [f32; 3], texture: &ColorImage) -> [f32; 4] {
    let mut color = [0.0; 4];
    let (mut u, mut v) = (0.0, 0.0);
    for (corner, weight) in corners.iter().zip(weights) {
        for (sum, channel) in color.iter_mut().zip(corner.color.to_array()) {
            *sum += weight * f32::from(channel) / 255.0;
        }
        u += weight * corner.uv.x;
        v += weight * corner.uv.y;
    }
    let texel = sample(texture, u, v);
    std::array::from_fn(|channel| color[channel] * texel[channel])
}

/// Interpolates a texture between its four nearest texels.
fn sample(texture: &ColorImage, u: f32, v: f32) -> [f32; 4] {
    let [width, height] = texture.size;
    let (x, y) = (u * width as f32 - 0.5, v * height as f32 - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let texel = |dx: f32, dy: f32| {
        let column = (left + dx).clamp(0.0, width as f32 - 1.0) as usize;
        let row = (top + dy).clamp(0.0, height as f32 - 1.0) as usize;
        texture.pixels[row * width + column].to_array().map(|channel| f32::from(channel) / 255.0)
    };
    let (right, low) = (x - left, y - top);
    let corners = [
        (texel(0.0, 0.0), (1.0 - right) * (1.0 - low)),
        (texel(1.0, 0.0), right * (1.0 - low)),
        (texel(0.0, 1.0), (1.0 - right) * low),
        (texel(1.0, 1.0), right * low),
    ];
    std::array::from_fn(|channel| corners.iter().map(|(texel, share)| texel[channel] * share).sum())
}

/// Blends a colour over an opaque one, as the window does.
fn over(color: [f32; 4], under: Color32) -> Color32 {
    let under = under.to_array();
    let channel = |at: usize| {
        let below = f32::from(under[at]) / 255.0;
        ((color[at] + below * (1.0 - color[3])) * 255.0).round().clamp(0.0, 255.0) as u8
    };
    Color32::from_rgb(channel(0), channel(1), channel(2))
}
