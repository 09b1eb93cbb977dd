//! The time of an element update, forces and motion, with all laws.

use std::fmt::Write;
use std::time::Instant;

use fem_explicit::FreeMotion;

use super::bodies::{ELASTIC, Error, KINDS, mesh_and_glass};
use super::plain::Plain;
use crate::timing::median;

/// Element sizes at the contact, µm.
pub const SIZES: [u32; 3] = [60, 28, 14];
const TURNS: usize = 301;
/// Element updates of a turn, so that it takes at least a tenth of a millisecond.
const UPDATES: usize = 20_000;

/// Bodies on one mesh, and the times of their turns, ns per element update.
struct Timed {
    plain: Plain,
    spheres: Vec<FreeMotion>,
    n_elements: usize,
    of_plain: Vec<f64>,
    of_spheres: Vec<Vec<f64>>,
}

impl Timed {
    fn new(micrometres: u32) -> Result<Self, Error> {
        let size = 1e-6 * f64::from(micrometres);
        let (mesh, glass) = mesh_and_glass(size)?;
        let plain = Plain::beside(&mesh, &glass, &mut ELASTIC.sphere(size)?);
        let spheres: Result<Vec<_>, Error> =
            KINDS.into_iter().map(|kind| kind.sphere(size)).collect();
        let spheres = spheres?;
        let of_spheres = spheres.iter().map(|_| Vec::new()).collect();
        let n_elements = mesh.quads().len();
        Ok(Self { plain, spheres, n_elements, of_plain: Vec::new(), of_spheres })
    }

    fn take_turn(&mut self) {
        let n_steps = UPDATES.div_ceil(self.n_elements);
        let updates = (n_steps * self.n_elements) as f64;
        let time = |step: &mut dyn FnMut()| {
            // The first steps wait for memory and for the clock of wide vector instructions.
            (0..n_steps).for_each(|_| step());
            let start = Instant::now();
            (0..n_steps).for_each(|_| step());
            1e9 * start.elapsed().as_secs_f64() / updates
        };
        self.of_plain.push(time(&mut || self.plain.step()));
        for (sphere, times) in self.spheres.iter_mut().zip(&mut self.of_spheres) {
            times.push(time(&mut || sphere.step()));
        }
    }

    /// Returns for each kind the median time, ns, and its ratio to plain code in the same turn.
    fn medians(&self) -> Vec<[f64; 2]> {
        let share = |times: &Vec<f64>| {
            times.iter().zip(&self.of_plain).map(|(t, plain)| t / plain).collect()
        };
        self.of_spheres.iter().map(|times| [median(times.clone()), median(share(times))]).collect()
    }
}

/// Returns a function that measures plain code on the mesh of 28 µm, ns per element update: the unit for
/// processes.
pub fn of_plain_code() -> Result<impl FnMut() -> f64, Error> {
    let mut timed = Timed::new(28)?;
    timed.spheres.clear();
    Ok(move || {
        timed.of_plain.clear();
        for _ in 0..20 {
            timed.take_turn();
        }
        median(timed.of_plain.clone())
    })
}

/// Returns the table, one row per kind.
pub fn table() -> Result<String, Error> {
    let mut all: Vec<Timed> = SIZES.into_iter().map(Timed::new).collect::<Result<_, _>>()?;
    for _ in 0..TURNS {
        all.iter_mut().for_each(Timed::take_turn);
    }
    let mut table = String::from("| ns per element update |");
    for (size, timed) in SIZES.iter().zip(&all) {
        write!(table, " {size} µm, {} elements | of plain |", timed.n_elements)?;
    }
    writeln!(table, "\n|---|{}", "---|---|".repeat(SIZES.len()).as_str())?;
    write!(table, "| plain code |")?;
    for timed in &all {
        write!(table, " {:.1} | 1 |", median(timed.of_plain.clone()))?;
    }
    let medians: Vec<_> = all.iter().map(Timed::medians).collect();
    for (k, kind) in KINDS.into_iter().enumerate() {
        write!(table, "\n| {} |", kind)?;
        for of_mesh in &medians {
            let [time, share] = of_mesh[k];
            write!(table, " {time:.1} | {share:.2} |")?;
        }
    }
    Ok(table)
}
