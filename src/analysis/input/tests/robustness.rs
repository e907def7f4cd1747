//! Files as they come: names that only look alike, optional columns, odd bytes, odd line ends.

use super::*;

#[test]
fn scenes_and_printed_numbers_are_kept() {
    let data = read_texts(&[
        "condition,technique_a,technique_b,votes_a,votes_b,scene,published_chi_square,published_p\n\
         c,x,y,11,25,atrium,5.44,.0196\nd,x,y,18,18,,,\n",
    ])
    .unwrap();
    let [c, d] = &data.conditions[..] else {
        panic!("{:?}", data.conditions)
    };
    assert_eq!(c.scene.as_deref(), Some("atrium"));
    assert_eq!(c.published.chi_square.as_deref(), Some("5.44"));
    assert_eq!(c.published.p.as_deref(), Some(".0196"));
    assert_eq!((&d.scene, &d.published), (&None, &Default::default()));
    assert!(data.notes.is_empty(), "{:?}", data.notes);
    let data = read_texts(&[
        "participant,condition,first_technique,second_technique,chosen,scene\n\
         P,c,x,y,first,\nQ,c,y,x,first,atrium\n",
    ])
    .unwrap();
    assert_eq!(data.conditions[0].scene.as_deref(), Some("atrium"));
    let dir = results_folder(&[row("P1", 0, "a")], None);
    let data = read(&[dir.path().to_owned()], Options::default()).unwrap();
    assert_eq!(data.conditions[0].scene.as_deref(), Some("atrium"));
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    const PUBLISHED: &str =
        "condition,technique_a,technique_b,votes_a,votes_b,published_chi_square,published_p\n";
    let p = |row: &str| format!("{PUBLISHED}c,x,y,1,2,{row}\n");
    let t = |rows: &str| format!("{TRIALS}{rows}");
    for (text, parts) in [
        (
            p("abc,"),
            vec![":2: column `published_chi_square`", "`abc`", "0 or more"],
        ),
        (p("-1,"), vec![":2: column `published_chi_square`", "`-1`"]),
        (
            p("inf,"),
            vec![":2: column `published_chi_square`", "`inf`"],
        ),
        (
            p(",1.5"),
            vec![":2: column `published_p`", "`1.5`", "from 0 to 1"],
        ),
        (p(",<0.001"), vec![":2: column `published_p`", "`<0.001`"]),
        (
            "participant,condition,first_technique,second_technique,chosen,scene\n\
             P,c,x,y,first,atrium\nQ,c,x,y,first,lions\n"
                .to_owned(),
            vec![":3:", "scene lions", "atrium", "0.csv:2"],
        ),
        (
            t("P,c,none,gtao,gtao,\n"),
            vec![":2: column `chosen`", "`gtao`", "`second` is meant"],
        ),
        (
            t("P,c,none,gtao,none,\n"),
            vec![":2: column `chosen`", "`none`", "`first` is meant"],
        ),
        (
            t("P,c,x,y,first,\nQ,c,x\n"),
            vec![":3:", "3 fields", "6 columns"],
        ),
        (
            TRIALS.to_owned(),
            vec!["no trial to analyse", "no data row"],
        ),
        (TRIALS.replace(',', ";"), vec![":1:", "';'", "commas"]),
        (TRIALS.replace(',', "\t"), vec![":1:", "'\\t'", "commas"]),
        (
            "participant,condition,first_technique,second_technique,chosen\rP,c,x,y,first\r"
                .to_owned(),
            vec![":1:", "carriage return"],
        ),
        (String::new(), vec!["the file is empty"]),
    ] {
        let message = error_of(&[&text]);
        for part in parts {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
}

/// The message on bytes that are no UTF-8 text.
fn error_of_bytes(bytes: &[u8]) -> String {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("x.csv");
    std::fs::write(&path, bytes).unwrap();
    read(&[path], Options::default()).unwrap_err().to_string()
}

#[test]
fn other_encodings_are_told_from_text() {
    let utf16: Vec<u8> = format!("\u{feff}{TRIALS}P,c,x,y,first,\n")
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert!(error_of_bytes(&utf16).contains("UTF-16"));
    assert!(error_of_bytes(&utf16[2..]).contains("UTF-16"));
    let latin1 =
        |row: &[u8]| error_of_bytes(&[TRIALS.as_bytes(), b"P,c,x,y,first,\n", row].concat());
    for (row, field) in [
        (&b"Zo\xeb,c,x,y,first,\n"[..], "participant"),
        (b"Q,caf\xe9,x,y,first,\n", "condition"),
        (b"Q,c,\xfcber,y,first,\n", "first technique"),
        (b"Q,d,x,\xfcber,first,\n", "second technique"),
    ] {
        let message = latin1(row);
        for part in [":3:", field, "UTF-8"] {
            assert!(message.contains(part), "{part:?} not in {message:?}");
        }
    }
    let ranks = b"participant,condition,technique,rank\nZo\xeb,c,x,1\n";
    let message = error_of_bytes(ranks);
    assert!(
        message.contains(":2:") && message.contains("participant"),
        "{message}"
    );
}

#[test]
fn marks_line_ends_quotes_and_blank_lines_are_read_through() {
    let text = "\u{feff}participant,condition,first_technique,second_technique,chosen\r\n\r\n\
        \"P,\r\n1\",\"say \"\"c\"\"\",x,y,first\r\n Q ,\"say \"\"c\"\" \",x,y,second";
    let data = read_texts(&[text]).unwrap();
    assert_eq!(data.participants, ["P,\r\n1", "Q"]);
    assert_eq!(data.conditions[0].id, "say \"c\"");
    assert_eq!(data.conditions[0].votes, Votes { a: 1, b: 1 });
}

#[test]
fn one_row_is_a_study() {
    let data = read_texts(&[&format!("{TRIALS}P,c,x,y,second,")]).unwrap();
    assert_eq!(data.conditions[0].votes, Votes { a: 0, b: 1 });
}

#[test]
fn names_that_look_alike_are_noted_with_their_places() {
    let data = read_texts(&[
        &format!("{TRIALS}Zo\u{e9},c,x,y,first,\n"),
        &format!("{TRIALS}Zoe\u{301},c,x,y,first,\nP,C,x,X,first,\n"),
    ])
    .unwrap();
    assert_eq!(data.participants.len(), 3);
    for parts in [
        ["participants", "0.csv:2", "1.csv:2", "Unicode normal form"],
        ["conditions `c`", "0.csv:2", "1.csv:3", "case"],
        ["techniques `x`", "0.csv:2", "1.csv:3", "case"],
    ] {
        let found = data
            .notes
            .iter()
            .any(|note| parts.iter().all(|part| note.contains(part)));
        assert!(found, "{parts:?} not in {:?}", data.notes);
    }
    let data = read_texts(&[&format!("{COUNTS}c,x,y,1,2\nC,x,y,1,2\n")]).unwrap();
    assert!(data.notes[0].contains("conditions `c`"), "{:?}", data.notes);
}
