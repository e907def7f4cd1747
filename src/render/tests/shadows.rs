//! Shadows against exact geometry: where rays to the sun meet a box, and where they do not.

use glam::{Vec2, Vec3};

use super::*;
use crate::render::testing::{direction_at, direction_through};

const ALBEDO: f32 = 0.8;
const IRRADIANCE: f32 = 2.5;

/// A sun at an elevation over +X, turned towards +Z, and nothing else.
fn sunlit(elevation_deg: f32, azimuth_deg: f32) -> FrameRequest {
    let mut request = request("none");
    (request.width_px, request.height_px) = (320, 240);
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    request.lighting.background = Background::Colour(Vec3::ZERO);
    let (elevation, azimuth) = (elevation_deg.to_radians(), azimuth_deg.to_radians());
    let across = elevation.cos();
    request.lighting.sun = Some(Sun {
        towards: Vec3::new(
            across * azimuth.cos(),
            elevation.sin(),
            across * azimuth.sin(),
        ),
        irradiance: Vec3::splat(IRRADIANCE),
        casts_shadows: true,
    });
    request
}

fn towards(request: &FrameRequest) -> Vec3 {
    request.lighting.sun.as_ref().unwrap().towards
}

fn see(request: &mut FrameRequest, from: Vec3, to: Vec3, vertical_fov_rad: f32) {
    request.camera.position_m = from;
    request.camera.target_m = to;
    request.camera.vertical_fov_rad = vertical_fov_rad;
}

const BOX: (Vec3, Vec3) = (Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5));

fn box_on_floor() -> Geometry {
    let tower = cuboid("box", BOX.0, BOX.1);
    of_one_material(matte([ALBEDO; 3]), vec![floor(), tower])
}

/// Distance at which a ray enters a box, if it does: the slab test.
fn enters(origin: Vec3, along: Vec3, (low, high): (Vec3, Vec3)) -> Option<f32> {
    let (to_low, to_high) = ((low - origin) / along, (high - origin) / along);
    let near = to_low.min(to_high).max_element().max(0.0);
    let far = to_low.max(to_high).min_element();
    (near <= far).then_some(near)
}

/// The floor's point at a pixel's centre, unless something else is there or within the grid
/// that edges are drawn on, 1/16 of a pixel.
fn floor_at(request: &FrameRequest, pixel: (u32, u32)) -> Option<Vec3> {
    let along = direction_at(request, pixel);
    let eye = request.camera.position_m;
    let distance = -eye.y / along.y;
    let point = eye + along * distance;
    let centre_px = Vec2::new(pixel.0 as f32, pixel.1 as f32) + 0.5;
    let hidden = [Vec2::ZERO, Vec2::X, Vec2::NEG_X, Vec2::Y, Vec2::NEG_Y]
        .map(|step| direction_through(request, centre_px + step / 16.0))
        .iter()
        .any(|&along| enters(eye, along, BOX).is_some_and(|box_at| box_at < distance));
    (distance > 0.0 && !hidden && point.abs().max_element() < 5.5).then_some(point)
}

/// Share of the sun's irradiance that a floor pixel shows, from its level.
fn lit_share(request: &FrameRequest, frame: &RenderedFrame, pixel: (u32, u32)) -> f32 {
    let level = f32::from(rgb(frame, pixel)[0]) / 255.0;
    let linear = if level <= 0.040_45 {
        level / 12.92
    } else {
        ((level + 0.055) / 1.055).powf(2.4)
    };
    linear / (ALBEDO / std::f32::consts::PI * IRRADIANCE * towards(request).y)
}

