//! A palace courtyard in the manner of the Italian Renaissance: two storeys of round
//! arches on columns about a paved court, groin vaults over the walks, hangings in the
//! arches. Its length lies along x; the court's middle is the origin, the walks' floor y = 0.

mod arcade;
mod floor;
mod hangings;
mod interior;
mod ironwork;
mod materials;
mod mouldings;
mod orders;
mod props;
mod walls;
mod weather;

use std::f32::consts::{FRAC_PI_2, PI};

use glam::Vec3;

use super::Generator;
use crate::scene::geometry::Geometry;
use crate::scene::modelling::Frame;
use arcade::Storey;
use materials::Stuff;
use weather::Weather;

/// The registry's entry.
pub const GENERATOR: Generator = Generator {
    name: "atrium",
    summary: "courtyard of a palace: two storeys of arches, vaulted walks, hangings, tiled floor",
    generate,
};

/// Half the court's length and width, to the middle of its columns, metres.
pub(super) const HALF_LENGTH_M: f32 = 12.0;
pub(super) const HALF_WIDTH_M: f32 = 4.2;
/// From the middle of the columns to the outer wall, metres.
pub(super) const WALK_M: f32 = 4.0;
/// The court lies this far below the walks, metres.
pub(super) const COURT_DROP_M: f32 = 0.3;

/// One side of the court: its frame (x along it from the left corner, z into the
/// court), bays and their width in metres.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub frame: Frame,
    pub bays: u32,
    pub bay_m: f32,
}

impl Side {
    /// The four sides, the long ones first.
    fn all() -> [Self; 4] {
        let (l, w) = (HALF_LENGTH_M, HALF_WIDTH_M);
        let side = |x, z, angle, bays, length: f32| Self {
            frame: Frame::turned(Vec3::new(x, 0.0, z), angle),
            bays,
            bay_m: length / bays as f32,
        };
        [
            side(-l, -w, 0.0, 6, 2.0 * l),
            side(l, w, PI, 6, 2.0 * l),
            side(-l, w, FRAC_PI_2, 2, 2.0 * w),
            side(l, -w, -FRAC_PI_2, 2, 2.0 * w),
        ]
    }

    /// Its length, metres.
    fn length_m(&self) -> f32 {
        self.bays as f32 * self.bay_m
    }
}

fn generate(seed: u64) -> Geometry {
    let mut stuff = Stuff::new(seed);
    let storeys = [Storey::lower(), Storey::upper()];
    for side in Side::all() {
        for storey in &storeys {
            arcade::build(&mut stuff, &side, storey);
            interior::build(&mut stuff, &side, storey);
            ironwork::build(&mut stuff, &side, storey);
        }
        hangings::build(&mut stuff, &side, &storeys, seed);
        props::build(&mut stuff, &side, seed);
    }
    for storey in &storeys {
        arcade::corner_piers(&mut stuff, storey);
        interior::corners(&mut stuff, storey);
    }
    interior::shell(&mut stuff);
    floor::build(&mut stuff, seed);
    props::well(&mut stuff);
    stuff.weather(Weather::new(seed));
    stuff.finish()
}
