//! x
use super::Generator;
/// x
pub const GENERATOR: Generator = Generator {
    name: "figures",
    summary: "",
    generate: |_| crate::scene::Geometry::default(),
};
