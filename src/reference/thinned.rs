//! Some of the points of surroundings.

use glam::Vec3;

use super::occlusion::Surroundings;

/// Some points, chosen, of all that there are.
#[derive(Debug)]
pub struct Thinned<'a, S> {
    all: &'a S,
    points: Vec<usize>,
}

impl<'a, S: Surroundings> Thinned<'a, S> {
    /// The points of these numbers.
    ///
    /// # Panics
    /// When a number is used that there is no point of.
    #[must_use]
    pub fn new(all: &'a S, points: Vec<usize>) -> Self {
        Self { all, points }
    }
}

impl<S: Surroundings> Surroundings for Thinned<'_, S> {
    type Start = S::Start;

    fn len(&self) -> usize {
        self.points.len()
    }

    fn start(&self, point: usize) -> Option<(S::Start, Vec3)> {
        self.all.start(self.points[point])
    }

    fn is_blocked(&self, start: &S::Start, direction: Vec3, reach_m: f32) -> bool {
        self.all.is_blocked(start, direction, reach_m)
    }

    fn nearest_m(&self, start: &S::Start, direction: Vec3, reach_m: f32) -> Option<f32> {
        self.all.nearest_m(start, direction, reach_m)
    }
}
