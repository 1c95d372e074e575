//! Every knob by name: what a recipe file, `--set` and a window show of it.

use crate::error::{Error, nearest};

/// One setting of the recipe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knob {
    /// Its name, `section.field`.
    pub name: &'static str,
    /// The same in Japanese.
    pub japanese: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// What it counts in; empty for choices and flags.
    pub unit: &'static str,
    /// What it does, in a sentence or two.
    pub help: &'static str,
    /// The same in Japanese.
    pub japanese_help: &'static str,
}

/// What a knob takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A number from `min` to `max`; the step suits a slider.
    Number {
        /// The least value.
        min: f64,
        /// The largest value that makes sense on a slider.
        max: f64,
        /// Whether it must be whole.
        whole: bool,
        /// Whether it may be `none`.
        optional: bool,
    },
    /// A length of time, frames or seconds.
    Span,
    /// A count (`4`) or a share (`4%`, `1/3`).
    Amount,
    /// Koma a drawing (`2`), or the fewest and the most (`1-3`).
    On,
    /// A number, or a share of the joint's own 95th percentile (`5%`).
    Band,
    /// A side to look from (`front`), or where a camera stands and what it looks at (`X,Y,Z:X,Y,Z`).
    SeenFrom,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
}

const fn number(min: f64, max: f64) -> Kind {
    Kind::Number { min, max, whole: false, optional: false }
}

const fn whole(min: f64, max: f64) -> Kind {
    Kind::Number { min, max, whole: true, optional: false }
}

