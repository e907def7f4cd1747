//! The pose of the nodes at one moment of one animation.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use glam::{Quat, Vec3};
use gltf::json;
use gltf::json::animation::{Interpolation, Property};
use gltf::json::validation::Checked;

use super::super::error::Fault;
use super::super::{AnimationChoice, AnimationReport};
use super::accessor::Accessor;
use super::document::{Document, look_up};
use super::node::NodePose;

/// Most key frames of one channel.
const MOST_KEYS: u64 = 10_000_000;

/// What the file has to choose from.
pub(super) fn reports(document: &Document) -> Result<Vec<AnimationReport>, Fault> {
    let mut times = Times::default();
    let animations = document.root.animations.iter().enumerate();
    animations
        .map(|(index, animation)| {
            let mut duration_s = 0.0_f32;
            for (s, sampler) in animation.samplers.iter().enumerate() {
                let place = format!("animations[{index}].samplers[{s}].input");
                let keys = times.read(document, sampler.input, &place)?;
                duration_s = duration_s.max(keys.last().copied().unwrap_or_default());
            }
            Ok(AnimationReport {
                name: animation.name.clone().unwrap_or_default(),
                duration_s,
                channels: animation.channels.len(),
            })
        })
        .collect()
}

/// The animation of that name or number.
pub(super) fn find(document: &Document, choice: &AnimationChoice) -> Result<usize, Fault> {
    let animations = &document.root.animations;
    let found = match choice {
        AnimationChoice::Index(index) => (*index < animations.len()).then_some(*index),
        AnimationChoice::Name(name) => animations
            .iter()
            .position(|animation| animation.name.as_ref() == Some(name)),
    };
    found.ok_or_else(|| {
        let wanted = match choice {
            AnimationChoice::Index(index) => format!("animation {index}"),
            AnimationChoice::Name(name) => format!("the animation \"{name}\""),
        };
        let known: Vec<String> = animations
            .iter()
            .take(20)
            .enumerate()
            .map(|(i, a)| format!("{i} \"{}\"", a.name.as_deref().unwrap_or_default()))
            .collect();
        let known = if known.is_empty() {
            String::from("none")
        } else {
            known.join(", ")
        };
        Fault::new(
            "animations",
            format!("{wanted} is asked for; the file has: {known}"),
        )
    })
}

/// Moves `pose` to `time_s` of an animation; before its first key and after its last
/// it stands still.
pub(super) fn apply(
    document: &Document,
    animation: usize,
    time_s: f32,
    pose: &mut [NodePose],
) -> Result<(), Fault> {
    let mut times = Times::default();
    let json = &document.root.animations[animation];
    for (c, channel) in json.channels.iter().enumerate() {
        let place = format!("animations[{animation}].channels[{c}]");
        let sampler = look_up(&json.samplers, channel.sampler, "sampler", &place)?;
        look_up(&document.root.nodes, channel.target.node, "node", &place)?;
        let node = &mut pose[channel.target.node.value()];
        let Checked::Valid(property) = channel.target.path else {
            let message = "is none of translation, rotation, scale and weights";
            return Err(Fault::new(format!("{place}.target.path"), message));
        };
        let keys = times.read(document, sampler.input, &place)?;
        let track = Track::open(document, sampler, keys, property, &place)?;
        let value = track.at(time_s)?;
        let three = || Vec3::new(value[0], value[1], value[2]);
        match property {
            Property::Translation => *node.placement.parts().0 = three(),
            Property::Rotation => {
                let [x, y, z, w] = [0, 1, 2, 3].map(|k| value[k]);
                *node.placement.parts().1 = Quat::from_xyzw(x, y, z, w);
            }
            Property::Scale => *node.placement.parts().2 = three(),
            Property::MorphTargetWeights => node.weights = Some(value),
        }
    }
    Ok(())
}

/// Key times by accessor: many channels share one.
#[derive(Default)]
struct Times {
    known: BTreeMap<usize, Vec<f32>>,
}

impl Times {
    fn read(
        &mut self,
        document: &Document,
        input: json::Index<json::Accessor>,
        user: &str,
    ) -> Result<&[f32], Fault> {
        match self.known.entry(input.value()) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(new) => Ok(new.insert(key_times(document, input, user)?)),
        }
    }
}

/// Reads and checks the key times of a sampler.
fn key_times(
    document: &Document,
    input: json::Index<json::Accessor>,
    user: &str,
) -> Result<Vec<f32>, Fault> {
    let accessor = Accessor::open(document, input, user)?;
    if !(1..=MOST_KEYS).contains(&accessor.count) {
        let message = format!(
            "{} key frames; 1 to {MOST_KEYS} are allowed",
            accessor.count
        );
        return Err(Fault::new(&accessor.place, message));
    }
    let mut times: Vec<f32> = Vec::new();
    accessor.for_each_float(|i, [time_s]| {
        if times.last().is_some_and(|&last| time_s < last) {
            let message = format!("key frame {i} is at {time_s} s, before the one before it");
            return Err(Fault::new(&accessor.place, message));
        }
        times.push(time_s);
        Ok(())
    })?;
    Ok(times)
}

/// The values of one property over time.
struct Track<'a> {
    times: &'a [f32],
    values: Accessor<'a>,
    interpolation: Interpolation,
    property: Property,
    /// Numbers a key frame.
    width: u64,
}

