use super::*;

fn request(conditions: u32, p: f64) -> Request {
    Request {
        p,
        alpha: Alpha::FIVE_PERCENT,
        conditions,
        powers: vec![0.8, 0.9],
        block: 2 * conditions,
        participants: None,
    }
}

#[test]
fn every_number_is_finite_or_says_why_not() {
    for (conditions, p) in [
        (1, 0.5),
        (1, 0.65),
        (7, 0.5),
        (7, 0.65),
        (7, 0.999),
        (40, 0.3),
    ] {
        let sheet = sheet(&request(conditions, p));
        let tables = sheet.sections.iter().flat_map(|it| &it.tables);
        let tables: Vec<&Table> = tables.map(|it| &it.table).chain([&sheet.curve]).collect();
        for table in tables {
            for (row, cell) in table
                .rows
                .iter()
                .flat_map(|row| row.iter().map(move |cell| (row, cell)))
            {
                assert_eq!(row.len(), table.columns.len());
                if let Cell::Number(number) = cell {
                    assert!(number.is_finite());
                }
            }
        }
    }
}

#[test]
fn rows_are_full_blocks_and_the_number_asked_about() {
    assert_eq!(
        numbers(36, 14),
        [14, 28, 36, 42, 56, 70, 84, 98, 112, 126, 140]
    );
    assert!(numbers(98, 14).contains(&98) && numbers(98, 14).contains(&196));
    assert!(numbers(1, 1).contains(&1));
}
