# SPDX-License-Identifier: GPL-3.0-or-later
"""Japanese translations of the panel, in the form that Blender expects."""

# Context of labels that Blender translates otherwise, such as Snap.
CONTEXT = "genga"

JAPANESE = {
    # Operators.
    "Find Keys": "原画を探す",
    "Show the Take": "テイクを表示",
    "Show the Sheet": "シートを表示",
    "Pin": "固定",
    "Forbid": "禁止",
    "Only": "これだけ",
    "Clear": "消去",
    "Export Timesheet": "タイムシートを書き出す",
    "genga Timesheet onto Action (.json)": "genga のタイムシートを適用 (.json)",
    "genga GLB with Roles (.glb)": "genga の GLB、役割付き (.glb)",
    # Panels.
    "Genga": "原画",
    "Knobs": "設定",
    "Corrections": "修正",
    "Take and Files": "テイクとファイル",
    "Presets": "プリセット",
    # Settings.
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
    "Live": "即時反映",
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
    # Tooltips.
    "Find the key drawings of the armature's take, and write them as constant keys into a separate action. Esc cancels":
        "アーマチュアのテイクから原画を探し、別のアクションに一定補間のキーで書き込む。Esc で中止",
    "Show the take, or its drawings on the sheet": "テイクとシートの画を切り替える",
    "Write the timesheet into a folder": "タイムシートをフォルダーに書き出す",
    "Number of key drawings, including first and last; 0 keeps the number found": "原画の枚数（最初と最後を含む）。0 は指定なし",
    "Drawings per second, including inbetweens; 0 keeps the rate found": "中割りも含めた毎秒の枚数。0 は指定なし",
    "Koma per drawing between two genga": "原画の間で1枚を見せるコマ数",
    "How closely inbetweens crowd towards their genga (spacing)": "中割りを近い原画に寄せる強さ",
    "Share of inbetweens, the fastest ones, to leave out, in %": "速いほうから抜く中割りの割合 (%)",
    "Share of inbetweens, the slowest ones, to replace by holds, in %": "遅いほうから止めに置き換える中割りの割合 (%)",
    "Keep a foot in place while it stands in the take; hip and knee adapt":
        "テイクで足が接地している間、足を同じ位置に保つ。股関節と膝が合わせて動く",
    "Koma per second of the sheet, independent of the scene's rate; 24 in film and television": "シートの毎秒コマ数。シーンのレートとは独立。映画とテレビは 24",
    "Other recipe settings by name, such as keys.min_price=8; keys.contacts=keys": "そのほかの設定を名前で指定。例: keys.min_price=8; keys.contacts=keys",
    "Run again when a setting changes": "設定を変えるとすぐに再実行する",
    "Number the genga on the timeline": "原画の番号をタイムラインに付ける",
    "Leave out controls and mechanisms, if the rig has deforming bones": "変形ボーンのあるリグで、コントロールや補助のボーンを除く",
    "Bones to ignore, as patterns such as *twist*, *hair*; they still get keys": "無視するボーンのパターン。例: *twist*, *hair*。キーは付く",
    "Ignore this bone; it still gets keys": "このボーンを無視する。キーは付く",
    "Also leave out the selected bones": "選択したボーンも除く",
    "Untick all bones": "すべてのボーンのチェックを外す",
    "Frames without a genga nearby, such as 50, 60..66": "付近に原画を置かないフレーム。例: 50, 60..66",
    "Always make the selected frames genga": "選択したフレームを必ず原画にする",
    "Find no genga near the selected frames": "選択したフレームの付近に原画を置かない",
    "Make only the selected frames genga": "選択したフレームだけを原画にする",
    "Remove all pins and forbidden frames": "固定と禁止をすべて消去",
}


def translations(operator_context, any_context="*"):
    """Returns the table for Blender: context and text, with the translation."""
    contexts = (CONTEXT, any_context, operator_context)
    return {"ja_JP": {(context, word): its for word, its in JAPANESE.items() for context in contexts}}
