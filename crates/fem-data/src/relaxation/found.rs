//! The relaxation of a material from a table of moduli, with the checks of the data.

use std::collections::BTreeMap;
use std::f64::consts::{LN_10, TAU};

use fem_case::engineering::{number, show};
use fem_case::schema::ActsOn;
use fem_material::{ShiftLaw, ZERO_CELSIUS};

use crate::table::{DataError, Modulus, ModulusPoint, ModulusTable, TestKind};

use super::series::{FittedSeries, fit_series};
use super::superposition::{Block, Superposition};

/// The least ratio of the largest to the smallest frequency or time.
const MIN_SPAN: f64 = 3.0;
/// The share by which a storage modulus may fall below one at a lower frequency, by scatter: 4.2 standard deviations of the difference
/// of two moduli with 3 % noise. Among many points running medians are compared, since the extremes of many are far apart.
const MAX_FALL: f64 = 0.18;
/// Points of a table over those of a running median.
const PER_MEDIAN: usize = 20;
/// The share by which two values at one frequency may differ.
const MAX_CONTRADICTION: f64 = 0.2;
/// Frequencies closer than this ratio are the same.
const SAME: f64 = 1.0 + 1e-6;
/// Temperatures that are closer are of one block, K.
const SAME_TEMPERATURE: f64 = 1.0;
/// Most that the temperatures of a block may differ, K.
const MAX_DRIFT: f64 = 3.0;
/// Ratio of the misfit of one series to that of a series for each temperature above which these do not superpose.
const MIN_MISFIT_RATIO: f64 = 3.0;
/// Deviation of log10 a_T from a law above which the shifts are tabulated.
const MAX_SHIFT_DEVIATION: f64 = 0.3;
/// The least misfit of a series that is reported so.
const LEAST_MISFIT: f64 = 0.05;
/// Root mean square of relative residuals above which a warning is given.
const LARGE_RMS: f64 = 0.1;

/// Settings of [`FoundRelaxation::of`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelaxationSettings {
    /// Terms per decade; by the data without it.
    pub terms_per_decade: Option<f64>,
    /// The bulk modulus, Pa, which then is elastic; without it Poisson's ratio is constant.
    pub bulk_modulus: Option<f64>,
    /// The temperature, K, whose block is the reference; that in the middle without it.
    pub reference_temperature: Option<f64>,
    /// Whether moduli of other temperatures are scaled too.
    pub has_vertical_shift: bool,
}

/// The relaxation that a table of moduli shows.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundRelaxation {
    /// The table of measured moduli.
    pub table: ModulusTable,
    /// The series through them.
    pub series: FittedSeries,
    /// The points at the reference temperature, in the order of the table, without those that are left out.
    pub points: Vec<ModulusPoint>,
    /// Standard uncertainty of ln a_T of each point.
    shift_uncertainties: Vec<f64>,
    /// The shifts of a table of several temperatures.
    pub superposition: Option<Superposition>,
    /// Root mean square of relative residuals of a series for each temperature alone.
    pub scatter: Option<f64>,
    /// The reference temperature, K, if the table has temperatures.
    pub temperature: Option<f64>,
    /// The elastic bulk modulus, Pa; Poisson's ratio is constant without it.
    pub bulk_modulus: Option<f64>,
}

impl FoundRelaxation {
    /// Fits a series to a table.
    ///
    /// # Errors
    /// The table spans too few frequencies or times, has several temperatures, or contradicts itself.
    pub fn of(table: ModulusTable, settings: RelaxationSettings) -> Result<Self, DataError> {
        check_span(&table)?;
        let blocks = isothermal_blocks(&table)?;
        for block in &blocks {
            check_block(&table, block)?;
        }
        let table = match settings.bulk_modulus {
            Some(bulk) => of_shear(table, bulk)?,
            None => table,
        };
        let kind = table.kind;
        let superposition =
            (blocks.len() > 1).then(|| superposed(&table, blocks.clone(), settings));
        let superposition = superposition.transpose()?;
        let points = match &superposition {
            Some(superposition) => superposition.reduced(kind, &table.points),
            None => table.points.iter().map(|point| (*point, 0.0)).collect(),
        };
        let (points, shift_uncertainties): (Vec<_>, Vec<_>) = points.into_iter().unzip();
        let temperature = superposition.as_ref().map(Superposition::reference_temperature);
        let is_known = table.points.iter().any(|point| point.temperature.is_some());
        let temperature = temperature.or(is_known.then_some(blocks[0].temperature));
        let scatter = superposition.as_ref().map(|_| scatter_of_blocks(&table, &blocks));
        let series = fit_series(kind, &points, settings.terms_per_decade);
        if series.terms.is_empty() {
            let message = "no loss and no change of the modulus is found: the material is elastic";
            let error = DataError::new(&table.name, message);
            return Err(error.with_help("leave relaxation out of the material"));
        }
        let bulk_modulus = settings.bulk_modulus;
        Ok(Self {
            table,
            series,
            points,
            shift_uncertainties,
            superposition,
            scatter,
            temperature,
            bulk_modulus,
        })
    }

