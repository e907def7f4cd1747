//! The side panel: one control a setting, the pins, and the pair.

use std::ops::RangeInclusive;

use eframe::egui::{
    Button, CollapsingHeader, ComboBox, ScrollArea, Slider, SliderClamping, TextEdit, Ui,
};

use super::knobs::{Knobs, WIDEST_BLUR_PX};
use super::numbers::short;
use super::result::Slot;
use super::{Tuner, percent};
use crate::config::ParameterValue;
use crate::cost::Resolution;
use crate::render::technique::{Parameter, Range, SettingsError};

/// From which ratio of its ends on a slider is logarithmic.
const WIDE: f64 = 50.0;

/// Draws the panel and does what it asks.
pub(super) fn show(tuner: &mut Tuner, ui: &mut Ui) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // Room for the number and the name beside each slider.
        ui.spacing_mut().slider_width = (ui.available_width() - 200.0).max(80.0);
        if let Some(knobs) = &mut tuner.knobs {
            let before = (state(knobs), knobs.lighting.clone());
            let refused = all_knobs(
                ui,
                knobs,
                &tuner.tuning.scene.lightings.keys().collect::<Vec<_>>(),
            );
            let after = (state(knobs), knobs.lighting.clone());
            if let Err(error) = refused {
                tuner.refusal = Some(error.message);
            } else if before != after {
                tuner.refusal = None;
            }
            if before.1 != after.1 {
                tuner.measure_all();
            } else if before != after {
                tuner.measure();
            }
        }
        if let Some(refusal) = &tuner.refusal {
            ui.label(refusal);
        }
        ui.separator();
        truth(tuner, ui);
        ui.separator();
        pins(tuner, ui);
        ui.separator();
        progress(tuner, ui);
    });
}

/// Everything that a measurement depends on but the light.
fn state(knobs: &Knobs) -> (String, u32) {
    let configuration = knobs.configuration();
    let name = configuration.settings.technique.name;
    let text = format!("{name} {}", configuration.parameters());
    (text, configuration.blur_radius_px)
}

fn all_knobs(ui: &mut Ui, knobs: &mut Knobs, lightings: &[&String]) -> Result<(), SettingsError> {
    technique(ui, knobs);
    let runs = knobs.settings().technique.shader.is_some();
    let done = [samples(ui, knobs), radius(ui, knobs), resolution(ui, knobs)];
    ui.add_enabled(
        runs,
        Slider::new(&mut knobs.blur_radius_px, 0..=WIDEST_BLUR_PX)
            .text("Blur radius")
            .suffix(" px"),
    );
    ComboBox::from_label("Lighting")
        .selected_text(knobs.lighting.clone())
        .show_ui(ui, |ui| {
            for lighting in lightings {
                ui.selectable_value(&mut knobs.lighting, (*lighting).clone(), lighting.as_str());
            }
        });
    let further = CollapsingHeader::new("All parameters")
        .show(ui, |ui| further(ui, knobs))
        .body_returned
        .unwrap_or(Ok(()));
    done.into_iter().collect::<Result<(), _>>().and(further)
}

fn technique(ui: &mut Ui, knobs: &mut Knobs) {
    let chosen = knobs.settings().technique;
    let mut next = chosen.name;
    ComboBox::from_label("Technique")
        .height(440.0)
        .selected_text(chosen.name)
        .show_ui(ui, |ui| {
            for technique in knobs.techniques() {
                ui.selectable_value(&mut next, technique.name, technique.name)
                    .on_hover_text(technique.summary);
            }
        });
    if next != chosen.name {
        knobs.choose(next);
    }
    ui.weak(knobs.settings().technique.summary);
}

