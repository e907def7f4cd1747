//! What stands in a sweep's folder at the end: tables, figures, one page.

use std::io::Cursor;
use std::path::Path;

use anyhow::anyhow;

use super::pictures::{FOLDER, TRUTH};
use crate::cli::Failure;
use crate::cost::scaling::{ScalingRow, exponents};
use crate::cost::votes::Preference;
use crate::cost::{CostError, Store};
use crate::report::ReportError;
use crate::report::cost::{
    CostReport, PagePicture, exponents_csv, page, preferences_csv, scaling_csv,
};

/// Columns of a picture on the page; the pictures themselves lie in the folder.
const PAGE_WIDTH_PX: u32 = 640;

/// Name of the table of growth.
const GROWTH: &str = "scaling.csv";

/// The growth that an earlier run measured; none where there was no such run.
///
/// # Errors
/// A damaged table.
pub fn kept_growth(store: &Store) -> Result<Vec<ScalingRow>, Failure> {
    let path = store.path(GROWTH);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let rows = csv::Reader::from_path(&path)
        .and_then(|mut reader| reader.deserialize().collect::<Result<_, _>>());
    rows.map_err(|error| {
        let file = path.display();
        Failure::bad_input(anyhow!("{file} cannot be read: {error}; mend or remove it"))
    })
}

/// Writes tables, figures and the page.
///
/// # Errors
/// [`CostError::Files`].
pub fn write(
    store: &Store,
    preferences: &[Preference],
    votes_source: &str,
    growth: &[ScalingRow],
) -> Result<(), CostError> {
    let exponents = exponents(growth);
    let pictures = pictures(store);
    let report = CostReport {
        scaling: growth,
        exponents: &exponents,
        preferences,
        votes_source,
        pictures: &pictures,
        ..CostReport::of(&store.record, &store.rows)
    };
    if !growth.is_empty() {
        store.write(GROWTH, text(scaling_csv(growth))?.as_bytes())?;
        store.write("exponents.csv", text(exponents_csv(&exponents))?.as_bytes())?;
    }
    if !preferences.is_empty() {
        store.write("votes.csv", text(preferences_csv(preferences))?.as_bytes())?;
    }
    for (name, svg) in report.figures() {
        store.write(&format!("{name}.svg"), svg.as_bytes())?;
    }
    store.write("cost.html", page(&report).as_bytes())
}

fn text(written: Result<String, ReportError>) -> Result<String, CostError> {
    written.map_err(|error| CostError::Input(error.to_string()))
}

/// The pictures of the folder as the page shows them: the truth's first, then configuration by
/// configuration. One that cannot be read is left out: the page is for people, and the tables have
/// everything.
fn pictures(store: &Store) -> Vec<PagePicture> {
    let mut found: Vec<Found> = std::fs::read_dir(store.path(FOLDER))
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| Found::of(entry.file_name().into_string().ok()?))
        .filter(|found| store.record.scenes.contains_key(&found.scene))
        .collect();
    found.sort_by_key(|found| (found.subject != TRUTH, found.subject.clone(), found.order()));
    let of = |found: Found| {
        Some(PagePicture {
            caption: format!(
                "{}: {}",
                found.subject,
                found.what.replace("--", ", ").replace('-', " ")
            ),
            bytes: small_jpeg(&store.path(FOLDER).join(&found.file))?,
            mime: "image/jpeg",
            scene: found.scene,
            subject: found.subject,
        })
    };
    found.into_iter().filter_map(of).collect()
}

/// A picture by its name, `SCENE--SUBJECT--WHAT.png`.
struct Found {
    file: String,
    scene: String,
    subject: String,
    what: String,
}

impl Found {
    fn of(file: String) -> Option<Self> {
        let mut parts = file.strip_suffix(".png")?.splitn(3, "--");
        let mut part = || parts.next().map(str::to_owned);
        let (scene, subject, what) = (part()?, part()?, part()?);
        Some(Self {
            file,
            scene,
            subject,
            what,
        })
    }

    /// The occlusion before the images, an image before what differs in it.
    fn order(&self) -> (bool, String) {
        (!self.what.starts_with("occlusion"), self.what.clone())
    }
}

fn small_jpeg(path: &Path) -> Option<Vec<u8>> {
    let picture = image::open(path).ok()?;
    let picture = match picture.width() > PAGE_WIDTH_PX {
        true => picture.resize(
            PAGE_WIDTH_PX,
            u32::MAX,
            image::imageops::FilterType::Triangle,
        ),
        false => picture,
    };
    let mut bytes = Cursor::new(Vec::new());
    let encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 88);
    picture.to_rgb8().write_with_encoder(encoder).ok()?;
    Some(bytes.into_inner())
}
