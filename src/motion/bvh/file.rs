//! The bytes of a file.

use std::fs;
use std::io;
use std::path::Path;

use super::threads;

/// All bytes of a file. Most of the time goes into new memory, so large files share that between threads.
pub(super) fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    match usize::try_from(fs::metadata(path)?.len()) {
        Ok(size) if threads::parts(size) > 1 => in_parts(path, size, threads::parts(size)),
        _ => fs::read(path),
    }
}

#[cfg(unix)]
fn in_parts(path: &Path, size: usize, parts: usize) -> io::Result<Vec<u8>> {
    use std::os::unix::fs::FileExt;

    let file = fs::File::open(path)?;
    // Asked first whether there is so much memory: what gives zeroes untouched, for the threads to
    // touch, cannot say no.
    Vec::<u8>::new().try_reserve_exact(size)?;
    let mut bytes = vec![0; size];
    let part = size.div_ceil(parts);
    let jobs = bytes.chunks_mut(part).enumerate().map(|(index, target)| {
        let file = &file;
        move || file.read_exact_at(target, (index * part) as u64)
    });
    threads::all(jobs).into_iter().collect::<io::Result<()>>()?;
    Ok(bytes)
}

#[cfg(not(unix))]
fn in_parts(path: &Path, _: usize, _: usize) -> io::Result<Vec<u8>> {
    fs::read(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_read_in_parts_is_the_file() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/kick.bvh");
        let whole = fs::read(&path).unwrap();
        for parts in 1..5 {
            assert_eq!(in_parts(&path, whole.len(), parts).unwrap(), whole);
        }
        assert_eq!(bytes(&path).unwrap(), whole);
        #[cfg(unix)]
        let longer = in_parts(&path, whole.len() + 1, 2).map_err(|error| error.kind());
        #[cfg(unix)]
        assert_eq!(longer, Err(io::ErrorKind::UnexpectedEof), "it got shorter meanwhile");
        assert!(bytes(Path::new("no such file")).is_err());
    }
}
