//! Tests the contents of the X-sheet.

use super::*;
use genga::motion::bvh;
use genga::sheet::{
    Blank, CameraWork, Drawing, Exposure, Layer, Numbers, Role, Source, SpokenLine, Why,
};

fn clip() -> Clip {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/kick.bvh");
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

/// Returns a layer of drawings by role (`e`nd, `g`enga, `i`nbetween), each with its number of koma on screen.
fn layer(name: &str, shown: &[(char, usize)]) -> Layer {
    let role = |letter| match letter {
        'e' => Role::End,
        'g' => Role::Genga,
        _ => Role::Inbetween,
    };
    let drawing = |(at, (letter, _)): (usize, &(char, usize))| {
        Drawing::new(Source::At(at as f64), role(*letter), Why::default())
    };
    let exposure =
        |(drawing, (_, koma)): (usize, &(char, usize))| Exposure { drawing, koma: *koma };
    Layer {
        name: name.into(),
        joints: vec![],
        drawings: shown.iter().enumerate().map(drawing).collect(),
        exposures: shown.iter().enumerate().map(exposure).collect(),
        gone: vec![],
    }
}

fn sheet(layers: Vec<Layer>) -> Sheet {
    Sheet::new(clip().clock(24.0), layers)
}

fn pages(settings: &XSheet, layers: Vec<Layer>) -> Vec<String> {
    settings.draw("c012 蹴り", &clip(), &sheet(layers)).unwrap()
}

/// Returns the words of a page, without the koma numbers, which are right-aligned.
fn words(page: &str) -> Vec<String> {
    let text = |line: &'_ str| {
        let (look, word) = line.strip_suffix("</text>")?.rsplit_once('>')?;
        let is_koma = look.contains("\"end\"") && word.parse::<usize>().is_ok();
        (!is_koma).then(|| word.to_owned())
    };
    page.lines().filter_map(text).collect()
}

/// Counts the upright lines in ink: hold lines, and the one in the legend.
fn hold_lines(page: &str) -> usize {
    let number = |line: &str, name: &str| {
        let rest = line.split(&format!(" {name}=\"")).nth(1).unwrap();
        rest.split('"').next().unwrap().parse::<f64>().unwrap()
    };
    let upright = |line: &&str| {
        let ink = line.contains("stroke=\"#22252b\"");
        ink && number(line, "x1") == number(line, "x2") && number(line, "y1") != number(line, "y2")
    };
    page.lines().filter(|line| line.starts_with("<line")).filter(upright).count()
}

const CUT: [(char, usize); 7] =
    [('e', 6), ('i', 2), ('i', 2), ('g', 3), ('g', 3), ('i', 3), ('e', 5)];

#[test]
fn the_words_of_a_small_sheet_are_as_they_were() {
    let pages = pages(&XSheet::default(), vec![layer("A", &CUT)]);
    assert_eq!(pages.len(), 2, "the koma, and the gauges");
    let words: Vec<_> = pages.iter().map(|page| words(page).join("\n")).collect();
    insta::assert_snapshot!(words.join("\n\n"));
}

#[test]
fn every_inbetween_has_a_fraction_beside_action_and_among_the_gauges() {
    let is_fraction = |word: &&String| {
        let parts = word.split_once('/').map(|(of, whole)| [of, whole].map(str::parse::<u32>));
        parts.is_some_and(|parts| parts.iter().all(Result::is_ok))
    };
    for count in [2, 12, 40] {
        let inbetweens = vec![('i', 1); count];
        let shown = [&[('e', 1)], &inbetweens[..], &[('e', 1)]].concat();
        let pages = pages(&XSheet::default(), vec![layer("A", &shown)]);
        let fractions = pages.iter().map(|page| words(page).iter().filter(is_fraction).count());
        assert_eq!(fractions.collect::<Vec<_>>(), [count; 2]);
    }
}

