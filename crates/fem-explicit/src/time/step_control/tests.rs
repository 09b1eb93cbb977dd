use fem_collision::{Approach, BodyInput};
use fem_material::finite::HyperelasticLaw;
use fem_mesh::Side;

use super::*;
use crate::model::{ExplicitBodies, ModelParts};
use crate::state::State;
use crate::test_support::{glass_sphere, settings, started};

fn model(law: Option<HyperelasticLaw>) -> ExplicitBodies {
    at_speed(law, 0.01)
}

/// The sphere at a speed of approach; pressure waves have the speed 1.1.
fn at_speed(law: Option<HyperelasticLaw>, speed: f64) -> ExplicitBodies {
    let bodies = [BodyInput::Wall, glass_sphere(4.0, Side::Above)];
    let parts = ModelParts { finite_strain: [None, law], ..ModelParts::default() };
    let approach = Approach::new([speed, 0.0], 1e3 * speed).unwrap();
    started(bodies, approach, &settings(), parts).0
}

/// The control of a model at first touch.
fn first(model: &ExplicitBodies) -> StepControl {
    State::at_first_touch(model).step_control.unwrap()
}

/// The step over the model's.
fn share_of(control: &StepControl, model: &ExplicitBodies) -> f64 {
    control.time_step(model.time_step()) / model.time_step()
}

/// The control after a bound where the critical step is a multiple of the model's, at a strain rate per step of the
/// model.
fn after(
    control: &StepControl,
    model: &ExplicitBodies,
    step: u64,
    [critical, rate]: [f64; 2],
) -> Option<StepControl> {
    let demand = StepDemand {
        critical_time_step: critical * model.time_step() / model.step_factor(),
        strain_rate: rate / model.time_step(),
        allowance_rate: rate / STRAIN_BETWEEN_BOUNDS / model.time_step(),
    };
    let time = control.time_after(step, model.time_step());
    control.after_bound(demand, (step, time), [model.time_step(), model.step_factor()])
}

/// Levels are powers of the sixteenth root of two; bodies at small strain have none.
#[test]
fn levels_are_powers_of_the_sixteenth_root_of_two() {
    for level in 0..=MAX_LEVELS {
        let exact = 0.5f64.powf(f64::from(level) / 16.0);
        // Rounding of the power, which grows with it.
        assert!((level_factor(level) / exact - 1.0).abs() < 1e-13, "{level}");
    }
    assert_eq!(State::at_first_touch(&model(None)).step_control, None);
}

/// The step is never above the allowed one, and below it by at most a level and its margin.
#[test]
fn the_step_follows_the_critical_one_down_at_once_and_up_where_there_is_room() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let mut control = first(&model);
    assert_eq!(share_of(&control, &model), 1.0);
    let quarters = [1.0, 0.99, 0.7, 0.5001, 0.5, 0.1, 0.3, 0.31, 0.35, 0.6, 1.0, 1.1, 2.0];
    for (k, critical) in quarters.into_iter().enumerate() {
        control = after(&control, &model, 100 * (k as u64 + 1), [critical, 0.0]).unwrap();
        let share = share_of(&control, &model);
        let least =
            (critical / MARGIN_TO_LENGTHEN * 0.5f64.powf(1.0 / 16.0)).min(1.0 / MARGIN_TO_LENGTHEN);
        assert!(
            share <= critical * ROUNDING_OF_STEP && share > least * 0.999,
            "{critical}: {share}"
        );
    }
    // Little more than a level is no margin: the step would go up and down.
    let at_half = after(&control, &model, 2000, [0.5, 0.0]).unwrap();
    let stays = after(&at_half, &model, 2100, [0.5 * 1.05, 0.0]).unwrap();
    assert_eq!(share_of(&stays, &model), share_of(&at_half, &model));
    let grows = after(&at_half, &model, 2100, [0.5 * 1.06, 0.0]).unwrap();
    assert!(share_of(&grows, &model) > share_of(&at_half, &model));
}

/// Time is the step number times the step, counted from where the step last changed.
#[test]
fn time_is_continuous_where_the_step_changes() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let start = first(&model);
    let touch = model.approach().first_touch();
    assert_eq!(start.time_after(7, model.time_step()), model.time_after(7));
    let second = after(&start, &model, 10, [0.5, 0.0]).unwrap();
    assert_eq!(second.time_after(10, model.time_step()), start.time_after(10, model.time_step()));
    let later = second.time_after(14, model.time_step()) - touch;
    // Rounding.
    assert!((later / (12.0 * model.time_step()) - 1.0).abs() < 1e-12);
}

/// The next bound is the sooner, the faster the critical step changes.
#[test]
fn next_bound_is_sooner_for_faster_changes() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let start = first(&model);
    let pause = |critical: f64, rate: f64| {
        let next = after(&start, &model, 10, [critical, rate]).unwrap();
        assert!(!next.is_bound_due(next.next_bound - 1) && next.is_bound_due(next.next_bound));
        next.next_bound - 10
    };
    assert_eq!(pause(1.0, 0.0), LONGEST_PAUSE as u64);
    // A change of 1 % in ten steps is one of 2 % in twenty.
    assert!((19..=20).contains(&pause(0.99, 0.0)));
    assert_eq!(pause(0.5, 0.0), 1);
    // A strain of 5 % at half a per cent per step.
    assert!((9..=10).contains(&pause(1.0, 0.005)));
    assert_eq!(pause(1.0, 1.0), 1);
}

/// The strain per step is limited down to the shortest step.
#[test]
fn a_step_strains_no_element_by_much() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let control = first(&model);
    for (rate, share) in [(0.0, 1.0), (0.9 * STRAIN_PER_STEP, 1.0), (8.0 * STRAIN_PER_STEP, 0.125)]
    {
        let next = after(&control, &model, 10, [1.0, rate]).unwrap();
        // Rounding of the level's power.
        assert!((share_of(&next, &model) / share - 1.0).abs() < 1e-9, "{rate}");
    }
    let next = after(&control, &model, 10, [1.0, 1e9]).unwrap();
    assert_eq!(next.level, MAX_LEVELS);
    assert!(after(&control, &model, 10, [1.0, f64::INFINITY]).is_some());
    // Bodies that need too short a step are refused.
    assert!(after(&control, &model, 10, [1.001e-3, 0.0]).is_some());
    for critical in [0.9e-3, 0.0, f64::NAN] {
        assert_eq!(after(&control, &model, 10, [critical, 0.0]), None);
    }
}

/// The first steps are short where first touch strains the pole fast: the rate is the speed over the height of the
/// element at the pole, about a quarter, less a little by averaging over the element.
#[test]
fn a_fast_approach_starts_with_short_steps() {
    for (speed, is_short) in [(0.01, false), (0.1, false), (1.0, true), (10.0, true)] {
        let model = at_speed(Some(HyperelasticLaw::NeoHooke), speed);
        let control = first(&model);
        assert_eq!(control.level > 0, is_short, "{speed}");
        let strain = speed / 0.25 * control.time_step(model.time_step());
        assert!(strain < 2.5 * STRAIN_PER_STEP, "{speed}: {strain}");
        assert!(!is_short || strain > STRAIN_PER_STEP, "{speed}: {strain}");
    }
}