    /// Returns the modulus that was measured.
    pub fn modulus(&self) -> Modulus {
        self.table.modulus
    }

    /// Returns the law by which a case shifts the series to its temperature: the one that fits better, or a table of the shifts if none
    /// of them is near all of them.
    pub fn shift_law(&self) -> Option<ShiftLaw> {
        let found = self.superposition.as_ref()?;
        let laws = [&found.wlf, &found.arrhenius].into_iter().flatten();
        let best = laws.min_by(|a, b| a.misfit.total_cmp(&b.misfit));
        let near = best.filter(|law| law.largest_deviation < MAX_SHIFT_DEVIATION);
        Some(near.map_or_else(
            || {
                let row = |block: &Block| (block.temperature, block.ln_shift / LN_10);
                ShiftLaw::Table(found.blocks.iter().map(row).collect())
            },
            |law| law.law.clone(),
        ))
    }

    /// Returns the moduli that relax.
    pub fn acts_on(&self) -> ActsOn {
        if self.bulk_modulus.is_some() { ActsOn::Shear } else { ActsOn::All }
    }

    /// Returns the smallest and the largest measured frequency at the reference temperature, Hz; of a relaxation test 1/(2πt).
    pub fn band(&self) -> [f64; 2] {
        band(self.table.kind, &self.points)
    }

    /// Returns frequencies at the reference temperature (Hz), one per measured decade, with the standard uncertainty of the loss modulus over
    /// its value: by the scatter of the moduli, and by the uncertainty of the shift of each point. Values are root mean squares over a decade.
    pub fn loss_uncertainty(&self) -> Vec<(f64, f64)> {
        let mut decades: BTreeMap<i32, Vec<[f64; 2]>> = BTreeMap::new();
        let points =
            self.points.iter().zip(&self.series.loss_uncertainties).zip(&self.shift_uncertainties);
        for ((point, by_scatter), shift) in points {
            let [at, _] = band(self.table.kind, std::slice::from_ref(point));
            let both = by_scatter.hypot(self.series.loss_slope(TAU * at) * shift);
            // A loss that the data do not determine is as uncertain as it is large.
            let both = if both.is_finite() { both.min(1.0) } else { 1.0 };
            decades.entry(at.log10().floor() as i32).or_default().push([at.ln(), both * both]);
        }
        let mean = |rows: &[[f64; 2]], part: usize| {
            rows.iter().map(|row| row[part]).sum::<f64>() / rows.len() as f64
        };
        decades.values().map(|rows| (mean(rows, 0).exp(), mean(rows, 1).sqrt())).collect()
    }

    /// Returns the weights G_k/G_0 and the relaxation times (s).
    pub fn weights(&self) -> Vec<(f64, f64)> {
        let whole = self.series.instantaneous_modulus();
        let terms = self.series.terms.iter();
        terms.map(|term| (term.modulus / whole, term.relaxation_time)).collect()
    }

