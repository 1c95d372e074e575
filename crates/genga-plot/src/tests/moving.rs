//! Tests the pictures drawn straight to pixels: the preview and the numbered images.

use gif::{ColorOutput, DecodeOptions};
use resvg::tiny_skia::Pixmap;

use super::figures::{looped, walk};
use super::versions::{both, on_twos};
use super::*;

fn images(settings: &NumberedImages, clip: &Clip, sheet: &Sheet) -> Vec<(String, Vec<u8>)> {
    let mut images = vec![];
    let take = |name: &str, png| -> Result<(), Error> {
        images.push((name.to_owned(), png));
        Ok(())
    };
    settings.draw(clip, sheet, take).unwrap();
    images
}

/// Returns the left edge and the lower edge of all dark pixels.
fn edges(png: &[u8]) -> (usize, usize) {
    let map = Pixmap::decode_png(png).unwrap();
    let width = map.width() as usize;
    let dark = map
        .pixels()
        .iter()
        .enumerate()
        .filter(|(_, pixel)| pixel.blue() < 128 && pixel.alpha() > 128);
    let (left, low) = dark
        .fold((usize::MAX, 0), |(left, low), (at, _)| (left.min(at % width), low.max(at / width)));
    (left, low)
}

#[test]
fn images_and_previews_refuse_settings_that_cannot_be() {
    let (clip, sheet) = walk();
    for (settings, name) in [
        (NumberedImages { width: 63, ..NumberedImages::default() }, "width"),
        (NumberedImages { height: 8193, ..NumberedImages::default() }, "height"),
    ] {
        has_setting_error(settings.validate(), name);
        has_setting_error(settings.draw(&clip, &sheet, |_, _| Ok::<(), Error>(())), name);
    }
    for (settings, name) in [
        (Preview { width: 319, ..Preview::default() }, "width"),
        (Preview { height: 1081, ..Preview::default() }, "height"),
        (Preview { most: 0, ..Preview::default() }, "most"),
    ] {
        has_setting_error(settings.validate(), name);
        has_setting_error(
            settings.draw("cut", &SideBySide::Source(&clip, &sheet), Vec::new()),
            name,
        );
    }
}

#[test]
fn an_image_a_drawing_is_numbered_as_the_cell_column() {
    let (clip, mut sheet) = walk();
    sheet.layers[0].name = "A/手".into();
    let small = NumberedImages { width: 160, height: 90, ..NumberedImages::default() };
    let names: Vec<_> = images(&small, &clip, &sheet).into_iter().map(|(name, _)| name).collect();
    let expected = [1, 2, 3, 4, 5].map(|number| format!("A_手_000{number}.png"));
    assert_eq!(names, expected);
    let stopped = small.draw(&clip, &sheet, |_, _| Err(Error::clip("the disk is full")));
    assert_eq!(stopped.unwrap_err().to_string(), "the disk is full");
}

#[test]
fn all_images_have_one_frame_so_that_the_way_gone_is_kept() {
    let (clip, sheet) = walk();
    let camera = Camera::Side;
    let settings = NumberedImages { camera, width: 640, height: 360, ..NumberedImages::default() };
    let images = images(&settings, &clip, &sheet);
    let edges: Vec<_> = images.iter().map(|(_, png)| edges(png)).collect();
    // The walker goes 10 a frame on a stage of 180 that fills 90 − 20 % of the height.
    let way: Vec<_> = edges.windows(2).map(|pair| pair[1].0 as f64 - pair[0].0 as f64).collect();
    let frames = [1.0, 3.0, 1.5, 1.5];
    let px = way[1] / frames[1];
    assert!(px > 5.0, "{edges:?}");
    for (way, frames) in way.iter().zip(frames) {
        assert!((way - px * frames).abs() <= 2.0, "{edges:?}");
    }
    assert!(edges.iter().all(|(_, low)| *low == edges[0].1), "one floor: {edges:?}");
}

#[test]
fn images_of_a_loop_stand_where_its_first_round_has_come_to_behind_the_seam_too() {
    let small = NumberedImages {
        camera: Camera::Side,
        width: 640,
        height: 360,
        ..NumberedImages::default()
    };
    let ways = |pngs: &[Vec<u8>]| -> Vec<f64> {
        let lefts: Vec<f64> = pngs.iter().map(|png| edges(png).0 as f64).collect();
        lefts.windows(2).map(|pair| pair[1] - pair[0]).collect()
    };
    for rounds in [1, 3] {
        let (clip, sheet) = looped(rounds);
        let whole: Vec<_> =
            images(&small, &clip, &sheet).into_iter().map(|image| image.1).collect();
        let mut columns = vec![];
        let take = |own: ColumnPictures| -> Result<(), Error> {
            columns.push(own.douga);
            Ok(())
        };
        small.draw_columns(&clip, &sheet, take).unwrap();
        for pngs in [whole, columns] {
            assert_eq!(pngs.len(), 4, "a picture a drawing");
            let ways = ways(&pngs);
            assert!(ways[0] > 10.0, "{ways:?}");
            assert!(ways.iter().all(|way| (way - ways[0]).abs() <= 2.0), "{ways:?}");
        }
    }
}

