//! Sound on this machine: reads WAV files, and plays them with a player of the system.

use std::env;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use hound::{SampleFormat, WavReader, WavWriter};

use genga_studio::{Playing, Waveform};

/// Placeholder for the file in a player's arguments. [`FILE_NAMED`] has its path too.
const FILE: &str = "FILE";
/// Environment variable with the file's path, for a player that cannot take it as an argument or has trouble with
/// spaces.
const FILE_NAMED: &str = "GENGA_SOUND";
/// Players in order of preference, with their arguments.
const PLAYERS: [(&str, &[&str]); 6] = [
    ("pw-play", &[FILE]),
    ("paplay", &[FILE]),
    ("aplay", &["-q", FILE]),
    ("afplay", &[FILE]),
    ("ffplay", &["-nodisp", "-autoexit", "-loglevel", "error", FILE]),
    (
        "powershell",
        &["-NoProfile", "-Command", "(New-Object Media.SoundPlayer $env:GENGA_SOUND).PlaySync()"],
    ),
];
/// Most seconds handed to a player at once; longer sound is started anew.
const SECONDS: u32 = 1800;
/// Interval at which a player is checked for being wanted still.
const LOOK: Duration = Duration::from_millis(15);

type Wav = WavReader<BufReader<File>>;

fn open(file: &Path) -> Result<Wav, String> {
    WavReader::open(file).map_err(|error| said(file, &error))
}

fn said(file: &Path, error: &dyn std::fmt::Display) -> String {
    format!("{}: {error}; expected a WAV file (PCM)", file.display())
}

/// Computes how loud a sound is.
pub(super) fn look(file: &Path) -> Result<Waveform, String> {
    let mut wav = open(file)?;
    let spec = wav.spec();
    let mut fault = None;
    let mut heard =
        |sample: Result<f32, hound::Error>| sample.map_err(|error| fault = Some(error)).ok();
    let waveform = match spec.sample_format {
        SampleFormat::Float => {
            let samples = wav.samples::<f32>().map_while(&mut heard);
            Waveform::new(samples, spec.channels, spec.sample_rate)
        }
        SampleFormat::Int => {
            let samples = wav.samples::<i32>().map(|sample| sample.map(|sample| sample as f32));
            Waveform::new(samples.map_while(&mut heard), spec.channels, spec.sample_rate)
        }
    };
    match fault {
        Some(error) => Err(said(file, &error)),
        None => Ok(waveform),
    }
}

/// A sound being played. Its thread ends the player once it is no longer wanted.
struct Heard {
    is_over: Arc<AtomicBool>,
    fault: Arc<Mutex<Option<String>>>,
}

impl Playing for Heard {
    fn fault(&self) -> Option<String> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Drop for Heard {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

/// Plays a sound from a given second on.
pub(super) fn play(file: &Path, from: f64) -> Result<Box<dyn Playing>, String> {
    let path = env::var_os("PATH").unwrap_or_default();
    let player = player_in(&env::split_paths(&path).collect::<Vec<_>>()).ok_or_else(no_player)?;
    Ok(Box::new(begin(file.to_owned(), from, player)))
}

fn no_player() -> String {
    let names = PLAYERS.map(|(name, _)| name).join(", ");
    format!(
        "no sound is heard: this machine has no player ({names}); on Debian apt install pipewire-bin or alsa-utils"
    )
}

/// A player and its arguments.
type Player = (PathBuf, &'static [&'static str]);

/// Finds the first player that one of the folders contains.
fn player_in(folders: &[PathBuf]) -> Option<Player> {
    let find = |(name, words): (&str, _)| {
        let name = format!("{name}{}", env::consts::EXE_SUFFIX);
        let found = folders.iter().map(|folder| folder.join(&name)).find(|path| path.is_file())?;
        Some((found, words))
    };
    PLAYERS.into_iter().find_map(find)
}

/// Cuts and plays a sound on a thread of its own, so that the window does not wait.
fn begin(file: PathBuf, from: f64, player: Player) -> Heard {
    let heard = Heard { is_over: Arc::default(), fault: Arc::default() };
    let (is_over, fault) = (Arc::clone(&heard.is_over), Arc::clone(&heard.fault));
    thread::spawn(move || {
        if let Err(error) = cut_and_play(&file, from, &player, &is_over) {
            *fault.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
        }
    });
    heard
}

fn cut_and_play(
    file: &Path,
    from: f64,
    (player, words): &Player,
    is_over: &AtomicBool,
) -> Result<(), String> {
    let failed = |error: &dyn std::fmt::Display| format!("no sound is heard: {error}");
    let folder = tempfile::tempdir().map_err(|error| failed(&error))?;
    let rest = folder.path().join("genga.wav");
    cut(file, from, &rest).map_err(|error| said(file, &error))?;
    if is_over.load(Ordering::Relaxed) {
        return Ok(());
    }
    let mut command = Command::new(player);
    for word in *words {
        command.arg(if *word == FILE { rest.as_os_str() } else { OsStr::new(word) });
    }
    command.env(FILE_NAMED, &rest);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|error| failed(&error))?;
    loop {
        if is_over.load(Ordering::Relaxed) {
            drop(child.kill());
            drop(child.wait());
            return Ok(());
        }
        match child.try_wait().map_err(|error| failed(&error))? {
            None => thread::sleep(LOOK),
            Some(status) if status.success() => return Ok(()),
            Some(status) => {
                let words = complaint(&mut child).unwrap_or_else(|| status.to_string());
                let name = player.file_stem().unwrap_or_default().display();
                return Err(failed(&format!("{name} says: {words}")));
            }
        }
    }
}

