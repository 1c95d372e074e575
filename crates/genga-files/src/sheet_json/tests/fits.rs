//! Which clips fit a sheet.

use super::*;
use genga::motion::{Axis, Channel, Clip, EndSite, JointId, Skeleton};
use genga::time::{Frame, FrameRate};

/// The wave with changed values, rate or joints.
fn other(change: impl Fn(&mut Skeleton, &mut Vec<f64>), rate: f64) -> Clip {
    let clip = wave();
    let (mut skeleton, mut values) =
        (clip.skeleton().clone(), clip.rows().flatten().copied().collect());
    change(&mut skeleton, &mut values);
    let frames = values.len() / skeleton.channels();
    Clip::new(skeleton, FrameRate::new(rate).unwrap(), clip.first(), frames, values).unwrap()
}

fn same(_: &mut Skeleton, _: &mut Vec<f64>) {}

#[test]
fn its_own_clip_fits_without_a_word_also_with_more_around_it() {
    let (clip, notes) = file().fit(wave()).unwrap();
    assert_eq!((clip, notes), (wave(), vec![]));
    let wave = wave();
    let rows: Vec<f64> = wave.rows().flatten().copied().collect();
    let around = [&rows[..4 * 12], &rows, &rows[..12]].concat();
    let whole = Clip::new(wave.skeleton().clone(), wave.rate(), Frame(0), 106, around).unwrap();
    let (clip, notes) = file().fit(whole).unwrap();
    assert_eq!((clip, notes), (wave, vec![]));
}

#[test]
fn a_sheet_of_an_exaggerated_motion_knows_its_source_and_makes_that_motion_again() {
    let mut recipe = recipe();
    for (name, value) in [("cartoon", "0.8"), ("cartoon_parts", "body"), ("ease", "0.5")] {
        recipe.set(&format!("exaggerate.{name}"), value).unwrap();
    }
    let mut engine = Engine::new(wave()).unwrap();
    let made = engine.run(&recipe, &Default::default()).unwrap();
    assert_ne!(made.clip, made.source);
    let cut = Cut {
        name: "wave",
        clip_file: "wave.bvh",
        clip: made.clip,
        exaggerated: Some((made.source, &recipe.exaggerate)),
        sheet: made.sheet,
        spaced: None,
        splits: &[],
        made_with: None,
    };
    let written = SheetFile::new(&cut).write().unwrap();
    let again = read(written.as_bytes()).unwrap();
    assert_eq!(again.write().unwrap(), written);
    let (source, notes) = again.fit(wave()).unwrap();
    assert_eq!((&source, notes), (made.source, vec![]));
    assert_eq!(again.drawn(&source).unwrap().as_ref(), Some(made.clip));
    assert_eq!(file().drawn(&source).unwrap(), None, "another sheet is of the clip itself");
    let wrong = written.replacen("\"ease\": 0.5", "\"ease\": 1.5", 1);
    let error = read(wrong.as_bytes()).unwrap_err();
    assert!(error.position().is_some(), "{error}");
    assert!(
        error.to_string().contains("exaggerate.ease: expected strength (0 is off), 0 to 1"),
        "{error}"
    );
}

