//! What every figure and the page must hold.

use super::*;
use crate::multi_bounce::Coefficients;
use crate::reference::bounce_fit::{
    ColourPicture, MapSettings, StudiedMap, errors, fit_forms, fit_greyfield,
};
use crate::reference::height_field::{
    Border, Bounces, HeightField, LinkSettings, Links, TransportSettings, procedural,
};

/// A procedural map, followed.
fn studied(
    name: &str,
    size: usize,
    rays: usize,
    amplitude: f64,
    held_out: bool,
) -> (StudiedMap, Links) {
    let heights = (procedural::find(name).unwrap().heights)(size, 1);
    let scale = amplitude as f32 * size as f32;
    let heights: Vec<f32> = heights.iter().map(|height| height * scale).collect();
    let field = HeightField::new((size, size), &heights, Border::Tiled).unwrap();
    let settings = LinkSettings { rays, seed: 1 };
    let links = Links::cast(&field, &settings, &|_| {});
    let bounces = Bounces::follow(
        &links,
        &vec![1.0; size * size],
        &TransportSettings::default(),
    );
    let settings = MapSettings {
        name: name.to_owned(),
        size_px: (size, size),
        amplitude,
        border: Border::Tiled,
        rays,
        held_out,
    };
    (StudiedMap::of(settings, &bounces), links)
}

/// The first map in its colours: every model, off and truth.
fn pictures(links: &Links, size: usize, albedo: [f32; 3]) -> Vec<ColourPicture> {
    let channels = albedo.map(|rho| {
        let all = vec![rho; links.texels()];
        Bounces::follow(links, &all, &TransportSettings::default())
    });
    let of = |name: &str, value: &dyn Fn(usize, usize) -> f32| ColourPicture {
        name: name.to_owned(),
        size_px: (size, size),
        rgb: (0..links.texels())
            .map(|texel| [0, 1, 2].map(|c| albedo[c] * value(texel, c) / std::f32::consts::PI))
            .collect(),
    };
    let pi = std::f64::consts::PI;
    let mut found = vec![of("off", &|texel, c| channels[c].irradiance[0][texel])];
    for model in crate::multi_bounce::MODELS.iter().skip(1) {
        found.push(of(model.name, &|texel, c| {
            let alpha = f64::from(channels[c].openness[texel]);
            let given = crate::multi_bounce::Openness::Uniform;
            (pi * model.value(given, alpha, f64::from(albedo[c]))) as f32
        }));
    }
    found.push(of("truth", &|texel, c| channels[c].sum(texel)));
    found
}

/// Everything, from small maps.
fn study(size: usize, rays: usize, names: &[&str]) -> Study {
    let amplitude = |name: &str| if name == "fbm" { 0.25 } else { 0.12 };
    let of = |(place, name): (usize, &&str)| {
        let held_out = place > 0 && 2 * place >= names.len();
        studied(name, size, rays, amplitude(name), held_out)
    };
    let (maps, links): (Vec<_>, Vec<_>) = names.iter().enumerate().map(of).unzip();
    let fitted: Vec<_> = maps
        .iter()
        .filter(|map| !map.held_out)
        .map(|map| map.measured.clone())
        .collect();
    let mut fits = fit_forms(&fitted).unwrap();
    let (refitted, fit) = fit_greyfield(&fitted).unwrap();
    fits.push(fit);
    let sweep =
        [0.02, 0.06, 0.2].map(|amplitude| studied(names[0], size, rays / 2, amplitude, false).0);
    let albedo = [0.75, 0.45, 0.2];
    Study {
        errors: errors(&maps, Some(&refitted)),
        maps,
        sweep: sweep.to_vec(),
        fits,
        refitted: Some(refitted),
        pictures: pictures(&links[0], size, albedo),
        albedo: albedo.map(f64::from),
    }
}

fn small() -> Study {
    static SMALL: std::sync::OnceLock<Study> = std::sync::OnceLock::new();
    let made = || study(48, 64, &["bricks", "fbm"]);
    SMALL.get_or_init(made).clone()
}

/// Every number of a coordinate is one, and lies inside the drawing; elements are closed.
fn assert_sound(figure: &Figure) {
    let (svg, stem) = (&figure.svg, &figure.stem);
    let drawing: Vec<&str> = svg.split("</style>").collect();
    let size: Vec<f64> = (quoted(svg, "viewBox=\""))
        .split(' ')
        .map(|n| n.parse().unwrap())
        .collect();
    let inside = |place: f64, most: f64| {
        assert!(
            (-0.01..=most + 0.01).contains(&place),
            "{stem}: {place} of {most}"
        )
    };
    for (name, most) in [
        ("x", size[2]),
        ("x1", size[2]),
        ("x2", size[2]),
        ("cx", size[2]),
        ("y", size[3]),
        ("y1", size[3]),
        ("y2", size[3]),
        ("cy", size[3]),
    ] {
        for part in drawing[1].split(&format!(" {name}=\"")).skip(1) {
            inside(part.split('"').next().unwrap().parse().unwrap(), most);
        }
    }
    for part in svg.split(" points=\"").skip(1) {
        for pair in part.split('"').next().unwrap().split(' ') {
            let (x, y) = pair.split_once(',').unwrap();
            inside(x.parse().unwrap(), size[2]);
            inside(y.parse().unwrap(), size[3]);
        }
    }
    for part in svg.split(" d=\"M").skip(1) {
        for dot in part
            .split('"')
            .next()
            .unwrap()
            .split("h0")
            .filter(|dot| !dot.is_empty())
        {
            let (x, y) = dot.trim_start_matches('M').split_once(' ').unwrap();
            inside(x.parse().unwrap(), size[2]);
            inside(y.parse().unwrap(), size[3]);
        }
    }
    assert!(
        !drawing[1].contains("NaN") && !drawing[1].contains(">inf<"),
        "{stem}"
    );
    assert_closed(svg, stem);
}