/// Every floor pixel but those within a penumbra of the shadow's outline is as dark or as lit as
/// the ray from its centre to the sun says.
#[test]
fn the_shadow_of_a_box_is_where_rays_say() {
    for (elevation_deg, azimuth_deg) in [(60.0, 20.0), (30.0, 0.0), (30.0, 200.0), (10.0, 35.0)] {
        let mut request = sunlit(elevation_deg, azimuth_deg);
        see(&mut request, Vec3::new(0.5, 5.0, 4.5), Vec3::ZERO, 0.9);
        let frame = draw(&box_on_floor(), &request);
        let towards = towards(&request);
        let (mut dark, mut lit) = (0, 0);
        for pixel in (0..240).flat_map(|y| (0..320).map(move |x| (x, y))) {
            let Some(point) = floor_at(&request, pixel) else {
                continue;
            };
            // A texel of the map is 3 mm here; the sun's disc spreads an edge at distance d
            // by 0.00465 d; both lie slanted on the floor.
            let spread_m = (0.0047 / towards.y + 0.01) / towards.y;
            let shaded = |x: f32, z: f32| {
                let moved = point + Vec3::new(x, 0.0, z) * spread_m;
                enters(moved, towards, BOX).is_some()
            };
            let is_shaded = shaded(0.0, 0.0);
            let crosses = (0..16).any(|i| {
                let angle = i as f32 * std::f32::consts::TAU / 16.0;
                shaded(angle.cos(), angle.sin()) != is_shaded
            });
            if crosses {
                continue;
            }
            let share = lit_share(&request, &frame, pixel);
            if is_shaded {
                dark += 1;
                assert!(share < 0.01, "{elevation_deg}°: {point} shows {share}");
            } else {
                lit += 1;
                assert!(
                    (share - 1.0).abs() < 0.02,
                    "{elevation_deg}°: {point} shows {share}"
                );
            }
        }
        assert!(
            dark > 300 && lit > 10_000,
            "{elevation_deg}°: {dark} dark, {lit} lit"
        );
    }
}

/// The middle of the penumbra is the edge of a point sun's shadow, and the penumbra is as wide as the
/// sun's disc makes it: 10 to 90 % of a disc are 1.37 of its radius apart.
#[test]
fn the_edge_of_a_shadow_is_in_place_and_as_soft_as_the_sun() {
    for (elevation_deg, height_m) in [(60.0_f32, 1.0_f32), (30.0, 1.0), (45.0, 4.0)] {
        let tower = cuboid(
            "tower",
            Vec3::new(0.0, 0.0, -2.0),
            Vec3::new(0.5, height_m, 2.0),
        );
        let geometry = of_one_material(matte([ALBEDO; 3]), vec![floor(), tower]);
        let mut request = sunlit(elevation_deg, 0.0);
        let elevation = elevation_deg.to_radians();
        let edge = Vec3::new(-height_m / elevation.tan(), 0.0, 0.0);
        see(&mut request, edge + Vec3::new(-0.2, 1.0, 0.6), edge, 0.4);
        let frame = draw(&geometry, &request);
        // Where the share passes a value, going out of the shadow.
        let passes = |value: f32| {
            let steps = (0..400).map(|i| edge.x + 0.2 - i as f32 * 0.001);
            let mut shares = steps.map(|x| {
                (
                    x,
                    lit_share(&request, &frame, pixel_of(&request, edge.with_x(x))),
                )
            });
            shares.find(|(_, share)| *share > value).unwrap().0
        };
        let pixel_m = 0.4 * 1.2 / 240.0;
        let off_m = (passes(0.5) - edge.x).abs();
        assert!(off_m < 2.5 * pixel_m, "{elevation_deg}°: {off_m} m off");
        let radius_m = 0.004_65 * height_m / elevation.sin() / elevation.sin();
        let width_m = passes(0.1) - passes(0.9);
        let expected_m = 1.37 * radius_m;
        assert!(
            (width_m - expected_m).abs() < 0.3 * expected_m + 2.0 * pixel_m,
            "{elevation_deg}°, {height_m} m: {width_m} m wide, not {expected_m} m"
        );
    }
}

/// Seen from 40 cm away, the floor at the foot of the box is dark to the last pixel.
#[test]
fn no_light_leaks_under_a_box() {
    for elevation_deg in [60.0, 30.0, 10.0] {
        let mut request = sunlit(elevation_deg, 10.0);
        let foot = Vec3::new(-0.5, 0.0, 0.0);
        see(&mut request, foot + Vec3::new(-0.25, 0.2, 0.2), foot, 0.3);
        let frame = draw(&box_on_floor(), &request);
        let mut seen = 0;
        for pixel in (0..240).flat_map(|y| (0..320).map(move |x| (x, y))) {
            let Some(point) = floor_at(&request, pixel).filter(|p| (-0.6..=-0.5).contains(&p.x))
            else {
                continue;
            };
            seen += 1;
            let level = rgb(&frame, pixel)[0];
            assert!(level <= 1, "{elevation_deg}°: {point} leaks {level}");
        }
        assert!(seen > 5_000, "{seen}");
    }
}

