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
    length: (take) => `${take.length} (${take.koma} koma)${
      take.before ? ` · koma 1 here is koma ${take.before + 1} of the cut` : ""}`, between: " · ",
    counts: (rounds, genga, drawings) => `${rounds > 1 ? `${rounds} rounds, ` : ""}${genga} genga, ${drawings} drawings`,
    different: "different drawings", differ: (koma) => `≠ different drawings on ${koma} koma`, blank: "blank",
    drawing: "drawing",
    key_help: [
      ["Space", "play, stop"], ["← →", "one koma"], ["↑ ↓", "one drawing"], ["Shift ← →", "one genga"],
      ["Home End", "first, last koma"], ["S", "left, right, side by side"], ["O", "onion skin"],
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
    genga: "原画", inbetween: "中割り", end: "端", of: "/", play: "再生", stop: "停止",
    "koma-back": "1コマ戻る", "koma-on": "1コマ進む", "drawing-back": "1枚戻る", "drawing-on": "1枚進む",
    scrub: "コマ", column: "シートの列、クリックでそのコマへ", stage: "人物、ドラッグで回す",
    length: (take) => `尺 ${take.length}（${take.koma}コマ）${
      take.before ? `　ここの1コマ目はカットの${take.before + 1}コマ目` : ""}`, between: "　",
    counts: (rounds, genga, drawings) => `${rounds > 1 ? `リピート${rounds}回・` : ""}原画 ${genga}枚・動画 ${drawings}枚`,
    different: "絵が違う", differ: (koma) => `≠ 絵が違うコマ：${koma}`, blank: "空セル",
    drawing: "動画",
    key_help: [
      ["Space", "再生・停止"], ["← →", "1コマ"], ["↑ ↓", "1枚"], ["Shift ← →", "原画ごと"],
      ["Home End", "最初・最後のコマ"], ["S", "左・右・並べて"], ["O", "オニオンスキン"],
      ["K", "原画のみ"], ["F", "カメラが追う"], ["L", "ループ"], ["1 2 3 4", "正面・側面・斜め・自動"],
      ["− +", "遅く・速く"], ["T", "明・暗"], ["J", "English"], ["?", "この一覧"],
    ],
  },
};

