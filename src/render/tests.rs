//! Frames of scenes whose answer is known, on whatever adapter there is.

use super::technique::{Range, Settings, TECHNIQUES};
use super::testing::{
    assert_level, brightest, draw, floor, floor_and_wall, matte, pixel_of, renderer, request, rgb,
    srgb8,
};
use super::*;
use crate::scene::primitives::{cuboid, of_one_material, quad};
use crate::scene::{
    Ambient, Background, Cone, Geometry, Material, Mesh, PointLight, Sun, Texture, TextureEncoding,
    TextureUse, Wrap,
};

mod bent_cones;
mod cone_twins;
mod display;
mod effects;
mod environments;
mod exact_occlusion;
mod handed;
mod hollows;
mod inter_reflection;
mod light;
mod occlusion;
mod shadows;
mod ssdo;
mod surfaces;
mod twins;
mod two_band;
