//! Converts a ufbx scene to a clip.

use std::cell::Cell;

use glam::{DAffine3, DMat3, DQuat, DVec3};
use ufbx::{
    AnimStack, CoordinateAxes, CoordinateAxis, ElementType, InheritMode, InheritModeHandling,
    LoadOpts, Matrix, Node, ProgressCb, ProgressResult, Scene, SceneRoot, SpaceConversion,
    Transform,
};

use super::takes::{Curves, key_at, listed};
use crate::posed::{Bone, Nodes, Posed, Stand, join};
use crate::rates;
use crate::reading::{Found, Given, Options, Read, join_names};
use genga::error::{Error, Place, Warning};
use genga::motion::Declared;
use genga::time::FrameRate;

/// Bytes between the progress reports of ufbx.
const STEP: u64 = 4096;

/// Metres in a centimetre.
const CENTIMETRE: f64 = 0.01;

/// Reads an FBX file.
pub(crate) fn read(given: &Given<'_>, options: &Options) -> Result<Read, Error> {
    let scene = loaded(given.bytes, options)?;
    let takes = listed(&scene);
    let Some((at, told)) = options.choose(&takes)? else {
        let message = "there is no take: nothing moves in this file; export it with its animation";
        return Err(Error::Motion { place: Place::Whole, message: message.into() });
    };
    let stack = &scene.anim_stacks[at];
    let curves = Curves::new(&scene, stack);
    let own = own_rate(&scene, stack)?;
    let rate = options.fps.unwrap_or(own);
    let ((begin, end), far) = curves.whole(stack).map_err(|error| of_take(error, stack))?;
    let frames = rates::frames(end - begin, rate);
    let Joints { joints, left_out: beside } = joints(&scene, &curves);
    let mut world = vec![World::default(); scene.nodes.count];
    let carrying = carrying(&scene, &joints);
    let keys = curves.most_keys();
    let stand = |frame: usize, stands: &mut [DAffine3]| {
        let time = key_at(keys, begin + frame as f64 / rate.fps(), rate);
        let local = |node: &Node| ufbx::evaluate_transform(&stack.anim, node, time);
        place(&scene, &carrying, local, &mut world);
        stands.iter_mut().zip(&joints).for_each(|(stand, (node, _))| *stand = world[*node].stand);
    };
    let (clip, named) = Posed::new(bones(&scene, &joints, &carrying), frames, options, stand)
        .and_then(|posed| posed.clip(rate))
        .map_err(|error| of_take(error, stack))?;
    let mut warnings: Vec<Warning> = told.into_iter().chain(named).chain(far).collect();
    let finer = rates::finer(&curves.times(), begin, rate).filter(|_| options.fps.is_none());
    warnings.extend(finer);
    let clip = clip.with_declared(Declared::y_up(CENTIMETRE));
    let mut found = found(&scene, stack, rate);
    found.extend(left_out(&scene, &beside));
    Ok(Read { clip, warnings, written_frame_time: None, found, takes })
}

/// Bytes that the scene may take. Zeros pack to a thousandth, so a small file could else fill the memory; motion packs to
/// a twentieth at best.
fn most_unpacked(packed: usize, options: &Options) -> usize {
    let allowed = usize::try_from(options.stream.bytes).unwrap_or(usize::MAX);
    packed.saturating_mul(64).saturating_add(64 << 20).min(allowed)
}

