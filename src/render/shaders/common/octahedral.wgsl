// Unit vectors as two numbers in [-1, 1]: Meyer et al. 2010, "On Floating-Point Normal
// Vectors"; the error at 16 bits a component is below 0.003 degrees.

fn octahedral_wrap(v: vec2f) -> vec2f {
    return (1.0 - abs(v.yx)) * select(vec2f(-1.0), vec2f(1.0), v >= vec2f(0.0));
}

fn octahedral_encode(direction: vec3f) -> vec2f {
    let length_1 = max(abs(direction.x) + abs(direction.y) + abs(direction.z), 1e-20);
    let projected = direction.xy / length_1;
    return select(octahedral_wrap(projected), projected, direction.z >= 0.0);
}

fn octahedral_decode(encoded: vec2f) -> vec3f {
    let z = 1.0 - abs(encoded.x) - abs(encoded.y);
    let xy = select(octahedral_wrap(encoded), encoded, z >= 0.0);
    return normalize(vec3f(xy, z));
}