/// A slider over the numbers of samples that there are, which stand at uneven distances.
fn samples(ui: &mut Ui, knobs: &mut Knobs) -> Result<(), SettingsError> {
    let counts = knobs.counts();
    let (Some(&low), Some(&high)) = (counts.first(), counts.last()) else {
        ui.weak("It takes no samples.");
        return Ok(());
    };
    let mut done = Ok(());
    let is_dragged = ui.input(|input| input.pointer.any_down() || input.pointer.any_released());
    let (low, high) = (f64::from(low), f64::from(high));
    let slider = Slider::from_get_set(low..=high, |new| {
        let now = f64::from(knobs.settings().taps());
        if let Some(wanted) = new.filter(|new| *new != now) {
            done = knobs.set_samples(wanted);
            // A key goes one step, which may end nearer to where it began than to the next.
            if !is_dragged
                && f64::from(knobs.settings().taps()) == now
                && let Some(next) = knobs.neighbour(wanted > now)
            {
                done = knobs.set_samples(f64::from(next));
            }
        }
        f64::from(knobs.settings().taps())
    });
    ui.add(slider.integer().logarithmic(true).text("Samples"));
    done
}

fn radius(ui: &mut Ui, knobs: &mut Knobs) -> Result<(), SettingsError> {
    let technique = knobs.settings().technique;
    let (Some(reach), Some(mut reach_m)) = (technique.reach, knobs.reach_m()) else {
        if technique.shader.is_some() {
            ui.weak("It has no radius in metres; see all parameters.");
        }
        return Ok(());
    };
    let before = reach_m;
    let scale = positive(knobs.opened(reach));
    ui.add(
        Slider::new(&mut reach_m, scale / 100.0..=scale * 20.0)
            .logarithmic(true)
            .clamping(SliderClamping::Never)
            .text("Radius")
            .suffix(" m"),
    );
    match reach_m == before {
        true => Ok(()),
        false => knobs.set_reach_m(reach_m),
    }
}

fn resolution(ui: &mut Ui, knobs: &mut Knobs) -> Result<(), SettingsError> {
    if knobs.settings().technique.shader.is_none() {
        return Ok(());
    }
    let before = knobs.configuration().resolution();
    let mut after = before;
    ui.horizontal(|ui| {
        ui.selectable_value(&mut after, Resolution::Full, "Full");
        ui.selectable_value(&mut after, Resolution::Half, "Half");
        ui.label("Resolution");
    });
    match after == before {
        true => Ok(()),
        false => knobs.set("resolution", after.name()),
    }
}

/// Every parameter that has no control of its own.
fn further(ui: &mut Ui, knobs: &mut Knobs) -> Result<(), SettingsError> {
    let mut done = Ok(());
    let mut is_none = true;
    for parameter in knobs.further() {
        is_none = false;
        let one = match parameter.range {
            Range::Number {
                unit,
                low,
                high,
                multiple_of,
                ..
            } => number(ui, knobs, parameter, unit, (low, high), multiple_of),
            Range::Choice(words) => choice(ui, knobs, parameter, words),
        };
        done = done.and(one);
    }
    if is_none {
        ui.weak("There are no others.");
    }
    done
}

fn number(
    ui: &mut Ui,
    knobs: &mut Knobs,
    parameter: &Parameter,
    unit: &str,
    (low, high): (f64, f64),
    multiple_of: f64,
) -> Result<(), SettingsError> {
    let name = parameter.name;
    let before = knobs.settings().get(name);
    let mut value = before;
    let scale = positive(knobs.opened(name));
    let range = slider_range(low, high, scale);
    let is_wide = *range.end() > WIDE * range.start().max(scale / 20.0);
    let mut slider = Slider::new(&mut value, range)
        .logarithmic(is_wide)
        .smallest_positive(scale / 1000.0)
        // What lies beyond the slider can be typed; the technique says what it takes.
        .clamping(SliderClamping::Never)
        .text(name);
    if multiple_of > 0.0 {
        slider = slider.step_by(multiple_of).max_decimals(0);
    }
    if !unit.is_empty() {
        slider = slider.suffix(format!(" {unit}"));
    }
    ui.add(slider).on_hover_text(parameter.meaning);
    match value == before {
        true => Ok(()),
        false => knobs.set(name, value),
    }
}

/// The part of a parameter's range that a slider covers: all of it, unless that would leave
/// no room for the values in use.
fn slider_range(low: f64, high: f64, scale: f64) -> RangeInclusive<f64> {
    low..=high.min((scale * 100.0).max(1.0))
}

