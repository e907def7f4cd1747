//! Scenes that need no file: generated from a seed, the same on every machine.
//!
//! Each generator is one file or folder that declares itself as a [`Generator`], and
//! one line in [`GENERATORS`].

pub mod atrium;
pub mod figures;
pub mod figurine;
pub mod shapes;

use super::Geometry;

/// A procedural scene.
#[derive(Debug)]
pub struct Generator {
    /// Name in scene configs (`[geometry] generator = "atrium"`).
    pub name: &'static str,
    /// One line for help texts.
    pub summary: &'static str,
    /// Makes the geometry; the same seed gives the same bytes.
    pub generate: fn(seed: u64) -> Geometry,
}

/// Every generator there is.
pub const GENERATORS: &[&Generator] = &[
    &atrium::GENERATOR,
    &figurine::GENERATOR,
    &figures::GENERATOR,
    &shapes::GENERATOR,
];

/// The generator of that name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Generator> {
    GENERATORS
        .iter()
        .copied()
        .find(|generator| generator.name == name)
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;
    use std::sync::LazyLock;

    use glam::Vec3;

    use super::*;

    /// Every scene once, seed 1.
    static SCENES: LazyLock<HashMap<&str, Geometry>> = LazyLock::new(|| {
        GENERATORS
            .iter()
            .map(|generator| (generator.name, (generator.generate)(1)))
            .collect()
    });

    fn size_m(geometry: &Geometry) -> Vec3 {
        let (low, high) = geometry.bounds_m().unwrap();
        high - low
    }

    #[test]
    fn the_same_seed_gives_the_same_bytes_and_another_seed_does_not() {
        for generator in GENERATORS {
            assert!(
                (generator.generate)(1) == SCENES[generator.name],
                "{}",
                generator.name
            );
            let other = (generator.generate)(2);
            // Exact shapes have nothing that a seed could decide.
            let is_exact = generator.name == "shapes";
            assert_eq!(
                other == SCENES[generator.name],
                is_exact,
                "{}",
                generator.name
            );
        }
    }

    #[test]
    fn indices_and_references_are_in_range() {
        for (name, scene) in &*SCENES {
            for mesh in &scene.meshes {
                let label = format!("{name}: {}", mesh.name);
                assert_eq!(mesh.indices.len() % 3, 0, "{label}");
                assert!(!mesh.indices.is_empty(), "{label}");
                assert!(mesh.material < scene.materials.len(), "{label}");
                let count = mesh.vertices.len();
                assert!(
                    mesh.indices.iter().all(|&i| (i as usize) < count),
                    "{label}"
                );
            }
            for material in &scene.materials {
                let mut textures = material.textures();
                assert!(textures.all(|t| t.texture < scene.textures.len()));
            }
            for texture in &scene.textures {
                assert_eq!(
                    texture.rgba8.len() as u32,
                    4 * texture.width_px * texture.height_px
                );
            }
        }
    }

    #[test]
    fn vertices_are_finite_with_unit_frames() {
        for (name, scene) in &*SCENES {
            for mesh in &scene.meshes {
                for v in &mesh.vertices {
                    let label = || format!("{name}: {} {v:?}", mesh.name);
                    let numbers = v.position_m.iter().chain(&v.uv).chain(&v.color);
                    assert!(numbers.into_iter().all(|x| x.is_finite()), "{}", label());
                    let n = Vec3::from(v.normal);
                    let [x, y, z, w] = v.tangent;
                    let t = Vec3::new(x, y, z);
                    assert!((n.length() - 1.0).abs() < 1e-3, "{}", label());
                    assert!((t.length() - 1.0).abs() < 1e-3, "{}", label());
                    assert!(n.dot(t).abs() < 1e-2, "{}", label());
                    assert!(w.abs() == 1.0, "{}", label());
                    assert!(
                        v.color.iter().all(|c| (0.0..=2.0).contains(c)),
                        "{}",
                        label()
                    );
                }
            }
        }
    }

    /// Hardly any triangle may face away from its own corners' normals: that would be
    /// a surface built inside out. (Strands of hair finer than the marching cubes leave a few.)
    #[test]
    fn triangles_face_where_their_normals_point() {
        for (name, scene) in &*SCENES {
            for mesh in &scene.meshes {
                let mut against = 0;
                for c in mesh.indices.chunks_exact(3) {
                    let v = [0, 1, 2].map(|k| mesh.vertices[c[k] as usize]);
                    let p = v.map(|v| Vec3::from(v.position_m));
                    let face = (p[1] - p[0]).cross(p[2] - p[0]);
                    let mean: Vec3 = v.iter().map(|v| Vec3::from(v.normal)).sum();
                    against += usize::from(face.dot(mean) < 0.0);
                }
                let share = against as f64 * 3.0 / mesh.indices.len() as f64;
                assert!(share < 0.03, "{name}: {} {share}", mesh.name);
            }
        }
    }

    #[test]
    fn scenes_are_detailed_and_of_plausible_size() {
        for (name, scene) in &*SCENES {
            let triangles = scene.triangles();
            for mesh in &scene.meshes {
                println!("{name}: {} {}", mesh.name, mesh.indices.len() / 3);
            }
            let expected = match *name {
                "shapes" => 1..=10_000,
                _ => 200_000..=1_000_000,
            };
            assert!(expected.contains(&triangles), "{name}: {triangles}");
        }
        let court = size_m(&SCENES["atrium"]);
        assert!(
            (20.0..40.0).contains(&court.x) && (8.0..20.0).contains(&court.y),
            "{court}"
        );
        let dragon = size_m(&SCENES["figurine"]);
        assert!((0.2..0.5).contains(&dragon.y), "{dragon}");
    }

    /// Both people, by their hair's and boots' height: 1.6 to 1.95 m tall.
    #[test]
    fn people_are_as_tall_as_people() {
        let scene = &SCENES["figures"];
        let heights = |part: &str, top: bool| -> Vec<f32> {
            let named = scene.meshes.iter().filter(|mesh| mesh.name == part);
            named
                .map(|mesh| {
                    let y = mesh.vertices.iter().map(|v| v.position_m[1]);
                    if top {
                        y.fold(f32::MIN, f32::max)
                    } else {
                        y.fold(f32::MAX, f32::min)
                    }
                })
                .collect()
        };
        let (tops, soles) = (heights("hair", true), heights("boots", false));
        assert_eq!(tops.len(), 2);
        for (top, sole) in tops.iter().zip(&soles) {
            assert!((1.6..1.95).contains(&(top - sole)), "{top} {sole}");
            assert!(sole.abs() < 0.01, "the boots stand on the ground: {sole}");
        }
    }

    /// Cavity shading is in the clothes' colours: some corners at most half as bright as
    /// the brightest of the same layer, though the dye is one colour.
    #[test]
    fn hollows_are_painted_dark() {
        let scene = &SCENES["figures"];
        for part in ["jacket", "trousers", "leather"] {
            let mesh = scene.meshes.iter().find(|mesh| mesh.name == part).unwrap();
            let mut light: Vec<f32> = mesh.vertices.iter().map(|v| v.color[1]).collect();
            light.sort_by(f32::total_cmp);
            let (dark, bright) = (light[light.len() / 20], light[light.len() * 19 / 20]);
            assert!(dark < 0.75 * bright, "{part}: {dark} {bright}");
        }
    }

    /// No hole: welded by position (to 0.1 mm where positions are computed face by face), every
    /// edge is walked once in each direction.
    #[test]
    fn solids_are_closed() {
        let same_bits = |p: f32| p.to_bits();
        let same_place = |p: f32| (p * 1e4).round() as i32 as u32;
        hold_closed("figurine", same_bits);
        hold_closed("shapes", same_place);
    }

    fn hold_closed(scene: &str, place: impl Fn(f32) -> u32) {
        for mesh in &SCENES[scene].meshes {
            let mut numbers: HashMap<[u32; 3], u32> = HashMap::new();
            let welded: Vec<u32> = mesh
                .vertices
                .iter()
                .map(|v| {
                    let next = numbers.len() as u32;
                    *numbers.entry(v.position_m.map(&place)).or_insert(next)
                })
                .collect();
            let mut edges: HashMap<(u32, u32), [u32; 2]> = HashMap::new();
            for c in mesh.indices.chunks_exact(3) {
                for k in 0..3 {
                    let (a, b) = (welded[c[k] as usize], welded[c[(k + 1) % 3] as usize]);
                    let uses = edges.entry((a.min(b), a.max(b))).or_default();
                    uses[usize::from(a > b)] += 1;
                }
            }
            assert!(edges.values().all(|&uses| uses == [1, 1]), "{}", mesh.name);
        }
    }
}