/// The first line that a player printed to stderr.
fn complaint(child: &mut Child) -> Option<String> {
    let mut words = String::new();
    child.stderr.take()?.take(4096).read_to_string(&mut words).ok()?;
    words.lines().map(str::trim).find(|line| !line.is_empty()).map(str::to_owned)
}

/// Writes a sound from a given second on.
fn cut(file: &Path, from: f64, rest: &Path) -> Result<(), hound::Error> {
    let mut wav = WavReader::open(file)?;
    let spec = wav.spec();
    let first = (from.max(0.0) * f64::from(spec.sample_rate)) as u32;
    wav.seek(first.min(wav.duration()))?;
    let mut writer = WavWriter::create(rest, spec)?;
    let most = SECONDS as usize * spec.sample_rate as usize * usize::from(spec.channels);
    match spec.sample_format {
        SampleFormat::Float => {
            for sample in wav.samples::<f32>().take(most) {
                writer.write_sample(sample?)?;
            }
        }
        SampleFormat::Int => {
            for sample in wav.samples::<i32>().take(most) {
                writer.write_sample(sample?)?;
            }
        }
    }
    writer.finalize()
}

#[cfg(test)]
mod tests {
    use hound::WavSpec;

    use super::*;

    /// Writes two seconds in two channels; the second one is loud.
    fn wav(folder: &Path, bits: u16, sample_format: SampleFormat) -> PathBuf {
        let file = folder.join(format!("{bits}.wav"));
        let spec = WavSpec { channels: 2, sample_rate: 8000, bits_per_sample: bits, sample_format };
        let mut writer = WavWriter::create(&file, spec).unwrap();
        for at in 0..32_000 {
            let is_loud = at >= 16_000;
            match sample_format {
                SampleFormat::Float => {
                    writer.write_sample(if is_loud { 0.5_f32 } else { 0.0 }).unwrap()
                }
                SampleFormat::Int => writer.write_sample(if is_loud { 90_i32 } else { 0 }).unwrap(),
            }
        }
        writer.finalize().unwrap();
        file
    }

    #[test]
    fn every_usual_wav_is_heard() {
        let folder = tempfile::tempdir().unwrap();
        let int = SampleFormat::Int;
        for (bits, format) in [(8, int), (16, int), (24, int), (32, int), (32, SampleFormat::Float)]
        {
            let waveform = look(&wav(folder.path(), bits, format)).unwrap();
            assert_eq!(waveform.seconds(), 2.0, "{bits}");
            assert_eq!((waveform.level(0.0, 0.99), waveform.level(1.1, 1.2)), (0.0, 1.0), "{bits}");
        }
    }

    #[test]
    fn what_is_no_sound_is_said_by_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("no.wav");
        std::fs::write(&file, "RIFF").unwrap();
        let error = look(&file).unwrap_err();
        assert!(error.contains("no.wav: ") && error.contains("expected a WAV file"), "{error}");
        let whole = wav(folder.path(), 16, SampleFormat::Int);
        let bytes = std::fs::read(&whole).unwrap();
        std::fs::write(&whole, &bytes[..1000]).unwrap();
        assert!(look(&whole).is_err(), "a file that breaks off");
        assert!(look(&folder.path().join("gone.wav")).unwrap_err().contains("gone.wav"));
    }

    #[test]
    fn a_machine_without_a_player_says_so() {
        let folder = tempfile::tempdir().unwrap();
        assert!(player_in(&[folder.path().to_owned()]).is_none());
        assert!(no_player().contains("aplay") && no_player().contains("apt install"));
    }

    #[cfg(unix)]
    #[test]
    fn a_player_is_given_the_rest_and_ends_when_nobody_listens() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let file = wav(folder.path(), 16, SampleFormat::Int);
        let script = |text: &str| {
            let path = folder.path().join("aplay");
            std::fs::write(&path, text).unwrap();
            std::fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).unwrap();
            player_in(&[folder.path().to_owned()]).unwrap()
        };
        let until = |is_so: &dyn Fn() -> bool| {
            (0..2000).any(|_| {
                thread::sleep(Duration::from_millis(5));
                is_so()
            })
        };
        let copy = folder.path().join("heard.wav");
        let player = script(&format!(
            "#!/bin/sh\n[ \"$1\" = -q ] || exit 3\ncp \"$2\" {0}.part && mv {0}.part {0}\nexec sleep 60\n",
            copy.display()
        ));
        let heard = begin(file.clone(), 1.5, player);
        assert!(until(&|| copy.exists()), "it was never called");
        assert_eq!(WavReader::open(&copy).unwrap().duration(), 4000, "half a second is left");
        assert!(heard.fault().is_none());
        let over = Arc::downgrade(&heard.is_over);
        drop(heard);
        assert!(until(&|| over.strong_count() == 0), "the player goes on");
        let heard =
            begin(file.clone(), 0.0, script("#!/bin/sh\necho 'no soundcards found' >&2\nexit 1\n"));
        assert!(until(&|| heard.fault().is_some()));
        assert_eq!(heard.fault().unwrap(), "no sound is heard: aplay says: no soundcards found");
    }
}
