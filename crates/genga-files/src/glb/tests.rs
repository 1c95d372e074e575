//! Reads a GLB back with a small reader and compares it with the sheet and `limited.bvh`.

mod others;
mod reader;

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::limited_bvh;
use genga::edits::Edits;
use genga::motion::{Body, Channel, EndSite, Joint, JointId, Poser, Skeleton, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Blank, Drawing, Exposure, Role, Source};
use genga::time::{Clock, Frame, FrameRate};
use reader::Read;

/// A sample clip and its sheet, made by the default recipe with some settings changed.
fn made(clip: &str, settings: &[(&str, &str)]) -> (Clip, Sheet) {
    let path = format!("{}/../../data/{clip}.bvh", env!("CARGO_MANIFEST_DIR"));
    let clip = bvh::read(&std::fs::read(path).unwrap()).unwrap().clip;
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(knob, value)| recipe.set(knob, value).unwrap());
    let mut engine = Engine::new(clip.clone()).unwrap();
    let sheet = engine.run(&recipe, &Edits::default()).unwrap().sheet.clone();
    (clip, sheet)
}

fn read(clip: &Clip, sheet: &Sheet) -> Read {
    Read::new(&Glb::default().write(clip, sheet).unwrap())
}

/// A chain of joints that turn about X and Y only, with a moving root, and a sheet of some exposures of its
/// frames.
fn chain(names: &[&str], frames: usize) -> (Clip, Sheet) {
    let turns = [Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];
    let moves = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
    let joint = |(at, name): (usize, &&str)| Joint {
        name: (*name).into(),
        parent: at.checked_sub(1).map(JointId),
        offset: DVec3::new(0.0, 10.0, 1.0),
        channels: if at == 0 { [&moves[..], &turns].concat() } else { turns.to_vec() },
        first_channel: if at == 0 { 0 } else { 3 + 2 * at },
        end_sites: vec![],
    };
    let skeleton = Skeleton { joints: names.iter().enumerate().map(joint).collect() };
    let values = (0..frames * skeleton.channels()).map(|at| (at as f64 * 7.7).sin() * 40.0);
    let values = values.collect();
    let rate = FrameRate::new(24.0).unwrap();
    let clip = Clip::new(skeleton, rate, Frame(0), frames, values).unwrap();
    let sheet = Sheet::on_ones(clip.clock(24.0), frames);
    (clip, sheet)
}

/// Position of every joint on every koma according to `limited.bvh`, in metres and Y up.
fn by_limited_bvh(clip: &Clip, sheet: &Sheet, glb: &Glb) -> Vec<Vec<DVec3>> {
    let limited = bvh::read(limited_bvh(clip, sheet).unwrap().as_bytes()).unwrap().clip;
    let space = glb.space(clip);
    let (mut poser, mut body) = (Poser::new(&limited), Body::new(clip.skeleton()));
    let koma = |koma| {
        body.place(poser.frame(Frame(koma)));
        body.positions().iter().map(|position| space.position(*position)).collect()
    };
    (0..limited.len()).map(koma).collect()
}

