//! What the numbers of the page are.

use super::CostReport;
use crate::report::markup::terms;

/// The section on how it was measured.
pub fn methods(page: &mut String, report: &CostReport) {
    page.push_str("<section>\n<h2>How it was measured</h2>\n");
    let about = &report.record.about;
    let reaches: Vec<String> = (report.record.scenes.iter())
        .map(|(id, scene)| format!("{id} {} m", scene.reach_m))
        .collect();
    let truth = format!(
        "Ray-traced: the share of the cosine-weighted hemisphere over a surface point that no triangle closes within the reach ({}), with a standard error of {} at most asked for. Errors against it are over all pixels that show a surface.",
        reaches.join(", "),
        about.truth_error
    );
    let flip = format!(
        "Mean over the image of the difference that a person could see when flipping between it and the image with the true occlusion, 0 to 1, at {:.1} pixels per degree of the field of view (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström & Fairchild 2020).",
        about.pixels_per_degree
    );
    terms(
        page,
        &[
            (
                "Occlusion, k_A",
                "The coefficient that ambient light is multiplied by: 0 is closed, 1 is open. All errors of occlusion are in its unit.",
            ),
            ("Truth", &truth),
            (
                "RMSE, MAE, p95, bias",
                "Root of the mean squared error, mean absolute error, 95th percentile of the absolute error, and mean error of k_A against the truth; a bias above 0 is too open.",
            ),
            (
                "Information loss",
                "RMSE against the truth of the best answer that the depth buffer alone allows: rays traced through the depths themselves, where what is seen has one thickness in the whole picture, the one of six tried that comes nearest to the truth. It is no strict floor under a technique's RMSE, as an error may happen to point the other way.",
            ),
            (
                "Estimator error",
                "RMSE of a technique against that best answer, over an even choice of the pixels: what it gets wrong of what it could know. The two errors do not add up, because they are not independent.",
            ),
            ("FLIP", &flip),
            (
                "SSIM",
                "Mean structural similarity to the image with the true occlusion, 1 for the same image (Wang, Bovik, Sheikh & Simoncelli 2004).",
            ),
            (
                "Time",
                "Median over frames of all passes that make the occlusion: the technique's own, the blur, the upsampling from half resolution. Its 95 % interval lies between order statistics and takes no distribution for granted (Conover 1999); six frames at least. None is given where there were fewer.",
            ),
            (
                "Blur",
                "The number behind b in a configuration's name is the half width of the depth-aware blur in pixels; b0 is unblurred. The blur's time is part of the whole.",
            ),
            (
                "Knee",
                "Where a front bends: the point furthest below the straight line between its ends, in the logarithm of time and in RMSE, both scaled to 0 to 1 (after Satopaa, Albrecht, Irwin & Raghavan 2011).",
            ),
        ],
    );
    page.push_str("</section>\n");
}