/// Loads the scene without the data that no motion needs, within the memory limit.
fn loaded(bytes: &[u8], options: &Options) -> Result<SceneRoot, Error> {
    let read = Cell::new(0);
    let mut wanted = LoadOpts {
        ignore_geometry: true,
        ignore_embedded: true,
        skip_skin_vertices: true,
        skip_mesh_parts: true,
        target_axes: CoordinateAxes {
            right: CoordinateAxis::PositiveX,
            up: CoordinateAxis::PositiveY,
            front: CoordinateAxis::PositiveZ,
        },
        target_unit_meters: CENTIMETRE,
        space_conversion: SpaceConversion::TransformRoot,
        inherit_mode_handling: InheritModeHandling::Preserve,
        node_depth_limit: 4096,
        progress_interval_hint: STEP,
        ..LoadOpts::default()
    };
    let most = most_unpacked(bytes.len(), options);
    wanted.temp_allocator.memory_limit = most;
    wanted.result_allocator.memory_limit = most;
    let mut progress = |progress: &ufbx::Progress| {
        read.set(progress.bytes_read);
        ProgressResult::Continue
    };
    wanted.progress_cb = ProgressCb::Mut(&mut progress);
    ufbx::load_memory(bytes, wanted).map_err(|error| {
        let place = Place::Byte(read.get().min(bytes.len() as u64));
        let reason = error.description.to_string();
        let message = format!(
            "is no whole FBX: {}, at or behind this byte; export it again, as FBX 2014 or later, GLB or BVH",
            reason.to_lowercase()
        );
        Error::Motion { place, message }
    })
}

/// Adds the name of the take to an error of its motion.
fn of_take(error: Error, stack: &AnimStack) -> Error {
    let place = Place::Part(format!("take {}", stack.element.name));
    match error {
        Error::Motion { place: Place::Whole, message } | Error::Clip { message } => {
            Error::Motion { place, message }
        }
        other => other,
    }
}

fn own_rate(scene: &Scene, stack: &AnimStack) -> Result<FrameRate, Error> {
    let fps = scene.settings.frames_per_second;
    FrameRate::from_frame_time(1.0 / fps).map_err(|_| {
        let message = format!("{fps} frames a second are no rate; --fps N gives one");
        of_take(Error::Motion { place: Place::Whole, message }, stack)
    })
}

/// The nodes that become joints, parents first, each with the index of its parent joint; and the moving
/// nodes that become none.
struct Joints {
    joints: Vec<(usize, Option<usize>)>,
    left_out: Vec<usize>,
}

/// Chooses the joints: the bones and the moving nodes in their trees or, without bones, the moving nodes
/// and the nodes that hang on them.
fn joints(scene: &Scene, curves: &Curves<'_>) -> Joints {
    let parent = |node: usize| scene.nodes[node].parent.as_ref().map(|node| id(node));
    let mut chosen: Vec<bool> = scene.nodes.into_iter().map(is_bone).collect();
    let is_seen: Vec<bool> = scene.nodes.into_iter().map(is_seen).collect();
    let parents: Vec<Option<usize>> = (0..chosen.len()).map(parent).collect();
    let order = order(scene);
    let mut left_out = Vec::new();
    if scene.bones.count > 0 {
        // The scene's root joins unrelated trees, so it does not count as a parent.
        let is_root = |node: &usize| scene.nodes[*node].is_root;
        let parents: Vec<_> =
            parents.iter().map(|node| node.filter(|node| !is_root(node))).collect();
        let nodes =
            Nodes { order: &order, parents: &parents, moves: &curves.moves, is_seen: &is_seen };
        left_out = nodes.choose_moving(&mut chosen);
    } else {
        chosen.clone_from(&curves.nodes);
        // Nodes that hang on a moving node move with it.
        for node in 0..chosen.len() {
            chosen[node] |= !is_seen[node] && parents[node].is_some_and(|parent| chosen[parent]);
        }
    }
    // Some programs write the node that carries all bones, and travels, as something other than a bone.
    join(&order, &parents, &mut chosen, |top| curves.nodes[top]);
    let mut places = vec![None; chosen.len()];
    let mut joints = Vec::new();
    for node in order {
        let carrier = parent(node).and_then(|parent| places[parent]);
        places[node] = carrier;
        if chosen[node] && !scene.nodes[node].is_root {
            places[node] = Some(joints.len());
            joints.push((node, carrier));
        }
    }
    Joints { joints, left_out }
}

/// Whether a node is visible: a camera, a light, a shape, or a rig control, which is a curve. Empties are
/// invisible.
fn is_seen(node: &Node) -> bool {
    !matches!(node.attrib_type, ElementType::Unknown | ElementType::Empty | ElementType::Bone)
}

