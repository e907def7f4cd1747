//! What holds for every design, and for inner orders in every design with blocks.

use proptest::prelude::*;

use super::{DESIGNS, Design, InnerOrder, Place};

fn block(design: &Design, n: usize, seed: u64, number: u32, inner: InnerOrder) -> Vec<Vec<Place>> {
    let slots = u32::try_from((design.block_slots)(n).unwrap()).unwrap();
    (number * slots..(number + 1) * slots)
        .map(|slot| (design.order)(n, seed, slot, inner))
        .collect()
}

fn with_blocks() -> impl Iterator<Item = &'static Design> {
    let has_blocks = |design: &&Design| (design.block_slots)(2).is_some();
    DESIGNS.iter().copied().filter(has_blocks)
}

fn reversed(session: &[Place]) -> usize {
    session.iter().filter(|place| place.reversed).count()
}

/// How many of a condition's sessions, and of those at each place, are reversed.
fn reversed_by<const N: usize>(
    sessions: &[Vec<Place>],
    keys: fn(usize, &Place) -> usize,
) -> Vec<usize> {
    let mut counts = vec![0; N];
    for (place, found) in sessions
        .iter()
        .flat_map(|session| session.iter().enumerate())
    {
        counts[keys(place, found)] += usize::from(found.reversed);
    }
    counts
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn a_session_is_a_pure_function_and_has_every_condition_once(
        n in 1_usize..=26, seed: u64, slot: u32,
    ) {
        for design in DESIGNS {
            let sessions = InnerOrder::ALL.map(|inner| (design.order)(n, seed, slot, inner));
            let again = InnerOrder::ALL.map(|inner| (design.order)(n, seed, slot, inner));
            prop_assert_eq!(&sessions, &again);
            let conditions = sessions.map(|session| {
                session.iter().map(|place| place.condition).collect::<Vec<_>>()
            });
            prop_assert_eq!(&conditions[0], &conditions[1], "the inner order moves nothing");
            let mut sorted = conditions[0].clone();
            sorted.sort_unstable();
            prop_assert_eq!(sorted, (0..n).collect::<Vec<_>>());
        }
    }

    #[test]
    fn within_every_session_half_of_the_pairs_are_reversed(
        n in 1_usize..=26, seed: u64, slot: u32,
    ) {
        for design in DESIGNS {
            let count = reversed(&(design.order)(n, seed, slot, InnerOrder::Within));
            prop_assert!(count == n / 2 || count == n.div_ceil(2), "{}: {count}", design.name);
        }
    }
}

proptest! {
    // Every slot of a block draws the whole block again.
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn over_a_block_every_condition_is_reversed_half_the_time_at_every_place(
        n in 1_usize..=26, seed: u64, number in 0_u32..1000,
    ) {
        for (design, inner) in with_blocks().flat_map(|d| InnerOrder::ALL.map(|inner| (d, inner))) {
            let sessions = block(design, n, seed, number, inner);
            let half = sessions.len() / 2;
            for (session, mirror) in sessions[..half].iter().zip(&sessions[half..]) {
                let opposite = session.iter().zip(mirror).all(|(one, other)| {
                    one.condition == other.condition && one.reversed != other.reversed
                });
                prop_assert!(opposite, "{}", design.name);
            }
            let mut counts = vec![[0_usize; 2]; n * n];
            for (place, found) in sessions.iter().flat_map(|s| s.iter().enumerate()) {
                counts[place * n + found.condition][usize::from(found.reversed)] += 1;
            }
            let expected = half / n;
            prop_assert!(counts.iter().all(|found| *found == [expected; 2]), "{}", design.name);
        }
    }

    /// What is left of a block's balance if nobody comes for its second half.
    #[test]
    fn in_half_a_block_every_condition_is_reversed_half_the_time_within_one(
        n in 1_usize..=26, seed: u64, number in 0_u32..1000,
    ) {
        for design in with_blocks() {
            let sessions = block(design, n, seed, number, InnerOrder::Within);
            let half = &sessions[..sessions.len() / 2];
            let counts = reversed_by::<26>(half, |_, place| place.condition);
            let (low, high) = (half.len() / 2, half.len().div_ceil(2));
            prop_assert!(
                counts[..n].iter().all(|&count| count == low || count == high),
                "{}: {counts:?}", design.name
            );
        }
    }
}

/// The exchanges always find their way there in these; a block whose second half is missing
/// is then off by one session at most.
#[test]
fn in_half_a_block_every_position_is_reversed_half_the_time_within_one() {
    for (design, n) in with_blocks().flat_map(|design| (2..=12).map(move |n| (design, n))) {
        for number in 0..4 {
            let sessions = block(design, n, 2026, number, InnerOrder::Within);
            let half = &sessions[..sessions.len() / 2];
            let counts = reversed_by::<12>(half, |position, _| position);
            let off = |&count: &usize| (2 * count).abs_diff(half.len());
            assert!(
                counts[..n].iter().all(|count| off(count) <= 2),
                "{counts:?}"
            );
        }
    }
}
