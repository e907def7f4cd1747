// What a point gets of the light in the open, where no light between surfaces is asked for.
fn received(point: Point, openness: f32) -> vec3f {
    return vec3f(openness);
}
