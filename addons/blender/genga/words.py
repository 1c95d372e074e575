"""The panel in Japanese. Knows nothing of Blender but that it looks for a word in a context."""

# Of words that Blender has for something else, such as Snap.
CONTEXT = "genga"

JAPANESE = {
    # Operators.
    "Find Keys": "原画を探す",
    "Show the Take": "テイクを見る",
    "Show the Sheet": "シートを見る",
    "Pin": "固定",
    "Forbid": "禁止",
    "Only": "これだけ",
    "Clear": "消す",
    "Export Timesheet": "タイムシートを書き出す",
    "genga Timesheet onto Action (.json)": "genga のタイムシートをアクションへ (.json)",
    "genga GLB with Roles (.glb)": "genga の GLB、役割付き (.glb)",
    # Panels.
    "Genga": "原画",
    "Knobs": "つまみ",
    "Corrections": "修正",
    "Take and Files": "テイクとファイル",
    "Presets": "プリセット",
    # Knobs.
    "Per Second": "毎秒の枚数",
    "On": "コマ打ち",
    "Ones": "1コマ打ち",
    "Twos": "2コマ打ち",
    "Threes": "3コマ打ち",
    "Ones to Threes": "打ち分け（1〜3）",
    "Twos and Threes": "打ち分け（2〜3）",
    "Snap": "詰め",
    "Naka-nashi": "中無し",
    "Koma-dori": "コマ撮り",
    "Feet Held": "足を止める",
    "Rate": "毎秒のコマ数",
    "More": "その他",
    "Live": "すぐに反映",
    "Markers": "マーカー",
    "Frames": "範囲",
    "Take": "テイク",
    "Scene": "シーン",
    "Deforming Bones Only": "変形ボーンだけ",
    "Leave Out": "除くボーン",
    "Left Out": "除く",
    "Leave Out Selected": "選択を除く",
    "Leave Out None": "除かない",
    "Pins": "固定",
    "Only Pins": "固定だけを原画に",
    # Presets.
    "On Twos": "2コマ打ち",
    "On Threes": "3コマ打ち",
    "Snappy": "メリハリ",
    "Soft": "なめらか",
    "Few Genga": "原画少なめ",
    # What is said of them.
    "Find the key drawings of the armature's take, and put them onto constant keys in an action of their own. Esc ends it":
        "アーマチュアのテイクから原画を探し、別のアクションにコンスタントキーで並べる。Esc で中止",
    "Show the take, or its drawings on the sheet": "テイクと、シートの上の画を切り替える",
    "Write the timesheet that was found into a folder": "できたタイムシートをフォルダに書き出す",
    "So many key drawings, first and last among them; 0 is as many as are found": "原画の枚数（最初と最後を含む）。0 は見つかっただけ",
    "So many drawings a second, inbetweens too; 0 is as they are found": "中割りも含めた毎秒の枚数。0 は成り行き",
    "How many koma a drawing stays between two genga": "原画のあいだで、1枚を何コマ見せるか",
    "How far inbetweens crowd towards their genga (spacing)": "中割りを近い原画にどれだけ寄せるか",
    "How many of the fastest inbetweens are left out, in %": "いちばん速い中割りを何 % 抜くか",
    "How many of the slowest inbetweens are held over, in %": "いちばん遅い中割りを何 % 止めるか",
    "A foot stays on one place for as long as it stands in the take; hip and knee give way":
        "テイクで足が着いているあいだ、足を同じ場所に止める。腰と膝が合わせて曲がる",
    "Koma a second of the sheet: 24 in film and television, whatever rate the scene has": "シートの毎秒コマ数。シーンのレートにかかわらず、映画とテレビは 24",
    "Any other setting of a recipe by its name, such as keys.min_price=8; keys.contacts=keys": "ほかの設定を名前で。例: keys.min_price=8; keys.contacts=keys",
    "Run again as soon as a knob is turned": "つまみを回すとすぐにやり直す",
    "Number the genga on the timeline": "原画の番号をタイムラインに付ける",
    "Leave out controls and mechanisms, where the rig has bones that deform": "変形ボーンのあるリグで、コントロールや補助のボーンを除く",
    "Bones that are not looked at, by patterns such as *twist*, *hair*; they are keyed all the same": "見ないボーンをパターンで。例: *twist*, *hair*。キーは付く",
    "This bone is not looked at; it is keyed all the same": "このボーンは見ない。キーは付く",
    "The selected bones are left out too": "選択したボーンも除く",
    "No bone is left out by its tick": "チェックで除いたボーンをなくす",
    "Frames near which no genga is found, such as 50, 60..66": "付近で原画を探さないフレーム。例: 50, 60..66",
    "They are genga whatever is found": "何が見つかっても原画にする",
    "No genga is found near them": "付近で原画を探さない",
    "They are the only genga": "これだけを原画にする",
    "No frame is pinned or forbidden": "固定と禁止をすべて消す",
}


def translations(operator_context, any_context="*"):
    """What Blender takes: a word in a context, and its translation."""
    contexts = (CONTEXT, any_context, operator_context)
    return {"ja_JP": {(context, word): its for word, its in JAPANESE.items() for context in contexts}}
