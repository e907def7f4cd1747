//! What was found, as a table for people, as CSV, and as pictures.

use std::path::Path;

use greyfield::render::AdapterRecord;

use crate::Failure;
use crate::agreement::Agreement;
use crate::scene::{RADIUS_M, Scene, THICKNESS_M};
use crate::times::{self, Passes, Spread};
use crate::truth::{Distance, Truth};

/// One renderer's occlusion.
pub struct Row {
    pub name: String,
    pub blur_radius_px: Option<u32>,
    /// Frame by frame, in turn with the other rows'.
    pub times: Vec<Passes>,
    /// The occlusion before and after denoising.
    pub images: [Vec<f32>; 2],
}

/// A pass, or all.
type TimeMs = fn(&Passes) -> f64;

/// What is told of a frame.
const TIMES: [(&str, TimeMs); 4] = [
    ("mips", |passes| passes.before_ms),
    ("occlusion", |passes| passes.occlusion_ms),
    ("denoise", |passes| passes.denoise_ms),
    ("all", Passes::total_ms),
];

impl Row {
    fn spread(&self, time_ms: TimeMs) -> Spread {
        Spread::of(self.times.iter().map(time_ms))
    }

    /// For tables and files: a technique with two blurs is two rows.
    fn label(&self) -> String {
        let name = self.name.replace(':', "-");
        match self.blur_radius_px {
            Some(px) => format!("{name}-blur{px}"),
            None => name,
        }
    }
}

/// Everything that was found; the first row is what the others are compared with.
pub struct Report<'a> {
    pub scene: &'a Scene,
    pub adapter: &'a AdapterRecord,
    pub agreement: &'a Agreement,
    /// What Bevy's own diagnostics say of its first to last pass.
    pub own_ms: &'a [f64],
    pub rows: &'a [Row],
    pub truths: &'a [Truth],
}

