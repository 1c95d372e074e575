// Every word the page shows, in both languages.
const WORDS = {
  en: {
    left: "left", right: "right", theme: "dark / light", help: "keys", language: "日本語",
    source: "source", result: "result", both: "side by side", koma: "koma", time: "time", held: "held",
    frame: "source frame", loop: "loop", onion: "onion skin", keys: "genga only", follow: "go along",
    shown: "shown", camera: "camera", speed: "speed", close: "close", keys_title: "Keys",
    front: "front", side: "side", "three-quarter": "three-quarter", auto: "auto", turned: "turned by hand",
    genga: "genga", inbetween: "inbetween", end: "end", of: "of", play: "play", stop: "stop",
    "koma-back": "one koma back", "koma-on": "one koma on",
    "drawing-back": "one drawing back", "drawing-on": "one drawing on",
    scrub: "koma", column: "sheet column, click for a koma", stage: "figure, drag to turn",
    facts: (take, genga, drawings) =>
      `${take.length} (${take.koma} koma${take.rounds > 1 ? `, ${take.rounds} rounds` : ""}) · ${genga} genga · ${drawings} drawings`,
    drawing: "drawing",
    key_help: [
      ["Space", "play, stop"], ["← →", "one koma"], ["↑ ↓", "one drawing"], ["Shift ← →", "one genga"],
      ["Home End", "first, last koma"], ["S", "source, result, side by side"], ["O", "onion skin"],
      ["K", "genga only"], ["F", "camera goes along"], ["L", "loop"], ["1 2 3 4", "front, side, three-quarter, auto"],
      ["− +", "slower, faster"], ["T", "dark, light"], ["J", "日本語"], ["?", "this list"],
    ],
  },
  ja: {
    left: "左", right: "右", theme: "明 / 暗", help: "キー", language: "English",
    source: "素材", result: "結果", both: "並べて", koma: "コマ", time: "秒＋コマ", held: "コマ目",
    frame: "素材フレーム", loop: "ループ", onion: "オニオンスキン", keys: "原画のみ", follow: "追う",
    shown: "表示", camera: "カメラ", speed: "速さ", close: "閉じる", keys_title: "キー操作",
    front: "正面", side: "側面", "three-quarter": "斜め", auto: "自動", turned: "手動",
    genga: "原画", inbetween: "中割り", end: "両端", of: "/", play: "再生", stop: "停止",
    "koma-back": "1コマ戻る", "koma-on": "1コマ進む", "drawing-back": "1枚戻る", "drawing-on": "1枚進む",
    scrub: "コマ", column: "シートの列、クリックでそのコマへ", stage: "人物、ドラッグで回す",
    facts: (take, genga, drawings) =>
      `尺 ${take.length}（${take.koma}コマ${take.rounds > 1 ? `、リピート${take.rounds}回` : ""}）・原画 ${genga}枚・動画 ${drawings}枚`,
    drawing: "動画",
    key_help: [
      ["Space", "再生・停止"], ["← →", "1コマ"], ["↑ ↓", "1枚"], ["Shift ← →", "原画ごと"],
      ["Home End", "最初・最後のコマ"], ["S", "素材・結果・並べて"], ["O", "オニオンスキン"],
      ["K", "原画のみ"], ["F", "カメラが追う"], ["L", "ループ"], ["1 2 3 4", "正面・側面・斜め・自動"],
      ["− +", "遅く・速く"], ["T", "明・暗"], ["J", "English"], ["?", "この一覧"],
    ],
  },
};