#[test]
fn a_cut_that_is_entered_late_is_blank_before_and_has_its_koma_behind() {
    let draw = |blank| {
        let sheet = sheet(vec![layer("A", &CUT)]).with_blank(blank);
        XSheet { gauges: false, ..XSheet::default() }.draw("kick", &clip(), &sheet).unwrap()
    };
    let (plain, late) = (draw(Blank::default()), draw(Blank { before: 24, after: 12 }));
    // Numbers, marks and lines of the columns come 24 rows lower.
    let circles = |page: &str| -> Vec<f64> {
        let y = |line: &str| line.split(" cy=\"").nth(1)?.split('"').next()?.parse().ok();
        let all = page.lines().filter(|line| line.starts_with("<circle")).filter_map(y);
        all.filter(|y: &f64| *y < half_page::TOP + 72.0 * half_page::ROW).collect()
    };
    let lower: Vec<f64> = circles(&plain[0]).iter().map(|y| y + 24.0 * half_page::ROW).collect();
    assert!(!lower.is_empty());
    let off = |(a, b): (&f64, &f64)| (a - b).abs();
    assert_eq!(circles(&late[0]).len(), lower.len());
    assert!(circles(&late[0]).iter().zip(&lower).map(off).all(|off| off < 1e-3));
    let words = |pages: &[String]| words(&pages[0]);
    assert!(words(&plain).contains(&"1+0".into()) && words(&late).contains(&"2+12".into()));
    // A cross at both ends of both columns, and one in the legend: two lines each.
    let crosses = |page: &str| page.matches("stroke-width=\"1.4\"").count();
    assert_eq!((crosses(&plain[0]), crosses(&late[0])), (2, 2 + 2 * 2 * 2));
}

#[test]
fn camera_work_stands_in_the_camera_column() {
    let work =
        |begin, koma, words: &str| CameraWork { begin, koma, words: words.into(), is_guess: false };
    let camera = vec![work(2, 12, "PAN"), work(80, 20, "T.U")];
    let sheet = Sheet { camera, ..sheet(vec![layer("A", &[('e', 144)])]) };
    let page = XSheet::default().draw("kick", &clip(), &sheet).unwrap().remove(0);
    for (words, half) in [("PAN", 0), ("T.U", 1)] {
        let line = page.lines().find(|line| line.contains(&format!(">{words}<"))).unwrap();
        let x = line.split(" x=\"").nth(1).unwrap().split('"').next().unwrap();
        let x = x.parse::<f64>().unwrap();
        let right = [490.0, 992.0][half];
        assert!(x > right - 60.0 && x < right, "{words}: {line}");
        assert!(!line.contains("writing-mode"), "it is upright: {line}");
    }
    let camera = vec![work(2, 12, "PAN + 回転"), work(80, 20, "PAN slowly to the left")];
    let sheet = Sheet { camera, ..sheet };
    let page = XSheet::default().draw("kick", &clip(), &sheet).unwrap().remove(0);
    assert!(page.contains(">PAN<") && page.contains(">+ 回転<"), "under each other");
    let long = page.lines().find(|line| line.contains(">PAN slowly to the left<")).unwrap();
    assert!(long.contains("writing-mode"), "what is too wide runs down: {long}");
}

#[test]
fn the_head_has_the_slate_and_settings_go_over_it() {
    let slate = Slate { animator: "アキ".into(), cut: "46".into(), ..Slate::default() };
    let sheet = Sheet { slate, ..sheet(vec![layer("A", &CUT)]) };
    let head =
        |settings: &XSheet| words(&settings.draw("ep03_s12_c045", &clip(), &sheet).unwrap()[0]);
    let said = head(&XSheet::default());
    for word in ["アキ", "46", "03", "12", "カット cut  ep03_s12_c045"] {
        assert!(said.contains(&word.to_owned()), "{word}: {said:?}");
    }
    let said = head(&XSheet { scene: "7".into(), ..XSheet::default() });
    assert!(said.contains(&"7".into()) && !said.contains(&"12".into()));
}

#[test]
fn a_page_has_144_koma_and_eight_layers_at_most() {
    let long = |koma| vec![layer("A", &vec![('i', 1); koma])];
    let settings = XSheet { gauges: false, ..XSheet::default() };
    for (koma, count) in [(0, 1), (1, 1), (144, 1), (145, 2), (288, 2), (289, 3)] {
        assert_eq!(pages(&settings, long(koma)).len(), count, "{koma} koma");
    }
    let many = (0..9).map(|at| layer(&format!("L{at}"), &[('e', 150)])).collect();
    let pages = pages(&settings, many);
    assert_eq!(pages.len(), 4);
    for (at, page) in pages.iter().enumerate() {
        let words = words(page);
        assert!(words.contains(&format!("{} / 4", at + 1)));
        assert_eq!(words.contains(&"L7".to_owned()), at < 2);
        assert_eq!(words.contains(&"L8".to_owned()), at >= 2);
    }
    assert_eq!(self::pages(&settings, vec![]).len(), 1, "an empty sheet is a page to write on");
}