    /// Returns what may be wrong, and what was not read.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if !self.table.unread.is_empty() {
            warnings.push(format!("columns not read: {}", self.table.unread.join(", ")));
        }
        if let Some(found) = self.superposition.as_ref().filter(|found| !found.left_out.is_empty())
        {
            let names: Vec<String> = found.left_out.iter().map(|kelvin| celsius(*kelvin)).collect();
            warnings.push(format!(
                "the moduli at {} do not determine their shifts, since they hardly depend on the frequency: they are left out",
                names.join(", ")
            ));
        }
        if !self.table.modulus_is_named {
            warnings.push(
                "the columns do not say which modulus they are: Young's is taken; --modulus shear for G"
                    .to_string(),
            );
        }
        if let (Some(scatter), rms) = (self.scatter, self.series.rms)
            && rms > LEAST_MISFIT
            && rms > MIN_MISFIT_RATIO * scatter
        {
            warnings.push(format!(
                "the temperatures do not superpose: one series misses the moduli by {:.1} % (rms), a series for each \
                 temperature by {:.1} %; keep fewer temperatures, or try --vertical-shift",
                100.0 * rms,
                100.0 * scatter
            ));
        } else if self.series.rms > LARGE_RMS {
            warnings.push(format!(
                "the series misses the moduli by {:.0} % (rms): check the columns, the units and the temperatures",
                100.0 * self.series.rms
            ));
        }
        warnings
    }
}

/// Returns the smallest and the largest frequency of points, Hz.
fn band(kind: TestKind, points: &[ModulusPoint]) -> [f64; 2] {
    let frequency = |point: &ModulusPoint| match kind {
        TestKind::Oscillation => point.at / TAU,
        TestKind::Relaxation => (TAU * point.at).recip(),
    };
    let all = points.iter().map(frequency);
    all.fold([f64::INFINITY, 0.0], |[from, to], it| [from.min(it), to.max(it)])
}

/// Returns the table with shear moduli, G* = 3 K E*/(9 K − E*) of Hooke's law with an elastic bulk modulus K (Pa) and a complex
/// Young's modulus, by the correspondence principle.
fn of_shear(mut table: ModulusTable, bulk: f64) -> Result<ModulusTable, DataError> {
    if table.modulus == Modulus::Shear {
        return Ok(table);
    }
    if table.kind == TestKind::Relaxation {
        let message = "E(t) becomes G(t) only over frequency if the bulk modulus is elastic";
        let help = "leave out --bulk-modulus: Poisson's ratio is constant then";
        return Err(DataError::new(&table.name, message).with_help(help));
    }
    for point in &mut table.points {
        // Poisson's ratio is 1/2 − E/(6 K).
        if point.magnitude() >= 3.0 * bulk {
            let message = format!(
                "E is {}, and the bulk modulus {} leaves Poisson's ratio below 0",
                show(point.magnitude(), "Pa"),
                show(bulk, "Pa")
            );
            let error = DataError::new(&table.name, message).in_line(point.line);
            return Err(error.with_help("the bulk modulus of a solid is above a third of E"));
        }
        // 3 K E (9 K − Ē)/|9 K − E|²
        let (real, norm) =
            (9.0 * bulk - point.storage, (9.0 * bulk - point.storage).hypot(point.loss));
        let storage = point.storage * real - point.loss * point.loss;
        let loss = point.loss * real + point.storage * point.loss;
        let factor = 3.0 * bulk / norm / norm;
        (point.storage, point.loss) = (factor * storage, factor * loss);
    }
    table.modulus = Modulus::Shear;
    Ok(table)
}

/// Returns the rows by temperature; one block without temperatures.
fn isothermal_blocks(table: &ModulusTable) -> Result<Vec<Block>, DataError> {
    let temperature = |k: &usize| table.points[*k].temperature.unwrap_or(0.0);
    let mut order: Vec<usize> = (0..table.points.len()).collect();
    order.sort_by(|a, b| temperature(a).total_cmp(&temperature(b)));
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for k in order {
        match groups.last_mut() {
            Some(group)
                if group
                    .last()
                    .is_some_and(|last| temperature(&k) - temperature(last) < SAME_TEMPERATURE) =>
            {
                group.push(k);
            }
            _ => groups.push(vec![k]),
        }
    }
    let block = |mut points: Vec<usize>| {
        let [from, to] = [points.first(), points.last()].map(|k| k.map_or(0.0, temperature));
        if to - from > MAX_DRIFT {
            let message = format!(
                "the temperatures go from {} to {} without a step",
                celsius(from),
                celsius(to)
            );
            let help =
                "superposition needs several frequencies at each of several constant temperatures";
            return Err(DataError::new(&table.name, message).with_help(help));
        }
        let mean = points.iter().map(temperature).sum::<f64>() / points.len() as f64;
        points.sort_unstable();
        let at = |k: &usize| table.points[*k].at;
        let first = points.first().map_or(0.0, at);
        if points.iter().all(|k| (at(k) / first).max(first / at(k)) < SAME) {
            let line = table.points[points[0]].line;
            let message = format!("only one frequency or time is at {}", celsius(mean));
            let help = "superposition needs several frequencies at each temperature";
            return Err(DataError::new(&table.name, message).in_line(line).with_help(help));
        }
        Ok(Block {
            temperature: mean,
            points,
            ln_shift: 0.0,
            shift_uncertainty: 0.0,
            ln_vertical: 0.0,
        })
    };
    groups.into_iter().map(block).collect()
}

