//! A snapshot: a grid with vectors and stresses, compressed and written.

use divan::Bencher;
use divan::counter::BytesCount;
use fem_vtk::{VtuWriter, pad_vectors};

/// Cells a side: 2,600 cells as the glass pair has them, and four times as many.
const SIDES: [usize; 2] = [51, 102];
/// Stresses a cell and a point.
const STRESSES: [&str; 6] =
    ["sigma_yy", "sigma_rr", "sigma_tt", "sigma_ry", "pressure", "von_mises"];

fn main() {
    divan::main();
}

/// Smooth numbers, as fields are.
fn field(n: usize, k: usize) -> Vec<f64> {
    (0..n).map(|i| ((i * (k + 3)) as f64 * 1e-3).sin() * 1e6 / (1.0 + i as f64)).collect()
}

#[divan::bench(args = SIDES)]
fn write(bencher: Bencher<'_, '_>, side: usize) {
    let row = side + 1;
    let points: Vec<[f64; 3]> =
        (0..row * row).map(|k| [(k % row) as f64 * 3e-5, (k / row) as f64 * 3e-5, 0.0]).collect();
    let quads: Vec<[u32; 4]> = (0..side * side)
        .map(|cell| (cell / side * row + cell % side) as u32)
        .map(|k| [k, k + 1, k + 1 + row as u32, k + row as u32])
        .collect();
    let vectors: Vec<f64> = pad_vectors(&field(2 * points.len(), 0));
    let (of_points, of_cells): (Vec<_>, Vec<_>) =
        (0..STRESSES.len()).map(|k| (field(points.len(), k), field(quads.len(), k))).unzip();
    let n_numbers = 2 * vectors.len() + STRESSES.len() * (points.len() + quads.len());
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("snapshot.vtu");
    bencher.counter(BytesCount::of_many::<f64>(n_numbers)).bench_local(|| {
        let mut writer = VtuWriter::new(&points, &quads)
            .time(1e-5)
            .point_data("displacement", 3, &vectors)
            .point_data("velocity", 3, &vectors);
        for (k, name) in STRESSES.into_iter().enumerate() {
            writer = writer.point_data(name, 1, &of_points[k]).cell_data(name, 1, &of_cells[k]);
        }
        writer.write(&path)
    });
}
