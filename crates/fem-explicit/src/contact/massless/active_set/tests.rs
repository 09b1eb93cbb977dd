use super::*;
use crate::test_support::noise;

/// A chain of masses on the ground, and a spring at each that closes or opens it.
fn chain(n: usize, stiffness: f64) -> Problem {
    let mut matrix = Skyline::new((0..n).map(|i: usize| i.saturating_sub(1)));
    for i in 0..n {
        *matrix.entry(i, i) = 2.1;
        if i > 0 {
            *matrix.entry(i, i - 1) = -1.0;
        }
    }
    let spring = |j: usize| Spring {
        stiffness: stiffness * (1.5 + noise(j)),
        opening: vec![(j, -0.6), (j + 1, 0.4 + noise(j + 9))],
    };
    Problem { stiffness: matrix, springs: (0..n - 1).map(spring).collect() }
}

/// Forces and gaps without pattern.
fn disturbed(problem: &Problem, seed: usize) -> ActiveSet {
    let mut active_set = ActiveSet::new(problem);
    for (i, force) in active_set.lacking.iter_mut().enumerate() {
        *force = 4.0 * noise(17 * seed + i);
    }
    for (j, gap) in active_set.gaps.iter_mut().enumerate() {
        *gap = noise(23 * seed + j + 5);
    }
    active_set
}

/// K x of the chain.
fn pull(x: &[f64]) -> Vec<f64> {
    let at = |i: Option<usize>| i.and_then(|i| x.get(i)).copied().unwrap_or(0.0);
    (0..x.len()).map(|i| 2.1 * x[i] - at(i.checked_sub(1)) - at(Some(i + 1))).collect()
}

/// The conditions of the minimum, with springs' compliance: p ≥ 0, overlap p/k + gap ≥ 0, one of them 0,
/// and K x = R + Σ p b.
#[test]
fn active_set_solution_satisfies_balance_and_complementarity() {
    for stiffness in [1e-3, 1.0, 1e3, 1e6] {
        let problem = chain(40, stiffness);
        for seed in 0..50 {
            let mut active_set = disturbed(&problem, seed);
            active_set.solve(&problem).unwrap();
            let mut lack = pull(&active_set.change);
            lack.iter_mut().zip(&active_set.lacking).for_each(|(lack, force)| *lack -= force);
            for (spring, gap) in problem.springs.iter().zip(&active_set.gaps) {
                let gap = gap + spring.opens_by(&active_set.change);
                let pressure = spring.stiffness * (-gap).max(0.0);
                assert!(gap >= 0.0 || pressure > 0.0);
                spring.opening.iter().for_each(|(i, share)| lack[*i] -= share * pressure);
            }
            // Rounding of springs whose force is a difference of displacements of size 1.
            let rounding = 1e-14 * stiffness.max(1.0);
            let worst = lack.iter().fold(0.0, |worst: f64, lack| worst.max(lack.abs()));
            assert!(worst < rounding, "{stiffness} {seed}: {worst}");
        }
    }
}

/// The search along lines ends at the same springs and so at the same bits.
#[test]
fn line_search_finds_the_same_active_set() {
    for stiffness in [1.0, 1e3] {
        let problem = chain(40, stiffness);
        for seed in 0..50 {
            let (mut free, mut searched) = (disturbed(&problem, seed), disturbed(&problem, seed));
            free.solve(&problem).unwrap();
            searched.search_lines(&problem).unwrap();
            assert_eq!(free.change, searched.change);
        }
    }
}

/// The contents of the buffers from earlier solutions do not change a bit.
#[test]
fn a_solution_does_not_depend_on_those_before() {
    let problem = chain(40, 30.0);
    let mut kept = disturbed(&problem, 0);
    for seed in 0..50 {
        let mut fresh = disturbed(&problem, seed);
        kept.lacking.copy_from_slice(&fresh.lacking);
        kept.gaps.copy_from_slice(&fresh.gaps);
        kept.solve(&problem).unwrap();
        fresh.solve(&problem).unwrap();
        assert_eq!(kept.change, fresh.change);
    }
}
