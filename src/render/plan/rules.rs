//! The rules: what calls for each effect, or why nothing does.

use super::super::technique::{self, Noise};
use super::planner::Planner;
use crate::scene::{Ambient, Background, ToneMap};

/// Called for, and by what; or not called for, and why not.
pub(super) type Asked = Result<String, String>;

impl Planner<'_> {
    pub(super) fn occludes(&self) -> Asked {
        let settings = &self.request.occlusion;
        let technique = format!("the technique is `{}`", settings.label);
        if settings.technique.is_handed_in() {
            return Ok(technique + ": computed by ray tracing on the processor, handed in");
        }
        match settings.technique.shader {
            Some(_) if self.request.has_directional() => {
                Ok(technique
                    + ": it says by direction and colour what the ambient light changes by")
            }
            Some(_) => Ok(technique),
            None => Err(technique),
        }
    }

    /// Whether the ambient term gets light between surfaces.
    pub(super) fn reflects_between(&self) -> Asked {
        let settings = &self.request.occlusion;
        let label = &settings.label;
        match settings.inter_reflection() {
            Some((model, _)) => Ok(format!(
                "`{label}` asks for light between surfaces by the model `{}`",
                model.name
            )),
            None if settings.technique.openness().is_some() => {
                Err(format!("`{label}` asks for no model of it"))
            }
            None => Err(format!(
                "technique `{}` estimates no openness that a model could start from",
                settings.technique.name
            )),
        }
    }

    pub(super) fn blurs(&self) -> Asked {
        self.occludes()?;
        let noise = match self.request.occlusion.technique.noise {
            Noise::None => return Err(String::from("the technique's estimate has no noise")),
            Noise::Tile => "in a 4×4 tile",
            Noise::Hilbert => "along a Hilbert curve",
        };
        match self.request.blur_radius_px {
            0 => Err(String::from("the scene's blur_radius_px is 0")),
            radius => Ok(format!(
                "the samples turn from pixel to pixel {noise}; the scene asks for a blur of {radius} px"
            )),
        }
    }

    /// Whether there is a target for the bent cone; `None` for a technique that gives none.
    pub(super) fn keeps_cone(&self) -> Option<Asked> {
        let request = self.request;
        let settings = &request.occlusion;
        let is_on = settings.is(technique::BENT_CONE, "on");
        settings.technique.gives_cone.then(|| {
            match (request.lights_through_cone(), request.keeps_cone) {
                (true, _) => Ok(String::from(
                    "the environment's light comes in through its bent cone",
                )),
                (false, true) => Ok(String::from("its bent cone is kept to be read")),
                (false, false) if is_on => Err(String::from(
                    "constant ambient light is the same through any cone",
                )),
                (false, false) if request.has_directional() => {
                    Err(String::from("the technique answers by direction already"))
                }
                (false, false) => Err(String::from("the technique's `bent_cone` is off")),
            }
        })
    }

    /// Whether there is anything for a technique's proxies to stand for.
    pub(super) fn fits_proxies(&self) -> Asked {
        let settings = &self.request.occlusion;
        let name = settings.technique.name;
        let asked = settings.get(technique::PROXIES);
        match (asked as usize, self.geometry.triangles) {
            (0, _) => Err(format!("technique `{name}`: its parameter `proxies` is 0")),
            (_, 0) => Err(format!(
                "technique `{name}`, parameter `proxies`: found {asked}, but the scene has no triangles to fit spheres to"
            )),
            (count, _) => Ok(format!("{count} spheres in place of the scene's triangles")),
        }
    }

    pub(super) fn sun(&self) -> Asked {
        match self.request.lighting.sun {
            Some(_) => Ok(String::from("the lighting has a directional light")),
            None => Err(String::from("the lighting has no directional light")),
        }
    }

    pub(super) fn casts_shadows(&self) -> Asked {
        self.sun()?;
        let casts = self
            .request
            .lighting
            .sun
            .as_ref()
            .is_some_and(|sun| sun.casts_shadows);
        match (casts, self.geometry.triangles) {
            (false, _) => Err(String::from("the directional light casts no shadows")),
            (true, 0) => Err(String::from("there is no surface to cast a shadow")),
            (true, _) => Ok(String::from("the directional light casts shadows")),
        }
    }

    pub(super) fn points(&self) -> Asked {
        match self.request.lighting.points.len() {
            0 => Err(String::from("the lighting has no point light")),
            1 => Ok(String::from("the lighting has a point light")),
            count => Ok(format!("the lighting has {count} point lights")),
        }
    }

    pub(super) fn reflects(&self) -> Asked {
        if self.request.lighting.reflections {
            Ok(String::from(
                "the lighting asks for reflections of the environment",
            ))
        } else {
            Err(String::from("the lighting asks for none"))
        }
    }

    pub(super) fn sky(&self) -> Asked {
        if self.request.lighting.background != Background::Environment {
            return Err(String::from("the background is one colour"));
        }
        match self.geometry.uncovered {
            Some(true) => Ok(String::from("some pixels show no surface")),
            Some(false) => Err(String::from("surfaces cover every pixel")),
            None => Ok(String::from(
                "the background is the environment (left out if the depth shows that surfaces cover every pixel)",
            )),
        }
    }

    pub(super) fn emits(&self) -> Asked {
        if self.geometry.emits {
            Ok(String::from("a material sends out light"))
        } else {
            Err(String::from("no material sends out light"))
        }
    }

    pub(super) fn bakes(&self) -> Asked {
        match (
            self.request.baked_occlusion,
            self.geometry.has_baked_occlusion,
        ) {
            (true, true) => Ok(String::from(
                "the scene asks for the model's baked occlusion",
            )),
            (true, false) => Err(String::from("no material has any")),
            (false, _) => Err(String::from(
                "the scene does not ask for it: it would count beside the computed one",
            )),
        }
    }

    /// Whether the frame is ambient light before a colour and nothing else, none of it
    /// brighter than white: then no radiance needs keeping.
    pub(super) fn is_plain(&self) -> bool {
        let lighting = &self.request.lighting;
        !self.request.all_effects
            && matches!(lighting.ambient, Ambient::Constant(_))
            && lighting.tone_map == ToneMap::None
            && [
                self.sun(),
                self.points(),
                self.reflects(),
                self.emits(),
                self.sky(),
            ]
            .iter()
            .all(Result::is_err)
    }

    /// Whether anything reads the surfaces' normals; what does.
    pub(super) fn reads_normals(&self) -> Asked {
        let readers: Vec<&str> = [
            (self.occludes().is_ok(), "the occlusion"),
            (
                self.request.lighting.ambient == Ambient::Environment,
                "the environment's light",
            ),
            (self.reflects().is_ok(), "reflections"),
            (self.sun().is_ok(), "the directional light"),
            (self.points().is_ok(), "the point lights"),
        ]
        .into_iter()
        .filter_map(|(needed, by)| needed.then_some(by))
        .collect();
        if readers.is_empty() {
            Err(String::from(
                "constant ambient light alone depends on no normal",
            ))
        } else {
            Ok(readers.join(", "))
        }
    }

    /// Whether normal maps are read, given whether normals are.
    pub(super) fn maps_normals(&self, reads_normals: bool) -> Result<(), &'static str> {
        match (self.geometry.has_normal_maps, reads_normals) {
            (false, _) => Err("no material has a normal map"),
            (true, false) => Err("nothing reads normals"),
            (true, true) => Ok(()),
        }
    }
}
