//! What a trial puts before the participant: a pair, one image alone, a pair with
//! its reference, or every version of a scene. A stimulus set is a list of pairs;
//! the other kinds are made from the images of those pairs.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::options::twice;
use super::{PlanError, Position, Protocol};

/// One pair of a stimulus set: two techniques on one scene in one lighting.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pair {
    /// Condition id (`sponza-moderate-h1`).
    pub id: String,
    /// Scene id (`atrium`).
    pub scene: String,
    /// Lighting or validity of the scene (`moderate`): pairs of one scene and one
    /// lighting show the same view.
    pub lighting: String,
    /// Techniques in the base order.
    pub techniques: [String; 2],
    /// SHA-256 of the images; empty where they are not drawn yet.
    pub image_sha256: [String; 2],
    /// The hypothesis it asks (`H1`); empty where none is said.
    pub hypothesis: String,
}

/// One condition of a study, as the design needs it: the images of one trial.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "AsWritten")]
pub struct Condition {
    /// Condition id (`sponza-moderate-h1`).
    pub id: String,
    /// Scene id (`atrium`).
    pub scene: String,
    /// Techniques of its images in the base order: two of a pair, one of a single
    /// image, all of a scene's versions.
    pub techniques: Vec<String>,
    /// Technique of the image the others are compared with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// The hypothesis it asks (`H1`), free text; empty where none is said.
    pub hypothesis: String,
}

/// A condition in a file; results folders begun before there were other procedures
/// than pairs name two techniques.
#[derive(Deserialize)]
struct AsWritten {
    id: String,
    scene: String,
    #[serde(default)]
    techniques: Vec<String>,
    first_technique: Option<String>,
    second_technique: Option<String>,
    reference: Option<String>,
    #[serde(default)]
    hypothesis: String,
}

impl From<AsWritten> for Condition {
    fn from(written: AsWritten) -> Self {
        let pair = written.first_technique.into_iter();
        let pair = pair.chain(written.second_technique);
        Self {
            id: written.id,
            scene: written.scene,
            techniques: pair.chain(written.techniques).collect(),
            reference: written.reference,
            hypothesis: written.hypothesis,
        }
    }
}

/// Where an image of an exhibit is found: one side of a pair of the set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ImageOf {
    /// Index of the pair.
    pub pair: usize,
    /// Which of its two images, in the base order.
    pub position: Position,
}

/// A condition and the images it shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exhibit {
    /// The condition.
    pub condition: Condition,
    /// Its images, in the base order.
    pub images: Vec<ImageOf>,
    /// The image they are compared with.
    pub reference: Option<ImageOf>,
}

/// What kind of exhibit a procedure shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exhibits {
    /// The pairs as the set has them.
    Pairs,
    /// Every different image of the set, alone.
    Singles,
    /// The pairs, each with the image of its view that the protocol's
    /// `reference.technique` made. A pair that holds that image itself is shown
    /// only where the protocol names it, for practice or as a catch trial.
    PairsWithReference,
    /// Every view with all its different images at once.
    Versions,
}

/// One different image of a view.
struct Version<'a> {
    technique: &'a str,
    sha256: &'a str,
    image: ImageOf,
}

/// The different images of one view, in the order the set names them.
struct View<'a> {
    scene: &'a str,
    lighting: &'a str,
    versions: Vec<Version<'a>>,
}

/// The exhibits of a protocol over the pairs of its stimulus set, in the set's order.
///
/// # Errors
/// [`PlanError::NoReference`] for a pair whose view the reference technique has not drawn;
/// [`PlanError::OneVersion`] for a view with nothing to rank.
pub fn exhibits(protocol: &Protocol, pairs: &[Pair]) -> Result<Vec<Exhibit>, PlanError> {
    match protocol.procedure.exhibits {
        Exhibits::Pairs => Ok((0..pairs.len()).map(|pair| of_pair(pairs, pair)).collect()),
        Exhibits::Singles => Ok(views(pairs).iter().flat_map(singles).collect()),
        Exhibits::PairsWithReference => with_reference(protocol, pairs),
        Exhibits::Versions => views(pairs).iter().map(versions).collect(),
    }
}