/// Orders the nodes parents first and limb by limb, while ufbx sorts them by depth.
fn order(scene: &Scene) -> Vec<usize> {
    let mut open = vec![id(&scene.root_node)];
    let mut order = Vec::with_capacity(scene.nodes.count);
    while let Some(node) = open.pop() {
        order.push(node);
        open.extend(scene.nodes[node].children.iter().rev().map(|node| id(node)));
    }
    order
}

fn is_bone(node: &Node) -> bool {
    node.bone.is_some()
}

/// Builds the joints with their rest transforms: the bind pose if the file has one, else the scene's own
/// pose.
fn bones(scene: &Scene, joints: &[(usize, Option<usize>)], carrying: &[usize]) -> Vec<Bone> {
    let mut rests: Vec<DAffine3> = Vec::with_capacity(joints.len());
    let mut world = vec![World::default(); scene.nodes.count];
    place(scene, carrying, |node| node.local_transform, &mut world);
    let stands = |node: usize| world[node].stand;
    let mut bone = |(node, parent): &(usize, Option<usize>)| {
        let by_parent = || {
            let on_parent = |parent: usize| stands(joints[parent].0).inverse() * stands(*node);
            parent.map_or_else(|| stands(*node), |parent| rests[parent] * on_parent(parent))
        };
        let rest = bound(&scene.nodes[*node]).unwrap_or_else(by_parent);
        rests.push(rest);
        let name = scene.nodes[*node].element.name.to_string();
        Bone { name, parent: *parent, rest: Stand::new(&rest) }
    };
    joints.iter().map(&mut bone).collect()
}

/// The bind transform of a node, in the world of the converted scene.
fn bound(node: &Node) -> Option<DAffine3> {
    let pose = node.bind_pose.as_ref().filter(|pose| pose.is_bind_pose)?;
    let own = pose.bone_poses.iter().find(|own| id(&own.bone_node) == id(node))?;
    let bound = affine(&own.bone_to_world);
    (bound.is_finite() && bound.matrix3.determinant().abs() > 1e-12).then_some(bound)
}

fn id(node: &Node) -> usize {
    node.element.typed_id as usize
}

/// The joints and all their ancestors, parents first. Other nodes are skipped, since a scene may have
/// thousands.
fn carrying(scene: &Scene, joints: &[(usize, Option<usize>)]) -> Vec<usize> {
    let mut is_needed = vec![false; scene.nodes.count];
    joints.iter().for_each(|(node, _)| is_needed[*node] = true);
    for node in (0..is_needed.len()).rev() {
        if let (true, Some(parent)) = (is_needed[node], scene.nodes[node].parent.as_ref()) {
            is_needed[id(parent)] = true;
        }
    }
    (0..is_needed.len()).filter(|node| is_needed[*node]).collect()
}

/// World transform of a node, with its rotation and its own scale kept apart.
#[derive(Debug, Clone, Copy, Default)]
struct World {
    stand: DAffine3,
    rotation: DQuat,
    scale: DVec3,
}

/// Computes the world transforms of some nodes, parents first, from their local transforms.
fn place(scene: &Scene, nodes: &[usize], local: impl Fn(&Node) -> Transform, world: &mut [World]) {
    for &at in nodes {
        let node = &scene.nodes[at];
        world[at] = match node.parent.as_ref().map(|parent| id(parent)) {
            Some(parent) => world[parent].carry(&local(node), node.inherit_mode),
            // The scale of the root is the unit conversion, which every node inherits.
            None => {
                let stand = affine(&node.node_to_parent);
                let rotation = stand.to_scale_rotation_translation().1;
                World { stand, rotation, scale: DVec3::ONE }
            }
        };
    }
}

