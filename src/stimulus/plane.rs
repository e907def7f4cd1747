//! One channel of a picture as numbers, and its filtering by rows and by columns.

use rayon::prelude::*;

use super::manifest::Picture;

/// One number a pixel, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    width_px: usize,
    /// As many whole rows as there are.
    pub values: Vec<f32>,
}

/// What a filter finds outside the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Border {
    /// The pixel of the edge, again and again.
    Repeat,
    /// The picture mirrored at its edge, the pixel of the edge twice.
    Mirror,
}

impl Border {
    /// The index, 0 to `length - 1`, that stands for index `at`; `length` is at least 1.
    fn inside(self, at: isize, length: usize) -> usize {
        let last = length as isize - 1;
        match self {
            Self::Repeat => at.clamp(0, last) as usize,
            Self::Mirror => {
                // Twice the length is the period, also of a picture smaller than the filter.
                let along = at.rem_euclid(2 * length as isize);
                along.min(2 * last + 1 - along) as usize
            }
        }
    }
}

impl Plane {
    /// A number of every pixel of `picture`, of its red, green and blue.
    pub fn of(picture: &Picture, number: impl Fn([u8; 3]) -> f32 + Sync) -> Self {
        Self {
            width_px: picture.width_px as usize,
            values: picture
                .rgba8
                .par_chunks_exact(4)
                .map(|pixel| number([pixel[0], pixel[1], pixel[2]]))
                .collect(),
        }
    }

    /// A number of every two numbers at one place; both planes have one size.
    pub fn zip(&self, other: &Self, number: impl Fn(f32, f32) -> f32 + Sync) -> Self {
        let pairs = self.values.par_iter().zip(&other.values);
        Self {
            width_px: self.width_px,
            values: pairs.map(|(&a, &b)| number(a, b)).collect(),
        }
    }

    /// Filtered along the rows by one kernel and then along the columns by another.
    pub fn filtered(&self, rows: &[f32], columns: &[f32], border: Border) -> Self {
        self.along_rows(rows, border).along_columns(columns, border)
    }

    /// The sum of `kernel[i]` times the value `i - radius` to the right, where the kernel has
    /// `2 · radius + 1` numbers.
    pub fn along_rows(&self, kernel: &[f32], border: Border) -> Self {
        let width = self.width_px;
        let radius = kernel.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        let rows = values.par_chunks_exact_mut(width.max(1));
        rows.zip(self.values.par_chunks_exact(width.max(1)))
            .for_each_with(Vec::new(), |wider, (out, row)| {
                wider.clear();
                wider.extend((0..width + 2 * radius).map(|x| {
                    // Indices of a row in memory are far below isize::MAX.
                    row[border.inside(x as isize - radius as isize, width)]
                }));
                add_weighted(out, kernel, |offset| &wider[offset..offset + width]);
            });
        Self {
            width_px: width,
            values,
        }
    }

    /// As [`along_rows`](Self::along_rows), downwards.
    pub fn along_columns(&self, kernel: &[f32], border: Border) -> Self {
        let width = self.width_px.max(1);
        let height = self.values.len() / width;
        let radius = (kernel.len() / 2) as isize;
        let mut values = vec![0.0; self.values.len()];
        let rows = values.par_chunks_exact_mut(width).enumerate();
        rows.for_each(|(y, out)| {
            add_weighted(out, kernel, |offset| {
                let from = border.inside(y as isize + offset as isize - radius, height);
                &self.values[from * width..][..width]
            });
        });
        Self {
            width_px: self.width_px,
            values,
        }
    }
}

/// Adds to `out` each weight times the values that `values` has for its index, which are as many.
fn add_weighted<'a>(out: &mut [f32], weights: &[f32], values: impl Fn(usize) -> &'a [f32]) {
    let count = out.len();
    let mut fours = weights.chunks_exact(4);
    let mut offset = 0;
    // Plain loops over slices, which the compiler turns into wide instructions; four weights at
    // once, so that the sums are loaded and stored a quarter as often.
    for four in &mut fours {
        let [a, b, c, d] = [0, 1, 2, 3].map(|more| &values(offset + more)[..count]);
        for (i, sum) in out.iter_mut().enumerate() {
            *sum += (four[0] * a[i] + four[1] * b[i]) + (four[2] * c[i] + four[3] * d[i]);
        }
        offset += 4;
    }
    for (more, weight) in fours.remainder().iter().enumerate() {
        for (sum, value) in out.iter_mut().zip(values(offset + more)) {
            *sum += weight * value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(width_px: usize, values: &[f32]) -> Plane {
        Plane {
            width_px,
            values: values.to_vec(),
        }
    }

    #[test]
    fn borders_repeat_or_mirror() {
        let indices = |border: Border| (-4..7).map(move |at| border.inside(at, 3));
        let repeated: Vec<usize> = indices(Border::Repeat).collect();
        assert_eq!(repeated, [0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2]);
        let mirrored: Vec<usize> = indices(Border::Mirror).collect();
        assert_eq!(mirrored, [2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0]);
        assert_eq!(Border::Mirror.inside(-9, 1), 0);
    }

    /// One bright pixel comes back as the kernel, turned round: `kernel[2]` weighs the pixel to
    /// the right, and so shows to the left of the bright one.
    #[test]
    fn a_point_becomes_the_kernel() {
        let mut values = vec![0.0; 15];
        values[7] = 1.0;
        let found = plane(5, &values).filtered(&[1.0, 2.0, 3.0], &[5.0, 7.0, 9.0], Border::Repeat);
        #[rustfmt::skip]
        assert_eq!(found.values, [
            0.0, 27.0, 18.0,  9.0, 0.0,
            0.0, 21.0, 14.0,  7.0, 0.0,
            0.0, 15.0, 10.0,  5.0, 0.0,
        ]);
    }

    /// The quick sum against one written out, with a kernel of more than two fours.
    #[test]
    fn long_kernels_weigh_every_value() {
        let (width, kernel) = (
            7,
            [1.0, 2.0, 4.0, 8.0, 16.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0],
        );
        let values: Vec<f32> = (0..35).map(|i| (i * i % 23) as f32).collect();
        for border in [Border::Repeat, Border::Mirror] {
            let rows = plane(width, &values).along_rows(&kernel, border);
            let columns = plane(width, &values).along_columns(&kernel, border);
            for (at, (&along, &down)) in rows.values.iter().zip(&columns.values).enumerate() {
                let (x, y) = (at % width, at / width);
                let sum = |from: &dyn Fn(isize) -> usize| -> f32 {
                    let taps = (-5..=5).zip(kernel);
                    taps.map(|(shift, weight)| weight * values[from(shift)])
                        .sum()
                };
                let row = |shift: isize| y * width + border.inside(x as isize + shift, width);
                let column = |shift: isize| border.inside(y as isize + shift, 5) * width + x;
                assert_eq!((along, down), (sum(&row), sum(&column)), "{x} {y}");
            }
        }
    }

    #[test]
    fn a_kernel_wider_than_the_picture_stays_inside() {
        let kernel = [0.2; 5];
        for border in [Border::Repeat, Border::Mirror] {
            let found = plane(2, &[3.0; 4]).filtered(&kernel, &kernel, border);
            assert!(found.values.iter().all(|value| (value - 3.0).abs() < 1e-6));
        }
    }

    #[test]
    fn nothing_stays_nothing() {
        let found = plane(0, &[]).filtered(&[1.0; 3], &[1.0; 3], Border::Mirror);
        assert!(found.values.is_empty());
    }
}