/// Every knob, in the order of the chain.
pub const KNOBS: &[Knob] = &[
    Knob {
        name: "rate",
        japanese: "コマ数",
        kind: number(2.0, 60.0),
        unit: "koma a second",
        help: "Koma a second of the sheet: 24 in film and TV animation.",
        japanese_help: "シートの毎秒コマ数。映画やテレビアニメは24。",
    },
    Knob {
        name: "layers",
        japanese: "セル分け",
        kind: Kind::Choice(&["body", "limbs", "joints"]),
        unit: "",
        help: "The layers of the sheet, each with keys and timing of its own: the whole body, trunk and each \
               limb, or every joint that moves. A recipe may name them too: \
               [{ name = \"A\", joints = [\"Hips\", \"*Arm*\"] }].",
        japanese_help: "シートのセル分け。全身を一枚（body）、胴と手足（limbs）、動く部位ごと（joints）。\
                        セルごとに原画とタイミングを持つ。レシピでは名前を付けて分けることもできる。",
    },
    Knob {
        name: "root",
        japanese: "移動",
        kind: Kind::Choice(&["drawings", "ones"]),
        unit: "",
        help: "What carries the body through the room: its drawings, or the source on ones, so that held \
               drawings slide on (1コマ打ち).",
        japanese_help: "体を運ぶのは絵（drawings）か、1コマ打ちの元の動き（ones）か。\
                        onesでは止めた絵のまま体が滑っていく。",
    },
    Knob {
        name: "seen_from",
        japanese: "見る位置",
        kind: Kind::SeenFrom,
        unit: "world | auto | front | side | three-quarter, or X,Y,Z:X,Y,Z (where a camera stands : what it looks at)",
        help: "From where movement is measured: in the world, or on the screen of a camera, where what comes \
               straight at us hardly moves. It counts for displacements, keys, rests and omission, not for rotations.",
        japanese_help: "動きをどこから測るか。空間（world）か、カメラの画面の上か。\
                        画面ではこちらへ真っすぐ来る動きは小さい。移動・原画・止め・省略に効き、回転には効かない。",
    },
    Knob {
        name: "feet",
        japanese: "接地",
        kind: Kind::Choice(&["free", "held"]),
        unit: "",
        help: "Whether a foot stays where it stands: where its drawing has it (free), or on one place for \
               as long as it stands in the source, hip and knee giving way (held).",
        japanese_help: "接地した足を止めるか。絵のまま（free）か、素材で接地している間は一か所に止め、\
                        股と膝で合わせる（held）か。",
    },
    Knob {
        name: "exaggerate.cartoon",
        japanese: "誇張",
        kind: number(0.0, 2.0),
        unit: "0 (off) to 2 on the slider, 3 at the most",
        help: "Anticipation before movements and follow-through after them (the cartoon animation filter), before \
               keys are chosen. 1 goes back and beyond by 36 % of a sudden movement. More breaks joints.",
        japanese_help: "原画を選ぶ前に、動きの前の予備動作と後の後追いを強める（カートゥーン・アニメーション・フィルタ）。\
                        1で、急な動きの36％だけ逆へ引き、行き過ぎる。強すぎると関節が壊れる。",
    },
    Knob {
        name: "exaggerate.cartoon_width",
        japanese: "予備動作から後追いまで",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "The time from the anticipation of a sudden movement to its follow-through. Longer exaggerates \
               slow movements too.",
        japanese_help: "急な動きの予備動作から後追いまでの時間。長いほど、ゆっくりした動きも誇張される。",
    },
    Knob {
        name: "exaggerate.cartoon_parts",
        japanese: "誇張する部位",
        kind: Kind::Choice(&["upper", "body"]),
        unit: "",
        help: "What is exaggerated so: all that no foot hangs on, so that feet stand where they stood (upper), or \
               legs and the way of the body too (body): feet slide a little then.",
        japanese_help: "誇張する部位。足につながらない部位だけで、接地した足は動かない（upper）か、\
                        脚と体の移動も含む全身（body）で、足は少し滑る。",
    },
    Knob {
        name: "exaggerate.ease",
        japanese: "スローイン・スローアウト",
        kind: number(0.0, 1.0),
        unit: "0 (off) to 1",
        help: "Slow-in and slow-out: poses gather round rests and turning points, and the movement between is \
               faster. No pose is changed, only its time.",
        japanese_help: "止まりや折り返しの近くに時間を集め、あいだの動きを速くする。ポーズは変わらず、時刻だけが変わる。",
    },
    Knob {
        name: "exaggerate.ease_reach",
        japanese: "時間を集める範囲",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "How far in time poses are drawn to the slow ones beside them. Longer draws short movements to the \
               rests beside them.",
        japanese_help: "近くの遅いポーズに引き寄せる時間の範囲。長いほど、短い動きは隣の止めに引き寄せられる。",
    },
    Knob {
        name: "speed.measure",
        japanese: "速さの測り方",
        kind: Kind::Choice(&["rotation", "displacement", "combined", "angle"]),
        unit: "",
        help: "How fast a joint is: its rotation against its parent, its way through the world (or on the screen), both, or the signed change of its own rotation angle (for studies).",
        japanese_help: "部位の速さの測り方。親に対する回転、空間での移動、その両方、\
                        または自身の回転角の符号つき変化（研究用）。",
    },
    Knob {
        name: "filter.kind",
        japanese: "ローパスフィルタ",
        kind: Kind::Choice(&["box", "gaussian", "ideal", "butterworth"]),
        unit: "",
        help: "How the speeds are smoothed.",
        japanese_help: "速さをならす方法。",
    },
    Knob {
        name: "filter.width",
        japanese: "フィルタの適用範囲",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "How wide the smoothing is. Wider finds fewer turns, so fewer genga, and blurs quick double actions.",
        japanese_help: "ならす幅。広いほど原画は減り、素早い二段の動きはぼやける。",
    },
    Knob {
        name: "turns.reading",
        japanese: "読み方",
        kind: Kind::Choice(&["event", "literal"]),
        unit: "",
        help: "What a turn is: every rest and slowing has its end and its start (event), or the first \
               paper to the letter (literal), which loses the ends of movements.",
        japanese_help: "動きの変わり目の読み方。止まりや減速ごとに終わりと始まりを取る (event) か、\
                        第一論文の文言どおり (literal) で、この場合は動き終わりが失われる。",
    },
    Knob {
        name: "turns.steady",
        japanese: "定速とみなす加速度",
        kind: Kind::Band,
        unit: "°/s², or a share of the joint's own 95th percentile (\"5%\")",
        help: "Accelerations of a joint up to this count as none. Raised, slow joints turn less often. Turns of \
               the body do not ask for it.",
        japanese_help: "部位のこの加速度までは等速とみなす。上げると、ゆっくりした部位の変わり目がなくなる。\
                        全身の変わり目には効かない。",
    },
    Knob {
        name: "turns.persistence",
        japanese: "連続フレーム数",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "How long before and after a turn the body must be faster. Longer finds fewer turns, and short \
               pauses and quick back-and-forth movements go.",
        japanese_help: "変わり目の前後でどれだけの間より速ければ数えるか。長いほど変わり目は減り、\
                        短い間や素早い往復は消える。",
    },
    Knob {
        name: "turns.side",
        japanese: "連続を見る側",
        kind: Kind::Choice(&["after", "both", "rising"]),
        unit: "",
        help: "Where it must last, in the literal reading: after the turn, on both sides of it, or after \
               it with every step rising.",
        japanese_help: "literal のとき、どちら側で続けばよいか。変わり目の後、前後の両方、\
                        または後で毎フレーム速くなり続けること。",
    },
    Knob {
        name: "keys.merge",
        japanese: "原画の候補",
        kind: Kind::Choice(&["body", "union", "vote", "sum"]),
        unit: "",
        help: "What picks the keys: turns of the whole body (body). For studies: a turn of any joint (union), \
               what joints elect that vote with the length of what hangs on them, or turns of their speeds \
               added up (sum).",
        japanese_help: "原画を選ぶもの。全身の変わり目 (body)。研究用に、いずれかの部位の変わり目 (union)、\
                        先につながる長さを票とする部位の投票 (vote)、速さの合計の変わり目 (sum)。",
    },
    Knob {
        name: "keys.fill",
        japanese: "補いの原画",
        kind: Kind::Choice(&["on", "off"]),
        unit: "",
        help: "Whether moments that are no turn become keys where the body would go astray without them.",
        japanese_help: "変わり目でない瞬間も、ないと動きが崩れるところでは原画にするか。",
    },
    Knob {
        name: "keys.reach",
        japanese: "票の届く範囲",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "How far a joint's vote carries: longer joins turns that lie further apart into one key. With \
               union it decides which of two turns nearer than a koma stays.",
        japanese_help: "部位の票が届く範囲。長いほど離れた変わり目が一枚の原画にまとまる。union では、\
                        1コマより近い二つの変わり目のどちらを残すかを決める。",
    },
    Knob {
        name: "keys.rank",
        japanese: "原画の選び方",
        kind: Kind::Choice(&["price", "strength"]),
        unit: "",
        help: "What decides between keys: what they save together at a price a drawing, or how much of a turn \
               each is.",
        japanese_help: "原画どうしの選び方。一枚の値段に対して全体で減る誤差か、\
                        変わり目としての強さか。",
    },
    Knob {
        name: "keys.min_price",
        japanese: "最低の価値",
        kind: number(0.0, 20.0),
        unit: "% of body height",
        help: "What a key costs that is no turn: it must save an error so large for an eighth of a second. A \
               clear turn costs a tenth. Higher keeps fewer; small gestures go first.",
        japanese_help: "変わり目でない原画一枚の値段。これだけの誤差を8分の1秒のあいだ減らすものだけが残る。\
                        はっきりした変わり目は十分の一の値段。上げると原画は減り、小さな芝居から消える。",
    },
    Knob {
        name: "keys.rest",
        japanese: "止めとみなす速さ",
        kind: number(0.0, 60.0),
        unit: "% of body height a second",
        help: "Slower than this for half a second, the whole body rests: both ends of a rest are keys.",
        japanese_help: "全身がこれより遅い状態が半秒続けば止めとみなし、その両端を原画にする。",
    },
    Knob {
        name: "keys.contacts",
        japanese: "接地を原画に",
        kind: Kind::Choice(&["off", "candidates", "keys"]),
        unit: "",
        help: "What the moments are at which a foot or a hand comes down or leaves: like all others (off), \
               candidates even where no joint turns, or keys whatever they save.",
        japanese_help: "足や手が着く瞬間と離れる瞬間をどう扱うか。特別扱いしない（off）、部位が変わらなくても\
                        候補にする（candidates）、必ず原画にする（keys）。",
    },
    Knob {
        name: "keys.min_strength",
        japanese: "最低の強さ",
        kind: number(0.0, 1.0),
        unit: "0 to 1; for body how much of a turn it is, for vote and union the share of all votes, for sum the depth of the valley",
        help: "How strong a key must be at the least.",
        japanese_help: "原画に最低限必要な強さ。",
    },
    Knob {
        name: "keys.per_second",
        japanese: "毎秒の原画数",
        kind: number(0.1, 12.0),
        unit: "keys a second, inf for no limit",
        help: "That many found keys at the most; pins, ends of rests and contacts that are keys come on top. \
               Where more are worth it the price rises until they fit.",
        japanese_help: "見つける原画の毎秒の上限。固定した原画、止めの両端、原画にした接地は別に数える。\
                        超えるときは収まるまで値段が上がる。",
    },
    Knob {
        name: "actions.split",
        japanese: "動作に分ける",
        kind: Kind::Flag,
        unit: "",
        help: "Whether a long take is split into actions: what is left out is then counted in each of them.",
        japanese_help: "長いテイクを動作に分けるか。抜く枚数は動作ごとに数える。",
    },
    Knob {
        name: "actions.length",
        japanese: "動作の普通の長さ",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "How long an action usually is: 4.4 s in the second paper. Longer makes fewer actions.",
        japanese_help: "一つの動作の普通の長さ（第二の論文では4.4秒）。長くすると動作の数が減る。",
    },
    Knob {
        name: "actions.contrast",
        japanese: "区切りの明瞭さ",
        kind: number(1.0, 20.0),
        unit: "times",
        help: "How clear a split has to be: the body so many times slower than before and after (4: or half of \
               the movement goes over to other parts). Less will do where an action would be too long.",
        japanese_help: "区切りがどれほどはっきりしていればよいか。前後の何分の一まで遅くなるか（4）、\
                        または動きの半分がほかの部位へ移るか。動作が長すぎるときは、もっと弱くても区切る。",
    },
    Knob {
        name: "actions.shortest",
        japanese: "最短の動作",
        kind: Kind::Span,
        unit: "source frames or seconds",
        help: "How short an action may be. Longer joins short movements with those beside them.",
        japanese_help: "動作の最短の長さ。長くすると短い動きは隣の動作に入る。",
    },
    Knob {
        name: "spacing.on",
        japanese: "何コマ打ち",
        kind: Kind::On,
        unit: "koma, 1 (ones) or more, or the fewest and the most (\"1-3\")",
        help: "A drawing every so many koma: 1 is on ones, 2 on twos, 3 on threes. 1-3 chooses for each \
               interval: fast on ones, slow on threes (打ち分け).",
        japanese_help: "何コマごとに絵を置くか。1は1コマ打ち、2は2コマ打ち、3は3コマ打ち。\
                        1-3 は区間ごとに選び、速いところは1コマ、遅いところは3コマ（打ち分け）。",
    },
    Knob {
        name: "spacing.step",
        japanese: "一枚で動く量",
        kind: number(0.1, 50.0),
        unit: "% of body height",
        help: "Where spacing.on is a range: how far the body may go from one drawing to the next. More \
               puts more of the motion on threes.",
        japanese_help: "spacing.on が範囲のとき、次の絵までに体が動いてよい量。\
                        大きいほど3コマ打ちが増える。",
    },
    Knob {
        name: "spacing.drift",
        japanese: "止めのずれ",
        kind: number(0.0, 20.0),
        unit: "% of body height",
        help: "How far the body may be from the drawing that a rest holds; further on, an inbetween stands there. 0 has \
               inbetweens in rests as everywhere. More loses small gestures.",
        japanese_help: "止めのあいだ、体が今の絵からどこまで離れてよいか。それより離れたところには中割りを置く。\
                        0なら止めの中にも普段どおり中割りを置く。大きいほど小さな芝居が消える。",
    },
    Knob {
        name: "spacing.inbetweens",
        japanese: "中割り枚数",
        kind: Kind::Number { min: 0.0, max: 12.0, whole: true, optional: true },
        unit: "drawings, or none",
        help: "A fixed number of inbetweens between two keys instead.",
        japanese_help: "コマ打ちの代わりに、原画のあいだの中割りを決まった枚数にする。",
    },
    Knob {
        name: "spacing.weight",
        japanese: "詰めの重み",
        kind: number(0.0, 0.95),
        unit: "0 (even) to below 1",
        help: "How far inbetweens crowd towards their key (spacing, 詰め). More makes the middle of a \
               movement snap.",
        japanese_help: "中割りを近い原画にどれだけ寄せるか（詰め）。大きいほど動きの真ん中が飛び、\
                        メリハリが出る。",
    },
    Knob {
        name: "spacing.max_shift",
        japanese: "詰めの上限",
        kind: number(0.0, 6.0),
        unit: "koma",
        help: "How far an inbetween may be taken from its own time.",
        japanese_help: "中割りを本来の時刻からどれだけずらしてよいか。",
    },
    Knob {
        name: "spacing.source",
        japanese: "中割りの元",
        kind: Kind::Choice(&["sample", "blend"]),
        unit: "",
        help: "What an inbetween shows: the performer's own arc, or a blend of the two keys alone.",
        japanese_help: "中割りに何を描くか。演者の実際の軌道 (sample) か、\
                        前後の原画だけを混ぜたもの (blend) か。",
    },
    Knob {
        name: "omission.naka_nashi",
        japanese: "中無し",
        kind: Kind::Amount,
        unit: "drawings an action, or a share of its koma (at most 6)",
        help: "How many inbetweens of the fastest movement are left out of each action (naka-nashi). More \
               than about 6 in one and it jumps.",
        japanese_help: "動作ごとに、いちばん速い動きの中割りを何枚抜くか（中無し）。\
                        一つの動作で6枚ほどを超えると飛んで見える。",
    },
    Knob {
        name: "omission.koma_dori",
        japanese: "コマ撮り",
        kind: Kind::Amount,
        unit: "drawings, or a share of the inbetweens",
        help: "How many inbetweens of the slowest movement are held over (koma-dori). More stills small \
               movements.",
        japanese_help: "いちばん遅い動きの中割りを何枚止めに変えるか（コマ撮り）。\
                        多いほど小さな動きが止まる。",
    },
    Knob {
        name: "omission.max_hold",
        japanese: "最長の止め",
        kind: whole(1.0, 12.0),
        unit: "koma",
        help: "How long a drawing may stay because others were left out, though never less than two \
               drawings' time (4 koma on twos). Longer freezes the body.",
        japanese_help: "抜いた分、一枚をどこまで長く見せてよいか。\
                        ただし絵二枚分（2コマ打ちなら4コマ）を下回らない。長いほど体が固まる。",
    },
    Knob {
        name: "omission.keep_length",
        japanese: "尺を保つ",
        kind: Kind::Flag,
        unit: "",
        help: "Whether the koma of left-out drawings are given to their neighbours.",
        japanese_help: "抜いた絵のコマを前後の絵に渡し、尺を保つかどうか。",
    },
    Knob {
        name: "omission.all_at_once",
        japanese: "一度に抜く",
        kind: Kind::Flag,
        unit: "",
        help: "Leave out the fastest drawings all at once instead of one by one: weaker, for comparison.",
        japanese_help: "速い絵を一枚ずつでなく一度に抜く。効果は弱く、比較のためのもの。",
    },
    Knob {
        name: "omission.order",
        japanese: "順番",
        kind: Kind::Choice(&["naka_nashi_first", "koma_dori_first"]),
        unit: "",
        help: "Which of the two comes first; it hardly matters.",
        japanese_help: "どちらを先にするか。結果はほとんど変わらない。",
    },
];

