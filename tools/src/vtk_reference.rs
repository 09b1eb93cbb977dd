//! Writes a `.vtu` of tricky values and, as JSON, the values that a reader must find in it.
//!
//! `fem-tools vtk_reference FILE.vtu FILE.json`; then
//! `.ci/check_vtk.py reference FILE.vtu FILE.json`.

use crate::Error;
use fem_vtk::VtuWriter;
use serde_json::{Map, Value, json};

/// Cells a side: 64 * 64 doubles fill one compression block of 32768 bytes exactly, three
/// components fill three, and 65 * 65 doubles leave a short second block.
const N_SIDE: usize = 64;

/// Writes the two files.
pub fn run(words: &[String]) -> Result<(), Error> {
    match words {
        [vtu, json] => write(vtu, json),
        _ => Err("vtk_reference FILE.vtu FILE.json".into()),
    }
}

/// Numbers of all sizes and signs, no two alike.
fn tricky(index: usize) -> f64 {
    let number = index as f64;
    match index % 7 {
        0 => 1e-300 * (number + 1.0),
        1 => -1e300 / (number + 1.0),
        2 => -number / 3.0,
        3 => f64::MIN_POSITIVE / (number + 2.0),
        4 => 0.1 + number,
        5 => f64::MAX / (number + 1.0),
        _ => (number.sin() * 1e9).recip(),
    }
}

fn write(vtu: &str, json_path: &str) -> Result<(), Error> {
    let row = N_SIDE + 1;
    let points: Vec<[f64; 3]> = (0..row * row)
        .map(|k| [(k % row) as f64 / 3.0, -1e-5 * (k / row) as f64, tricky(k)])
        .collect();
    let corner = |cell: usize| (cell / N_SIDE * row + cell % N_SIDE) as u32;
    let quads: Vec<[u32; 4]> = (0..N_SIDE * N_SIDE)
        .map(corner)
        .map(|k| [k, k + 1, k + 1 + row as u32, k + row as u32])
        .collect();
    let (n_points, n_cells) = (points.len(), quads.len());

    let floats =
        |count: usize, shift: usize| (0..count).map(|k| tricky(k + shift)).collect::<Vec<f64>>();
    let displacement = floats(3 * n_points, 1);
    let temperature = floats(n_points, 2);
    let tensor = floats(9 * n_points, 3);
    let number: Vec<i64> = (0..n_points as i64).map(|k| (k - 7) * 1_000_000_007_000).collect();
    let one_block = floats(n_cells, 4);
    let three_blocks = floats(3 * n_cells, 5);
    let body: Vec<i32> = (0..n_cells as i32).map(|k| k % 2 - 1).collect();
    let byte: Vec<u8> = (0..n_cells).map(|k| (k * 7 % 256) as u8).collect();
    let odd_name = "<a & b> \"c\" 'd' \u{3c3}";

    VtuWriter::new(&points, &quads)
        .time(1.0 / 3e5)
        .point_data("displacement", 3, &displacement)
        .point_data("temperature", 1, &temperature)
        .point_data("tensor", 9, &tensor)
        .point_data("number", 1, &number)
        .cell_data("one block", 1, &one_block)
        .cell_data("three blocks", 3, &three_blocks)
        .cell_data("body", 1, &body)
        .cell_data("byte", 1, &byte)
        .cell_data(odd_name, 1, &one_block)
        .field_data("step", 1, &[-3_i64])
        .field_data("extrema", 3, &[f64::MIN, 5e-324, f64::MAX])
        .field_data("pairs", 2, &[1, 2, 3, 4_i32])
        .write(vtu)?;

    let array =
        |components: usize, values: Value| json!({"components": components, "values": values});
    let arrays = |list: Vec<(&str, usize, Value)>| {
        let entries = list
            .into_iter()
            .map(|(name, components, values)| (name.to_owned(), array(components, values)));
        Value::Object(entries.collect::<Map<_, _>>())
    };
    let reference = json!({
        "points": points,
        "cells": quads,
        "point_data": arrays(vec![
            ("displacement", 3, json!(displacement)),
            ("temperature", 1, json!(temperature)),
            ("tensor", 9, json!(tensor)),
            ("number", 1, json!(number)),
        ]),
        "cell_data": arrays(vec![
            ("one block", 1, json!(one_block)),
            ("three blocks", 3, json!(three_blocks)),
            ("body", 1, json!(body)),
            ("byte", 1, json!(byte)),
            (odd_name, 1, json!(one_block)),
        ]),
        "field_data": arrays(vec![
            ("TimeValue", 1, json!([1.0 / 3e5])),
            ("step", 1, json!([-3])),
            ("extrema", 3, json!([f64::MIN, 5e-324, f64::MAX])),
            ("pairs", 2, json!([1, 2, 3, 4])),
        ]),
    });
    std::fs::write(json_path, serde_json::to_string(&reference)?)?;
    Ok(())
}
