//! Tests the messages if no video can be made. The video itself is tested by `tests/others/video`.

use super::Mp4;
use crate::{Cut, Format, Settings};
use genga::edits::Edits;
use genga::error::Error;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;

fn with(ffmpeg: &str) -> Settings {
    Settings { mp4: Mp4 { ffmpeg: ffmpeg.into(), ..Mp4::default() }, ..Settings::default() }
}

#[test]
fn odd_sides_are_refused_with_the_even_ones_beside() {
    let mut settings = Settings::default();
    let said = settings.set("mp4.width", "641").unwrap_err().to_string();
    assert_eq!(said, "mp4.width: videos have even sides; expected 640 or 642, found 641");
    assert!(settings.set("mp4.height", "361").is_err());
    settings.set("mp4.width", "640").unwrap();
}

/// Calls `work` with the format and the kick's cut.
fn kick<T>(work: impl FnOnce(&'static Format, &Cut<'_>) -> T) -> T {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    let mut engine = Engine::new(bvh::open(path.as_ref()).unwrap().clip).unwrap();
    let breakdown = engine.run(&Recipe::default(), &Edits::default()).unwrap();
    let cut = Cut {
        name: "c012",
        clip_file: "kick.bvh",
        clip: breakdown.clip,
        exaggerated: None,
        sheet: breakdown.sheet,
        spaced: None,
        splits: &[],
        made_with: None,
    };
    work(Format::find("mp4").unwrap(), &cut)
}

/// The messages before any work, and while writing.
fn said(ffmpeg: &str) -> [String; 2] {
    kick(|format, cut| {
        let mut put = |name: &str, _: &[u8]| -> Result<(), Error> { panic!("{name} was made") };
        let before = format.notes(cut, &with(ffmpeg)).map(|_| String::from("nothing"));
        let at_work = format.write(cut, &with(ffmpeg), &mut put).unwrap_err();
        [before.unwrap_or_else(|error| error.to_string()), at_work.to_string()]
    })
}

#[test]
fn without_ffmpeg_it_says_how_to_get_it() {
    for said in said("no-such-ffmpeg") {
        assert!(
            said.starts_with("mp4.ffmpeg: a video needs ffmpeg, and \"no-such-ffmpeg\" could"),
            "{said}"
        );
        assert!(said.contains("apt install ffmpeg") && said.contains("mp4.ffmpeg=PATH"), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn an_ffmpeg_that_fails_or_makes_nothing_is_an_error() {
    let [before, at_work] = said("false");
    assert!(before.contains("\"false\" ended with exit status: 1"), "{before}");
    assert!(at_work.starts_with("the video could not be written: "), "{at_work}");
    let [before, at_work] = said("true");
    assert_eq!(before, "nothing");
    assert!(at_work.starts_with("the video could not be written: "), "{at_work}");
}

#[cfg(unix)]
#[test]
fn what_ffmpeg_complains_of_is_passed_on() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ffmpeg");
    std::fs::write(
        &path,
        "#!/bin/sh\n[ \"$1\" = -version ] && exit\ncat >/dev/null\necho 'no encoder' >&2\nexit 1\n",
    )
    .unwrap();
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).unwrap();
    let [before, at_work] = said(path.to_str().unwrap());
    assert_eq!(before, "nothing");
    assert!(at_work.ends_with("ffmpeg says: no encoder"), "{at_work}");
}
