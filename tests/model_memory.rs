//! A large model needs less than three times its size in memory.
//!
//! Slow, and measured by the kernel's own count: `cargo test --test model_memory -- --ignored
//! --nocapture` on Linux.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Vertices along each side of a square terrain; 56 bytes of file each make 200 MB.
const SIDE: u32 = 1900;

/// Writes the terrain as `.glb`, as exporters do: positions, normals and texture
/// coordinates, 32-bit indices. Gives the file's size in bytes.
fn write_terrain(path: &Path) -> u64 {
    let vertices = u64::from(SIDE) * u64::from(SIDE);
    let corners = 6 * u64::from(SIDE - 1) * u64::from(SIDE - 1);
    let sizes = [12 * vertices, 12 * vertices, 8 * vertices, 4 * corners];
    let total: u64 = sizes.iter().sum();
    let mut offset = 0;
    let views: Vec<String> = sizes
        .iter()
        .map(|size| {
            let view = format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{size}}}"#);
            offset += size;
            view
        })
        .collect();
    let accessor = |view: u32, component: u32, kind: &str, count: u64| {
        format!(
            r#"{{"bufferView":{view},"componentType":{component},"type":"{kind}","count":{count}}}"#
        )
    };
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{total}}}],"bufferViews":[{}],"accessors":[{},{},{},{}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3}}]}}],"nodes":[{{"mesh":0}}]}}"#,
        views.join(","),
        accessor(0, 5126, "VEC3", vertices),
        accessor(1, 5126, "VEC3", vertices),
        accessor(2, 5126, "VEC2", vertices),
        accessor(3, 5125, "SCALAR", corners),
    );
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let mut file = BufWriter::new(File::create(path).unwrap());
    let length = 28 + json.len() as u64 + total;
    file.write_all(b"glTF").unwrap();
    for number in [2, length, json.len() as u64] {
        file.write_all(&u32::try_from(number).unwrap().to_le_bytes())
            .unwrap();
    }
    file.write_all(b"JSON").unwrap();
    file.write_all(json.as_bytes()).unwrap();
    file.write_all(&u32::try_from(total).unwrap().to_le_bytes())
        .unwrap();
    file.write_all(b"BIN\0").unwrap();
    write_terrain_data(&mut file);
    file.flush().unwrap();
    length
}

fn write_terrain_data(file: &mut impl std::io::Write) {
    let mut floats = |values: &[f32]| {
        for value in values {
            file.write_all(&value.to_le_bytes()).unwrap();
        }
    };
    let grid =
        || (0..SIDE).flat_map(|z| (0..SIDE).map(move |x| (x as f32 * 0.05, z as f32 * 0.05)));
    for (x, z) in grid() {
        floats(&[x, x.sin() * z.cos(), z]);
    }
    for _ in grid() {
        floats(&[0.0, 1.0, 0.0]);
    }
    for (x, z) in grid() {
        floats(&[x, z]);
    }
    for z in 0..SIDE - 1 {
        for x in 0..SIDE - 1 {
            let a = z * SIDE + x;
            for index in [a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1] {
                file.write_all(&index.to_le_bytes()).unwrap();
            }
        }
    }
}

/// The peak of a process' resident memory so far, bytes; `None` once it has ended.
fn peak_bytes(pid: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes * 1024)
}

#[test]
#[ignore = "writes 200 MB and takes some seconds"]
fn a_200_mb_model_takes_less_than_three_times_its_size() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("terrain.glb");
    let size = write_terrain(&path);
    assert!(size > 200_000_000, "{size}");
    let started = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_greyfield"))
        .args(["model", "--quiet"])
        .arg(&path)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut peak = 0;
    // The count is the kernel's and only rises, so that the last look is the peak but for what
    // happens in the last few milliseconds.
    while child.try_wait().unwrap().is_none() {
        peak = peak.max(peak_bytes(child.id()).unwrap_or_default());
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().unwrap();
    let report = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success());
    assert!(report.contains("triangles"), "{report}");
    let times = peak as f64 / size as f64;
    println!(
        "{:.0} MB file, {:.0} MB at the peak: {times:.2} times; read in {:.1} s",
        size as f64 / 1e6,
        peak as f64 / 1e6,
        started.elapsed().as_secs_f64()
    );
    assert!(
        times > 1.0,
        "the geometry alone is larger than the file: {times}"
    );
    assert!(times < 3.0, "{times}");
}
