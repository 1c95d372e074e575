# SPDX-License-Identifier: GPL-3.0-or-later
"""Japanese translations of the panel, in the form that Blender expects."""

import bpy

# Context of labels that Blender translates otherwise, such as Snap.
CONTEXT = "genga"

JAPANESE = {
    # Operators.
    "Find Keys": "原画を探す",
    "Keys with Curves": "カーブ付きキー",
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
    "Passages": "区間",
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
    "Loop": "リピート",
    "Rounds": "回数",
    "First Frame": "最初のフレーム",
    "Last Frame": "最後のフレーム",
    "Elsewhere": "区間の外",
    "On the Sheet": "シートどおり",
    "As It Is": "素材のまま",
    "Curve Error": "カーブの誤差",
    "Clean Capture": "キャプチャを整える",
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
    "Only Pins": "固定だけを原画に",
    # Preferences.
    "Language": "言語",
    "As Blender": "Blender に合わせる",
    "Default Preset": "既定のプリセット",
    "Sheet": "シート",
    # Presets.
    "Usual": "標準",
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
    "Use only the markers “pin” and keys of type Extreme as genga": "固定のマーカー「pin」と「極値」のキーだけを原画にする",
    "Always make the current frame, or in the dope sheet those of selected keys, genga":
        "現在のフレームを必ず原画にする。ドープシートでは選択したキーのフレーム",
    "Find no genga near the current frame, or in the dope sheet near selected keys":
        "現在のフレームの付近に原画を置かない。ドープシートでは選択したキーの付近",
    "Make only these frames genga: the current one, or in the dope sheet those of selected keys":
        "このフレームだけを原画にする。ドープシートでは選択したキーのフレーム",
    "Remove all markers that pin or forbid": "固定と禁止のマーカーをすべて消す",
    "Set the settings of a preset, and reset the others that presets change": "プリセットの設定にし、ほかのプリセットの設定は元に戻す",
    "Write the genga as keys with smooth curves between them into an action of their own. Keys are added where the motion would be further off the take than Curve Error. Esc cancels":
        "原画をキーにし、間を滑らかなカーブでつないで別のアクションに書き込む。カーブの誤差を超える所にはキーを足す。Esc で中止",
    "Largest distance between the motion of keys with curves and the take, in % of body height":
        "カーブ付きキーの動きとテイクとの差の上限。身長に対する割合 (%)",
    "Repeat the take, whose last pose is its first; the body travels on": "最後のポーズが最初と同じテイクを繰り返す。移動は先へ続く",
    "Number of rounds of a loop": "リピートの回数",
    "Add the marked range: between selected markers, the preview range, or the selected keys":
        "選択したマーカーの間、プレビュー範囲、または選択したキーの範囲を区間にする",
    "Remove the passage selected in the list": "リストで選択した区間を消す",
    "First frame of the passage": "区間の最初のフレーム",
    "Last frame of the passage": "区間の最後のフレーム",
    "What is shown outside of the passages": "区間の外で見せるもの",
    "Timed with the settings of the take": "テイクの設定でコマを割る",
    "A drawing of the take on every koma; the passages begin and end with its poses":
        "テイクを1コマごとにそのまま見せる。区間はそのポーズで始まり、終わる",
    "Leave out inserted poses, such as a T-pose, at the ends of the take, and mend glitches of single frames":
        "テイクの端に入った T ポーズなどを除き、1フレームだけの乱れを直す",
    "Language of the panel": "パネルの言語",
    "Settings of an armature whose keys are found for the first time": "初めて原画を探すアーマチュアの設定",
    "Colour of the sheet's channels in the dope sheet": "ドープシートでのシートのチャンネルの色",
    "Colour of the channels of keys with curves in the dope sheet": "ドープシートでのカーブ付きキーのチャンネルの色",
}


def be_silent():
    """Forgets all translations."""
    bpy.app.translations.unregister(__package__)


def speak(language):
    """Speaks a language: AUTO is Blender's."""
    tables = bpy.app.translations
    be_silent()
    own = tables.locale or "en_US"
    locales = {"AUTO": {"ja_JP"}, "en_US": set(), "ja_JP": {"ja_JP", own}}[language]
    table = translations(tables.contexts.operator_default)
    tables.register(__package__, {locale: table for locale in locales})


def translations(operator_context, any_context="*"):
    """Returns the Japanese table for Blender: context and text, with the translation."""
    contexts = (CONTEXT, any_context, operator_context)
    return {(context, word): its for word, its in JAPANESE.items() for context in contexts}
