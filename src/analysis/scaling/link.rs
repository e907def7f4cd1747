//! The two models of a choice: P(i preferred to j) = F(λᵢ − λⱼ), F symmetric about 0.

use crate::analysis::tails::normal_upper;

/// ln √(2π).
const LN_SQRT_2PI: f64 = 0.918_938_533_204_672_8;
/// The standard normal's 75 % point: one JOD in units of the probit scale.
pub const PROBIT_OF_JOD: f64 = 0.674_489_750_196_081_7;

/// F.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Link {
    /// Bradley & Terry: F is the logistic distribution.
    BradleyTerry,
    /// Thurstone's case V: F is the normal distribution; λ is in units of √2 σ.
    Thurstone,
}

/// What F is at one point and at its mirror image.
#[derive(Debug, Clone, Copy)]
pub struct At {
    /// ln F(η).
    pub ln_win: f64,
    /// ln F(−η).
    pub ln_loss: f64,
    /// F′(η)/F(η), by which a win pulls λ up.
    pub win_pull: f64,
    /// F′(η)/F(−η), by which a loss pulls it down.
    pub loss_pull: f64,
}

impl Link {
    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::BradleyTerry => "Bradley–Terry",
            Self::Thurstone => "Thurstone case V",
        }
    }

    /// Everything the fit needs of F at η. Nothing overflows and nothing is lost where F is near
    /// 0 or 1.
    #[must_use]
    pub fn at(self, eta: f64) -> At {
        let distance = eta.abs();
        let (ln_rare, ln_frequent, ln_density) = match self {
            Self::BradleyTerry => {
                let ln_frequent = -(-distance).exp().ln_1p();
                let ln_rare = ln_frequent - distance;
                (ln_rare, ln_frequent, ln_rare + ln_frequent)
            }
            Self::Thurstone => {
                let ln_rare = normal_upper(distance).ln();
                let ln_frequent = (-ln_rare.exp()).ln_1p();
                (ln_rare, ln_frequent, -0.5 * eta * eta - LN_SQRT_2PI)
            }
        };
        let (rare_pull, frequent_pull) = (
            (ln_density - ln_rare).exp(),
            (ln_density - ln_frequent).exp(),
        );
        if eta >= 0.0 {
            At {
                ln_win: ln_frequent,
                ln_loss: ln_rare,
                win_pull: frequent_pull,
                loss_pull: rare_pull,
            }
        } else {
            At {
                ln_win: ln_rare,
                ln_loss: ln_frequent,
                win_pull: rare_pull,
                loss_pull: frequent_pull,
            }
        }
    }

    /// −d²/dη² of ln F(η) and of ln F(−η): what a win and a loss add to the observed information.
    #[must_use]
    pub fn curvature(self, eta: f64, at: At) -> (f64, f64) {
        match self {
            Self::BradleyTerry => {
                let both = at.win_pull * at.loss_pull;
                (both, both)
            }
            Self::Thurstone => (
                at.win_pull * (at.win_pull + eta).max(0.0),
                at.loss_pull * (at.loss_pull - eta).max(0.0),
            ),
        }
    }

    /// First and second d/dη of the logarithm of the Fisher information of one vote, F′²/(F(1 − F)).
    #[must_use]
    pub fn information_slope(self, eta: f64, at: At) -> (f64, f64) {
        let (win, loss) = self.curvature(eta, at);
        match self {
            Self::BradleyTerry => (at.win_pull - at.loss_pull, -win - loss),
            Self::Thurstone => (-2.0 * eta - at.win_pull + at.loss_pull, win + loss - 2.0),
        }
    }
}

impl At {
    /// The Fisher information of one vote about η.
    #[must_use]
    pub fn information(&self) -> f64 {
        self.win_pull * self.loss_pull
    }
}
