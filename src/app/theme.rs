//! How the application looks: greys only, so that nothing on the screen tints
//! what the eye sees next; large, plain type.

use eframe::egui::{self, Color32, FontFamily, FontId, Stroke, TextStyle, Visuals};

/// Background of the experimenter's pages (8-bit sRGB).
pub const PAGE: u8 = 226;
const CARD: u8 = 243;
const INK: Color32 = Color32::from_gray(20);
const QUIET_INK: Color32 = Color32::from_gray(84);
const LINE: Color32 = Color32::from_gray(196);

/// Side length under which nothing that can be clicked gets smaller, points.
const TARGET: f32 = 36.0;

/// Installs type sizes, spacing and colours, and switches off what would get in
/// an experiment's way.
pub fn install(ctx: &egui::Context) {
    ctx.set_theme(egui::Theme::Light);
    ctx.options_mut(|options| {
        // A zoom step would move the page under the participant's hand.
        options.zoom_with_keyboard = false;
        // egui closes the window at Ctrl+Q, which is half of the abort chord.
        options.quit_shortcuts.clear();
    });
    ctx.all_styles_mut(|style| {
        style.visuals = visuals();
        style.animation_time = 0.0;
        style.text_styles = [
            (TextStyle::Heading, 30.0),
            (TextStyle::Body, 18.0),
            (TextStyle::Button, 18.0),
            (TextStyle::Small, 15.0),
        ]
        .map(|(role, size)| (role, FontId::new(size, FontFamily::Proportional)))
        .into_iter()
        .chain([(
            TextStyle::Monospace,
            FontId::new(15.0, FontFamily::Monospace),
        )])
        .collect();
        style.spacing.item_spacing = egui::vec2(12.0, 10.0);
        style.spacing.button_padding = egui::vec2(20.0, 9.0);
        style.spacing.interact_size.y = TARGET;
        style.interaction.selectable_labels = false;
        style.interaction.tooltip_delay = 0.4;
    });
}

fn visuals() -> Visuals {
    let mut visuals = Visuals::light();
    visuals.panel_fill = Color32::from_gray(PAGE);
    visuals.window_fill = Color32::from_gray(CARD);
    visuals.extreme_bg_color = Color32::from_gray(252);
    visuals.faint_bg_color = Color32::from_gray(235);
    visuals.hyperlink_color = INK;
    visuals.warn_fg_color = INK;
    visuals.error_fg_color = INK;
    visuals.weak_text_color = Some(QUIET_INK);
    visuals.selection.bg_fill = Color32::from_gray(190);
    visuals.selection.stroke = Stroke::new(1.5, INK);
    visuals.text_cursor.stroke = Stroke::new(2.0, INK);
    visuals.text_cursor.blink = false;
    visuals.disabled_alpha = 0.45;

    let widgets = &mut visuals.widgets;
    for (widget, fill, line) in [
        (&mut widgets.noninteractive, CARD, LINE),
        (&mut widgets.inactive, 214, Color32::from_gray(150)),
        (&mut widgets.hovered, 200, Color32::from_gray(90)),
        (&mut widgets.active, 180, INK),
        (&mut widgets.open, 200, Color32::from_gray(90)),
    ] {
        widget.bg_fill = Color32::from_gray(fill);
        widget.weak_bg_fill = Color32::from_gray(fill);
        widget.bg_stroke = Stroke::new(1.0, line);
        widget.fg_stroke = Stroke::new(1.5, INK);
        widget.corner_radius = 4.into();
        widget.expansion = 0.0;
    }
    visuals
}

/// Grey behind the pictures of the stimulus browser (8-bit sRGB).
pub const BROWSER_STAGE: u8 = 96;
const BROWSER_PAGE: u8 = 58;
const BROWSER_INK: Color32 = Color32::from_gray(228);
const BROWSER_QUIET_INK: Color32 = Color32::from_gray(176);

/// Dark greys and smaller type, for judging pictures and reading much about them.
pub fn install_browser(ui: &mut egui::Ui) {
    browser_style(ui.style_mut());
}