/// Returns a temperature (K) as text.
fn celsius(kelvin: f64) -> String {
    format!("{:.1} °C", kelvin - ZERO_CELSIUS)
}

/// Shifts blocks to the reference.
fn superposed(
    table: &ModulusTable,
    blocks: Vec<Block>,
    settings: RelaxationSettings,
) -> Result<Superposition, DataError> {
    let middle = blocks[blocks.len() / 2].temperature;
    let wanted = settings.reference_temperature.unwrap_or(middle);
    let far = |k: &usize| (blocks[*k].temperature - wanted).abs();
    let reference = (0..blocks.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0);
    let names: Vec<String> = blocks.iter().map(|block| celsius(block.temperature)).collect();
    if far(&reference) > MAX_DRIFT {
        let message = format!("no rows are at the reference temperature, {}", celsius(wanted));
        let help = format!("there are {}", names.join(", "));
        return Err(DataError::new(&table.name, message).with_help(help));
    }
    let has_vertical = settings.has_vertical_shift;
    let found = Superposition::of(table.kind, &table.points, blocks, reference, has_vertical);
    let found = found.map_err(|k| {
        let message = format!("the moduli at {} and {} do not overlap", names[k], names[k + 1]);
        let help = "superposition needs steps of temperature so small that neighbouring blocks share moduli";
        DataError::new(&table.name, message).with_help(help)
    })?;
    if found.blocks.len() < 2 {
        let message =
            format!("no other moduli determine their shift against those at {}", names[reference]);
        let help = "choose a reference temperature at which the moduli depend on the frequency";
        return Err(DataError::new(&table.name, message).with_help(help));
    }
    Ok(found)
}

/// Returns the root mean square of the residuals of a series for each block, per degree of freedom.
fn scatter_of_blocks(table: &ModulusTable, blocks: &[Block]) -> f64 {
    let (mut sum, mut freedom) = (0.0, 0.0);
    for block in blocks {
        let points: Vec<ModulusPoint> = block.points.iter().map(|k| table.points[*k]).collect();
        let series = fit_series(table.kind, &points, None);
        let n = if table.kind == TestKind::Oscillation { 2 * points.len() } else { points.len() };
        let n_parameters = 2 * series.terms.len() + 1;
        if n > n_parameters {
            sum += n as f64 * series.rms.powi(2);
            freedom += (n - n_parameters) as f64;
        }
    }
    if freedom > 0.0 { (sum / freedom).sqrt() } else { f64::NAN }
}

/// Returns the least and the largest loss factor over temperature, each with its temperature; `None` without several temperatures.
fn losses_of_ramp(table: &ModulusTable) -> Option<String> {
    let of = |point: &ModulusPoint| Some((point.loss / point.storage, point.temperature?));
    let losses: Vec<(f64, f64)> = table.points.iter().map(of).collect::<Option<_>>()?;
    let order = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0);
    let (least, most) = (losses.iter().min_by(order)?, losses.iter().max_by(order)?);
    let shown =
        |(loss, kelvin): &(f64, f64)| format!("{} at {}", number(*loss, 2), celsius(*kelvin));
    let is_ramp = table.kind == TestKind::Oscillation && least.1 != most.1;
    is_ramp.then(|| format!("tan δ from {} to {}", shown(least), shown(most)))
}

