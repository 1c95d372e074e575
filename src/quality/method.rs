//! The ways to choose keys that are laid side by side.

use std::fmt;

use serde::{Serialize, Serializer};

/// A way to choose keys (手法).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Method {
    /// The program's own: turns of the body, cheaper than what fills between them, and of all sets the one that loses least.
    Own,
    /// The least mean error of reconstruction that there is.
    OptimalMean,
    /// The least error of the worst koma that there is.
    OptimalWorst,
    /// Ramer, Douglas and Peucker on poses.
    Simplified,
    /// The longest polyline through the poses.
    Polyline,
    /// The first paper alone: frames that are a key of any joint, those first that most joints share.
    KurodaTokoi,
    /// Even distances.
    Uniform,
    /// A key every second koma, however many that are.
    Twos,
    /// A key every third koma.
    Threes,
}

impl Method {
    /// Those that choose as many keys as they are asked for, in the order of tables.
    pub const ALL: [Self; 7] = [
        Self::Own,
        Self::OptimalMean,
        Self::OptimalWorst,
        Self::Simplified,
        Self::Polyline,
        Self::KurodaTokoi,
        Self::Uniform,
    ];

    /// Those that have a number of keys of their own, with the koma from key to key.
    pub const PACES: [(Self, usize); 2] = [(Self::Threes, 3), (Self::Twos, 2)];

    /// Whether it is the best there is by some measure.
    pub fn is_optimal(self) -> bool {
        matches!(self, Self::OptimalMean | Self::OptimalWorst)
    }

    /// Whether its work grows with the third power of the length of a clip.
    pub fn is_cubic(self) -> bool {
        self.is_optimal() || self == Self::Polyline
    }

    /// What it is called in tables and files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Own => "genga",
            Self::OptimalMean => "optimal-mean",
            Self::OptimalWorst => "optimal-worst",
            Self::Simplified => "rdp",
            Self::Polyline => "polyline",
            Self::KurodaTokoi => "kt11",
            Self::Uniform => "uniform",
            Self::Twos => "twos",
            Self::Threes => "threes",
        }
    }

    /// What it is, in a few words and in Japanese.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Own => ("the keys of this program: turns of the body and fills", "原画"),
            Self::OptimalMean => {
                ("the least mean error there is (dynamic programming)", "平均誤差最小")
            }
            Self::OptimalWorst => {
                ("the least worst error there is (dynamic programming)", "最大誤差最小")
            }
            Self::Simplified => ("Ramer, Douglas and Peucker on poses", "曲線の単純化"),
            Self::Polyline => {
                ("the longest polyline through the poses (Morishima et al. 2007)", "最長の折れ線")
            }
            Self::KurodaTokoi => {
                ("the first paper alone, what most joints share first", "関節の原画の和")
            }
            Self::Uniform => ("even distances", "均等割り"),
            Self::Twos => ("a key every second koma, as many as that are", "2コマ打ち"),
            Self::Threes => ("a key every third koma, as many as that are", "3コマ打ち"),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

impl Serialize for Method {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}