#[test]
fn what_does_not_fit_is_named() {
    let told = |clip: Clip| file().fit(clip).unwrap_err().to_string();
    let error = told(other(|skeleton, _| skeleton.joints[1].name = "Leg".into(), 50.0));
    assert!(error.starts_with("the sheet has the joint Arm where the clip has Leg"), "{error}");
    let without_hand = other(
        |skeleton, values| {
            skeleton.joints.truncate(2);
            *values = values.chunks(12).flat_map(|row| row[..9].to_vec()).collect();
        },
        50.0,
    );
    let error = told(without_hand);
    assert_eq!(error, "the sheet has 3 joints, the clip 2: Hand is only in the sheet");
    let with_finger = other(
        |skeleton, _| {
            let mut finger = skeleton.joints[2].clone();
            (finger.name, finger.parent, finger.channels) =
                ("Finger".into(), Some(JointId(2)), vec![]);
            skeleton.joints.push(finger);
        },
        50.0,
    );
    let error = told(with_finger);
    assert_eq!(error, "the sheet has 3 joints, the clip 4: Finger is only in the clip");
    let error = told(other(same, 60.0));
    assert!(
        error.contains("for 50 frames a second, the clip has 60") && error.contains("--fps 50"),
        "{error}"
    );
    for (begin, end, has) in [(4, 104, "4 to 103"), (5, 105, "5 to 104")] {
        let error = told(wave().trimmed(Frame(begin), Frame(end)).unwrap());
        let words = format!("the sheet shows frames 4 to 104, the clip has frames {has}");
        assert_eq!(error, words);
    }
}

#[test]
fn a_length_that_was_changed_is_said() {
    let noted = |from: &str, to: &str| {
        let text = text();
        assert!(text.contains(from), "{from}");
        read(text.replacen(from, to, 1).as_bytes()).unwrap().fit(wave()).unwrap().1
    };
    assert_eq!(noted("\"koma\": 4", "\"koma\": 4"), []);
    let [note] = &noted("\"koma\": 4", "\"koma\": 6")[..] else { panic!("one note") };
    assert_eq!(note.code, fit::OTHER_LENGTH);
    let words = "the sheet's length was changed: the clip has 49 koma, layer A has 51";
    assert_eq!(note.message, words);
    // Another edit that keeps the length is not one of it.
    assert_eq!(noted("\"role\": \"genga\"", "\"role\": \"inbetween\""), []);
    // Nor is a length that the run itself made.
    let mut made = file();
    made.sheet.layers[0].exposures[0].koma += 2;
    made.made_with = Some(MadeWith::new(&recipe(), &edits(), &made.sheet));
    assert_eq!(made.fit(wave()).unwrap().1, []);
}

#[test]
fn other_bones_and_another_motion_are_noted() {
    let noted = |clip: Clip| {
        let notes = file().fit(clip).unwrap().1;
        notes.into_iter().map(|note| note.code).collect::<Vec<_>>()
    };
    assert_eq!(noted(other(|_, values| values[7] += 1e-9, 50.0)), [fit::OTHER_MOTION]);
    let bones: [fn(&mut Skeleton, &mut Vec<f64>); 4] = [
        |skeleton, _| skeleton.joints[1].offset.x = 1.0,
        |skeleton, _| skeleton.joints[2].channels.swap(0, 1),
        |skeleton, _| skeleton.joints[2].parent = Some(JointId(0)),
        |skeleton, _| {
            let tip = EndSite { name: "Site".into(), offset: glam::DVec3::ZERO };
            skeleton.joints[1].end_sites.push(tip);
        },
    ];
    for change in bones {
        assert_eq!(noted(other(change, 50.0)), [fit::OTHER_BONES]);
    }
}

#[test]
fn a_digest_sees_every_value_its_sign_and_its_order_but_not_the_sign_of_0() {
    let of = |values: &[f64]| {
        let mut skeleton = wave().skeleton().clone();
        skeleton.joints.truncate(1);
        skeleton.joints[0].channels = vec![Channel::Rotation(Axis::X)];
        let rate = FrameRate::new(24.0).unwrap();
        let clip = Clip::new(skeleton, rate, Frame(0), values.len(), values.to_vec()).unwrap();
        digest::motion(&clip)
    };
    let plain = of(&[1.0, 2.0, 0.0]);
    assert_eq!(plain, of(&[1.0, 2.0, -0.0]));
    for other in [&[-1.0, 2.0, 0.0][..], &[2.0, 1.0, 0.0], &[1.0, 2.0], &[1.0, 2.0, 1e-300]] {
        assert_ne!(plain, of(other), "{other:?}");
    }
    assert_eq!(plain.len(), 16);
}