#[test]
fn images_are_transparent_or_paper_as_asked_and_marks_stay_in_place() {
    let (clip, sheet) = walk();
    let small = NumberedImages { width: 160, height: 90, ..NumberedImages::default() };
    let corner = |settings: &NumberedImages| {
        let png = images(settings, &clip, &sheet).remove(0).1;
        Pixmap::decode_png(&png).unwrap().pixels()[0]
    };
    assert_eq!(corner(&small).alpha(), 255);
    assert_eq!(corner(&NumberedImages { transparent: true, ..small.clone() }).alpha(), 0);
    let marked = NumberedImages { marks: true, ..small };
    let top = |png: &[u8]| Pixmap::decode_png(png).unwrap().data()[..4 * 160 * 8].to_vec();
    let tops: Vec<_> = images(&marked, &clip, &sheet).iter().map(|(_, png)| top(png)).collect();
    assert!(tops[0].iter().any(|value| *value < 128), "a register mark in the corner");
    assert!(tops.iter().all(|other| *other == tops[0]));
}

#[test]
fn each_image_with_marks_has_its_own_number_below_the_floor() {
    let (clip, sheet) = walk();
    let marked =
        NumberedImages { marks: true, width: 640, height: 360, ..NumberedImages::default() };
    let number = |png: &[u8]| {
        let map = Pixmap::decode_png(png).unwrap();
        let corner = map.data()[4 * 640 * 330..4 * 640 * 340].to_vec();
        let faint = |pixel: &[u8]| pixel[0] < 160;
        let inked = corner.chunks(4).filter(|pixel| faint(pixel)).count();
        (corner, inked)
    };
    let images = images(&marked, &clip, &sheet);
    let numbers: Vec<_> = images.iter().map(|(_, png)| number(png)).collect();
    assert!(numbers.iter().all(|(_, inked)| *inked > 5), "a number is written");
    for (at, number) in numbers.iter().enumerate() {
        assert!(numbers[..at].iter().all(|other| other.0 != number.0), "drawing {}", at + 1);
    }
}

#[test]
fn the_number_of_a_drawing_that_came_later_has_its_letter_in_name_and_picture() {
    let (clip, _) = walk();
    let mut sheet = Sheet::on_ones(clip.clock(24.0), 1);
    let marked =
        NumberedImages { marks: true, width: 320, height: 180, ..NumberedImages::default() };
    let mut seen: Vec<Vec<u8>> = vec![];
    let letters = ('a'..='y').map(String::from).chain(["".into(), "za".into()]);
    for letters in letters {
        sheet.layers[0].drawings[0].numbers.drawing = format!("3{letters}").parse().ok();
        let (name, png) = images(&marked, &clip, &sheet).remove(0);
        assert_eq!(name, format!("A_0003{letters}.png"));
        let pixels = Pixmap::decode_png(&png).unwrap().data().to_vec();
        assert!(!seen.contains(&pixels), "{name} looks like another");
        seen.push(pixels);
    }
}

/// Returns every picture of a GIF as it is shown on the screen, with its time in hundredths of a second.
fn played(bytes: &[u8]) -> Vec<(Vec<u8>, u16)> {
    let mut options = DecodeOptions::new();
    options.set_color_output(ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).unwrap();
    let width = usize::from(decoder.width());
    let mut screen = vec![0; 4 * width * usize::from(decoder.height())];
    let mut played = vec![];
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        for (at, pixel) in frame.buffer.chunks(4).enumerate().filter(|(_, pixel)| pixel[3] == 255) {
            let (x, y) = (at % usize::from(frame.width), at / usize::from(frame.width));
            let to = 4 * ((y + usize::from(frame.top)) * width + x + usize::from(frame.left));
            screen[to..to + 4].copy_from_slice(pixel);
        }
        played.push((screen.clone(), frame.delay));
    }
    played
}

fn preview(settings: &Preview, clip: &Clip, sheet: &Sheet) -> (Vec<u8>, usize) {
    let mut bytes = vec![];
    let shown = settings.draw("cut", &SideBySide::Source(clip, sheet), &mut bytes).unwrap();
    (bytes, shown)
}

#[test]
fn a_preview_lasts_as_long_as_the_sheet_and_its_koma_do_not_drift() {
    let (clip, sheet) = walk();
    let (bytes, shown) = preview(&Preview::default(), &clip, &sheet);
    let times: Vec<u64> = played(&bytes).iter().map(|(_, time)| u64::from(*time)).collect();
    assert_eq!((shown, times.len()), (8, 8));
    assert_eq!(times.iter().sum::<u64>(), 33, "8/24 s");
    let begins = times.iter().scan(0, |at, time| Some(std::mem::replace(at, *at + time)));
    for (koma, begin) in begins.enumerate() {
        assert!((begin as f64 - 100.0 * koma as f64 / 24.0).abs() <= 0.5, "{times:?}");
    }
}