/// The same for a whole window: lists and hints open outside of the page that asks for them.
pub fn install_browser_everywhere(ctx: &egui::Context) {
    ctx.all_styles_mut(browser_style);
}

fn browser_style(style: &mut egui::Style) {
    style.visuals = browser_visuals();
    for (role, size) in [
        (TextStyle::Heading, 19.0),
        (TextStyle::Body, 15.0),
        (TextStyle::Button, 15.0),
        (TextStyle::Small, 13.0),
    ] {
        let font = FontId::new(size, FontFamily::Proportional);
        style.text_styles.insert(role, font);
    }
    let monospace = FontId::new(12.5, FontFamily::Monospace);
    style.text_styles.insert(TextStyle::Monospace, monospace);
    style.spacing.item_spacing = egui::vec2(8.0, 6.0);
    style.spacing.button_padding = egui::vec2(10.0, 4.0);
    style.spacing.interact_size.y = 28.0;
    style.interaction.selectable_labels = true;
}

fn browser_visuals() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = Color32::from_gray(BROWSER_PAGE);
    visuals.window_fill = Color32::from_gray(BROWSER_PAGE);
    visuals.extreme_bg_color = Color32::from_gray(40);
    visuals.faint_bg_color = Color32::from_gray(66);
    visuals.hyperlink_color = BROWSER_INK;
    visuals.warn_fg_color = BROWSER_INK;
    visuals.error_fg_color = BROWSER_INK;
    visuals.weak_text_color = Some(BROWSER_QUIET_INK);
    visuals.selection.bg_fill = Color32::from_gray(112);
    visuals.selection.stroke = Stroke::new(1.5, Color32::from_gray(250));
    visuals.text_cursor.stroke = Stroke::new(2.0, BROWSER_INK);
    let widgets = &mut visuals.widgets;
    for (widget, fill, line) in [
        (&mut widgets.noninteractive, BROWSER_PAGE, 84),
        (&mut widgets.inactive, 78, 104),
        (&mut widgets.hovered, 92, 150),
        (&mut widgets.active, 112, 228),
        (&mut widgets.open, 92, 150),
    ] {
        widget.bg_fill = Color32::from_gray(fill);
        widget.weak_bg_fill = Color32::from_gray(fill);
        widget.bg_stroke = Stroke::new(1.0, Color32::from_gray(line));
        widget.fg_stroke = Stroke::new(1.5, BROWSER_INK);
        widget.corner_radius = 3.into();
        widget.expansion = 0.0;
    }
    visuals
}

/// A button that is found first: a dark field, the same on every grey.
pub fn primary_button(text: &str, min_size: egui::Vec2) -> egui::Button<'_> {
    let text = egui::RichText::new(text).color(Color32::from_gray(250));
    // Room on both sides keeps the text in the middle of a wider button.
    egui::Button::new((egui::Atom::grow(), text, egui::Atom::grow()))
        .fill(Color32::from_gray(45))
        .stroke(Stroke::new(1.0, Color32::BLACK))
        .min_size(min_size)
}

/// One point of a scale: dark while it is the one chosen.
pub fn point_button(
    ui: &mut egui::Ui,
    text: &str,
    chosen: bool,
    min_size: egui::Vec2,
) -> egui::Response {
    let (fill, ink) = if chosen { (45, 250) } else { (250, 20) };
    let label = egui::RichText::new(text).color(Color32::from_gray(ink));
    let response = ui.add(
        egui::Button::new((egui::Atom::grow(), label, egui::Atom::grow()))
            .fill(Color32::from_gray(fill))
            .stroke(Stroke::new(1.0, Color32::BLACK))
            .min_size(min_size),
    );
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::Role::RadioButton, true, chosen, text));
    response
}

/// A light card that holds one group of facts.
pub fn card() -> egui::Frame {
    egui::Frame::new()
        .fill(Color32::from_gray(CARD))
        .stroke(Stroke::new(1.0, LINE))
        .corner_radius(6)
        .inner_margin(egui::Margin::symmetric(20, 16))
}