impl Knob {
    /// The knob of that name.
    ///
    /// # Errors
    /// [`Error::Setting`] with the nearest name when there is none.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        KNOBS.iter().find(|knob| knob.name == name).ok_or_else(|| {
            // A table and no knob.
            if name.starts_with("keys.weight") {
                let message = "there is no such setting; how much a joint counts is set by keys.weights.JOINT=2";
                return Error::setting(name, message);
            }
            let hint = nearest(name, KNOBS.iter().map(|knob| knob.name)).unwrap_or_default();
            Error::setting(name, format!("there is no such setting; did you mean {hint}?"))
        })
    }

    /// Section and field; no section for a setting at the top.
    pub fn path(&self) -> (Option<&'static str>, &'static str) {
        self.name
            .split_once('.')
            .map_or((None, self.name), |(section, field)| (Some(section), field))
    }

    /// Whether it may be `none`.
    pub fn is_optional(&self) -> bool {
        matches!(self.kind, Kind::Number { optional: true, .. })
    }

    /// Help, Japanese name and what it takes, as lines for a comment.
    pub(super) fn comment(&self) -> String {
        format!("{} — {}\n{}", self.japanese, self.help, self.takes())
    }

    /// What it takes, in words.
    pub fn takes(&self) -> String {
        match self.kind {
            Kind::Choice(words) => words.join(" | "),
            Kind::Flag => "true | false".into(),
            Kind::Number { min, .. } => format!("{} (from {min})", self.unit),
            Kind::Span | Kind::Amount | Kind::On | Kind::Band | Kind::SeenFrom => self.unit.into(),
        }
    }

    pub(super) fn refusal(&self, found: &str) -> Error {
        let takes = match self.kind {
            Kind::Choice(words) => format!("one of {}", words.join(", ")),
            _ => self.takes(),
        };
        Error::setting(self.name, format!("expected {takes}, found \"{found}\""))
    }
}
