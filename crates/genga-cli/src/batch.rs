//! Many clips at once (一括).
//!
//! ```text
//! list     the clips, their names, and the options of each
//! own_results  what genga wrote, which is no clip
//! shard    a part of the list; all parts have about the same number of bytes
//! row      a clip's row in the summary
//! work     one clip: reads it, draws it, writes it to staging
//! place    moves a clip's folder into its place
//! left     folders that are of no clip
//! again    formats of the last batch, for one that names none
//! pack     one archive instead of a folder per clip
//! journal  finished clips, one a line, so that the next batch resumes from there
//! pool     the worker threads: memory budget, and stopping at any time
//! tables   summary.csv, keys.csv and times.csv, from one journal or several
//! ```

pub(super) mod again;
pub(super) mod journal;
pub(super) mod left;
pub(super) mod list;
pub(super) mod own_results;
pub(super) mod pack;
pub(super) mod place;
pub(super) mod pool;
pub(super) mod row;
pub(super) mod shard;
pub(super) mod tables;
pub(super) mod work;
