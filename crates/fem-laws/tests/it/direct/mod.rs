//! Ting's impact by sums over the whole past, for comparison.

use fem_laws::{HertzImpact, Pair, PairRelaxation};

/// m(t) of the finite size: δ = u + m∘d(u^(3/2)) with m = m[0] − m[1] ln u, in metres.
pub type Added<'a> = &'a dyn Fn(f64) -> [f64; 2];

/// Ting's integrals as sums over equal steps with the kernel at midpoints, no series, no
/// recursion, t₁ by adding up increments from now backwards; velocity Verlet for the motion, with gravity
/// along the approach, m/s². Returns restitution, contact time, peak force, pressure, approach.
pub fn direct(
    pair: &Pair,
    relaxation: &PairRelaxation,
    added: Option<Added>,
    speed: f64,
    n_steps: usize,
    gravity: f64,
) -> [f64; 5] {
    let hertz = HertzImpact::new(pair, speed).unwrap();
    let dt = hertz.contact_time() / n_steps as f64;
    let midpoints = || (0..4 * n_steps).map(|i| (i as f64 + 0.5) * dt);
    let kernel: Vec<f64> = midpoints().map(|time| relaxation.relaxation(time)).collect();
    let added: Option<Vec<[f64; 2]>> = added.map(|added| midpoints().map(added).collect());
    // Hertz' approach u; δ itself only now.
    let mut approach = vec![0.0f64];
    let (mut whole, mut highest) = (0.0, 0.0f64);
    let (mut rate, mut acceleration, mut turn) = (speed, gravity, None);
    let [mut peak_force, mut peak_pressure] = [0.0f64; 2];
    loop {
        let n = approach.len();
        rate += 0.5 * dt * acceleration;
        whole += dt * rate;
        highest = highest.max(whole);
        approach.push(match &added {
            None => whole,
            Some(added) => hertz_approach(added, &approach, whole),
        });
        if turn.is_none() && rate < 0.0 {
            turn = Some(n - 1);
        }
        // Index and part of the step of t₁.
        let (mut last, mut part) = (n, 0.0);
        if turn.is_some() {
            let mut sum = 0.0;
            loop {
                if last == 0 {
                    // Contact ended within the step; the force there is nearly 0.
                    let time = n as f64 * dt;
                    return [-rate / speed, time, peak_force, peak_pressure, highest];
                }
                let added = kernel[n - last] * (approach[last] - approach[last - 1]);
                last -= 1;
                if sum + added >= 0.0 {
                    part = 1.0 + sum / added;
                    break;
                }
                sum += added;
            }
            part = 1.0 - part;
        }
        let sum = |power: fn(f64) -> f64| -> f64 {
            let increment = |j: usize| power(approach[j + 1]) - power(approach[j]);
            let whole: f64 = (0..last).map(|j| kernel[n - 1 - j] * increment(j)).sum();
            // Of the step with t₁ the part before it.
            match part > 0.0 {
                true => whole + (1.0 - part) * kernel[n - 1 - last] * increment(last),
                false => whole,
            }
        };
        let force = hertz.stiffness() * sum(|x| x * x.sqrt());
        peak_force = peak_force.max(force);
        let scale = 2.0 / std::f64::consts::PI * pair.contact_modulus();
        peak_pressure = peak_pressure.max(scale / pair.effective_radius().sqrt() * sum(f64::sqrt));
        acceleration = gravity - force / pair.effective_mass();
        rate += 0.5 * dt * acceleration;
    }
}

/// u now, from all earlier ones and δ now, by repeated substitution.
fn hertz_approach(added: &[[f64; 2]], earlier: &[f64], whole: f64) -> f64 {
    let power = |u: f64| u * u.sqrt();
    let n = earlier.len();
    let mut past = [0.0; 2];
    for j in 1..n {
        let increment = power(earlier[j]) - power(earlier[j - 1]);
        for i in 0..2 {
            past[i] += added[n - j][i] * increment;
        }
    }
    let mut now = earlier[n - 1].max(1e-12);
    // Each substitution leaves 2 % of the error.
    for _ in 0..8 {
        let increment = power(now) - power(earlier[n - 1]);
        let [alpha, beta] = [0, 1].map(|i| past[i] + added[0][i] * increment);
        now = (whole - alpha + beta * now.ln()).max(1e-12);
    }
    now
}
