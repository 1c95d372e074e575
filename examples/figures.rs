//! Throw-away figures.
#![allow(missing_docs, clippy::all, dead_code, unused)]
#[path = "../tests/all/quiet.rs"]
mod quiet;
use genga::edits::*;
use genga::motion::*;
use genga::pipeline::*;
use genga::quality::*;
use genga::recipe::*;
use genga::sheet::*;
use genga::time::*;
use std::path::PathBuf;
fn clips() -> Vec<(String, Clip)> {
    let mut v = vec![];
    for dir in ["../shared/data/bvh", "data"] {
        let mut p: Vec<PathBuf> = std::fs::read_dir(dir)
            .unwrap()
            .map(|e| e.unwrap().path())
            .filter(|p| p.extension().is_some_and(|e| e == "bvh"))
            .collect();
        p.sort();
        for p in p {
            let c = bvh::read(&std::fs::read(&p).unwrap()).unwrap().clip;
            v.push((
                p.file_stem().unwrap().to_string_lossy().into_owned(),
                bvh::lead_in::strip(c).0,
            ));
        }
    }
    v
}
fn median(mut v: Vec<f64>) -> f64 {
    v.sort_by(f64::total_cmp);
    if v.is_empty() {
        return f64::NAN;
    }
    let n = v.len();
    if n % 2 == 1 { v[n / 2] } else { (v[n / 2] + v[n / 2 - 1]) / 2.0 }
}
fn even(clip: &Clip, n: usize) -> Edits {
    let clock = clip.clock(24.0);
    let koma = clip.rate().koma_from_frames(clip.len(), 24.0);
    let mut frames: Vec<usize> = (1..=n)
        .map(|i| {
            let k = (i as f64 * (koma - 1) as f64 / (n + 1) as f64).round() as usize;
            clock.place_from_koma(k).round() as usize
        })
        .collect();
    frames.dedup();
    let pins =
        frames.into_iter().map(|f| Pin { frame: Frame(f), name: None, weight: None }).collect();
    Edits { pins, only_pins: true, ..Edits::default() }
}
fn shift(sheet: &mut Sheet, args: &[String]) {
    let fpk = sheet.clock.frames_in_koma();
    for l in &mut sheet.layers {
        let n = l.drawings.len();
        for x in l.exposures.clone() {
            let d = &l.drawings[x.drawing];
            if d.role != Role::Inbetween || x.drawing + 1 >= n {
                continue;
            }
            let held = d.why.held_for > 0;
            let len = d.why.lengthened > 0;
            let go = (args.iter().any(|a| a == "mid-held") && held && !len)
                || (args.iter().any(|a| a == "mid-all") && (held || len));
            if !go {
                continue;
            }
            let by = ((x.koma as f64 - 2.0) / 2.0).max(0.0).min(2.0) * fpk;
            let next = l.drawings[x.drawing + 1].source.place();
            let p = d.source.place();
            let q = (p + by).min(next - 0.25 * fpk).max(p);
            l.drawings[x.drawing].source = Source::At(q);
        }
    }
}
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let sets: Vec<(String, String)> =
        args.iter().filter_map(|a| a.split_once('=').map(|(a, b)| (a.into(), b.into()))).collect();
    let mut recipe = Recipe::default();
    for (k, v) in &sets {
        recipe.set(k, v).unwrap();
    }
    let table = args.iter().any(|a| a == "table");
    let mut all = clips();
    let real = 15;
    for (n, _) in quiet::ALL {
        all.push((n.into(), quiet::clip(n)));
    }
    if table {
        println!(
            "| clip | koma | genga | drawings | a second | longest | 1-koma % | twitches | shown mean | even | ratio |"
        );
    }
    let (mut ratios, mut owns, mut evens, mut ones, mut exps, mut tw) =
        (vec![], vec![], vec![], 0, 0, 0);
    let mut nn = (0, 0, 0, 0);
    let mut dps = vec![];
    let mut dps_even = vec![];
    for (i, (name, clip)) in all.iter().enumerate() {
        let mut engine = Engine::new(clip.clone()).unwrap();
        let b = engine.run(&recipe, &Edits::default()).unwrap();
        if i < real {
            let o = b.omission;
            nn.0 += o.naka_nashi.done;
            nn.1 += o.naka_nashi.asked;
            nn.2 += o.koma_dori.done;
            nn.3 += o.koma_dori.asked;
        }
        let mut sheet = b.sheet.clone();
        shift(&mut sheet, &args);
        if args.iter().any(|a| a == "rests") {
            let r = genga::keys::Reference::of(clip, b.clock);
            for rest in &b.keys.rests {
                let [f, t] = [rest.start(), rest.end()]
                    .map(|f| b.clock.koma_from_place(f.0 as f64).min(r.koma() - 1));
                let far = (f..=t).map(|k| r.apart(f, k)).fold(0.0, f64::max);
                let way: f64 = (f..t).map(|k| r.apart(k, k + 1)).sum();
                let found = b
                    .keys
                    .keys
                    .iter()
                    .filter(|k| k.frame > *rest.start() && k.frame < *rest.end())
                    .count();
                println!(
                    "REST {name} {f}..{t} {:.1}s far {far:.2} end {:.2} way {way:.1} keys {found}",
                    (t - f) as f64 / 24.0,
                    r.apart(f, t)
                );
            }
        }
        let e = Evaluation::of(clip, &sheet, None, 1.0).unwrap();
        let l = &sheet.layers[0];
        let x: Vec<(usize, Role)> =
            l.exposures.iter().map(|x| (x.koma, l.drawings[x.drawing].role)).collect();
        let one = x.iter().filter(|x| x.0 == 1).count();
        let twitch = x
            .windows(3)
            .filter(|w| w[0].0 >= 3 && w[1].0 == 1 && w[1].1 == Role::Inbetween && w[2].1.is_kept())
            .count();
        let genga = e.pace.genga;
        let (mut em, mut r) = (f64::NAN, f64::NAN);
        if genga > 0 {
            let mut s2 = engine.run(&recipe, &even(clip, genga)).unwrap().sheet.clone();
            shift(&mut s2, &args);
            let e2 = Evaluation::of(clip, &s2, None, 1.0).unwrap();
            em = e2.shown.mean;
            r = e.shown.mean / em;
            if i < real {
                dps_even.push(e2.pace.drawings_per_second);
            }
        }
        if table {
            println!(
                "| {name} | {} | {genga} | {} | {:.2} | {} | {:.1} | {twitch} | {:.2} | {:.2} | {:.3} |",
                e.pace.koma,
                e.pace.drawings,
                e.pace.drawings_per_second,
                l.longest_hold(),
                100.0 * one as f64 / x.len() as f64,
                e.shown.mean,
                em,
                r
            );
        }
        if i < real {
            ratios.push(r);
            owns.push(e.shown.mean);
            evens.push(em);
            ones += one;
            exps += x.len();
            tw += twitch;
            dps.push(e.pace.drawings_per_second);
        }
    }
    println!(
        "{:?}: median ratio {:.3} mean ratio {:.3} own {:.2} (median {:.2}) even {:.2}; dps {:.2} even {:.2}; ones {ones}/{exps} = {:.1}% twitches {tw} naka {}/{} dori {}/{}",
        args,
        median(ratios.clone()),
        ratios.iter().sum::<f64>() / 15.0,
        owns.iter().sum::<f64>() / 15.0,
        median(owns.clone()),
        evens.iter().sum::<f64>() / 15.0,
        dps.iter().sum::<f64>() / 15.0,
        dps_even.iter().sum::<f64>() / 15.0,
        100.0 * ones as f64 / exps as f64,
        nn.0,
        nn.1,
        nn.2,
        nn.3
    );
}