#[test]
fn all_pages_are_numbered_as_one_series_gauges_too() {
    let shown: Vec<_> = (0..45).flat_map(|_| [('g', 4), ('i', 4)]).collect();
    let pages = pages(&XSheet::default(), vec![layer("A", &shown)]);
    assert_eq!(pages.len(), 3 + 1, "360 koma, and gauges");
    for (at, page) in pages.iter().enumerate() {
        assert!(words(page).contains(&format!("{} / 4", at + 1)), "page {}", at + 1);
        assert_eq!(words(page).contains(&"ツメ指示 spacing gauges".to_owned()), at == 3);
    }
}

#[test]
fn a_fraction_beside_action_is_clear_of_the_lines_between_koma() {
    let settings = XSheet { gauges: false, ..XSheet::default() };
    // On threes a tick comes wherever its share of the way is, also on a line.
    let shown: Vec<_> = (0..18).map(|at| (if at % 2 == 0 { 'g' } else { 'i' }, 4)).collect();
    let page = &pages(&settings, vec![layer("A", &shown)])[0];
    let number = |line: &str, name: &str| {
        let rest = line.split(&format!(" {name}=\"")).nth(1).unwrap();
        rest.split('"').next().unwrap().parse::<f64>().unwrap()
    };
    let fractions = page.lines().filter(|line| {
        let text = line.strip_suffix("</text>").and_then(|line| line.rsplit('>').next());
        line.contains("\"8.5\"") && text.is_some_and(|text| text.contains('/'))
    });
    let boxes: Vec<_> = fractions.map(|line| number(line, "y") - 3.0).collect();
    assert!(boxes.len() >= 8, "{boxes:?}");
    for middle in boxes {
        let row = (middle - half_page::TOP).rem_euclid(half_page::ROW);
        assert!(row > 4.0 && row < half_page::ROW - 4.0, "{middle}: {row} of a row");
    }
}

#[test]
fn a_hold_line_stands_under_what_stays_for_more_than_three_koma() {
    let lines = |hold_line, shown: &[(char, usize)]| {
        let settings = XSheet { hold_line, gauges: false, ..XSheet::default() };
        // One line is in the legend; each drawing has a line in both columns.
        (hold_lines(&pages(&settings, vec![layer("A", shown)])[0]) - 1) / 2
    };
    for (shown, count) in [
        (&[('e', 3), ('i', 3), ('e', 3)][..], 0),
        (&[('e', 4), ('i', 3), ('e', 3)], 1),
        (&[('e', 4), ('i', 4), ('e', 9)], 3),
    ] {
        assert_eq!(lines(HoldLine::Long, shown), count, "{shown:?}");
        assert_eq!(lines(HoldLine::Always, shown), 3);
        assert_eq!(lines(HoldLine::Never, shown), 0);
    }
    assert_eq!(lines(HoldLine::Long, &[('e', 70), ('e', 20)]), 3, "on in the second half");
    assert_eq!(lines(HoldLine::Always, &[('e', 1), ('i', 1), ('e', 1)]), 0);
}

#[test]
fn the_numbers_of_genga_are_circled_and_those_of_drawings_are_not() {
    let settings = XSheet { gauges: false, ..XSheet::default() };
    let circles = |settings: &XSheet, radius: f64| {
        let page = &pages(settings, vec![layer("A", &CUT)])[0];
        let circle = format!(" r=\"{radius}\"");
        let outer = |line: &&str| line.starts_with("<circle") && line.contains(&circle);
        page.lines().filter(outer).filter(|line| line.contains("stroke=\"#")).count()
    };
    // Four keys in ACTION, and two in the legend.
    let rings = |settings| circles(settings, 7.2);
    assert_eq!(rings(&settings), 4 + 2);
    // CELL has all seven numbers, those of keys in bold.
    let cell = 8.0 + 30.0 + 58.0 + 150.0 + 38.0 + 15.0;
    let page = &pages(&settings, vec![layer("A", &CUT)])[0];
    let numbers = page.lines().filter(|line| {
        line.starts_with("<text")
            && line.contains(&format!("x=\"{cell}\""))
            && line.contains("\"10.5\"")
    });
    let is_bold: Vec<bool> = numbers.map(|line| line.contains("bold")).collect();
    assert_eq!(is_bold, CUT.map(|(role, _)| role != 'i'));
    let dots = pages(&settings, vec![layer("A", &CUT)])[0].matches(" r=\"2.2\"").count();
    assert_eq!(dots, 4, "three inbetweens and the legend");
    let round = XSheet { inbetween: InbetweenMark::Circle, ..settings };
    assert_eq!(circles(&round, 4.0), 4);
}

