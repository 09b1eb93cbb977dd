//! Stress on the surface and along the axis at the largest approach, against Hertz' and Ting's fields.
//!
//! Each `[run.NAME]` is an impact of explicit elements. The reference is Hertz' field of the circle a(t) of the contact
//! by closed forms. Bodies that relax with a constant Poisson's ratio have, as long as the contact grows (Ting 1966), the
//! superposition
//!
//! ```math
//! \sigma(t) = \int_0^t \varphi(t - t')\, \frac{\mathrm d\sigma_\text{H}(a(t'))}{\mathrm dt'}\,\mathrm dt'
//! ```
//!
//! of Hertz' fields with instantaneous moduli, with a(t) from Ting's impact. It measures over the peak pressure of the
//! reference: `NAME.surface_rr`, `NAME.surface_tt`, `NAME.axis_yy`, `NAME.axis_rr` and `NAME.axis_shear`, the largest
//! differences at the nodes from 0 to `distance` and `depth` contact radii; `NAME.edge`, the largest difference of σ_rr
//! within an element of the contact's edge; and `NAME.tension`, the largest tension over that of the reference at its node.

use fem_case::schema::{ModelTable, SnapshotsValue};
use fem_case::{Case, SnapshotLabel};
use fem_collision::SnapshotInstant;
use fem_figure::{Axis, Chart, Curve, GREY};
use fem_laws::HertzPressure;
use fem_material::PronySeries;
use serde::Deserialize;

use crate::{ExplicitRun, Findings, Laboratory, StudyError};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Distance from the axis and depth over the contact radius.
    distance: f64,
    depth: f64,
}

/// Hertz' fields with their shares in the stress.
struct ReferenceField {
    parts: Vec<(f64, HertzPressure)>,
    poissons_ratio: f64,
}

impl ReferenceField {
    /// Returns the field of a run at the largest approach of closed forms.
    fn of(laboratory: &Laboratory, run: &ExplicitRun) -> Result<Self, StudyError> {
        let missing = || StudyError::parameters("the case has no sphere");
        let material = run.case.scene().bodies().iter().find_map(|body| body.material());
        let material = material.ok_or_else(missing)?;
        let poissons_ratio = material.instantaneous().poissons_ratio();
        let Some(series) = material.relaxation() else {
            let parts = vec![(1.0, run.hertz.pressure(run.hertz.max_approach()))];
            return Ok(Self { parts, poissons_ratio });
        };
        let case = run.case.edited(|file| file.model = Some(ModelTable::ting()))?;
        let ting = laboratory.simulate(case)?;
        let rows = &ting.collision.history;
        let last = (0..rows.len()).max_by(|&a, &b| rows[a].approach.total_cmp(&rows[b].approach));
        let growing = &rows[..=last.ok_or_else(missing)?];
        let loads = growing.iter().map(|row| (row.time, run.hertz.pressure(row.approach.max(0.0))));
        Ok(Self { parts: superposition(&loads.collect::<Vec<_>>(), series), poissons_ratio })
    }

    /// Returns σ_rr, σ_yy, σ_θθ at a distance from the axis and a depth, m.
    fn stress(&self, r: f64, depth: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (share, circle) in &self.parts {
            let [rr, zz, tt, _] = circle.stress(r, depth, self.poissons_ratio);
            [rr, zz, tt].iter().zip(&mut sum).for_each(|(stress, sum)| *sum += share * stress);
        }
        sum
    }

    /// Returns the contact radius, m, and the pressure on the axis, Pa.
    fn scale(&self) -> (f64, f64) {
        let radii = self.parts.iter().map(|(_, circle)| circle.contact_radius);
        (radii.fold(0.0, f64::max), -self.stress(0.0, 0.0)[1])
    }
}

/// Returns the shares of growing circles (time in s, circle) in the stress at the last time: φ of the time since each
/// increment, half of it before and half of it after.
fn superposition(
    loads: &[(f64, HertzPressure)],
    series: &PronySeries,
) -> Vec<(f64, HertzPressure)> {
    let end = loads.last().map_or(0.0, |(time, _)| *time);
    let increment = |k: usize| {
        let middle = 0.5 * (loads[k - 1].0 + loads[k].0);
        series.relaxation(end - middle)
    };
    let share = |k: usize| {
        let own = if k > 0 { increment(k) } else { 0.0 };
        own - if k + 1 < loads.len() { increment(k + 1) } else { 0.0 }
    };
    loads.iter().enumerate().map(|(k, (_, circle))| (share(k), *circle)).collect()
}

/// A place over the contact radius, with the stress of the run and of the reference over the peak pressure.
type Sample = (f64, [f64; 3], [f64; 3]);

/// Profiles of a run over a and p₀, and the element size over a.
struct Profiles {
    surface: Vec<Sample>,
    axis: Vec<Sample>,
    element: f64,
}

impl Profiles {
    fn of(
        run: &ExplicitRun,
        reference: &ReferenceField,
        to: &Parameters,
    ) -> Result<Self, StudyError> {
        let missing = || StudyError::parameters("the run has no sphere or no largest approach");
        let snapshot = run.collision.snapshot(SnapshotInstant::Maximum).ok_or_else(missing)?;
        let bodies = run.model.bodies();
        let side = usize::from(bodies[0].mesh().is_none());
        let mesh = bodies[side].mesh().ok_or_else(missing)?;
        let stress = bodies[side].stress(&snapshot.bodies[side], Some(&snapshot.contact));
        let (radius, pressure) = reference.scale();
        let sample = |node: u32, end: f64| {
            let [r, y] = mesh.nodes()[node as usize];
            let place = r.max(y.abs()) / radius;
            let [rr, yy, tt, _] = stress.points[node as usize];
            let depth = if mesh.surface().contains(&node) { 0.0 } else { y.abs() };
            let over = |stress: [f64; 3]| stress.map(|stress| stress / pressure);
            (place <= end).then(|| (place, over([rr, yy, tt]), over(reference.stress(r, depth))))
        };
        let along = |nodes: &[u32], end: f64| nodes.iter().map_while(|&n| sample(n, end)).collect();
        let (surface, axis) = (along(mesh.surface(), to.distance), along(mesh.axis(), to.depth));
        let element = mesh.nodes()[mesh.surface()[1] as usize][0] / radius;
        Ok(Self { surface, axis, element })
    }

