//! A small study on disk: tiny images, a protocol with every text of its own, a
//! results folder.
#![allow(dead_code)] // every test file uses another part of it

use std::path::{Path, PathBuf};

use greyfield::digest::sha256_hex;
use greyfield::protocol::{Protocol, SessionPlan};
use greyfield::seed;
use greyfield::session::start;
use greyfield::stimulus::ImageRecord;
use greyfield::stimulus::manifest::{Manifest, PairRecord, SCHEMA_VERSION};

pub const PROTOCOL: &str = r#"
study_id = "tiny"
stimuli = "stimuli/tiny.toml"
procedure = "no-reference"
design = "latin"
seed = 3
planned_participants = 6

[grey]
duration_ms = 2000
level_srgb = 128
area = "screen"

# Whatever display the tests have, it will do.
[display]
minimum_frames = 10
maximum_jitter_ms = 1000
full_screen = false
focus = false
verdict = "warn"

[texts]
title = "Welcome"
instructions = """
You will see pairs of images.

Take your time."""
begin = "Begin"
menu = "Press the next button when you are ready."
pair = "Pair {n}"
question = "Which image looked more realistic?"
answer_first = "The first image"
answer_second = "The second image"
saving = "One moment, please."
trouble = "Please call the experimenter."
closing = "That was the last pair. Thank you!"
aborted = "The session has ended."
"#;

/// A study in a temporary folder.
pub struct Tiny {
    pub folder: tempfile::TempDir,
    pub manifest: Manifest,
}

impl Tiny {
    /// `pairs` pairs of noise of the given size, their manifest and the protocol.
    pub fn new(pairs: usize, size_px: [u32; 2]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let stimuli = folder.path().join("stimuli");
        std::fs::create_dir(&stimuli).expect("a folder for the images");
        let manifest = Manifest {
            schema_version: SCHEMA_VERSION,
            set_id: String::from("tiny"),
            config_sha256: String::new(),
            seed: 0,
            app_version: String::from("test"),
            adapter: None,
            pairs: (0..pairs).map(|n| pair(&stimuli, n, size_px)).collect(),
        };
        let text = serde_json::to_string(&manifest).expect("a manifest is JSON");
        std::fs::write(stimuli.join("manifest.json"), text).expect("the manifest is written");
        std::fs::write(folder.path().join("tiny.toml"), PROTOCOL).expect("the protocol is written");
        Self { folder, manifest }
    }

    /// Size of every image.
    pub fn size_px(&self) -> [u32; 2] {
        let image = &self.manifest.pairs[0].first;
        [image.width_px, image.height_px]
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn protocol(&self) -> Protocol {
        let path = self.path("tiny.toml");
        let text = std::fs::read_to_string(&path).expect("the protocol is there");
        Protocol::parse(&path, &text).expect("the protocol parses")
    }

    pub fn plan(&self, slot: u32) -> SessionPlan {
        let protocol = self.protocol();
        let conditions = start::conditions(&protocol, &self.manifest).expect("conditions");
        SessionPlan::new(&protocol, &conditions, slot).expect("a plan")
    }

    /// The two images of a trial in the order shown.
    pub fn shown(&self, plan: &SessionPlan, trial: usize) -> [&ImageRecord; 2] {
        let trial = &plan.trials[trial];
        let pair = &self.manifest.pairs[trial.condition];
        if trial.reversed {
            [&pair.second, &pair.first]
        } else {
            [&pair.first, &pair.second]
        }
    }

    /// The bytes of an image, red, green, blue, alpha.
    pub fn rgba8(&self, image: &ImageRecord) -> Vec<u8> {
        let bytes = std::fs::read(self.path("stimuli").join(&image.file)).expect("the image");
        image::load_from_memory(&bytes)
            .expect("a PNG")
            .to_rgba8()
            .into_raw()
    }
}

fn pair(folder: &Path, n: usize, size_px: [u32; 2]) -> PairRecord {
    let image = |which: &str, technique: &str| {
        let file = PathBuf::from(format!("pair{n}-{which}.png"));
        let mut rng = seed::generator(n as u64, which, 0);
        let noise = image::RgbImage::from_fn(size_px[0], size_px[1], |_, _| {
            image::Rgb([0; 3].map(|_: u8| seed::below(&mut rng, 256) as u8))
        });
        let path = folder.join(&file);
        noise.save(&path).expect("the image is written");
        let bytes = std::fs::read(&path).expect("the image is there");
        ImageRecord {
            file,
            sha256: sha256_hex(&bytes),
            width_px: size_px[0],
            height_px: size_px[1],
            technique: String::from(technique),
            parameters: std::collections::BTreeMap::default(),
            passes: Vec::new(),
            source: None,
        }
    };
    PairRecord {
        condition: format!("condition{n}"),
        scene: String::from("noise"),
        validity: String::from("low"),
        hypothesis: String::from("H1"),
        first: image("first", "none"),
        second: image("second", "crytek24"),
    }
}