impl World {
    /// Computes the world transform of a child. FBX has three ways to inherit a scale: before the child's
    /// own rotation, like all other programs; after it; or after it and without the parent's own scale.
    fn carry(&self, local: &Transform, mode: InheritMode) -> Self {
        let Transform { translation, rotation, scale } = local;
        let scale = DVec3::new(scale.x, scale.y, scale.z);
        let turn = DQuat::from_xyzw(rotation.x, rotation.y, rotation.z, rotation.w);
        let (turned, sized) = (DMat3::from_quat(turn), DMat3::from_diagonal(scale));
        let before = self.stand.matrix3;
        let behind = DMat3::from_quat(self.rotation.inverse()) * before;
        let rotation = self.rotation * turn;
        let matrix3 = match mode {
            InheritMode::Normal => before * turned * sized,
            InheritMode::ComponentwiseScale => DMat3::from_quat(rotation) * behind * sized,
            InheritMode::IgnoreParentScale => {
                let without = DMat3::from_diagonal(self.scale.recip());
                DMat3::from_quat(rotation) * behind * without * sized
            }
        };
        let way = DVec3::new(translation.x, translation.y, translation.z);
        let translation = self.stand.transform_point3(way);
        Self { stand: DAffine3 { matrix3, translation }, rotation, scale }
    }
}

fn affine(m: &Matrix) -> DAffine3 {
    let column = |x, y, z| DVec3::new(x, y, z);
    DAffine3 {
        matrix3: DMat3::from_cols(
            column(m.m00, m.m10, m.m20),
            column(m.m01, m.m11, m.m21),
            column(m.m02, m.m12, m.m22),
        ),
        translation: column(m.m03, m.m13, m.m23),
    }
}

/// Describes the file in words.
fn found(scene: &Scene, stack: &AnimStack, rate: FrameRate) -> Vec<Found> {
    let about = &scene.metadata;
    let (major, minor) = (about.version / 1000, about.version % 1000 / 100);
    let kind = if about.ascii { "text" } else { "binary" };
    let mut format = format!("FBX {major}.{minor}, {kind}");
    let maker = [&about.latest_application.name, &about.original_application.name];
    let maker = maker.into_iter().map(|name| name.trim()).find(|name| !name.is_empty());
    let creator = Some(about.creator.trim()).filter(|name| !name.is_empty());
    if let Some(maker) = maker.or(creator) {
        format += &format!(", by {maker}");
    }
    // `settings` holds the converted values, its properties the original ones.
    let said = |name: &str| {
        let properties = &scene.settings.props.props;
        properties.iter().find(|own| own.name.as_ref() == name).map(|own| own.value_vec4.x)
    };
    let up = match said("UpAxis").unwrap_or(1.0) as i64 {
        0 => "X up, turned to Y up",
        2 => "Z up, turned to Y up",
        _ => "Y up",
    };
    let unit = said("UnitScaleFactor").unwrap_or(1.0);
    let unit = match (unit - 1.0).abs() < 1e-6 {
        true => "centimetres".into(),
        false => format!("a unit of {} cm, measured in centimetres", rounded(unit)),
    };
    let name = stack.element.name.to_string();
    vec![
        Found::new("format", format),
        Found::new("up", up),
        Found::new("unit", unit),
        Found::new("read", format!("take {name}, sampled {rate} a second")),
    ]
}

/// Lists the parts of the scene that are no body motion and are left out. Constraints count only as baked.
fn left_out(scene: &Scene, nodes: &[usize]) -> Option<Found> {
    let called: Vec<String> =
        nodes.iter().map(|node| scene.nodes[*node].element.name.to_string()).collect();
    Found::left_out(&[
        (scene.meshes.count, "shapes"),
        (scene.blend_channels.count, "blend shapes"),
        (scene.cameras.count, "cameras"),
        (scene.lights.count, "lights"),
        (scene.constraints.count, "constraints beyond what is baked"),
        (nodes.len(), &format!("nodes that move beside the body: {}", join_names(&called))),
    ])
}

/// Rounds a number for display.
fn rounded(number: f64) -> f64 {
    (number * 1e6).round() / 1e6
}