/// Largest distance between corresponding points on any koma.
fn furthest(a: &[Vec<DVec3>], b: &[Vec<DVec3>]) -> f64 {
    let koma = a.iter().zip(b).flat_map(|(a, b)| a.iter().zip(b));
    koma.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

fn check_positions(clip: &Clip, sheet: &Sheet, glb: &Glb) {
    let read = Read::new(&glb.write(clip, sheet).unwrap());
    let size = Stature::new(clip).size * glb.space(clip).scale;
    let expected = by_limited_bvh(clip, sheet, glb);
    assert_eq!(expected.len(), sheet.cut_length());
    let shown: Vec<Vec<DVec3>> = (0..sheet.cut_length())
        .map(|koma| read.positions(0, (koma as f64 + 0.5) / 24.0))
        .map(|positions| positions[..clip.skeleton().len()].to_vec())
        .collect();
    let off = furthest(&shown, &expected) / size;
    assert!(off < 1e-6, "off by {off} of the body");
}

#[test]
fn every_koma_stands_where_limited_bvh_has_it() {
    for clip in ["kick", "pitch", "tennis"] {
        let (clip, sheet) = made(clip, &[]);
        check_positions(&clip, &sheet, &Glb::default());
    }
    let (clip, sheet) = made("swing", &[("spacing.source", "blend"), ("spacing.on", "3")]);
    let is_blend = |drawing: &Drawing| matches!(drawing.source, Source::Between { .. });
    assert!(sheet.layers[0].drawings.iter().any(is_blend));
    check_positions(&clip, &sheet, &Glb::default());
}

#[test]
fn layers_and_a_root_on_ones_stand_where_limited_bvh_has_them() {
    for settings in
        [[("layers", "limbs"), ("root", "drawings")], [("layers", "limbs"), ("root", "ones")]]
    {
        let (clip, sheet) = made("kick", &settings);
        assert_eq!(sheet.layers.len(), 5);
        check_positions(&clip, &sheet, &Glb::default());
    }
    let held = [("root", "ones"), ("feet", "held")];
    for settings in [&held[..], &held[1..]] {
        let (clip, sheet) = made("kick", settings);
        check_positions(&clip, &sheet, &Glb::default());
    }
    let (clip, sheet) = made("kick", &[("root", "ones")]);
    check_positions(&clip, &sheet, &Glb::default());
    let mut twice = sheet.clone();
    twice.layers[0].exposures = sheet.layers[0].exposures.repeat(2);
    check_positions(&clip, &twice, &Glb::default());
    let read = read(&clip, &sheet);
    let own_times =
        read.samplers(0).iter().filter(|own| own["input"] != read.samplers(0)[0]["input"]);
    let times: Vec<usize> = own_times.map(|own| read.floats(&own["input"]).len()).collect();
    assert_eq!(times, [93], "the root alone, a key a koma and one that closes");
}

#[test]
fn the_first_pose_stands_over_the_blank_koma_before_it_and_the_last_over_those_after() {
    for root in ["drawings", "ones"] {
        let (clip, sheet) = made("kick", &[("root", root)]);
        let rows = |sheet: &Sheet| by_limited_bvh(&clip, sheet, &Glb::default());
        let (late, plain) =
            (sheet.clone().with_blank(Blank { before: 24, after: 12 }), rows(&sheet));
        let [first, last] = [plain[0].clone(), plain[plain.len() - 1].clone()];
        assert_eq!(rows(&late), [vec![first; 24], plain, vec![last; 12]].concat(), "{root}");
        check_positions(&clip, &late, &Glb::default());
        let file = Read::new(&Glb::default().write(&clip, &late).unwrap());
        let extras = &file.json["animations"][0]["extras"];
        assert_eq!(extras["koma"], late.cut_length());
        assert_eq!(extras["keys"][0]["koma"], 24);
    }
}

#[test]
fn joints_of_fewer_axes_stand_where_limited_bvh_has_them_too() {
    let (clip, mut sheet) = chain(&["a", "b", "c"], 9);
    let drawings = &mut sheet.layers[0].drawings;
    drawings[2].source = Source::At(2.4);
    drawings[3].source = Source::Between { from: 1.0, to: 5.0, share: 0.6 };
    check_positions(&clip, &sheet, &Glb::default());
}

#[test]
fn every_sampler_is_stepped_and_closes_where_the_cut_ends() {
    let (clip, sheet) = made("kick", &[]);
    let read = read(&clip, &sheet);
    for animation in [0, 1] {
        let samplers = read.samplers(animation);
        assert!(samplers.len() > 20, "{}", samplers.len());
        for sampler in samplers {
            assert_eq!(sampler["interpolation"], "STEP");
            assert_eq!(sampler["input"], read.samplers(animation)[0]["input"], "one list of times");
        }
        let times = read.floats(&read.samplers(animation)[0]["input"]);
        assert_eq!(times[0], [0.0]);
        assert_eq!(times.last().unwrap(), &[(92.0 / 24.0f64) as f32]);
        assert!(times.is_sorted_by(|a, b| a[0] < b[0]));
        let outputs =
            read.samplers(animation).iter().map(|sampler| read.floats(&sampler["output"]));
        for output in outputs {
            assert_eq!(output.len(), times.len());
            assert_eq!(output[output.len() - 1], output[output.len() - 2], "the last pose is held");
        }
    }
    let times = read.floats(&read.samplers(0)[0]["input"]);
    let begins = sheet.layers[0].timed().map(|(begin, _)| [(begin as f64 / 24.0) as f32]);
    assert!(begins.eq(times[..times.len() - 1].iter().map(|time| [time[0]])));
}

#[test]
fn doubled_holds_stay_whole_for_a_reader_of_lines_at_120_frames() {
    let doubled = Glb { step: Step::Doubled, ..Glb::default() };
    for settings in [&[][..], &[("root", "ones")], &[("root", "ones"), ("feet", "held")]] {
        let (clip, sheet) = made("kick", settings);
        check_positions(&clip, &sheet, &doubled);
        let read = Read::new(&doubled.write(&clip, &sheet).unwrap());
        assert!(read.samplers(0).iter().all(|own| own["interpolation"] == "LINEAR"));
        let size = Stature::new(&clip).size * doubled.space(&clip).scale;
        let expected = by_limited_bvh(&clip, &sheet, &doubled);
        for frame in 0..5 * sheet.length() {
            let shown = read.positions(0, frame as f64 / 120.0);
            let off = furthest(&[shown[..clip.skeleton().len()].to_vec()], &expected[frame / 5..]);
            // At the start of a koma, the key's f32 time may be slightly after the frame.
            let most = if frame % 5 == 0 { 1e-3 } else { 1e-6 };
            assert!(off < most * size, "frame {frame}: off by {}", off / size);
        }
    }
}

#[test]
fn doubled_keys_are_a_pair_a_drawing_and_run_on_for_days() {
    let holds = [(0, 3), (3, 4), (4, 6)];
    let times = Step::Doubled.times(holds.into_iter(), 1.0);
    assert_eq!(times, [[0.0], [2.99], [3.0], [3.99], [4.0], [6.0]]);
    assert_eq!(Step::Doubled.values([7, 8, 9].into_iter()), [7, 7, 8, 8, 9, 9]);
    let day = 24 * 60 * 60 * 24;
    let late = Step::Doubled.times((day..day + 9).map(|koma| (koma, koma + 1)), 24.0);
    assert!(late.is_sorted_by(|a, b| a[0] < b[0]), "{late:?}");
    assert_eq!(Step::Doubled.times(std::iter::empty(), 24.0), [[0.0f32; 1]; 0]);
}

#[test]
fn the_keys_alone_hold_from_one_genga_to_the_next() {
    let (clip, sheet) = made("kick", &[]);
    let read = read(&clip, &sheet);
    assert_eq!(read.json["animations"][0]["name"], "koma");
    assert_eq!(read.json["animations"][1]["name"], "genga");
    let layer = &sheet.layers[0];
    let mut kept = 0;
    for (koma, drawing) in layer.koma().enumerate() {
        let is_kept = layer.drawings[drawing].role.is_kept();
        kept = if is_kept { koma } else { kept };
        let at = |koma: usize| (koma as f64 + 0.5) / 24.0;
        let (genga, all) = (read.positions(1, at(koma)), read.positions(0, at(kept)));
        assert_eq!(genga, all, "koma {koma}");
    }
}

#[test]
fn a_sheet_without_keys_has_no_genga_and_a_late_key_stands_from_the_start() {
    let (clip, mut sheet) = chain(&["a", "b"], 4);
    sheet.layers[0].drawings.iter_mut().for_each(|drawing| drawing.role = Role::Inbetween);
    assert_eq!(read(&clip, &sheet).json["animations"].as_array().unwrap().len(), 1);
    sheet.layers[0].drawings[2].role = Role::Genga;
    let read = read(&clip, &sheet);
    assert_eq!(read.floats(&read.samplers(1)[0]["input"]), [[0.0], [(4.0 / 24.0f64) as f32]]);
    assert_eq!(read.positions(1, 0.01), read.positions(0, 2.5 / 24.0));
}

#[test]
fn extras_say_what_stands_where() {
    let (clip, mut sheet) = chain(&["a", "b"], 4);
    let layer = &mut sheet.layers[0];
    layer.exposures[1].koma = 3;
    layer.exposures.push(Exposure { drawing: 1, koma: 2 });
    layer.drawings[2].source = Source::Between { from: 1.0, to: 3.0, share: 0.25 };
    insta::assert_snapshot!(
        serde_json::to_string_pretty(&read(&clip, &sheet).json["animations"][0]["extras"]).unwrap()
    );
}

#[test]
fn the_file_is_the_header_and_two_chunks_of_whole_words() {
    for name in ["a", "ab", "abc", "abcd"] {
        let (clip, sheet) = chain(&[name, "b"], 3);
        let glb = Glb::default().write(&clip, &sheet).unwrap();
        let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
        let json = word(12);
        assert_eq!((json % 4, &glb[16..20]), (0, &b"JSON"[..]));
        let text = std::str::from_utf8(&glb[20..20 + json]).unwrap();
        assert!(text.trim_end_matches(' ').ends_with('}'), "padded with blanks");
        let binary = 20 + json;
        assert_eq!((word(binary) % 4, &glb[binary + 4..binary + 8]), (0, &b"BIN\0"[..]));
        assert_eq!(binary + 8 + word(binary), glb.len());
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let (clip, sheet) = made("tennis", &[]);
    let glb = || Glb::default().write(&clip, &sheet).unwrap();
    assert_eq!(glb(), glb());
}

#[test]
fn accessors_lie_in_their_views_and_have_true_bounds() {
    let (clip, sheet) = made("kick", &[]);
    let read = read(&clip, &sheet);
    let accessors = read.json["accessors"].as_array().unwrap();
    assert!(accessors.len() > 40);
    for (number, accessor) in accessors.iter().enumerate() {
        let values = read.floats(&number.into());
        assert_eq!(accessor["count"], values.len());
        for (bound, further) in [("min", f32::min as fn(f32, f32) -> f32), ("max", f32::max)] {
            let Some(bounds) = accessor[bound].as_array() else { continue };
            for (axis, bound) in bounds.iter().enumerate() {
                let all = values.iter().map(|value| value[axis]).reduce(further).unwrap();
                assert_eq!(bound.as_f64().unwrap() as f32, all, "accessor {number}");
            }
        }
    }
    for sampler in read.samplers(0) {
        let times = &accessors[sampler["input"].as_u64().unwrap() as usize];
        assert!(times["min"].is_array() && times["max"].is_array(), "a reader needs them");
    }
}

#[test]
fn only_channels_that_move_are_written_and_small_turns_move() {
    let (clip, _) = chain(&["a", "b", "c"], 1);
    let mut values = [0.0; 9].to_vec();
    values[1] = 10.0;
    values[2] = 1.0;
    values[7] = 0.01;
    let rate = FrameRate::new(24.0).unwrap();
    let still = |values| Clip::new(clip.skeleton().clone(), rate, Frame(0), 1, values).unwrap();
    let channels = |clip: &Clip| {
        let sheet = Sheet::on_ones(clip.clock(24.0), 1);
        let channels = read(clip, &sheet).json["animations"][0]["channels"].clone();
        let targets = channels.as_array().unwrap().iter().map(|channel| {
            let target = &channel["target"];
            format!("{} {}", target["node"], target["path"].as_str().unwrap())
        });
        targets.collect::<Vec<_>>()
    };
    assert_eq!(channels(&still(values.clone())), ["2 rotation"]);
    values[7] = 0.0;
    assert_eq!(channels(&still(values.clone())), ["0 translation"], "one is the least");
    values[0] = 5.0;
    assert_eq!(channels(&still(values)), ["0 translation"]);
}

#[test]
fn signs_of_rotations_run_on() {
    let axis = Channel::Rotation(Axis::Z);
    let joint = Joint {
        name: "spin".into(),
        parent: None,
        offset: DVec3::ZERO,
        channels: vec![axis],
        first_channel: 0,
        end_sites: vec![],
    };
    let values: Vec<f64> = (0..20).map(|frame| f64::from(frame) * 50.0).collect();
    let (skeleton, rate) = (Skeleton { joints: vec![joint] }, FrameRate::new(24.0).unwrap());
    let clip = Clip::new(skeleton, rate, Frame(0), 20, values).unwrap();
    let read = read(&clip, &Sheet::on_ones(clip.clock(24.0), 20));
    let rotations = read.floats(&read.samplers(0)[0]["output"]);
    let dot = |pair: &[Vec<f32>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| a * b).sum::<f32>();
    assert!(rotations.windows(2).all(|pair| dot(pair) > 0.0));
}

#[test]
fn names_stay_as_they_are_and_tips_get_their_own() {
    let (mut clip, sheet) = chain(&["腰", "", "mixamorig:Left Hand", "腰_end"], 3);
    let mut skeleton = clip.skeleton().clone();
    let tip = EndSite { name: "Site".into(), offset: DVec3::Y };
    skeleton.joints[0].end_sites = vec![tip.clone(), tip.clone()];
    skeleton.joints[3].end_sites = vec![tip];
    let values = (0..3).flat_map(|frame| clip.row(Frame(frame)).to_vec()).collect();
    clip = Clip::new(skeleton, clip.rate(), Frame(0), 3, values).unwrap();
    let read = read(&clip, &sheet);
    let nodes = read.json["nodes"].as_array().unwrap();
    let names: Vec<_> = nodes.iter().map(|node| node["name"].as_str().unwrap()).collect();
    let expected = ["腰", "", "mixamorig:Left Hand", "腰_end", "腰_end2", "腰_end3", "腰_end_end"];
    assert_eq!(names[..7], expected);
    assert_eq!(read.json["skins"][0]["joints"].as_array().unwrap().len(), 7);
    assert_eq!(names[7], "bones", "the mesh");
    assert_eq!(nodes[0]["children"], json!([1, 4, 5]));
}

#[test]
fn several_roots_hang_on_one_node() {
    let (clip, sheet) = chain(&["a", "b"], 3);
    let mut skeleton = clip.skeleton().clone();
    skeleton.joints[1].parent = None;
    let values = (0..3).flat_map(|frame| clip.row(Frame(frame)).to_vec()).collect();
    let clip = Clip::new(skeleton, clip.rate(), Frame(0), 3, values).unwrap();
    let read = read(&clip, &sheet);
    assert_eq!(read.json["nodes"][2]["children"], json!([0, 1]));
    assert_eq!(read.json["skins"][0]["skeleton"], 2);
    assert_eq!(read.json["scenes"][0]["nodes"], json!([2, 3]));
    check_positions(&clip, &sheet, &Glb::default());
}

#[test]
fn the_mesh_has_a_closed_octahedron_a_bone_on_the_joint_that_turns_it() {
    let (clip, sheet) = made("kick", &[]);
    let read = read(&clip, &sheet);
    let parts = read.json["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(parts.len(), 3, "trunk, left and right");
    let corners = read.floats(&parts[0]["attributes"]["POSITION"]);
    let joints = read.floats(&parts[0]["attributes"]["JOINTS_0"]);
    let indices: Vec<_> = parts.iter().flat_map(|part| read.floats(&part["indices"])).collect();
    let bones = clip.skeleton().len() - 1
        + clip.skeleton().joints.iter().map(|joint| joint.end_sites.len()).sum::<usize>();
    assert_eq!((corners.len(), indices.len()), (6 * bones, 24 * bones));
    let corner = |at: &Vec<f32>| {
        let corner = &corners[at[0] as usize];
        DVec3::new(corner[0].into(), corner[1].into(), corner[2].into())
    };
    let rest = read.rest_positions();
    for faces in indices.chunks(24) {
        let bone = faces[0][0] as usize / 6;
        let middle =
            0.5 * (corner(&vec![6.0 * bone as f32]) + corner(&vec![6.0 * bone as f32 + 5.0]));
        for face in faces.chunks(3) {
            let [a, b, c] = [0, 1, 2].map(|at| corner(&face[at]));
            assert!((b - a).cross(c - a).dot(a - middle) > 0.0, "bone {bone} from outside");
            assert!(face.iter().all(|at| at[0] as usize / 6 == bone));
        }
        let carrier = joints[6 * bone][0] as usize;
        assert!(joints[6 * bone..6 * bone + 6].iter().all(|joint| joint[0] as usize == carrier));
        assert!(rest[carrier].distance(corner(&vec![6.0 * bone as f32])) < 1e-6);
    }
    let mut seen: Vec<_> = indices.iter().map(|index| index[0] as usize).collect();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), corners.len(), "every corner is part of a face");
    let plain = Glb { mesh: false, ..Glb::default() }.write(&clip, &sheet).unwrap();
    let plain = Read::new(&plain);
    assert!(plain.json["meshes"].is_null() && plain.json["materials"].is_null());
    assert_eq!(plain.json["scenes"][0]["nodes"], json!([0]));
}

#[test]
fn the_skin_leads_back_from_the_rest_pose() {
    let (clip, sheet) = made("kick", &[]);
    let read = read(&clip, &sheet);
    let matrices = read.floats(&read.json["skins"][0]["inverseBindMatrices"]);
    for (matrix, rest) in matrices.iter().zip(read.rest_positions()) {
        let back = DVec3::new(matrix[12].into(), matrix[13].into(), matrix[14].into());
        assert!((rest + back).length() < 1e-6);
        assert_eq!((matrix[0], matrix[5], matrix[10], matrix[15]), (1.0, 1.0, 1.0, 1.0));
    }
}

#[test]
fn more_joints_than_a_byte_counts_are_listed_in_words() {
    let names: Vec<String> = (0..300).map(|joint| format!("joint{joint}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (clip, sheet) = chain(&names, 2);
    let read = read(&clip, &sheet);
    let joints = &read.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"];
    assert_eq!(read.json["accessors"][joints.as_u64().unwrap() as usize]["componentType"], 5123);
    assert_eq!(read.floats(joints).last().unwrap()[0], 298.0, "the joint before the last");
    let (clip, sheet) = chain(&names[..255], 2);
    let read = self::read(&clip, &sheet);
    let joints = &read.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"];
    assert_eq!(read.json["accessors"][joints.as_u64().unwrap() as usize]["componentType"], 5121);
}

#[test]
fn one_koma_and_one_joint_and_no_motion_still_make_a_file() {
    let (clip, sheet) = chain(&["alone"], 1);
    let single = read(&clip, &sheet);
    let times = single.floats(&single.samplers(0)[0]["input"]);
    assert_eq!(times, [[0.0], [(1.0 / 24.0f64) as f32]]);
    let part = &single.json["meshes"][0]["primitives"][0];
    assert_eq!(single.floats(&part["indices"]).len(), 24, "something to be seen");
    let skeleton =
        Skeleton { joints: vec![Joint { channels: vec![], ..clip.skeleton().joints[0].clone() }] };
    let clip = Clip::new(skeleton, clip.rate(), Frame(0), 2, vec![]).unwrap();
    let read = read(&clip, &Sheet::on_ones(clip.clock(24.0), 2));
    assert_eq!(read.samplers(0).len(), 1);
}

#[test]
fn z_up_comes_out_y_up_and_units_come_out_as_metres() {
    let (clip, sheet) = made("kick", &[]);
    let upright = read(&clip, &sheet).positions(0, 0.5);
    let laid = laid_down(&clip);
    assert_eq!(Stature::new(&laid).up, Axis::Z);
    for (a, b) in read(&laid, &sheet).positions(0, 0.5).into_iter().zip(&upright) {
        assert!(a.distance(*b) < 1e-6, "{a} {b}");
    }
    let top = upright.iter().map(|point| point.y).fold(0.0, f64::max);
    assert!((1.2..2.2).contains(&top), "{top} m");
    let scaled =
        Glb { scale: 2.0, unit: LengthUnit::Cm, ..Glb::default() }.write(&clip, &sheet).unwrap();
    let scaled = Read::new(&scaled).positions(0, 0.5);
    assert!(scaled[5].distance(2.0 * upright[5]) < 1e-6);
    let forced = Glb { up: Up::Y, ..Glb::default() }.write(&laid, &sheet).unwrap();
    let top = Read::new(&forced).positions(0, 0.5).iter().map(|point| point.z).fold(0.0, f64::max);
    assert!(top > 1.2, "left lying");
}

/// The clip turned to Z up: x, y, z becomes x, −z, y.
fn laid_down(clip: &Clip) -> Clip {
    let text = limited_bvh(clip, &Sheet::on_ones(clip.clock(24.0), clip.len())).unwrap();
    let mut clip = bvh::read(text.as_bytes()).unwrap().clip;
    let mut skeleton = clip.skeleton().clone();
    let turned = |offset: DVec3| DVec3::new(offset.x, -offset.z, offset.y);
    let mut negated = Vec::new();
    for joint in &mut skeleton.joints {
        joint.offset = turned(joint.offset);
        joint.end_sites.iter_mut().for_each(|end| end.offset = turned(end.offset));
        for (column, channel) in (joint.first_channel..).zip(&mut joint.channels) {
            *channel = match *channel {
                Channel::Position(Axis::Y) => Channel::Position(Axis::Z),
                Channel::Rotation(Axis::Y) => Channel::Rotation(Axis::Z),
                Channel::Position(Axis::Z) => Channel::Position(Axis::Y),
                Channel::Rotation(Axis::Z) => Channel::Rotation(Axis::Y),
                x => x,
            };
            if matches!(channel, Channel::Position(Axis::Y) | Channel::Rotation(Axis::Y)) {
                negated.push(column);
            }
        }
    }
    let mut values = Vec::new();
    for frame in 0..clip.len() {
        let mut row = clip.row(Frame(frame)).to_vec();
        negated.iter().for_each(|column| row[*column] = -row[*column]);
        values.extend(row);
    }
    clip = Clip::new(skeleton, clip.rate(), Frame(0), clip.len(), values).unwrap();
    clip
}

#[test]
fn what_cannot_be_written_is_refused() {
    let (clip, mut sheet) = chain(&["a"], 2);
    let refused =
        |glb: Glb, clip: &Clip, sheet: &Sheet| glb.write(clip, sheet).unwrap_err().to_string();
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-4, 1e4] {
        let glb = Glb { scale, ..Glb::default() };
        assert!(refused(glb, &clip, &sheet).starts_with("glb.scale"), "{scale}");
    }
    let clock = Clock { first: Frame(0), frame_rate: clip.rate(), koma_rate: 24.0 };
    assert!(refused(Glb::default(), &clip, &Sheet::on_ones(clock, 0)).contains("no koma"));
    let mut skeleton = clip.skeleton().clone();
    skeleton.joints[0].offset.x = f64::NAN;
    let values = vec![0.0; skeleton.channels()];
    let wild = Clip::new(skeleton, clip.rate(), Frame(0), 1, values).unwrap();
    assert!(refused(Glb::default(), &wild, &sheet).contains("no length"));
    let none = Clip::new(Skeleton::default(), clip.rate(), Frame(0), 2, vec![]).unwrap();
    assert!(refused(Glb::default(), &none, &sheet).contains("no joint"));
    sheet.layers.clear();
    assert!(refused(Glb::default(), &clip, &sheet).contains("no koma"));
}

proptest! {
    #[test]
    fn any_exposures_are_shown_as_the_sheet_says(
        exposures in prop::collection::vec((0usize..5, 1usize..7), 1..20),
    ) {
        let (clip, mut sheet) = chain(&["a", "b", "c"], 5);
        let exposures = exposures.into_iter().map(|(drawing, koma)| Exposure { drawing, koma });
        sheet.layers[0].exposures = exposures.collect();
        check_positions(&clip, &sheet, &Glb::default());
    }
}
