//! Any-hit rays a second of Greyfield's tree over triangles. It compiles the tree's own files, so
//! that it needs no renderer.
//!
//! `peers FOLDER/NAME` reads NAME.triangles (nine little-endian f32 a triangle) and NAME.rays
//! (origin and direction, six a ray), which `embree.py` makes.

#[path = "../../../src/reference/bvh/build.rs"]
mod build;
#[path = "../../../src/reference/bvh/node.rs"]
#[allow(dead_code)]
mod node;
#[path = "../../../src/reference/bvh/tree.rs"]
mod tree;

use std::time::Instant;

use glam::Vec3;
use rayon::prelude::*;

fn main() {
    for name in std::env::args().skip(1) {
        if let Err(error) = measure(&name) {
            eprintln!("{name}: {error}");
            std::process::exit(1);
        }
    }
}

fn vectors(path: &str) -> std::io::Result<Vec<Vec3>> {
    let bytes = std::fs::read(path)?;
    let number = |at: usize| {
        let bytes = [0, 1, 2, 3].map(|k| bytes[at + k]);
        f32::from_le_bytes(bytes)
    };
    Ok((0..bytes.len() / 12)
        .map(|k| Vec3::new(number(12 * k), number(12 * k + 4), number(12 * k + 8)))
        .collect())
}

fn measure(name: &str) -> std::io::Result<()> {
    let corners: Vec<[Vec3; 3]> = vectors(&format!("{name}.triangles"))?
        .chunks_exact(3)
        .map(|t| [t[0], t[1], t[2]])
        .collect();
    let rays = vectors(&format!("{name}.rays"))?;
    let started = Instant::now();
    let tree = build::build(&corners, &vec![0; corners.len()]);
    let built_s = started.elapsed().as_secs_f64();
    let blocked = |ray: &[Vec3]| {
        let ray = node::Ray::new(ray[0], ray[1]);
        tree.walk::<true>(&ray, f32::INFINITY, &|_, _| true)
            .is_some()
    };
    let mut least_s = f64::INFINITY;
    let mut hits = 0;
    for _ in 0..5 {
        let started = Instant::now();
        hits = rays
            .par_chunks(2 * 4096)
            .map(|rays| rays.chunks_exact(2).filter(|ray| blocked(ray)).count())
            .sum();
        least_s = least_s.min(started.elapsed().as_secs_f64());
    }
    println!(
        "{name}: greyfield {:.2} Mrays/s on {} threads, {hits} blocked of {}, tree of {} triangles in {built_s:.2} s",
        rays.len() as f64 / 2.0 / least_s / 1e6,
        rayon::current_num_threads(),
        rays.len() / 2,
        corners.len(),
    );
    Ok(())
}