impl Report<'_> {
    /// Prints it.
    pub fn print(&self) {
        let (width_px, height_px) = self.scene.size_px;
        println!(
            "{} at {width_px}x{height_px}, {} triangles, radius {RADIUS_M} m, thickness {THICKNESS_M} m, on {} ({}, {})",
            self.scene.config.id,
            self.scene.geometry.triangles(),
            self.adapter.name,
            self.adapter.kind,
            self.adapter.driver,
        );
        println!("{}", self.agreement.line());
        self.print_times();
        for truth in self.truths {
            self.print_errors(truth);
        }
    }

    /// Characters of the longest label.
    fn label_width(&self) -> usize {
        let labels = self.rows.iter().map(|row| row.label().len());
        labels.max().unwrap_or_default()
    }

    fn print_times(&self) {
        let width = self.label_width();
        println!(
            "\nms, median [middle half] over {} frames; x: times Bevy's\n",
            self.rows[0].times.len()
        );
        print!("{:<width$}", "");
        for (name, _) in TIMES {
            print!(" {name:>26} {:>5}", "x");
        }
        println!();
        for row in self.rows {
            print!("{:<width$}", row.label());
            for (_, time_ms) in TIMES {
                let ratio = times::ratio(&row.times, &self.rows[0].times, time_ms);
                print!(" {:>26} {ratio:>5.2}", with_spread(row.spread(time_ms)));
            }
            println!();
        }
        let mut own_ms = self.own_ms.to_vec();
        own_ms.sort_by(f64::total_cmp);
        if let Some(median_ms) = own_ms.get(own_ms.len() / 2) {
            println!(
                "\nBevy's own diagnostics say {median_ms:.1} ms for all, median of {} frames of its own",
                own_ms.len()
            );
        }
    }

    fn print_errors(&self, truth: &Truth) {
        let width = self.label_width();
        let errors = truth
            .found
            .standard_error
            .iter()
            .zip(&self.agreement.counts);
        let squares: Vec<f64> = errors
            .filter(|&(_, &counts)| counts)
            .map(|(&error, _)| f64::from(error).powi(2))
            .collect();
        println!(
            "\nagainst the truth, {} (its own standard error: {:.4})\n",
            truth.name,
            (squares.iter().sum::<f64>() / (squares.len() as f64).max(1.0)).sqrt(),
        );
        println!(
            "{:<width$} {:>32} {:>32}\n{:<width$} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}",
            "", "before denoising", "after", "", "RMSE", "MAE", "bias", "RMSE", "MAE", "bias"
        );
        for row in self.rows {
            print!("{:<width$}", row.label());
            for distance in self.distances(row, truth) {
                let Distance { rmse, mae, bias } = distance;
                print!(" {rmse:>10.4} {mae:>10.4} {bias:>+10.4}");
            }
            println!();
        }
    }

    fn distances(&self, row: &Row, truth: &Truth) -> [Distance; 2] {
        let counts = &self.agreement.counts;
        let distance = |image: &Vec<f32>| Distance::new(image, &truth.found.occlusion, counts);
        row.images.each_ref().map(distance)
    }

    /// Writes `ssao.csv` and the pictures.
    pub fn write(&self, folder: &Path) -> Result<(), Failure> {
        self.write_csv(&folder.join("ssao.csv"))?;
        for row in self.rows {
            let label = row.label();
            for (image, when) in row.images.iter().zip(["noisy", "denoised"]) {
                self.write_png(&folder.join(format!("{label}-{when}.png")), image)?;
            }
        }
        for truth in self.truths {
            let path = folder.join(format!("truth-{}.png", truth.key));
            self.write_png(&path, &truth.found.occlusion)?;
        }
        println!("\nssao.csv and pictures are in {}", folder.display());
        Ok(())
    }

    fn write_csv(&self, path: &Path) -> Result<(), Failure> {
        let mut csv = csv::Writer::from_path(path)?;
        let mut header: Vec<String> = ["scene", "adapter", "occlusion", "blur_radius_px"]
            .map(str::to_owned)
            .to_vec();
        for (pass, _) in TIMES {
            let numbers = [
                "median_ms",
                "first_quartile_ms",
                "third_quartile_ms",
                "times_bevys",
            ];
            header.extend(numbers.map(|number| format!("{pass}_{number}")));
        }
        for truth in self.truths {
            for when in ["noisy", "denoised"] {
                let numbers = ["rmse", "mae", "bias"];
                header.extend(numbers.map(|number| format!("{}_{when}_{number}", truth.key)));
            }
        }
        csv.write_record(&header)?;
        for row in self.rows {
            let blur = row
                .blur_radius_px
                .map_or(String::new(), |px| px.to_string());
            let mut record = vec![
                self.scene.config.id.clone(),
                self.adapter.name.clone(),
                row.name.clone(),
                blur,
            ];
            for (_, time_ms) in TIMES {
                let Spread {
                    median,
                    quartiles: [low, high],
                } = row.spread(time_ms);
                let ratio = times::ratio(&row.times, &self.rows[0].times, time_ms);
                record.extend([median, low, high, ratio].map(|number| number.to_string()));
            }
            for truth in self.truths {
                for Distance { rmse, mae, bias } in self.distances(row, truth) {
                    record.extend([rmse, mae, bias].map(|number| number.to_string()));
                }
            }
            csv.write_record(&record)?;
        }
        Ok(csv.flush()?)
    }

    /// Linear: 0 closed, 255 open.
    fn write_png(&self, path: &Path, image: &[f32]) -> Result<(), Failure> {
        let (width_px, height_px) = self.scene.size_px;
        let byte = |value: &f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
        let grey: Vec<u8> = image.iter().map(byte).collect();
        Ok(image::save_buffer(
            path,
            &grey,
            width_px,
            height_px,
            image::ExtendedColorType::L8,
        )?)
    }
}

fn with_spread(spread: Spread) -> String {
    let [low, high] = spread.quartiles;
    format!("{:.1} [{low:.1} to {high:.1}]", spread.median)
}