fn of_pair(pairs: &[Pair], index: usize) -> Exhibit {
    let pair = &pairs[index];
    let image = |position| ImageOf {
        pair: index,
        position,
    };
    Exhibit {
        condition: Condition {
            id: pair.id.clone(),
            scene: pair.scene.clone(),
            techniques: pair.techniques.to_vec(),
            reference: None,
            hypothesis: pair.hypothesis.clone(),
        },
        images: vec![image(Position::First), image(Position::Second)],
        reference: None,
    }
}

fn views(pairs: &[Pair]) -> Vec<View<'_>> {
    let mut views: Vec<View> = Vec::new();
    let mut known = BTreeMap::new();
    for (index, pair) in pairs.iter().enumerate() {
        let view = *known
            .entry((&pair.scene, &pair.lighting))
            .or_insert_with(|| {
                views.push(View {
                    scene: &pair.scene,
                    lighting: &pair.lighting,
                    versions: Vec::new(),
                });
                views.len() - 1
            });
        for position in [Position::First, Position::Second] {
            let place = position.place();
            let (technique, sha256) = (&*pair.techniques[place], &*pair.image_sha256[place]);
            let versions = &mut views[view].versions;
            // Two images of one name that differ become two conditions of one name,
            // which no plan takes.
            if versions
                .iter()
                .all(|known| (known.technique, known.sha256) != (technique, sha256))
            {
                versions.push(Version {
                    technique,
                    sha256,
                    image: ImageOf {
                        pair: index,
                        position,
                    },
                });
            }
        }
    }
    views
}

impl View<'_> {
    fn id(&self) -> String {
        [self.scene, self.lighting]
            .into_iter()
            .filter(|part| !part.is_empty())
            .collect::<Vec<_>>()
            .join("-")
    }
}

fn singles<'a>(view: &'a View<'_>) -> impl Iterator<Item = Exhibit> + 'a {
    view.versions.iter().map(|version| Exhibit {
        condition: Condition {
            id: format!("{}-{}", view.id(), version.technique),
            scene: view.scene.to_owned(),
            techniques: vec![version.technique.to_owned()],
            reference: None,
            hypothesis: String::new(),
        },
        images: vec![version.image],
        reference: None,
    })
}

fn versions(view: &View<'_>) -> Result<Exhibit, PlanError> {
    if view.versions.len() < 2 {
        return Err(PlanError::OneVersion(view.id()));
    }
    let names = view.versions.iter().map(|version| version.technique);
    if let Some(technique) = twice(names) {
        return Err(PlanError::TwoImages {
            view: view.id(),
            technique: technique.to_owned(),
        });
    }
    let technique = |version: &Version| version.technique.to_owned();
    Ok(Exhibit {
        condition: Condition {
            id: view.id(),
            scene: view.scene.to_owned(),
            techniques: view.versions.iter().map(technique).collect(),
            reference: None,
            hypothesis: String::new(),
        },
        images: view.versions.iter().map(|version| version.image).collect(),
        reference: None,
    })
}

fn with_reference(protocol: &Protocol, pairs: &[Pair]) -> Result<Vec<Exhibit>, PlanError> {
    let wanted = protocol
        .reference
        .as_ref()
        .map_or("", |reference| &*reference.technique);
    let views = views(pairs);
    let mut exhibits = Vec::new();
    for (index, pair) in pairs.iter().enumerate() {
        let holds_it = pair.techniques.iter().any(|technique| technique == wanted);
        if holds_it && !protocol.names(&pair.id) {
            continue;
        }
        let view = views
            .iter()
            .find(|view| view.scene == pair.scene && view.lighting == pair.lighting);
        let reference = view
            .and_then(|view| view.versions.iter().find(|known| known.technique == wanted))
            .ok_or_else(|| PlanError::NoReference {
                pair: pair.id.clone(),
                technique: wanted.to_owned(),
            })?;
        let mut exhibit = of_pair(pairs, index);
        exhibit.condition.reference = Some(wanted.to_owned());
        exhibit.reference = Some(reference.image);
        exhibits.push(exhibit);
    }
    Ok(exhibits)
}

#[cfg(test)]
mod tests;
