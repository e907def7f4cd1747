// Surfaces to targets: albedo + specular, linear depth, surface record, emission.
//!use frame
//!use normals
//!use corner
//!use material_albedo
//!use material_mask
//!use material_normal
//!use material_finish
//!use material_emission
//!use material_baked

fn albedo_and_specular(albedo: vec3f) -> vec4f {
    return vec4f(clamp(albedo * (1.0 - material.unlit), vec3f(0.0), vec3f(1.0)), material.specular * (1.0 - material.unlit));
}

fn surface_record(surface: Surface, front: bool) -> SurfaceRecord {
    let side = select(-1.0, 1.0, front);
    let geometric = safe_normalize(surface.normal, vec3f(0.0, 1.0, 0.0)) * side;
    let finish = material_finish(surface);
    return pack_surface(material_normal(surface, geometric), geometric, finish.x, finish.y);
}

fn emission_and_baked(surface: Surface, albedo: vec3f) -> vec4f {
    // Half floats end at 65504.
    let emitted = min(material_emission(surface) + albedo * material.unlit, vec3f(60000.0));
    return vec4f(emitted, material_baked(surface));
}

struct Flat {
    @location(0) albedo: vec4f,
    @location(1) depth_m: vec4f,
}

// For frames in which nothing reads normals.
@fragment
fn fs_flat(surface: Surface) -> Flat {
    let albedo = material_albedo(surface);
    mask(albedo.a);
    return Flat(albedo_and_specular(albedo.rgb), vec4f(surface.depth_m));
}

struct FlatEmitting {
    @location(0) albedo: vec4f,
    @location(1) depth_m: vec4f,
    @location(2) emission: vec4f,
}

@fragment
fn fs_flat_emitting(surface: Surface) -> FlatEmitting {
    let albedo = material_albedo(surface);
    let emission = emission_and_baked(surface, albedo.rgb);
    mask(albedo.a);
    return FlatEmitting(albedo_and_specular(albedo.rgb), vec4f(surface.depth_m), emission);
}

struct Full {
    @location(0) albedo: vec4f,
    @location(1) depth_m: vec4f,
    @location(2) normals: SurfaceRecord,
}

@fragment
fn fs_full(surface: Surface, @builtin(front_facing) front: bool) -> Full {
    let albedo = material_albedo(surface);
    let record = surface_record(surface, front);
    mask(albedo.a);
    return Full(albedo_and_specular(albedo.rgb), vec4f(surface.depth_m), record);
}

struct FullEmitting {
    @location(0) albedo: vec4f,
    @location(1) depth_m: vec4f,
    @location(2) normals: SurfaceRecord,
    @location(3) emission: vec4f,
}

@fragment
fn fs_full_emitting(surface: Surface, @builtin(front_facing) front: bool) -> FullEmitting {
    let albedo = material_albedo(surface);
    let record = surface_record(surface, front);
    let emission = emission_and_baked(surface, albedo.rgb);
    mask(albedo.a);
    return FullEmitting(albedo_and_specular(albedo.rgb), vec4f(surface.depth_m), record, emission);
}
