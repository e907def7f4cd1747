fn sun_radiance(point: Point) -> vec3f {
    return vec3f(0.0);
}