fn quoted<'a>(text: &'a str, after: &str) -> &'a str {
    text.split(after).nth(1).unwrap().split('"').next().unwrap()
}

/// Every element that opens closes, in order, and every `&` begins an entity.
fn assert_closed(text: &str, name: &str) {
    let mut open: Vec<&str> = Vec::new();
    for part in text.split('<').skip(1) {
        let (tag, after) = part.split_once('>').unwrap();
        assert!(
            !after.contains('>') || after.contains("</style"),
            "{name}: > in {after}"
        );
        let word = tag.split([' ', '\n']).next().unwrap();
        match word.strip_prefix('/') {
            Some(closed) => assert_eq!(open.pop(), Some(closed), "{name}"),
            None if tag.ends_with('/') => {}
            None => open.push(word),
        }
    }
    assert!(open.is_empty(), "{name}: {open:?}");
    for part in text.split('&').skip(1) {
        assert!(
            ["amp;", "lt;", "gt;", "quot;"]
                .iter()
                .any(|entity| part.starts_with(entity)),
            "{name}: &{part:.20}"
        );
    }
}

#[test]
fn every_figure_is_whole_and_says_what_its_axes_are() {
    let study = small();
    let found = figures(&study);
    let stems: Vec<&str> = found.iter().map(|figure| figure.stem.as_str()).collect();
    assert_eq!(
        stems,
        [
            "curves--bricks",
            "curves--fbm",
            "decay--bricks",
            "direct",
            "first-bounce",
            "sum",
            "family--bricks",
            "family--fbm",
            "residuals--fitted",
            "residuals--held-out",
            "saturation",
            "colour-bleeding",
            "amplitudes"
        ]
    );
    for figure in &found {
        assert_sound(figure);
        let is_picture = figure.stem == "colour-bleeding";
        assert!(
            is_picture || figure.svg.contains("openness α"),
            "{}",
            figure.stem
        );
        let said = ["irradiance", "E₁/π", "E₀/π", "E/π", "τ₂", "luminance"];
        assert!(
            said.iter().any(|said| figure.svg.contains(said)),
            "{}",
            figure.stem
        );
        assert!(!figure.svg.contains("http:") || figure.svg.matches("http:").count() == 1);
    }
    let family = &found[6].svg;
    for model in crate::multi_bounce::MODELS {
        assert!(
            family.contains(&format!(">{}", model.name)),
            "{}",
            model.name
        );
    }
    assert!(family.contains("class=\"out\"") && family.contains("greyfield, refitted"));
}

#[test]
fn the_page_loads_nothing_and_names_everything() {
    let study = small();
    let text = page(&study, "greyfield bounces <map> --fit");
    assert_eq!(text, page(&study, "greyfield bounces <map> --fit"));
    let links = text.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    assert!(!links.contains("http:") && !links.contains("https:") && !links.contains("<script"));
    assert!(text.contains("greyfield bounces &lt;map&gt; --fit"));
    assert!(text.contains("data:image/png;base64,"));
    for map in &study.maps {
        assert!(text.contains(&format!(">{}<", map.name)), "{}", map.name);
    }
    for error in &study.errors {
        assert!(text.contains(&error.model), "{}", error.model);
    }
    for section in [
        "Every bounce",
        "Amplitude",
        "Colour",
        "How it was measured",
        "held out",
    ] {
        assert!(text.contains(section), "{section}");
    }
}

#[test]
fn what_was_not_asked_for_is_left_out() {
    let mut study = small();
    (study.sweep, study.fits, study.pictures) = (Vec::new(), Vec::new(), Vec::new());
    (study.refitted, study.errors) = (None, Vec::new());
    let text = page(&study, "");
    for section in [
        ">Amplitude<",
        "95 % intervals where",
        "What the models miss</h2>",
        "data:image",
    ] {
        assert!(!text.contains(section), "{section}");
    }
    figures(&study).iter().for_each(assert_sound);
    study.maps.clear();
    assert!(figures(&study).is_empty() && page(&study, "").ends_with("</html>\n"));
}

/// An even plane is open everywhere: one bin, and no bounce at all.
#[test]
fn a_map_of_one_bin_has_every_figure() {
    let mut study = small();
    let (flat, links) = studied("fbm", 24, 64, 0.0, false);
    assert_eq!(flat.measured.bins.len(), 1);
    study.pictures = pictures(&links, 24, [0.5; 3]);
    study.maps = vec![StudiedMap {
        name: String::from("<flat> & even"),
        ..flat
    }];
    study.sweep = study.maps.clone();
    study.errors = errors(&study.maps, None);
    study.refitted = None::<Coefficients>;
    figures(&study).iter().for_each(assert_sound);
    let text = page(&study, "");
    assert!(text.contains("&lt;flat&gt; &amp; even") && !text.contains("<flat>"));
    assert!(figures(&study)[0].stem.starts_with("curves---flat-"));
}

/// For eyes: `BOUNCES_OUT=DIR cargo test … -- --ignored for_eyes` writes page and figures there.
#[test]
#[ignore = "writes files to look at"]
fn for_eyes() {
    let Some(out) = std::env::var_os("BOUNCES_OUT").map(std::path::PathBuf::from) else {
        return;
    };
    std::fs::create_dir_all(&out).unwrap();
    let study = study(192, 256, &["bricks", "pebbles", "fbm", "concrete"]);
    for figure in figures(&study) {
        std::fs::write(out.join(format!("{}.svg", figure.stem)), figure.svg).unwrap();
    }
    let text = page(&study, "greyfield bounces bricks --fit");
    std::fs::write(out.join("bounces.html"), text).unwrap();
}
