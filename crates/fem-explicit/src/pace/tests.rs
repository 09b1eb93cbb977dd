use fem_collision::{Approach, BodyInput};
use fem_material::finite::HyperelasticLaw;
use fem_mesh::Side;

use super::*;
use crate::model::Parts;
use crate::test_support::{settings, unit_glass, unit_sphere};

fn model(law: Option<HyperelasticLaw>) -> Model {
    at_speed(law, 0.01)
}

/// At a speed of approach, where pressure waves have 1.1.
fn at_speed(law: Option<HyperelasticLaw>, speed: f64) -> Model {
    let sphere = BodyInput::Sphere { mesh: unit_sphere(4.0, Side::Above), material: unit_glass() };
    let parts = Parts { finite_strain: [None, law], ..Parts::default() };
    let approach = Approach::new([speed, 0.0], 1e3 * speed).unwrap();
    Model::with_parts([BodyInput::Wall, sphere], approach, &settings(), parts).unwrap()
}

/// The step over the model's, where the critical step is such a share of the model's.
fn share_of(pace: &Pace, model: &Model) -> f64 {
    pace.time_step(model) / model.time_step()
}

fn after(pace: &Pace, model: &Model, step: u64, critical: f64) -> Option<Pace> {
    strained(pace, model, step, critical, 0.0)
}

/// At a rate of so much strain a step of the model.
fn strained(pace: &Pace, model: &Model, step: u64, critical: f64, rate: f64) -> Option<Pace> {
    let outlook = Outlook {
        critical_time_step: critical * model.time_step() / model.step_factor(),
        strain_rate: rate / model.time_step(),
        urgency: rate / STRAIN_BETWEEN_BOUNDS / model.time_step(),
    };
    pace.after(model, (step, pace.time_after(step, model)), outlook)
}

#[test]
fn small_strain_has_no_pace() {
    assert_eq!(Pace::of(&model(None)), None);
}

#[test]
fn shares_are_powers_of_the_sixteenth_root_of_two() {
    for level in 0..=MOST_LEVELS {
        let exact = 0.5f64.powf(f64::from(level) / 16.0);
        // Rounding of the power, which grows with it.
        assert!((share(level) / exact - 1.0).abs() < 1e-13, "{level}");
    }
}

/// Never above what is allowed, and never more than a level and its room below.
#[test]
fn the_step_follows_the_critical_one_down_at_once_and_up_where_there_is_room() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let mut pace = Pace::of(&model).unwrap();
    assert_eq!(share_of(&pace, &model), 1.0);
    let quarters = [1.0, 0.99, 0.7, 0.5001, 0.5, 0.1, 0.3, 0.31, 0.35, 0.6, 1.0, 1.1, 2.0];
    for (k, critical) in quarters.into_iter().enumerate() {
        pace = after(&pace, &model, 100 * (k as u64 + 1), critical).unwrap();
        let share = share_of(&pace, &model);
        let least = (critical / ROOM_ABOVE * 0.5f64.powf(1.0 / 16.0)).min(1.0 / ROOM_ABOVE);
        assert!(share <= critical * ROUNDING && share > least * 0.999, "{critical}: {share}");
    }
    // A little more than a level is no room: the step would go up and down.
    let at_half = after(&pace, &model, 2000, 0.5).unwrap();
    let stays = after(&at_half, &model, 2100, 0.5 * 1.05).unwrap();
    assert_eq!(share_of(&stays, &model), share_of(&at_half, &model));
    let grows = after(&at_half, &model, 2100, 0.5 * 1.06).unwrap();
    assert!(share_of(&grows, &model) > share_of(&at_half, &model));
}

/// Time goes on from where the step changed, and is that of the step number as long as it does not.
#[test]
fn time_goes_on_where_the_step_changes() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let first = Pace::of(&model).unwrap();
    let touch = model.approach().first_touch();
    assert_eq!(first.time_after(7, &model), model.time_after(7));
    let second = after(&first, &model, 10, 0.5).unwrap();
    assert_eq!(second.time_after(10, &model), first.time_after(10, &model));
    let later = second.time_after(14, &model) - touch;
    // Rounding.
    assert!((later / (12.0 * model.time_step()) - 1.0).abs() < 1e-12);
}

/// It looks again the sooner the faster the critical step changes.
#[test]
fn fast_changes_are_looked_at_sooner() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let first = Pace::of(&model).unwrap();
    let pause = |critical: f64, rate: f64| {
        let next = strained(&first, &model, 10, critical, rate).unwrap();
        assert!(!next.is_due(next.next - 1) && next.is_due(next.next));
        next.next - 10
    };
    assert_eq!(pause(1.0, 0.0), LONGEST_PAUSE as u64);
    // A change by 1 % in ten steps: one by 2 % in twenty.
    assert!((19..=20).contains(&pause(0.99, 0.0)));
    assert_eq!(pause(0.5, 0.0), 1);
    // 5 % of strain, at half a per cent a step.
    assert!((9..=10).contains(&pause(1.0, 0.005)));
    assert_eq!(pause(1.0, 1.0), 1);
}

/// No element is strained by more than so much in a step, however fast: then the shortest is what is left.
#[test]
fn a_step_strains_no_element_by_much() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let pace = Pace::of(&model).unwrap();
    for (rate, share) in [(0.0, 1.0), (0.9 * STRAIN_A_STEP, 1.0), (8.0 * STRAIN_A_STEP, 0.125)] {
        let next = strained(&pace, &model, 10, 1.0, rate).unwrap();
        // Rounding of the level's power.
        assert!((share_of(&next, &model) / share - 1.0).abs() < 1e-9, "{rate}");
    }
    let next = strained(&pace, &model, 10, 1.0, 1e9).unwrap();
    assert_eq!(next.level, MOST_LEVELS);
    assert!(strained(&pace, &model, 10, 1.0, f64::INFINITY).is_some());
}

/// The first steps are short where first touch strains the pole fast: by its speed over its element's height,
/// which is about a quarter, and less on the axis, of which there is little in the mean over the element.
#[test]
fn a_fast_approach_starts_with_short_steps() {
    for (speed, is_short) in [(0.01, false), (0.1, false), (1.0, true), (10.0, true)] {
        let model = at_speed(Some(HyperelasticLaw::NeoHooke), speed);
        let pace = Pace::of(&model).unwrap();
        assert_eq!(pace.level > 0, is_short, "{speed}");
        let strain = speed / 0.25 * pace.time_step(&model);
        assert!(strain < 2.5 * STRAIN_A_STEP, "{speed}: {strain}");
        assert!(!is_short || strain > STRAIN_A_STEP, "{speed}: {strain}");
    }
}

#[test]
fn bodies_that_no_step_can_follow_have_none() {
    let model = model(Some(HyperelasticLaw::NeoHooke));
    let pace = Pace::of(&model).unwrap();
    assert!(after(&pace, &model, 10, 1.001e-3).is_some());
    for critical in [0.9e-3, 0.0, f64::NAN] {
        assert_eq!(after(&pace, &model, 10, critical), None);
    }
}
