//! Fig. 11: velocities of both spheres during an elastic collision, compared with Hertz.
//!
//! Hertz gives the approach rate; with the velocity of the centre of mass it gives both bodies':
//!
//! ```math
//! v_1 = V + \frac{m_2}{m_1+m_2}\,\dot\delta, \qquad v_2 = V - \frac{m_1}{m_1+m_2}\,\dot\delta
//! ```

use std::sync::Arc;

use fem_case::Scene;
use fem_case::engineering::show;
use fem_figure::{Axis, Chart, Curve, GREY};

use crate::{ExplicitRun, Findings, Laboratory, Run, StudyError, studies::summary::quantities};

const MAIN: &str = "elastic";

pub fn study(laboratory: &Laboratory) -> Result<Findings, StudyError> {
    let mut findings = Findings::new();
    let (names, cases) = laboratory.cases()?;
    let runs = laboratory.run_all(cases)?;
    for (name, run) in names.iter().zip(&runs) {
        for (quantity, value) in quantities(run) {
            findings.measure(format!("{name}.{quantity}"), value);
        }
    }
    let main = names.iter().position(|name| *name == MAIN).map(|k| &runs[k]);
    let run = main.ok_or_else(|| StudyError::parameters(format!("no [run.{MAIN}]")))?;
    let rigid = RigidPair::of(run.case.scene());
    measure(run, &rigid, &mut findings);
    draw(run, &rigid, &mut findings);
    compare(run, &rigid, &mut findings);
    Ok(findings)
}

/// Two point masses, whose velocities follow from the approach rate.
struct RigidPair {
    masses: [f64; 2],
    before: [f64; 2],
}

impl RigidPair {
    fn of(scene: &Scene) -> Self {
        let masses = scene.bodies().each_ref().map(|body| {
            let material = body.material().zip(body.diameter());
            material.map_or(f64::NAN, |(m, d)| fem_laws::sphere_mass(d, m.density()))
        });
        Self { masses, before: scene.bodies().each_ref().map(|body| body.velocity()) }
    }

    fn velocities(&self, approach_rate: f64) -> [f64; 2] {
        let [m1, m2] = self.masses;
        let [v1, v2] = self.before;
        let centre = (m1 * v1 + m2 * v2) / (m1 + m2);
        [centre + m2 / (m1 + m2) * approach_rate, centre - m1 / (m1 + m2) * approach_rate]
    }

    /// Returns the velocities after a collision without loss.
    fn after(&self) -> [f64; 2] {
        self.velocities(self.before[1] - self.before[0])
    }
}

fn measure(run: &Run, rigid: &RigidPair, findings: &mut Findings) {
    let hertz = run.hertz;
    let after = rigid.after();
    for (k, name) in ["striker", "target"].into_iter().enumerate() {
        let velocity = run.velocity_after()[k];
        findings.measure(format!("{name}_after"), velocity);
        findings.measure(format!("{name}_after_over_rigid"), velocity / after[k]);
    }
    for row in &run.collision.history {
        let expected = rigid.velocities(hertz.at(row.time).approach_rate);
        for (velocity, expected) in row.velocity.iter().zip(expected) {
            let difference = (velocity - expected).abs() / hertz.approach_speed();
            findings.measure_worst("worst_velocity_difference", difference);
        }
    }
    // The radius of the circle in which the undeformed spheres intersect.
    let overlap = (2.0 * run.max_approach() * hertz.pair().effective_radius()).sqrt();
    findings.measure("overlap_radius", overlap);
}

fn draw(run: &Arc<ExplicitRun>, rigid: &RigidPair, findings: &mut Findings) {
    let history = &run.collision.history;
    let hertz = run.hertz;
    let end = history.last().map_or(0.0, |row| row.time);
    let times = || (0..=160).map(move |k| end * f64::from(k) / 160.0);
    let micro = |time: f64| 1e6 * time;
    let velocity =
        |k: usize| history.iter().map(|row| (micro(row.time), row.velocity[k])).collect();
    let by_hertz = |k: usize| {
        let velocity = |t: f64| rigid.velocities(hertz.at(t).approach_rate)[k];
        times().map(|t| (micro(t), velocity(t))).collect()
    };
    let velocities = Chart::new(Axis::new("time [µs]"), Axis::new("velocity [m/s]"))
        .with(Curve::line("22.2 mm, striking", velocity(0)))
        .with(Curve::line("15.9 mm, at rest before", velocity(1)))
        .with(Curve::dashed("Hertz", by_hertz(0)).coloured(GREY))
        .with(Curve::dashed("", by_hertz(1)).coloured(GREY));
    let force = history.iter().map(|row| (micro(row.time), row.contact_force)).collect();
    let by_hertz = times().map(|t| (micro(t), hertz.at(t).force)).collect();
    let force = Chart::new(Axis::new("time [µs]"), Axis::new("contact force [N]"))
        .with(Curve::line("contact force", force).coloured("#009E73"))
        .with(Curve::dashed("Hertz", by_hertz).coloured(GREY));
    findings.draw(
        "velocities",
        "Fig. 11 of the paper, computed here on meshes like its own: velocities of the mass \
         centres and the contact force over an elastic collision at 0.5 m/s, Hertz dashed. The \
         curves end earlier than Hertz' because a sphere is stiffer than a half-space.",
        &[velocities, force],
    );
}

fn compare(run: &Run, rigid: &RigidPair, findings: &mut Findings) {
    let hertz = run.hertz;
    let [striker, target] = rigid.after();
    let after = run.velocity_after();
    let row = |name: &str, paper: &str, ours: String, theory: String| {
        [name.to_string(), paper.to_string(), ours, theory]
    };
    findings.tabulate(
        "Numbers of fig. 11",
        ["", "paper", "here", "Hertz, rigid bodies"],
        [
            row("restitution", "0.994", format!("{:.6}", run.restitution), "1".into()),
            row(
                "contact time",
                "64.23 µs",
                show(run.contact_time(), "s"),
                show(hertz.contact_time(), "s"),
            ),
            row("striker after", "", show(after[0], "m/s"), show(striker, "m/s")),
            row("target after", "", show(after[1], "m/s"), show(target, "m/s")),
            row(
                "contact radius",
                "0.31 mm",
                show(run.max_contact_radius(), "m"),
                show(hertz.max_contact_radius(), "m"),
            ),
        ],
    );
}