#[test]
fn the_highest_number_carries_end_once() {
    let settings = XSheet { gauges: false, ..XSheet::default() };
    for koma in [2, 72, 73, 144] {
        let mut shown = vec![('i', 1); koma - 1];
        shown.push(('e', 1));
        let page = &pages(&settings, vec![layer("A", &shown)])[0];
        assert_eq!(words(page).iter().filter(|word| *word == "END").count(), 1, "{koma} koma");
    }
}

#[test]
fn numbers_of_an_earlier_sheet_are_written_in_both_columns() {
    let mut own = layer("A", &[('e', 10), ('g', 80), ('i', 3), ('e', 4)]);
    let numbers = [("1", "1"), ("17za", "9a"), ("18", ""), ("20", "11")];
    for (drawing, (number, genga)) in own.drawings.iter_mut().zip(numbers) {
        drawing.numbers = Numbers { drawing: number.parse().ok(), genga: genga.parse().ok() };
    }
    let settings = XSheet { gauges: false, ..XSheet::default() };
    let page = &pages(&settings, vec![own])[0];
    let words = words(page);
    let count = |word: &str| words.iter().filter(|own| *own == word).count();
    for (word, times) in [
        ("1", 3),
        ("17za", 1),
        ("(17za)", 1),
        ("9a", 1),
        ("(9a)", 1),
        ("18", 1),
        ("20", 1),
        ("11", 1),
    ] {
        assert_eq!(count(word), times, "{word}");
    }
    assert_eq!(["2", "3", "4"].map(count), [1, 1, 0], "those of the legend alone");
}

#[test]
fn what_goes_on_into_the_next_half_is_named_there_in_brackets() {
    let settings = XSheet { gauges: false, ..XSheet::default() };
    let page = &pages(&settings, vec![layer("A", &[('e', 10), ('g', 80), ('e', 1)])])[0];
    assert_eq!(words(page).iter().filter(|word| *word == "(2)").count(), 2);
    let inbetween = &pages(&settings, vec![layer("A", &[('e', 10), ('i', 80), ('e', 1)])])[0];
    assert_eq!(words(inbetween).iter().filter(|word| *word == "(・)").count(), 1);
    let cut = &pages(&settings, vec![layer("A", &[('e', 72), ('g', 80)])])[0];
    let in_brackets = words(cut).iter().filter(|word| word.starts_with('(')).count();
    assert_eq!(in_brackets, 1, "the legend alone: a drawing of its own begins there");
}

#[test]
fn a_layer_that_ends_early_is_crossed_and_one_drawing_says_hold() {
    let settings = XSheet { gauges: false, ..XSheet::default() };
    let page = |layers| pages(&settings, layers).remove(0);
    let waves = |page: &str| page.matches("<polyline").count();
    let even = page(vec![layer("A", &CUT), layer("B", &[('e', 12), ('e', 12)])]);
    let short = page(vec![layer("A", &CUT), layer("B", &[('e', 6), ('e', 6)])]);
    assert_eq!((waves(&even), waves(&short)), (0, 2));
    let hold = page(vec![layer("A", &[('e', 24)])]);
    let down = ["止", "メ", "H", "O", "L", "D"];
    for letter in down {
        assert_eq!(words(&hold).iter().filter(|word| *word == letter).count(), 2, "{letter}");
    }
    assert!(!words(&even).iter().any(|word| word == "止"));
}

