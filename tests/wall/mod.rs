//! A wall of 1 m on a floor of 20 × 20 m, as a scene in a folder of its own, and the program run
//! there.
#![allow(dead_code, clippy::expect_used)] // each test uses a part; it ends where something is missing

use std::path::PathBuf;
use std::process::{Command, Output};

/// The model.
const MODEL: &str = "
v -10 0 10\nv 10 0 10\nv 10 0 -10\nv -10 0 -10
v -10 0 0\nv 10 0 0\nv 10 1 0\nv -10 1 0
f 1 2 3 4\nf 5 6 7 8
";

/// Its scene config, `wall.toml`; what a test adds follows it.
pub const SCENE: &str = r#"
title = "A wall"

[geometry]
file = "wall.obj"

[camera]
position_m = [0, 1.5, 4]
target_m = [0, 0.5, 0]
vertical_fov_deg = 40
near_m = 0.1
far_m = 50

[lighting.low]
ambient = { constant = [1, 1, 1] }
background = { colour = [1, 1, 1] }
"#;

/// A folder with the wall.
pub struct Wall {
    dir: tempfile::TempDir,
}

impl Wall {
    /// The scene, and more files by name.
    pub fn new(scene: &str, files: &[(&str, &str)]) -> Self {
        let dir = tempfile::tempdir().expect("a temporary folder");
        let wall = Self { dir };
        wall.write("wall.obj", MODEL);
        wall.write("wall.toml", scene);
        for (name, text) in files {
            wall.write(name, text);
        }
        wall
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("the folder can be written");
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_greyfield"));
        command.args(args).current_dir(self.dir.path());
        command
    }

    pub fn run(&self, args: &[&str]) -> Output {
        self.command(args).output().expect("the program starts")
    }
}
