//! `KHR_lights_punctual`.

use glam::{Affine3A, Vec3};
use gltf::json;
use gltf::json::extensions::scene::khr_lights_punctual::{Light, Type};
use gltf::json::validation::Checked;

use super::super::error::Fault;
use super::document::{Document, look_up};
use super::node::Nodes;
use crate::scene::geometry::ModelLights;
use crate::scene::{Cone, PointLight, Sun};

/// Adds the node's light, if it has one.
pub(super) fn read(
    document: &Document,
    node: usize,
    nodes: &Nodes,
    lights: &mut ModelLights,
) -> Result<(), Fault> {
    let extensions = document.root.nodes[node].extensions.as_ref();
    let Some(reference) = extensions.and_then(|e| e.khr_lights_punctual.as_ref()) else {
        return Ok(());
    };
    let all = defined(&document.root);
    let light = look_up(
        all,
        reference.light,
        "light",
        &format!("nodes[{node}].extensions"),
    )?;
    let place = format!(
        "extensions.KHR_lights_punctual.lights[{}]",
        reference.light.value()
    );
    let Checked::Valid(kind) = light.type_ else {
        let message = "its type is none of directional, point and spot";
        return Err(Fault::new(place, message));
    };
    let strength = Vec3::from(light.color) * light.intensity;
    if !strength.is_finite() || strength.min_element() < 0.0 {
        let message =
            format!("its colour times its intensity is {strength}; allowed is 0 and more");
        return Err(Fault::new(place, message));
    }
    let world = nodes.world[node];
    // A light shines along its own −Z.
    let along = Vec3::from(world.matrix3 * -glam::Vec3A::Z).normalize_or(Vec3::NEG_Z);
    if kind == Type::Directional {
        lights.suns.push(Sun {
            towards: -along,
            irradiance: strength,
            casts_shadows: true,
        });
    } else {
        lights.points.push(PointLight {
            position_m: position(&world),
            intensity: strength,
            cone: (kind == Type::Spot).then(|| cone(light, along)),
        });
    }
    Ok(())
}

fn defined(root: &json::Root) -> &[Light] {
    let extensions = root.extensions.as_ref();
    extensions
        .and_then(|e| e.khr_lights_punctual.as_ref())
        .map_or(&[], |lights| lights.lights.as_slice())
}

fn position(world: &Affine3A) -> Vec3 {
    world.translation.into()
}

/// The cone, with angles that are in order even if the file's are not.
fn cone(light: &Light, along: Vec3) -> Cone {
    const NARROWEST_RAD: f32 = 1e-3;
    let (inner, outer) = light
        .spot
        .as_ref()
        .map_or((0.0, std::f32::consts::FRAC_PI_4), |spot| {
            (spot.inner_cone_angle, spot.outer_cone_angle)
        });
    let outer_rad = outer.clamp(NARROWEST_RAD, std::f32::consts::FRAC_PI_2);
    Cone {
        along,
        inner_rad: inner.clamp(0.0, outer_rad - NARROWEST_RAD / 2.0),
        outer_rad,
    }
}