    /// Measures the largest differences.
    fn measure(&self, name: &str, findings: &mut Findings) {
        let is_at_edge = |sample: &&Sample| (sample.0 - 1.0).abs() < self.element;
        let worst = |samples: &mut dyn Iterator<Item = &Sample>, of: &dyn Fn(&[f64; 3]) -> f64| {
            samples.map(|(_, found, exact)| (of(found) - of(exact)).abs()).fold(0.0, f64::max)
        };
        let rr = |stress: &[f64; 3]| stress[0];
        let shear = |stress: &[f64; 3]| 0.5 * (stress[0] - stress[1]).abs();
        let mut put = |quantity: &str, value: f64| {
            findings.measure(format!("{name}.{quantity}"), value);
        };
        let away = || self.surface.iter().filter(|sample| !is_at_edge(sample));
        put("surface_rr", worst(&mut away(), &rr));
        put("surface_tt", worst(&mut away(), &|stress| stress[2]));
        put("edge", worst(&mut self.surface.iter().filter(is_at_edge), &rr));
        put("axis_yy", worst(&mut self.axis.iter(), &|stress| stress[1]));
        put("axis_rr", worst(&mut self.axis.iter(), &rr));
        put("axis_shear", worst(&mut self.axis.iter(), &shear));
        let tense = self.surface.iter().max_by(|a, b| a.1[0].total_cmp(&b.1[0]));
        put("tension", tense.map_or(f64::NAN, |(_, found, exact)| found[0] / exact[0]));
    }

    fn charts(&self, reference: &ReferenceField, to: &Parameters) -> [Chart; 2] {
        let (radius, pressure) = reference.scale();
        let chart = |x: &str| Chart::new(Axis::new(x), Axis::new("stress/p0"));
        let add =
            |chart: Chart, samples: &[Sample], end: f64, on_axis: bool, k: usize, name: &str| {
                let exact = (0..=400).map(|n| f64::from(n) / 400.0 * end).map(|x| {
                    let [r, depth] = if on_axis { [0.0, x] } else { [x, 0.0] };
                    (x, reference.stress(r * radius, depth * radius)[k] / pressure)
                });
                let found = samples.iter().map(|(place, found, _)| (*place, found[k])).collect();
                chart
                    .with(Curve::points(name, found).like_curve(k))
                    .with(Curve::dashed("closed form", exact.collect()).coloured(GREY))
            };
        let surface = add(chart("r/a"), &self.surface, to.distance, false, 0, "σ_rr, surface");
        let axis = add(chart("depth/a"), &self.axis, to.depth, true, 1, "σ_yy, axis");
        [
            add(surface, &self.surface, to.distance, false, 2, "σ_θθ, surface"),
            add(axis, &self.axis, to.depth, true, 0, "σ_rr, axis"),
        ]
    }
}

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let parameters: Parameters = laboratory.parameters()?;
    let (names, cases) = laboratory.cases()?;
    let with_snapshot = |case: Case| {
        case.edited(|file| {
            let snapshots = SnapshotsValue::labels([SnapshotLabel::Maximum]);
            file.output.get_or_insert_default().snapshots = Some(snapshots);
        })
    };
    let cases = cases.into_iter().map(with_snapshot).collect::<Result<_, _>>()?;
    let mut findings = Findings::new();
    for (name, run) in names.into_iter().zip(laboratory.run_all(cases)?) {
        let reference = ReferenceField::of(laboratory, &run)?;
        let profiles = Profiles::of(&run, &reference, &parameters)?;
        profiles.measure(name, &mut findings);
        let caption = format!(
            "Stress at the largest approach of the run `{name}` (points) and by closed forms (dashed)."
        );
        findings.draw(name, caption, &profiles.charts(&reference, &parameters));
    }
    Ok(findings)
}

#[cfg(test)]
mod tests {
    use fem_material::{ActsOn, PronyTerm};

    use super::*;

    /// Without relaxation only the last circle counts; with it, p = ∫φ dp of a pressure that grows evenly.
    #[test]
    fn superposed_circles_have_the_pressure_of_the_convolution() {
        let n = 400;
        let circle = |x: f64| HertzPressure { contact_radius: x, peak_pressure: x };
        let loads: Vec<_> =
            (0..=n).map(|k| f64::from(k) / f64::from(n)).map(|t| (t, circle(t))).collect();
        for (weight, exact) in [(0.0, 1.0), (1.0, 1.0 - (-1f64).exp())] {
            let term = PronyTerm { weight, relaxation_time: 1.0 };
            let series = PronySeries::new(vec![term], ActsOn::All).unwrap();
            let parts = superposition(&loads, &series);
            let field = ReferenceField { parts, poissons_ratio: 0.3 };
            // The middle rule over 400 increments.
            assert!((field.scale().1 - exact).abs() < 1e-5, "{}", field.scale().1);
        }
    }
}