/// Returns the pixels of a part of a picture that is 640 px wide.
fn part(picture: &[u8], rows: std::ops::Range<usize>, columns: std::ops::Range<usize>) -> Vec<u8> {
    let row = |row: usize| 4 * (row * 640 + columns.start)..4 * (row * 640 + columns.end);
    rows.flat_map(|at| picture[row(at)].to_vec()).collect()
}

/// Returns the pixels of the figure in a half of a picture.
fn figures(picture: &[u8], half: usize) -> Vec<u8> {
    part(picture, 50..270, half * 320 + 4..half * 320 + 316)
}

#[test]
fn a_preview_of_two_versions_shows_each_held_by_its_own_sheet_and_marks_where_they_differ() {
    let (clip, sheet) = walk();
    let twos = on_twos(&clip);
    let shown = both(&clip, [&sheet, &twos]);
    let mut pictures: Vec<Vec<u8>> = vec![];
    let settings = Preview { width: 640, height: 340, ..Preview::default() };
    let koma = settings.play("cut", &shown, |picture| {
        pictures.push(picture.to_vec());
        Ok(())
    });
    assert_eq!((koma.unwrap(), pictures.len()), (8, 8));
    let held = [&sheet, &twos].map(|sheet| sheet.layers[0].koma().collect::<Vec<_>>());
    for koma in 1..8 {
        for (half, held) in held.iter().enumerate() {
            let stays = held[koma] == held[koma - 1];
            let [before, now] = [koma - 1, koma].map(|koma| figures(&pictures[koma], half));
            assert_eq!(before == now, stays, "half {half}, koma {}", koma + 1);
        }
    }
    for (koma, differ) in shown.differences().unwrap().into_iter().enumerate() {
        let sign = part(&pictures[koma], 14..34, 310..330);
        let is_dark = |pixel: &[u8]| pixel[0] < 100 && pixel[1] < 100;
        assert_eq!(sign.chunks(4).any(is_dark), differ, "koma {}", koma + 1);
    }
    // The numbers: 1 and 2 of the first sheet are an end and an inbetween.
    let red = |koma: usize, half: usize| {
        let number = part(&pictures[koma], 8..38, half * 320 + 270..half * 320 + 298);
        number.chunks(4).filter(|pixel| pixel[0] > 150 && pixel[1] < 120).count()
    };
    assert!(red(0, 0) > 10 && red(4, 0) > 10 && red(0, 1) > 10, "keys");
    assert_eq!((red(1, 0), red(2, 1)), (0, 0), "inbetweens");
}

#[test]
fn a_preview_shows_the_result_held_while_the_source_goes_on() {
    let (clip, sheet) = walk();
    let played = played(&preview(&Preview::default(), &clip, &sheet).0);
    let held = sheet.layers[0].koma().collect::<Vec<_>>();
    for koma in 1..8 {
        let (before, now) = (&played[koma - 1].0, &played[koma].0);
        let stays = held[koma] == held[koma - 1];
        assert_eq!(figures(before, 1) == figures(now, 1), stays, "result of koma {}", koma + 1);
        assert!(figures(before, 0) != figures(now, 0), "source of koma {}", koma + 1);
    }
}

#[test]
fn a_long_preview_is_cut_and_says_how_much_it_shows() {
    let (clip, sheet) = walk();
    let short = Preview { most: 3, ..Preview::default() };
    let (bytes, shown) = preview(&short, &clip, &sheet);
    let times: u16 = played(&bytes).iter().map(|(_, time)| time).sum();
    assert_eq!((shown, times), (3, 13));
}

#[test]
fn degenerate_clips_move_too() {
    let (walk, _) = walk();
    let skeleton = Skeleton { joints: vec![joint("root", None, DVec3::ZERO, true)] };
    let point = Clip::new(skeleton, rate(24.0), Frame(0), 1, vec![1e7, -3.0, 0.5]).unwrap();
    for clip in [walk, point] {
        let sheet = Sheet::on_ones(clip.clock(24.0), 1);
        let small =
            NumberedImages { width: 64, height: 64, marks: true, ..NumberedImages::default() };
        assert_eq!(images(&small, &clip, &sheet).len(), 1);
        let (bytes, _) =
            preview(&Preview { width: 320, height: 200, ..Preview::default() }, &clip, &sheet);
        assert_eq!(played(&bytes).len(), 1);
    }
}

#[test]
fn the_same_clip_and_sheet_give_the_same_pixels() {
    let (clip, sheet) = walk();
    let settings =
        NumberedImages { width: 160, height: 90, marks: true, ..NumberedImages::default() };
    assert!(images(&settings, &clip, &sheet) == images(&settings, &clip, &sheet));
    let small = Preview { width: 320, height: 200, ..Preview::default() };
    assert!(preview(&small, &clip, &sheet) == preview(&small, &clip, &sheet));
}
