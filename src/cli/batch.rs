//! Many clips at once (一括).
//!
//! ```text
//! list     which clips, what they are called, and what is asked of each by itself
//! shard    a part of the list, of as many bytes as every other part
//! row      what there is to say of a clip in one row
//! work     one clip: read, drawn, written aside
//! place    the folder of a clip takes its place
//! pack     one archive in place of a folder a clip
//! journal  what is finished, a line a clip, so that the next batch goes on from there
//! crew     who works: threads, a room of memory, and an end at any time
//! tables   summary.csv, keys.csv and times.csv, of one journal or of several
//! ```

pub(super) mod crew;
pub(super) mod journal;
pub(super) mod list;
pub(super) mod pack;
pub(super) mod place;
pub(super) mod row;
pub(super) mod shard;
pub(super) mod tables;
pub(super) mod work;
