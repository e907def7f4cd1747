//! WGSL by parts. A shader names the shared parts it uses by lines `//!use NAME`; each
//! part is pasted once, before the shader, in the order of first use.

/// The shared parts, by name. `normals` exists once for each precision; the renderer
/// passes the one the frame uses.
const PARTS: &[(&str, &str)] = &[
    ("frame", include_str!("shaders/common/frame.wgsl")),
    ("fullscreen", include_str!("shaders/common/fullscreen.wgsl")),
    ("grid", include_str!("shaders/common/grid.wgsl")),
    ("gather", include_str!("shaders/common/gather.wgsl")),
    ("octahedral", include_str!("shaders/common/octahedral.wgsl")),
    ("screen", include_str!("shaders/common/screen.wgsl")),
    ("occlusion", include_str!("shaders/common/occlusion.wgsl")),
    (
        "directional",
        include_str!("shaders/common/directional.wgsl"),
    ),
    ("opening", include_str!("shaders/common/opening.wgsl")),
    ("sampling", include_str!("shaders/material/sampling.wgsl")),
    ("display", include_str!("shaders/display.wgsl")),
    ("light", include_str!("shaders/lighting/light.wgsl")),
    ("place", include_str!("shaders/lighting/place.wgsl")),
    ("point", include_str!("shaders/lighting/point.wgsl")),
    ("brdf", include_str!("shaders/lighting/brdf.wgsl")),
    (
        "irradiance",
        include_str!("shaders/lighting/irradiance.wgsl"),
    ),
    ("bent_cone", include_str!("shaders/lighting/bent_cone.wgsl")),
    ("diffuse", include_str!("shaders/lighting/diffuse.wgsl")),
    ("radiance", include_str!("shaders/lighting/radiance.wgsl")),
    (
        "equirectangular",
        include_str!("shaders/lighting/equirectangular.wgsl"),
    ),
];

/// Composes a shader. `variant` parts shadow the shared ones (and may use them).
pub fn compose(source: &str, variants: &[(&str, &str)]) -> String {
    let mut composed = String::new();
    let mut seen = Vec::new();
    append(source, variants, &mut seen, &mut composed);
    composed
}

fn append(source: &str, variants: &[(&str, &str)], seen: &mut Vec<String>, out: &mut String) {
    for name in source
        .lines()
        .filter_map(|line| line.strip_prefix("//!use "))
    {
        let name = name.trim();
        if seen.iter().any(|s| s == name) {
            continue;
        }
        seen.push(name.to_owned());
        let part = variants
            .iter()
            .chain(PARTS)
            .find(|(part, _)| *part == name)
            .map_or_else(
                || {
                    panic!(
                        "no shared WGSL part is called {name:?}: a shader of this crate names it"
                    )
                },
                |(_, text)| *text,
            );
        append(part, variants, seen, out);
    }
    out.push_str(source);
    out.push('\n');
}

/// A shader module of this crate's own WGSL.
pub fn module(
    device: &wgpu::Device,
    label: &str,
    source: &str,
    variants: &[(&str, &str)],
) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(compose(source, variants).into()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_used_twice_stands_once() {
        let variants = [("a", "//!use b\nfn a() {}"), ("b", "fn b() {}")];
        let composed = compose("//!use a\n//!use b\nfn main() {}", &variants);
        assert_eq!(composed.matches("fn b() {}").count(), 1);
        assert!(composed.find("fn b()") < composed.find("fn a()"));
        assert!(composed.find("fn a()") < composed.find("fn main()"));
    }
}
