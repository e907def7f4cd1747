//! What the numbers of the page are.

use crate::reference::bounce_fit::LEAST_TEXELS;
use crate::report::markup::terms;

/// The section on how it was measured.
pub fn methods(page: &mut String) {
    page.push_str("<section>\n<h2>How it was measured</h2>\n");
    let bins = format!(
        "Texels are sorted into 100 equal bins of α; bins with fewer than {LEAST_TEXELS} texels say nothing. Fits and errors take the mean of a bin. Every bin of a map counts alike however many texels it has, so that rare openness is fitted as well as common; our own form also counts every map alike, the published forms every bin of every map."
    );
    terms(
        page,
        &[
            (
                "What is simulated",
                "Diffuse surfaces under a sky of radiance 1. Every texel of a height field sends rays over its whole hemisphere, evenly in solid angle. A ray that meets nothing sees the sky; one that meets the field is a link to the texel there. Light then runs along the links, bounce after bounce, and nothing else is approximated but the number of rays and of texels.",
            ),
            (
                "Openness, α",
                "The share of a texel's rays that are free, without the cosine: 0 is closed, 1 is open.",
            ),
            (
                "Irradiance, E/π, F",
                "What a texel receives as a share of the π of a point in the open. F₀ is the direct light, F₁ what one bounce brings at an albedo of 1, and so on; with an albedo ρ everywhere the sum is F₀ + ρF₁ + ρ²F₂ + …",
            ),
            (
                "Border",
                "A tiled field goes on without end in all directions, so that no light is lost. An open one ends at its border, and rays that leave it are free: points near the border are more open than the same points of a larger map would be.",
            ),
            ("Bins and weights", &bins),
            (
                "Models",
                "All get the bin's mean openness and the albedo, but for those made for cosine-weighted openness: they get the direct light that was measured, which is more than a renderer that stores α knows.",
            ),
            (
                "rmse, worst",
                "Root mean square and largest size of a model's E/π minus the measured one, over the bins of a map. By texel: every texel weighs alike, each taken as the mean of its bin. Where a model is no finite number the bin is counted and left out.",
            ),
            (
                "Held out",
                "Maps that the fits of this page have not seen. What a refitted model misses on them is what to expect of it elsewhere.",
            ),
            (
                "95 % intervals",
                "Student's t times the standard errors from the Jacobian at the solution. That takes the residuals as independent, alike in size, and the form as right; neighbouring bins of one map are not independent, and other maps differ by more than these intervals say.",
            ),
            (
                "Mean curve of the maps fitted to",
                "No formula: the mean of the maps' own curves by openness. What it misses on a map is about what any function of openness and albedo alone must miss there.",
            ),
        ],
    );
    page.push_str("</section>\n");
}
