//! The horizontal mouldings of a side: between the storeys, and at the top.

use glam::Vec3;

use super::Side;
use super::arcade::{HALF_WALL_M, Storey};
use super::materials::Stuff;
use crate::scene::modelling::blocks::block;
use crate::scene::modelling::profile::Pen;
use crate::scene::modelling::{MeshBuilder, Profile};

/// Moulding between the storeys, all along the side, at the gallery's floor.
pub(super) fn string_course(stuff: &mut Stuff, side: &Side, storey: &Storey) {
    let y = storey.top_m;
    let outline = Pen::at(0.0, y - 0.28)
        .by(0.04, 0.0)
        .by(0.0, 0.12)
        .by(0.03, 0.0)
        .by(0.0, 0.12)
        .cavetto(0.07, 0.08)
        .by(0.06, 0.0)
        .by(0.0, 0.1)
        .ovolo(0.06, 0.07)
        .by(0.02, 0.0)
        .by(0.0, 0.05)
        .to(-0.3, y + 0.352)
        .profile();
    run_along(&mut stuff.carved, side, &outline);
}

/// Crowning cornice with dentils, under a brick parapet.
pub(super) fn cornice(stuff: &mut Stuff, side: &Side, storey: &Storey) {
    let y = storey.top_m;
    let outline = Pen::at(0.0, y - 0.45)
        .by(0.05, 0.0)
        .by(0.0, 0.16)
        .by(0.04, 0.0)
        .by(0.0, 0.12)
        .cavetto(0.06, 0.07)
        .by(0.03, 0.0)
        .by(0.0, 0.2)
        .by(0.16, 0.0)
        .by(0.0, 0.05)
        .by(0.2, 0.0)
        .by(0.0, 0.16)
        .ovolo(0.1, 0.12)
        .by(0.03, 0.0)
        .by(0.0, 0.06)
        .to(-0.35, y + 0.62)
        .profile();
    run_along(&mut stuff.carved, side, &outline);
    let step = 0.22;
    let count = (side.length_m() / step) as u32;
    let offset = 0.5 * (side.length_m() - count as f32 * step);
    for i in 0..count {
        let x = offset + (i as f32 + 0.2) * step;
        let low = Vec3::new(x, y - 0.08, HALF_WALL_M + 0.1);
        let high = low + Vec3::new(0.13, 0.17, 0.17);
        block(&mut stuff.carved, &side.frame, low, high, 0.006);
    }
}

/// Runs a moulding along the side's face, mitred into its neighbours.
fn run_along(stone: &mut MeshBuilder, side: &Side, outline: &Profile) {
    let face = HALF_WALL_M;
    // A full rectangle would be swept four times: take this side's stretch only, its
    // ends cut back to the neighbours' faces and let run into them.
    let start = side.frame.point(Vec3::new(face, 0.0, face));
    let end = side
        .frame
        .point(Vec3::new(side.length_m() - face, 0.0, face));
    outline.run(stone, &[start, end], false);
}
