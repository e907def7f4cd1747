//! Where several pictures stand on one screen: a grid on whole pixels, in the middle,
//! with room over it for the question and a strip under each picture for its answer.

use super::stimulus_view::{SizePx, TooSmall};

/// Room that is not pictures, physical pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Room {
    /// Between two pictures, and at the edges.
    pub gap: u32,
    /// Over all of them.
    pub header: u32,
    /// Under each.
    pub strip: u32,
    /// Under all of them.
    pub footer: u32,
}

impl Room {
    /// The room that text of the usual size needs, at a scale factor.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few hundred
    pub fn at_scale(scale: f32) -> Self {
        let px = |points: f32| (points * scale).ceil() as u32;
        Self {
            gap: px(16.0),
            header: px(84.0),
            strip: px(64.0),
            footer: px(72.0),
        }
    }
}

/// Upper left pixels of the pictures, row by row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arrangement {
    /// One a picture.
    pub corners: Vec<SizePx>,
    /// Size of every picture's place.
    pub picture_px: SizePx,
    /// Size of the whole, with its room.
    pub whole_px: SizePx,
}

/// Arranges `count` pictures in as few rows as fit; `columns` fixes how many stand side
/// by side.
///
/// # Errors
/// [`TooSmall`] with the size of the squarest grid, if none fits.
pub fn arrange(
    surface_px: SizePx,
    picture_px: SizePx,
    count: usize,
    columns: Option<usize>,
    room: Room,
) -> Result<Arrangement, TooSmall> {
    let candidates: Vec<usize> = columns.map_or_else(|| (1..=count).rev().collect(), |it| vec![it]);
    let fitting = candidates.iter().copied().find(|&columns| {
        let whole = whole_px(picture_px, count, columns, room);
        whole[0] <= surface_px[0] && whole[1] <= surface_px[1]
    });
    let Some(columns) = fitting else {
        let squarest = candidates
            .iter()
            .map(|&columns| whole_px(picture_px, count, columns, room))
            .min_by_key(|whole| whole[0].max(whole[1]));
        return Err(TooSmall {
            surface_px,
            picture_px: squarest.unwrap_or(picture_px),
        });
    };
    Ok(placed(surface_px, picture_px, count, columns, room))
}

fn placed(
    surface_px: SizePx,
    picture_px: SizePx,
    count: usize,
    columns: usize,
    room: Room,
) -> Arrangement {
    let whole = whole_px(picture_px, count, columns, room);
    let origin = [0, 1].map(|axis| (surface_px[axis] - whole[axis]) / 2);
    let corner = |index: usize| {
        let [column, row] = [index % columns, index / columns].map(as_u32);
        [
            origin[0] + room.gap + column * (picture_px[0] + room.gap),
            origin[1] + room.header + row * (picture_px[1] + room.strip),
        ]
    };
    Arrangement {
        corners: (0..count).map(corner).collect(),
        picture_px,
        whole_px: whole,
    }
}

fn whole_px(picture_px: SizePx, count: usize, columns: usize, room: Room) -> SizePx {
    let [columns, rows] = [columns, count.div_ceil(columns.max(1))].map(as_u32);
    [
        columns
            .saturating_mul(picture_px[0].saturating_add(room.gap))
            .saturating_add(room.gap),
        rows.saturating_mul(picture_px[1].saturating_add(room.strip))
            .saturating_add(room.header + room.footer),
    ]
}

fn as_u32(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// However many, of whatever size: inside the surface, none over another.
        #[test]
        fn pictures_stand_apart_and_inside(
            count in 1_usize..12,
            picture in (1_u32..700, 1_u32..500),
            surface in (600_u32..4000, 500_u32..2200),
        ) {
            let room = Room::at_scale(1.0);
            let (surface_px, picture_px) = ([surface.0, surface.1], [picture.0, picture.1]);
            let Ok(arranged) = arrange(surface_px, picture_px, count, None, room) else {
                return Ok(());
            };
            prop_assert_eq!(arranged.corners.len(), count);
            for (index, one) in arranged.corners.iter().enumerate() {
                for axis in [0, 1] {
                    prop_assert!(one[axis] + picture_px[axis] <= surface_px[axis]);
                }
                for other in &arranged.corners[..index] {
                    let apart = (0..2).any(|axis| one[axis].abs_diff(other[axis]) >= picture_px[axis] + room.gap.min(room.strip));
                    prop_assert!(apart);
                }
            }
        }
    }

    #[test]
    fn six_small_pictures_stand_in_two_rows_of_three_on_a_common_monitor() {
        let arranged = arrange([1920, 1080], [600, 338], 6, None, Room::at_scale(1.0)).unwrap();
        let rows: Vec<u32> = arranged.corners.iter().map(|corner| corner[1]).collect();
        assert_eq!(rows[0], rows[2]);
        assert!(rows[3] > rows[0]);
        assert_eq!(arranged.corners.len(), 6);
    }

    #[test]
    fn what_does_not_fit_is_refused_with_the_size_it_needs() {
        let error = arrange([1280, 720], [1280, 720], 3, Some(3), Room::at_scale(1.0)).unwrap_err();
        assert!(error.picture_px[0] > 3 * 1280);
    }
}