impl<'a> Track<'a> {
    fn open(
        document: &'a Document,
        sampler: &json::animation::Sampler,
        times: &'a [f32],
        property: Property,
        place: &str,
    ) -> Result<Self, Fault> {
        let Checked::Valid(interpolation) = sampler.interpolation else {
            let message = "its sampler's interpolation is none of LINEAR, STEP and CUBICSPLINE";
            return Err(Fault::new(place, message));
        };
        let values = Accessor::open(document, sampler.output, place)?;
        // A cubic spline has a tangent before and after each value.
        let elements_a_key = if interpolation == Interpolation::CubicSpline {
            3
        } else {
            1
        };
        let keys = times.len() as u64 * elements_a_key;
        let (components, width) = match property {
            Property::Translation | Property::Scale => (3, 3),
            Property::Rotation => (4, 4),
            Property::MorphTargetWeights => (1, values.count / keys),
        };
        if values.components != components {
            let message = format!(
                "{} has {} numbers an element; {components} are needed",
                values.place, values.components
            );
            return Err(Fault::new(place, message));
        }
        values.expect_count(keys * width / components as u64, place)?;
        Ok(Self {
            times,
            values,
            interpolation,
            property,
            width,
        })
    }

    /// The value at a moment (glTF 2.0, appendix C).
    fn at(&self, time_s: f32) -> Result<Vec<f32>, Fault> {
        let last = self.times.len() - 1;
        let time_s = time_s.clamp(self.times[0], self.times[last]);
        let key = self
            .times
            .partition_point(|&t| t <= time_s)
            .saturating_sub(1);
        let span_s = self.times[(key + 1).min(last)] - self.times[key];
        let t = (time_s - self.times[key]) / span_s;
        let still = key == last || span_s <= 0.0;
        match self.interpolation {
            Interpolation::CubicSpline if still => self.element(3 * key + 1),
            Interpolation::CubicSpline => {
                let [from, leaving, arriving, to] =
                    [3 * key + 1, 3 * key + 2, 3 * key + 3, 3 * key + 4].map(|i| self.element(i));
                Ok(hermite([&from?, &leaving?, &arriving?, &to?], t, span_s))
            }
            Interpolation::Linear if !still => {
                let (from, to) = (self.element(key)?, self.element(key + 1)?);
                if self.property == Property::Rotation {
                    return Ok(slerp(&from, &to, t));
                }
                Ok(from.iter().zip(&to).map(|(a, b)| a + (b - a) * t).collect())
            }
            Interpolation::Linear | Interpolation::Step => self.element(key),
        }
    }

    fn element(&self, index: usize) -> Result<Vec<f32>, Fault> {
        let elements = self.width / self.values.components as u64;
        let first = index as u64 * elements;
        let mut value = Vec::new();
        self.values
            .for_each_float_in(first..first + elements, |_, numbers| {
                value.extend_from_slice(numbers);
                Ok(())
            })?;
        Ok(value)
    }
}

/// Cubic Hermite spline from value to value, tangents given per second.
fn hermite([from, leaving, arriving, to]: [&[f32]; 4], t: f32, span_s: f32) -> Vec<f32> {
    let (t2, t3) = (t * t, t * t * t);
    (0..from.len())
        .map(|k| {
            from[k] * (2.0 * t3 - 3.0 * t2 + 1.0)
                + leaving[k] * span_s * (t3 - 2.0 * t2 + t)
                + to[k] * (3.0 * t2 - 2.0 * t3)
                + arriving[k] * span_s * (t3 - t2)
        })
        .collect()
}

/// Along the shorter great arc (Shoemake 1985), the same bits on every machine.
fn slerp(from: &[f32], to: &[f32], t: f32) -> Vec<f32> {
    let dot: f32 = from.iter().zip(to).map(|(a, b)| a * b).sum();
    let (dot, sign) = if dot < 0.0 { (-dot, -1.0) } else { (dot, 1.0) };
    let (a, b) = if dot > 0.9995 {
        (1.0 - t, t)
    } else {
        let angle_rad = libm::acosf(dot);
        let whole = libm::sinf(angle_rad);
        (
            libm::sinf((1.0 - t) * angle_rad) / whole,
            libm::sinf(t * angle_rad) / whole,
        )
    };
    from.iter()
        .zip(to)
        .map(|(p, q)| a * p + b * sign * q)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slerp_halves_a_quarter_turn_and_takes_the_shorter_way() {
        let eighth = (
            std::f32::consts::FRAC_PI_8.sin(),
            std::f32::consts::FRAC_PI_8.cos(),
        );
        let quarter = std::f32::consts::FRAC_1_SQRT_2;
        for sign in [1.0, -1.0] {
            let to = [0.0, sign * quarter, 0.0, sign * quarter];
            let half = slerp(&[0.0, 0.0, 0.0, 1.0], &to, 0.5);
            assert!((half[1] - eighth.0).abs() < 1e-6 && (half[3] - eighth.1).abs() < 1e-6);
        }
    }

    /// A Hermite spline through a cubic's values and slopes is that cubic.
    #[test]
    fn hermite_reproduces_a_cubic() {
        let cubic = |x: f32| x * x * x - 2.0 * x + 1.0;
        let slope = |x: f32| 3.0 * x * x - 2.0;
        let (x0, x1) = (0.5_f32, 2.0_f32);
        let value = hermite(
            [&[cubic(x0)], &[slope(x0)], &[slope(x1)], &[cubic(x1)]],
            0.4,
            x1 - x0,
        );
        assert!((value[0] - cubic(x0 + 0.4 * (x1 - x0))).abs() < 1e-5);
    }
}
