//! The compared ways to choose keys.

use std::fmt;

use serde::{Serialize, Serializer};

/// A way to choose keys (手法).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Method {
    /// This program's keys: turns of the body, which cost less than fills, in the set that loses the least.
    Own,
    /// The optimum of the mean reconstruction error.
    OptimalMean,
    /// The optimum of the worst koma's error.
    OptimalWorst,
    /// Curve simplification after Ramer, Douglas and Peucker, on poses.
    Simplified,
    /// The longest polyline through the poses.
    Polyline,
    /// The first paper alone: frames that are a key of any joint, those shared by most joints first.
    KurodaTokoi,
    /// Keys at even distances.
    Uniform,
    /// A key every second koma, which fixes their number.
    Twos,
    /// A key every third koma, which fixes their number.
    Threes,
}

impl Method {
    /// The methods that choose a requested number of keys, in the order of tables.
    pub const ALL: [Self; 7] = [
        Self::Own,
        Self::OptimalMean,
        Self::OptimalWorst,
        Self::Simplified,
        Self::Polyline,
        Self::KurodaTokoi,
        Self::Uniform,
    ];

    /// The methods with a fixed number of keys, with the koma from key to key.
    pub const PACES: [(Self, usize); 2] = [(Self::Threes, 3), (Self::Twos, 2)];

    /// Whether the method is optimal by some measure.
    pub fn is_optimal(self) -> bool {
        matches!(self, Self::OptimalMean | Self::OptimalWorst)
    }

    /// Whether its work is cubic in the length of a clip.
    pub fn is_cubic(self) -> bool {
        self.is_optimal() || self == Self::Polyline
    }

    /// Returns its name in tables and files.
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

    /// Describes it in a few words and in Japanese.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Own => ("keys of this program: turns of the body and fills", "原画"),
            Self::OptimalMean => {
                ("least possible mean error (dynamic programming)", "平均誤差最小")
            }
            Self::OptimalWorst => {
                ("least possible largest error (dynamic programming)", "最大誤差最小")
            }
            Self::Simplified => ("Ramer-Douglas-Peucker simplification of poses", "曲線の単純化"),
            Self::Polyline => {
                ("longest polyline through the poses (Morishima et al. 2007)", "最長の折れ線")
            }
            Self::KurodaTokoi => {
                ("first paper only: keys shared by most joints first", "関節の原画の和")
            }
            Self::Uniform => ("keys at even distances", "均等割り"),
            Self::Twos => ("a key every second koma, whatever their number", "2コマ打ち"),
            Self::Threes => ("a key every third koma, whatever their number", "3コマ打ち"),
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