fn check_span(table: &ModulusTable) -> Result<(), DataError> {
    let [from, to] = band(table.kind, &table.points);
    if to < MIN_SPAN * from {
        let (what, unit) = match table.kind {
            TestKind::Oscillation => ("frequency", "Hz"),
            TestKind::Relaxation => ("time", "s"),
        };
        let at = table.points[0].at;
        let at = if table.kind == TestKind::Oscillation { at / TAU } else { at };
        if let (true, Some(ramp)) = (to < SAME * from, losses_of_ramp(table)) {
            let message =
                format!("a ramp of temperature at one {what}, {}, is no series", show(at, unit));
            let help = format!(
                "it has the loss there alone, {ramp}: add a second frequency at each temperature"
            );
            return Err(DataError::new(&table.name, message).with_help(help));
        }
        let message = match to < SAME * from {
            true => format!("all rows are of one {what}, {}", show(at, unit)),
            false => format!("the rows span a factor of only {:.2} of {what}", to / from),
        };
        let help = format!(
            "a relaxation needs the moduli over a factor of 3 of {what} or more, better over several decades"
        );
        return Err(DataError::new(&table.name, message).with_help(help));
    }
    Ok(())
}

/// Checks the rows of one temperature: a storage modulus rises with frequency, a relaxation modulus falls with time.
fn check_block(table: &ModulusTable, block: &Block) -> Result<(), DataError> {
    let mut sorted: Vec<&ModulusPoint> = block.points.iter().map(|k| &table.points[*k]).collect();
    sorted.sort_by(|a, b| a.at.total_cmp(&b.at));
    let name = format!(
        "{}{}",
        table.modulus.symbol(),
        match table.kind {
            TestKind::Oscillation => "'",
            TestKind::Relaxation => "(t)",
        }
    );
    let at = |point: &ModulusPoint| match table.kind {
        TestKind::Oscillation => show(point.at / TAU, "Hz"),
        TestKind::Relaxation => show(point.at, "s"),
    };
    for pair in sorted.windows(2) {
        let [first, second] = [pair[0], pair[1]];
        let ratio = first.storage / second.storage;
        if second.at < SAME * first.at && ratio.max(ratio.recip()) > 1.0 + MAX_CONTRADICTION {
            let message = format!(
                "{name} is {} and in line {} it is {}, both at {}",
                show(second.storage, "Pa"),
                first.line,
                show(first.storage, "Pa"),
                at(first)
            );
            let help = "rows of different temperatures need a column of temperatures; rows of different samples are different tables";
            return Err(DataError::new(&table.name, message).in_line(second.line).with_help(help));
        }
    }
    // Over frequency the modulus rises; over time it falls.
    if table.kind == TestKind::Relaxation {
        sorted.reverse();
    }
    let medians = running_medians(&sorted, sorted.len() / PER_MEDIAN / 2);
    let Some(mut highest) = medians.first().copied() else { return Ok(()) };
    for point in medians {
        if point.storage > highest.storage {
            highest = point;
        } else if point.storage < (1.0 - MAX_FALL) * highest.storage {
            let message = format!(
                "{name} is {} at {} and only {} at {}",
                show(highest.storage, "Pa"),
                at(&highest),
                show(point.storage, "Pa"),
                at(&point)
            );
            let help = "at one temperature the modulus of every passive solid rises with frequency and falls with time: \
                        check columns, units and resonances of the instrument";
            return Err(DataError::new(&table.name, message).in_line(point.line).with_help(help));
        }
    }
    Ok(())
}

/// Returns the points with the medians of their storage moduli over so many neighbours on either side, fewer at the ends.
fn running_medians(points: &[&ModulusPoint], half: usize) -> Vec<ModulusPoint> {
    let place = |window: &[f64], value: f64| window.partition_point(|other| *other < value);
    let mut window: Vec<f64> = Vec::new();
    let mut end = 0;
    let median = |(k, point): (usize, &&ModulusPoint)| {
        while end < (k + half + 1).min(points.len()) {
            let value = points[end].storage;
            window.insert(place(&window, value), value);
            end += 1;
        }
        if k > half {
            window.remove(place(&window, points[k - half - 1].storage));
        }
        ModulusPoint { storage: window[window.len() / 2], ..**point }
    };
    points.iter().enumerate().map(median).collect()
}
