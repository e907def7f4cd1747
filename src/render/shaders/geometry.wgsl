// Surfaces to targets: albedo + specular, surface record, linear depth.
//!use frame
//!use normals
struct MaterialFactors {
    albedo: vec4f,
    roughness: f32,
    metallic: f32,
    specular: f32,
    // 1 where the material has a normal map.
    normal_map: f32,
}

@group(1) @binding(0) var<uniform> material: MaterialFactors;
@group(1) @binding(1) var material_sampler: sampler;
@group(1) @binding(2) var albedo_texture: texture_2d<f32>;
@group(1) @binding(3) var normal_texture: texture_2d<f32>;
@group(1) @binding(4) var finish_texture: texture_2d<f32>;

struct Corner {
    @location(0) position_m: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec2f,
    @location(4) color: vec4f,
}

struct Surface {
    @builtin(position) position: vec4f,
    @location(0) normal: vec3f,
    @location(1) tangent: vec4f,
    @location(2) uv: vec2f,
    @location(3) color: vec4f,
    @location(4) depth_m: f32,
}

@vertex
fn vs_geometry(corner: Corner) -> Surface {
    var surface: Surface;
    let world = vec4f(corner.position_m, 1.0);
    surface.position = frame.view_projection * world;
    surface.normal = corner.normal;
    surface.tangent = corner.tangent;
    surface.uv = corner.uv;
    surface.color = corner.color;
    surface.depth_m = -(frame.view * world).z;
    return surface;
}

fn albedo_and_specular(surface: Surface) -> vec4f {
    let texel = textureSample(albedo_texture, material_sampler, surface.uv);
    let albedo = material.albedo.rgb * texel.rgb * surface.color.rgb;
    return vec4f(clamp(albedo, vec3f(0.0), vec3f(1.0)), material.specular);
}

// A zero vector (an interpolated fold) has no direction: the fallback stands in.
fn safe_normalize(v: vec3f, fallback: vec3f) -> vec3f {
    let square = dot(v, v);
    return select(fallback, v * inverseSqrt(max(square, 1e-30)), square > 1e-12);
}

fn shading_normal(surface: Surface, normal: vec3f) -> vec3f {
    // The sampling stands outside the branch: derivatives need uniform control flow.
    let texel = textureSample(normal_texture, material_sampler, surface.uv).xyz * 2.0 - 1.0;
    if material.normal_map == 0.0 {
        return normal;
    }
    let tangent = safe_normalize(surface.tangent.xyz - normal * dot(normal, surface.tangent.xyz), vec3f(0.0));
    let bitangent = cross(normal, tangent) * surface.tangent.w;
    return safe_normalize(tangent * texel.x + bitangent * texel.y + normal * texel.z, normal);
}

struct FlatTargets {
    @location(0) albedo: vec4f,
    @location(1) depth_m: vec4f,
}

// For frames in which nothing reads normals.
@fragment
fn fs_flat(surface: Surface) -> FlatTargets {
    return FlatTargets(albedo_and_specular(surface), vec4f(surface.depth_m));
}

struct OcclusionTargets {
    @location(0) depth_m: vec4f,
    @location(1) normals: SurfaceRecord,
}

struct Targets {
    @location(0) albedo: vec4f,
    @location(1) depth_m: vec4f,
    @location(2) normals: SurfaceRecord,
}

fn surface_record(surface: Surface, front: bool) -> SurfaceRecord {
    let side = select(-1.0, 1.0, front);
    let geometric = safe_normalize(surface.normal, vec3f(0.0, 1.0, 0.0)) * side;
    let finish = textureSample(finish_texture, material_sampler, surface.uv);
    return pack_surface(
        shading_normal(surface, geometric),
        geometric,
        material.roughness * finish.g,
        material.metallic * finish.b,
    );
}

@fragment
fn fs_full(surface: Surface, @builtin(front_facing) front: bool) -> Targets {
    let record = surface_record(surface, front);
    return Targets(albedo_and_specular(surface), vec4f(surface.depth_m), record);
}

// At the occlusion's own resolution nobody asks for colour.
@fragment
fn fs_occlusion_inputs(surface: Surface, @builtin(front_facing) front: bool) -> OcclusionTargets {
    return OcclusionTargets(vec4f(surface.depth_m), surface_record(surface, front));
}
