//! Occlusion that is computed outside of the renderer, and the points it is computed at.

use std::sync::Arc;

use glam::Vec3;

use super::*;
use crate::render::FloatImage;

fn handed(values: Vec<f32>) -> Option<Arc<FloatImage>> {
    Some(Arc::new(FloatImage {
        width_px: 160,
        height_px: 120,
        values,
    }))
}

/// What is handed in is what the ambient term is scaled by.
#[test]
fn handed_occlusion_scales_the_ambient_term() {
    let geometry = of_one_material(matte([0.5; 3]), vec![floor()]);
    let mut request = request("ray-traced");
    request.handed_occlusion = handed(vec![0.25; 160 * 120]);
    let frame = draw(&geometry, &request);
    let spot = pixel_of(&request, Vec3::new(0.3, 0.0, 1.0));
    assert_level(rgb(&frame, spot), 0.5 * 0.25);
    let occlusion = frame.occlusion.unwrap();
    assert!(occlusion.values.iter().all(|&k| k == 0.25));
}

#[test]
fn occlusion_that_is_missing_or_too_small_is_refused() {
    let scene = renderer().upload(&of_one_material(matte([0.5; 3]), vec![floor()]));
    let scene = scene.unwrap();
    let mut request = request("ray-traced");
    let message =
        |request: &FrameRequest| renderer().render(&scene, request).unwrap_err().to_string();
    assert!(message(&request).contains("none was"));
    request.handed_occlusion = handed(vec![1.0; 160 * 120]);
    request.width_px = 80;
    assert!(message(&request).contains("another size"));
}

/// The points lie on the floor they show, at one sample a pixel and at four.
#[test]
fn visible_points_lie_on_what_is_seen() {
    let scene = renderer().upload(&of_one_material(matte([0.5; 3]), vec![floor()]));
    let scene = scene.unwrap();
    for supersampling in [1, 2] {
        let mut request = request("ray-traced");
        request.supersampling = supersampling;
        let seen = renderer().view(&scene).visible_surfaces(&request).unwrap();
        let projection = seen.projection();
        let on_floor = (0..seen.len()).filter(|&pixel| seen.has_surface(pixel));
        let mut points = 0;
        for pixel in on_floor {
            let at = projection.world_point(pixel, f64::from(seen.depth_m[pixel]));
            // A sixteenth of a pixel of 0.01 m at the far edge.
            assert!(at.y.abs() < 1e-2, "{supersampling}: {at}");
            assert!(seen.normals[pixel].y > 0.999 && seen.geometric_normals[pixel].y > 0.99);
            points += 1;
        }
        assert!(points > 5000, "{points}");
    }
}