/// Text in the quieter ink.
#[must_use]
pub fn quiet(text: impl Into<String>) -> egui::RichText {
    egui::RichText::new(text).color(QUIET_INK)
}

/// A tick in a square of side `size` points: two strokes, because the font has none.
pub fn paint_tick(painter: &egui::Painter, centre: egui::Pos2, size: f32, ink: Color32) {
    let at = |x: f32, y: f32| centre + egui::vec2(x, y) * size;
    let points = vec![at(-0.4, 0.02), at(-0.12, 0.32), at(0.4, -0.3)];
    painter.line(points, Stroke::new(size * 0.14, ink));
}

/// A cross in a square of side `size` points.
pub fn paint_cross(painter: &egui::Painter, centre: egui::Pos2, size: f32, ink: Color32) {
    let reach = egui::vec2(size, size) * 0.32;
    let across = egui::vec2(reach.x, -reach.y);
    let stroke = Stroke::new(size * 0.14, ink);
    for way in [reach, across] {
        painter.line_segment([centre - way, centre + way], stroke);
    }
}

/// A tick or a cross in front of a line of text.
pub fn mark(ui: &mut egui::Ui, good: bool) {
    let size = ui.text_style_height(&TextStyle::Body) * 0.8;
    let (rect, _) = ui.allocate_exact_size(egui::vec2(size, size), egui::Sense::hover());
    let centre = rect.center();
    if good {
        paint_tick(ui.painter(), centre, size, INK);
    } else {
        paint_cross(ui.painter(), centre, size, INK);
    }
}

/// Ink that can be read on a grey level: black or white, whichever contrasts more.
///
/// The two contrasts (WCAG 2.2, relative luminance `L`), `(L + 0.05) / 0.05`
/// and `1.05 / (L + 0.05)`, are equal at `L = 0.179`, sRGB level 117.6.
#[must_use]
pub fn ink_on(level: u8) -> Color32 {
    if level >= 118 {
        Color32::BLACK
    } else {
        Color32::WHITE
    }
}

/// Level of a card on a grey level: away from the ink, near the grey.
#[must_use]
pub fn card_on(level: u8) -> u8 {
    if ink_on(level) == Color32::BLACK {
        level.saturating_add(44)
    } else {
        level.saturating_sub(44)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(level: u8) -> f64 {
        let value = f64::from(level) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    }

    #[test]
    fn text_on_any_grey_reaches_the_contrast_of_wcag_aa() {
        for level in 0..=255 {
            let card = luminance(card_on(level));
            let (low, high) = match ink_on(level) {
                Color32::BLACK => (0.0, card),
                _ => (card, 1.0),
            };
            let contrast = (high + 0.05) / (low + 0.05);
            assert!(contrast >= 4.5, "level {level}: {contrast:.2}");
        }
    }

    #[test]
    fn every_colour_is_a_grey() {
        for visuals in [visuals(), browser_visuals()] {
            assert_grey(&visuals);
        }
    }

    fn assert_grey(visuals: &Visuals) {
        let widgets = &visuals.widgets;
        let colours = [
            visuals.panel_fill,
            visuals.extreme_bg_color,
            visuals.error_fg_color,
            visuals.warn_fg_color,
            visuals.hyperlink_color,
            visuals.selection.bg_fill,
            visuals.selection.stroke.color,
            visuals.text_cursor.stroke.color,
        ]
        .into_iter()
        .chain(
            [
                &widgets.noninteractive,
                &widgets.inactive,
                &widgets.hovered,
                &widgets.active,
                &widgets.open,
            ]
            .into_iter()
            .flat_map(|w| {
                [
                    w.bg_fill,
                    w.weak_bg_fill,
                    w.bg_stroke.color,
                    w.fg_stroke.color,
                ]
            }),
        );
        for colour in colours {
            assert!(
                colour.r() == colour.g() && colour.g() == colour.b(),
                "{colour:?}"
            );
        }
    }
}
