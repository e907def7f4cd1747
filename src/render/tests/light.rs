//! Light whose amount is known.

use glam::Vec3;

use super::*;

/// Lambert: irradiance π/2 on albedo 0.8 from straight above is radiance 0.4; at 60° half of it.
#[test]
fn the_directional_light_follows_lambert() {
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    for (towards, expected) in [
        (Vec3::Y, 0.4),
        (Vec3::new(3.0_f32.sqrt() / 2.0, 0.5, 0.0), 0.2),
        (Vec3::new(0.5, -0.5, 0.5).normalize(), 0.0),
    ] {
        request.lighting.sun = Some(Sun {
            towards,
            irradiance: Vec3::splat(std::f32::consts::FRAC_PI_2),
            casts_shadows: true,
        });
        let frame = draw(&of_one_material(matte([0.8; 3]), vec![floor()]), &request);
        assert_level(
            rgb(&frame, pixel_of(&request, Vec3::new(0.3, 0.0, 1.0))),
            expected,
        );
    }
}

#[test]
fn a_box_casts_its_shadow_where_geometry_says() {
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    request.lighting.sun = Some(Sun {
        towards: Vec3::new(1.0, 1.0, 0.0).normalize(),
        irradiance: Vec3::splat(3.0),
        casts_shadows: true,
    });
    // At 45° a box 1 m high shades 1 m of floor on its −X side.
    let tower = cuboid("box", Vec3::new(0.0, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5));
    let frame = draw(
        &of_one_material(matte([0.8; 3]), vec![floor(), tower]),
        &request,
    );
    let lit = |x: f32| rgb(&frame, pixel_of(&request, Vec3::new(x, 0.0, 0.3)))[0] > 20;
    assert!(!lit(-0.1), "the foot of the box leaks light");
    assert!(!lit(-0.5));
    assert!(!lit(-0.9));
    assert!(lit(-1.15));
    assert!(lit(0.8));
}

/// Inverse square and Lambert: intensity π/2 from 0.5 m straight above albedo 0.8 is an
/// irradiance of 2π and a radiance of 1.6; from 1 m it is a quarter of that.
#[test]
fn a_point_light_falls_with_the_square() {
    let mut request = request("none");
    request.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    let spot = Vec3::new(0.3, 0.0, 1.0);
    for (height_m, cone, expected) in [
        (1.0, None, 0.4),
        (2.0, None, 0.1),
        (1.0, Some((Vec3::NEG_Y, 0.2, 0.4)), 0.4),
        (1.0, Some((Vec3::X, 0.2, 0.4)), 0.0),
    ] {
        request.lighting.points = vec![PointLight {
            position_m: spot + Vec3::Y * height_m,
            intensity: Vec3::splat(std::f32::consts::FRAC_PI_2),
            cone: cone.map(|(along, inner_rad, outer_rad)| Cone {
                along,
                inner_rad,
                outer_rad,
            }),
        }];
        let frame = draw(&of_one_material(matte([0.8; 3]), vec![floor()]), &request);
        assert_level(rgb(&frame, pixel_of(&request, spot)), expected);
    }
}

#[test]
fn emission_and_unlit_surfaces_show_their_own_light() {
    let request = request("none");
    let spot = pixel_of(&request, Vec3::new(0.3, 0.0, 1.0));
    let lamp = Material {
        emission: [0.3; 3],
        ..matte([0.2; 3])
    };
    let frame = draw(&of_one_material(lamp, vec![floor()]), &request);
    assert_level(rgb(&frame, spot), 0.5);
    let unlit = Material {
        unlit: true,
        ..matte([0.35; 3])
    };
    let mut dark = request.clone();
    dark.lighting.ambient = Ambient::Constant(Vec3::ZERO);
    let frame = draw(&of_one_material(unlit, vec![floor()]), &dark);
    assert_level(rgb(&frame, spot), 0.35);
}