/// A ball of unit radius on the floor, and its smooth normals.
fn ball() -> Mesh {
    const ROWS: u32 = 48;
    const COLUMNS: u32 = 96;
    let mut mesh = Mesh {
        name: String::from("ball"),
        ..Mesh::default()
    };
    let corner = floor().vertices[0];
    for row in 0..=ROWS {
        for column in 0..=COLUMNS {
            let down = std::f32::consts::PI * row as f32 / ROWS as f32;
            let round = std::f32::consts::TAU * column as f32 / COLUMNS as f32;
            let normal = Vec3::new(
                down.sin() * round.cos(),
                down.cos(),
                down.sin() * round.sin(),
            );
            mesh.vertices.push(crate::scene::Vertex {
                position_m: (normal + Vec3::Y).to_array(),
                normal: normal.to_array(),
                ..corner
            });
        }
    }
    for (row, column) in (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| (row, column))) {
        let at = |row: u32, column: u32| row * (COLUMNS + 1) + column;
        let (a, b) = (at(row, column), at(row, column + 1));
        let (c, d) = (at(row + 1, column), at(row + 1, column + 1));
        mesh.indices.extend([a, b, c, b, d, c]);
    }
    mesh
}

/// Nothing shades itself: a floor under grazing light, and the lit side of a ball, have Lambert's
/// radiance at every pixel.
#[test]
fn lit_surfaces_have_no_acne() {
    let floor_alone = of_one_material(matte([ALBEDO; 3]), vec![floor()]);
    for elevation_deg in [2.0, 5.0, 10.0, 40.0] {
        let mut request = sunlit(elevation_deg, 30.0);
        see(&mut request, Vec3::new(0.0, 1.0, 2.0), Vec3::ZERO, 0.8);
        let frame = draw(&floor_alone, &request);
        let expected = srgb8(ALBEDO / std::f32::consts::PI * IRRADIANCE * towards(&request).y);
        for pixel in (0..240).flat_map(|y| (0..320).map(move |x| (x, y))) {
            if floor_at(&request, pixel).is_some() {
                let level = i32::from(rgb(&frame, pixel)[0]);
                assert!(
                    (level - expected).abs() <= 1,
                    "{elevation_deg}°: {pixel:?} shows {level}"
                );
            }
        }
    }
    for elevation_deg in [10.0, 50.0] {
        let mut request = sunlit(elevation_deg, 60.0);
        see(&mut request, Vec3::new(2.0, 2.0, 4.0), Vec3::Y, 0.55);
        let frame = draw(&of_one_material(matte([ALBEDO; 3]), vec![ball()]), &request);
        let mut seen = 0;
        for (x, y) in (0..240).flat_map(|y| (0..320).map(move |x| (x, y))) {
            let Some(normal) = ball_at(&request, (x, y)) else {
                continue;
            };
            let cosine = normal.dot(towards(&request));
            if cosine < 0.1 {
                continue;
            }
            seen += 1;
            let expected = srgb8(ALBEDO / std::f32::consts::PI * IRRADIANCE * cosine);
            let level = i32::from(rgb(&frame, (x, y))[0]);
            // A facet of 4° is up to 0.3° off the ball's own normal.
            assert!(
                (level - expected).abs() <= 4,
                "{elevation_deg}°: ({x}, {y}) shows {level}, not {expected}"
            );
        }
        assert!(seen > 5_000, "{seen}");
    }
}

/// Normal of the unit ball at a pixel, but for its outermost rim.
fn ball_at(request: &FrameRequest, pixel: (u32, u32)) -> Option<Vec3> {
    let along = direction_at(request, pixel);
    let to_centre = Vec3::Y - request.camera.position_m;
    let middle = to_centre.dot(along);
    let square = 0.97 - (to_centre.length_squared() - middle * middle);
    let depth = (square + 0.03).max(0.0).sqrt();
    (square > 0.0).then(|| along * (middle - depth) - to_centre)
}