#[test]
fn a_half_has_the_exposures_and_gauges_that_a_look_at_all_finds() {
    let letters = ['e', 'i', 'g', 'i', 'i', 'g', 'i', 'e'];
    for seed in 0..40 {
        let shown: Vec<_> =
            (0..60).map(|at| (letters[(at * 5 + seed) % 8], 1 + at * (seed + 3) % 11)).collect();
        let mut layer = layer("A", &shown);
        layer.exposures.swap(seed, 59 - seed / 2);
        let koma = layer.timed().map(|(begin, _)| begin).collect::<Vec<_>>();
        let gauges: Vec<_> = (0..59 / 4)
            .map(|at| Gauge {
                first: 4 * at,
                joint: genga::motion::JointId(0),
                shares: vec![0.5; 5],
            })
            .collect();
        let leaf = Leaf::new(&layer, &gauges, 0, None);
        let highest = layer.exposures.iter().map(|shown| shown.drawing).max();
        let end = layer.timed().filter(|(_, shown)| Some(shown.drawing) == highest).last();
        assert_eq!(leaf.end, end.map(|(begin, _)| begin));
        for begin in (0..layer.length() + 200).step_by(17) {
            let half = half_page::Half { left: 0.0, begin };
            let here = |from: usize, to: usize| from < half.end() && to > begin;
            let all = layer.timed().filter(|(from, shown)| here(*from, from + shown.koma));
            assert_eq!(
                leaf.on(half).collect::<Vec<_>>(),
                all.collect::<Vec<_>>(),
                "{seed}, {begin}"
            );
            let all = gauges.iter().map(|gauge| (gauge, koma[gauge.first], koma[gauge.first + 4]));
            let all: Vec<_> = all.filter(|(_, from, to)| here(*from, *to)).collect();
            assert_eq!(leaf.gauges_on(half).collect::<Vec<_>>(), all, "{seed}, {begin}");
        }
    }
}

#[test]
fn a_sheet_that_shows_what_it_has_not_is_refused() {
    let mut lying = layer("A", &CUT);
    lying.exposures[0].drawing = 7;
    let error = XSheet::default().draw("c1", &clip(), &sheet(vec![lying])).unwrap_err();
    assert!(error.to_string().contains("layer A shows drawing 7"), "{error}");
}

/// Returns the words in the S column of a page, from top to bottom.
fn speech(page: &str) -> Vec<&str> {
    let downwards = page.lines().filter(|line| line.contains("writing-mode"));
    downwards.filter_map(|line| Some(line.strip_suffix("</text>")?.rsplit_once('>')?.1)).collect()
}

#[test]
fn what_is_spoken_stands_in_the_s_column_on_every_half_it_is_heard_in() {
    let line = |begin, koma, speaker: &str, words: &str| SpokenLine {
        begin,
        koma,
        speaker: speaker.into(),
        words: words.into(),
    };
    let lines = [
        line(10, 20, "アキ", "えい！"),
        line(20, 40, "Ken", "No <way>"),
        line(60, 30, "", "待って"),
        line(143, 1, "", "a line that is far too long for one koma"),
    ];
    let settings = XSheet { gauges: false, ..XSheet::default() };
    let sheet = sheet(vec![layer("A", &[('e', 144)])]).with_lines(&lines);
    let page = &settings.draw("c1", &clip(), &sheet).unwrap()[0];
    let found = speech(page);
    assert_eq!(found[..3], ["アキ「えい！」", "Ken: No &lt;way&gt;", "「待って」"]);
    assert_eq!(found[3], "(「待って」)", "it goes on in the second half");
    assert!(found[4].ends_with('…'), "{found:?}");
    let silent = &settings.draw("c1", &clip(), &self::sheet(vec![layer("A", &CUT)])).unwrap()[0];
    assert!(speech(silent).is_empty());
}

#[test]
fn the_rounds_of_a_loop_are_written_once_and_then_repeated_with_an_arrow() {
    let settings = XSheet { gauges: false, ..XSheet::default() };
    let round = layer("A", &[('g', 4), ('i', 3), ('g', 3), ('i', 2)]);
    let draw = |times: usize| {
        let exposures = round.exposures.repeat(times);
        let looped = Sheet {
            repeat: Some(genga::sheet::Repeat { frames: 91, koma: 12 }),
            ..sheet(vec![Layer { exposures, ..round.clone() }])
        };
        settings.draw("c012", &clip(), &looped).unwrap()
    };
    let count = |page: &str, word: &str| words(page).iter().filter(|own| **own == word).count();
    let (once, thrice) = (&draw(1)[0], &draw(3)[0]);
    assert_eq!([count(once, "ピ"), count(thrice, "ピ")], [0, 2], "ACTION and CELL");
    // The first drawing comes again where the repeat begins, and no other does.
    assert_eq!(
        [count(thrice, "1") - count(once, "1"), count(thrice, "3") - count(once, "3")],
        [2, 0]
    );
    assert_eq!(hold_lines(thrice) - hold_lines(once), 2, "the arrow of either column");
    // Its arrow goes on over pages to the last koma.
    let long = draw(15);
    assert_eq!(long.len(), 2);
    assert_eq!(long.iter().map(|page| count(page, "ピ")).collect::<Vec<_>>(), [2, 0]);
    assert_eq!(hold_lines(&long[1]), 3, "one is in the legend");
}