/// What a slider is scaled by, where the value itself may be 0.
fn positive(value: f64) -> f64 {
    if value > 0.0 { value } else { 1.0 }
}

fn choice(
    ui: &mut Ui,
    knobs: &mut Knobs,
    parameter: &Parameter,
    words: &[&'static str],
) -> Result<(), SettingsError> {
    let place = knobs.settings().get(parameter.name) as usize;
    let before = words.get(place).copied().unwrap_or_default();
    let mut after = before;
    ComboBox::from_label(parameter.name)
        .selected_text(before)
        .show_ui(ui, |ui| {
            for word in words {
                ui.selectable_value(&mut after, word, *word);
            }
        })
        .response
        .on_hover_text(parameter.meaning);
    match after == before {
        true => Ok(()),
        false => knobs.set(parameter.name, ParameterValue::from(after)),
    }
}

/// Which truth everything is measured against.
fn truth(tuner: &mut Tuner, ui: &mut Ui) {
    let (truth_m, scene_m) = (tuner.bench.reach_m, tuner.tuning.reach_m);
    ui.label(format!(
        "Measured against the truth within {} m",
        short(truth_m)
    ));
    let radius_m = tuner.knobs.as_ref().and_then(Knobs::reach_m);
    let other = radius_m.filter(|radius_m| *radius_m > 0.0 && *radius_m != truth_m);
    let mut next = None;
    let button = Button::new("Trace the truth at this radius");
    let response = ui
        .add_enabled(other.is_some(), button)
        .on_hover_text("Until then the radius is the technique's alone")
        .on_disabled_hover_text("It is traced at this radius, or there is none");
    if response.clicked() {
        next = other;
    }
    if truth_m != scene_m
        && ui
            .button(format!("Back to the scene's {} m", short(scene_m)))
            .clicked()
    {
        next = Some(scene_m);
    }
    if let Some(reach_m) = next {
        tuner.bench.reach_m = reach_m;
        tuner.measure_all();
    }
}

fn pins(tuner: &mut Tuner, ui: &mut Ui) {
    let can_pin = tuner.knobs.is_some();
    ui.horizontal(|ui| {
        for (slot, name) in [(Slot::A, "Pin as A"), (Slot::B, "Pin as B")] {
            if ui.add_enabled(can_pin, Button::new(name)).clicked() {
                tuner.pin(slot);
            }
        }
    });
    let is_pair = tuner.pinned().is_some();
    ui.horizontal(|ui| {
        let label = ui.label("Set file");
        let field = TextEdit::singleline(&mut tuner.pair.file).desired_width(f32::INFINITY);
        ui.add(field).labelled_by(label.id);
    });
    let trouble = tuner.blur_trouble();
    let can_write = is_pair && trouble.is_none();
    let response = ui
        .add_enabled(can_write, Button::new("Make a stimulus pair"))
        .on_hover_text("Writes a stimulus set beside the scene, with A and B as its one condition")
        .on_disabled_hover_text("Pin an A and a B first");
    if response.clicked() {
        tuner.write_pair();
    }
    if let Some(trouble) = trouble {
        ui.label(trouble);
        let scene_px = tuner.tuning.scene.occlusion.blur_radius_px;
        if ui
            .button(format!("Blur A and B by {scene_px} px"))
            .clicked()
        {
            tuner.blur_as_the_scene();
        }
    }
    if let Some(outcome) = &tuner.pair.outcome {
        ui.label(outcome);
    }
}

/// What takes long, and what could not be done, while there is still a picture.
fn progress(tuner: &Tuner, ui: &mut Ui) {
    if tuner.bench.shown(Slot::Now).is_none() {
        // The stage says it in the place of the first picture.
        return;
    }
    if let Some(trouble) = &tuner.bench.trouble {
        ui.label(trouble);
        return;
    }
    match &tuner.bench.progress {
        Some((what, share)) => {
            ui.weak(format!("{what} …"));
            if let Some(share) = share {
                ui.add(percent(*share));
            }
        }
        None if tuner.is_measuring() => {
            ui.weak("measuring …");
        }
        None => {}
    }
}
