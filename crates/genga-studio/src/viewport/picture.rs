//! A reference picture (参考映像), in a view of its own or behind the figures.

use egui::{Align2, Color32, FontId, Id, Painter, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::view_state::Shown;

/// Opacity of a picture behind the figures.
pub(super) const BEHIND: f32 = 0.55;

/// Shows the picture of the current koma in a view of its own.
pub(super) fn show(ui: &mut Ui, rect: Rect, shown: &Shown<'_>) {
    let (painter, look, words) = (ui.painter_at(rect), &shown.look, shown.words);
    painter.rect_filled(rect, 4.0, look.ground);
    draw(&painter, rect, 1.0, shown);
    let name = words.say("Reference", "参考");
    let at = rect.min + vec2(10.0, 8.0);
    painter.text(at, Align2::LEFT_TOP, name, FontId::proportional(14.0), look.ink);
    let at = pos2(rect.min.x + 10.0, rect.max.y - 8.0);
    let standing = standing(shown);
    painter.text(at, Align2::LEFT_BOTTOM, &standing, FontId::proportional(12.0), look.faint);
    let response = ui.interact(rect, Id::unique("footage"), Sense::hover());
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(standing.clone()),
        ..WidgetInfo::labeled(Role::Canvas, true, name)
    });
}

/// Draws the picture as large as fits. `share` is its opacity.
pub(super) fn draw(painter: &Painter, rect: Rect, share: f32, shown: &Shown<'_>) {
    let Some((texture, size)) = shown.beside.picture else { return };
    let scale = (rect.size() / size).min_elem();
    let place = Rect::from_center_size(rect.center(), size * scale);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(texture, place, whole, Color32::WHITE.gamma_multiply(share));
}

/// Describes which picture is shown, or why there is none.
fn standing(shown: &Shown<'_>) -> String {
    let (beside, words) = (&shown.beside, shown.words);
    match (beside.number, beside.pictures) {
        (Some(number), Some(of)) => {
            format!("{} {} / {of}", words.say("picture", "画像"), number + 1)
        }
        (None, Some(of)) if of > 0 => {
            words.say("no picture on this koma", "このコマに画像なし").into()
        }
        _ => words.say("no pictures yet", "画像なし").into(),
    }
}
