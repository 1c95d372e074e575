//! Two sheets that a person made: a cycle three times over, and layers of different lengths of hold. Each is read, goes into
//! a timesheet and a GLB, and comes back.

use glam::DVec3;

use super::*;
use crate::sheet_json::SheetFile;
use crate::xdts::{Mark, Xdts, read_cells};
use crate::{Glb, LengthUnit, Up, limited_bvh, sheet_json};
use genga::motion::{Axis, Body, Channel, Joint, JointId, Poser, Skeleton, bvh};
use genga::time::{Frame, FrameRate};

fn case(name: &str) -> SheetFile {
    let path = crate::real::repository().join("tests/sheets").join(name);
    sheet_json::read(&std::fs::read(path).unwrap()).unwrap()
}

/// A motion that the sheet could be of: its joints in a chain, of which each turns at a pace of its own.
fn clip(file: &SheetFile) -> Clip {
    let joint = |(at, name): (usize, &String)| {
        let moves = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
        let moves = moves.into_iter().filter(|_| at == 0);
        Joint {
            name: name.clone(),
            parent: at.checked_sub(1).map(JointId),
            offset: if at == 0 { DVec3::ZERO } else { DVec3::Y },
            channels: moves.chain([Channel::Rotation(Axis::Z)]).collect(),
            first_channel: if at == 0 { 0 } else { 3 + at },
            end_sites: vec![],
        }
    };
    let joints: Vec<Joint> = file.clip.joints.iter().enumerate().map(joint).collect();
    let (frames, width) = (file.clip.last_frame() + 1, 3 + joints.len());
    let value = |at: usize| {
        let (frame, column) = ((at / width) as f64, (at % width) as f64);
        if column < 3.0 { 0.1 * frame } else { 3.0 * (frame * (0.1 + 0.01 * column)).sin() }
    };
    let rate = FrameRate::new(file.clip.frame_rate).unwrap();
    let values = (0..frames * width).map(value).collect();
    Clip::new(Skeleton { joints }, rate, Frame(0), frames, values).unwrap()
}

/// The numbers of the drawings on each koma of the columns of a timesheet.
fn shown(timesheet: &str) -> Vec<Vec<String>> {
    let read = read_cells(timesheet.as_bytes()).unwrap();
    let column = |column: &crate::xdts::Column| {
        let mut marks = column.changes.iter().peekable();
        let mut drawing = String::new();
        let koma = |koma| {
            while let Some(change) = marks.next_if(|change| change.koma <= koma) {
                if let Mark::Drawing(number) = &change.mark {
                    drawing.clone_from(number);
                }
            }
            drawing.clone()
        };
        (0..read.length).map(koma).collect()
    };
    read.columns.iter().map(column).collect()
}

/// Where each joint stands on each koma, as the GLB is read by genga's reader of glTF and as `limited.bvh` has it.
fn poses(clip: &Clip, file: &SheetFile) -> [Vec<Vec<DVec3>>; 2] {
    let glb = Glb { mesh: false, unit: LengthUnit::M, up: Up::Y, ..Glb::default() };
    let bytes = glb.write(clip, &file.sheet).unwrap();
    let fps = Some(FrameRate::new(24.0).unwrap());
    let read = genga_read::Options { fps, ..genga_read::Options::default() };
    let of_glb = read.read(&bytes).unwrap().clip;
    let text = limited_bvh(clip, &file.sheet).unwrap();
    let of_bvh = bvh::read(text.as_bytes()).unwrap().clip;
    [of_glb, of_bvh].map(|clip| {
        let (mut poser, mut body) = (Poser::new(&clip), Body::new(clip.skeleton()));
        let koma = |koma| {
            body.place(poser.frame(Frame(koma)));
            body.positions().to_vec()
        };
        (0..file.sheet.length()).map(koma).collect()
    })
}

fn check(name: &str, columns: usize) {
    let file = case(name);
    let whole = clip(&file);
    let (clip, _) = file.fit(whole).unwrap();
    let pair = Xdts::default().write(&file.sheet, &file.cut).unwrap();
    let written = shown(&pair.douga);
    assert_eq!(written.len(), columns, "{name}");
    for (layer, column) in file.sheet.layers.iter().zip(&written) {
        // Drawings that are on screen alike have one number, and others have another.
        let koma: Vec<usize> = layer.koma().collect();
        assert_eq!(koma.len(), column.len(), "{name}");
        for (at, drawing) in koma.iter().enumerate() {
            let first = koma.iter().position(|other| other == drawing).unwrap();
            assert_eq!(column[at], column[first], "{name}, koma {at}");
            assert!(
                koma.iter()
                    .zip(column)
                    .all(|(other, number)| { (other == drawing) == (*number == column[at]) })
            );
        }
    }
    let [glb, bvh] = poses(&clip, &file);
    assert_eq!(glb.len(), bvh.len());
    let size = file.clip.joints.len() as f64;
    for (koma, (glb, bvh)) in glb.iter().zip(&bvh).enumerate() {
        let off = glb.iter().zip(bvh).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(off < 1e-5 * size, "{name}, koma {koma}: off by {off} of {size}");
    }
}

#[test]
fn a_cycle_three_times_over_goes_out_and_comes_back() {
    let file = case("repeated-cycle.sheet.json");
    assert_eq!((file.sheet.layers[0].drawings.len(), file.sheet.length()), (10, 90));
    check("repeated-cycle.sheet.json", 1);
}

#[test]
fn layers_that_change_at_different_koma_go_out_and_come_back() {
    let file = case("merged-layers.sheet.json");
    let drawings: Vec<usize> = file.sheet.layers.iter().map(|layer| layer.drawings.len()).collect();
    assert_eq!((drawings, file.sheet.length()), (vec![25, 120], 120));
    check("merged-layers.sheet.json", 2);
}
