//! Heights on a grid, with a surface through them.

use glam::Vec3;

/// What lies beyond the edge of a height field.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Border {
    /// The field again, without end: no light is lost.
    Tiled,
    /// Nothing: a ray that leaves is free, whatever its direction.
    Open,
}

/// Side of a square of texels that a ray may pass over at once, texels.
pub(super) const BLOCK: usize = 16;

/// Heights at the corners of a grid of unit squares, joined by triangles: each square is cut from
/// its upper right to its lower left corner. Lengths are in texels, +z is up.
#[derive(Debug, Clone)]
pub struct HeightField {
    width: usize,
    height: usize,
    border: Border,
    /// Rows of `width + BLOCK + 1` heights, `height + BLOCK + 1` of them: what follows the last
    /// column and row is the first again, or the last, as the border has it.
    padded: Vec<f32>,
    /// The highest of the square of `BLOCK + 1` heights that begins at each texel.
    highest_of_block: Vec<f32>,
    highest: f32,
}

/// Heights that make no field.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HeightFieldError {
    /// Too few or too many.
    #[error("a height field needs 2×2 to {most}×{most} texels, found {width}×{height}")]
    Size {
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
        /// Most of either.
        most: usize,
    },
    /// Not as many as the size says.
    #[error("{found} heights are not {width}×{height}")]
    Count {
        /// How many there are.
        found: usize,
        /// Columns.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// No number.
    #[error("the height at column {x}, row {y} is {found}; a finite number is needed")]
    NotFinite {
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// What is there.
        found: f32,
    },
}

impl HeightField {
    /// Texels on a side at most: what a link can count.
    pub const LARGEST: usize = 16_384;

    /// A field of `width` × `height` heights in texels, rows from the top.
    ///
    /// # Errors
    /// [`HeightFieldError`].
    pub fn new(
        (width, height): (usize, usize),
        heights: &[f32],
        border: Border,
    ) -> Result<Self, HeightFieldError> {
        let allowed = 2..=Self::LARGEST;
        if !allowed.contains(&width) || !allowed.contains(&height) {
            return Err(HeightFieldError::Size {
                width,
                height,
                most: Self::LARGEST,
            });
        }
        if heights.len() != width * height {
            return Err(HeightFieldError::Count {
                found: heights.len(),
                width,
                height,
            });
        }
        if let Some(at) = heights.iter().position(|z| !z.is_finite()) {
            return Err(HeightFieldError::NotFinite {
                x: at % width,
                y: at / width,
                found: heights[at],
            });
        }
        let around = |at: usize, size: usize| match border {
            Border::Tiled => at % size,
            Border::Open => at.min(size - 1),
        };
        let stride = width + BLOCK + 1;
        let padded: Vec<f32> = (0..(height + BLOCK + 1) * stride)
            .map(|at| heights[around(at / stride, height) * width + around(at % stride, width)])
            .collect();
        Ok(Self {
            highest_of_block: highest_of_blocks(&padded, (width, height), stride),
            highest: heights.iter().copied().fold(f32::MIN, f32::max),
            width,
            height,
            border,
            padded,
        })
    }

    /// Columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// Number of texels.
    #[must_use]
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Never: a field has texels.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// What lies beyond the edge.
    #[must_use]
    pub fn border(&self) -> Border {
        self.border
    }

    /// The highest of all heights.
    #[must_use]
    pub fn highest(&self) -> f32 {
        self.highest
    }

    /// The height of a texel.
    #[must_use]
    pub fn at(&self, x: usize, y: usize) -> f32 {
        self.padded[y * self.stride() + x]
    }

    /// The unit normal of a texel, by central differences: one texel to either side, or what the
    /// border has there.
    #[must_use]
    pub fn normal(&self, x: usize, y: usize) -> Vec3 {
        let slope = |at: usize, size: usize, height: &dyn Fn(usize) -> f32| match self.border {
            Border::Tiled => 0.5 * (height((at + 1) % size) - height((at + size - 1) % size)),
            Border::Open => {
                let (before, after) = (at.saturating_sub(1), (at + 1).min(size - 1));
                (height(after) - height(before)) / (after - before) as f32
            }
        };
        let across = slope(x, self.width, &|x| self.at(x, y));
        let down = slope(y, self.height, &|y| self.at(x, y));
        Vec3::new(-across, -down, 1.0).normalize()
    }

    /// Length of a row of the padded heights.
    pub(super) fn stride(&self) -> usize {
        self.width + BLOCK + 1
    }

    /// The padded heights.
    pub(super) fn padded(&self) -> &[f32] {
        &self.padded
    }

    /// The highest of the `BLOCK + 1` by `BLOCK + 1` heights from a texel on.
    pub(super) fn highest_of_block(&self, x: usize, y: usize) -> f32 {
        self.highest_of_block[y * self.width + x]
    }
}

/// The highest of each square of `BLOCK + 1` heights, first along rows, then along columns.
fn highest_of_blocks(padded: &[f32], (width, height): (usize, usize), stride: usize) -> Vec<f32> {
    let rows = padded.len() / stride;
    let along_rows: Vec<f32> = (0..rows * width)
        .map(|at| {
            let from = at / width * stride + at % width;
            padded[from..=from + BLOCK]
                .iter()
                .copied()
                .fold(f32::MIN, f32::max)
        })
        .collect();
    (0..height * width)
        .map(|at| {
            let highest = (0..=BLOCK).map(|down| along_rows[at + down * width]);
            highest.fold(f32::MIN, f32::max)
        })
        .collect()
}
