//! Calibration through the library, with a case and data built in code.

use fem::calibrate::{
    Abscissa, Calibration, CalibrationFault, CalibrationModel, SettingNames, Settings,
};
use fem::laws::FitError;
use fem::measured::{MeasuredPairs, Restitutions};
use fem::schema::{ActsOn, BodyTable, MaterialTable, MeshTable, ModelTable, TermTable, TingTable};
use fem::{Case, CaseFile, collide};

/// Returns the paper's glass spheres without relaxation.
fn pair() -> Case {
    let glass = MaterialTable::from_youngs_modulus_poissons_ratio(2390.0, "63 GPa", 0.244);
    let striker = BodyTable::sphere("striker", "22.2 mm", "glass").approaching("0.5 m/s");
    let file = CaseFile::of_bodies(striker, BodyTable::sphere("target", "15.9 mm", "glass"));
    Case::of(file.with_material("glass", glass)).unwrap()
}

fn ting(n_terms: usize) -> Settings {
    Settings { model: Some(CalibrationModel::Ting), n_terms, ..Settings::default() }
}

/// Returns Ting's restitutions of a series at speeds, m/s, and diameters of the striker, m.
fn restitutions(series: &[TermTable], collisions: &[(f64, f64)]) -> Restitutions {
    let points = collisions.iter().map(|&(speed, diameter)| {
        let case = pair().edited(|file| {
            file.body[0].approach_speed = Some(speed.into());
            file.body[0].sphere.as_mut().unwrap().diameter = diameter.into();
            let glass = file.material.remove("glass").unwrap();
            let glass = glass.relaxing(ActsOn::All, series.to_vec());
            file.material.insert("glass".to_string(), glass);
            let ting = TingTable { finite_size: Some(true), tolerance: Some(1e-7.into()) };
            file.model = Some(ting.into());
        });
        let collision = collide(&case.unwrap()).unwrap();
        (speed, collision.restitution.unwrap())
    });
    Restitutions::of("made", &points.collect::<Vec<_>>())
}

#[test]
fn a_calibrated_series_reproduces_the_data() {
    let series = [
        TermTable::with_relaxation_time(0.03, "20 us"),
        TermTable::with_relaxation_time(0.25, "300 us"),
    ];
    let collisions = [0.05, 0.1, 0.3, 1.0].map(|speed| (speed, 22.2e-3));
    let settings = Settings { regularisation: Some(1e-4), ..ting(4) };
    let measured = restitutions(&series, &collisions);
    let found = Calibration::of(&pair(), measured.into(), &settings).unwrap();
    for row in found.residuals() {
        let [_, _, _, _, _, _, residual, _] = row;
        // Ten times the accuracy of the model, for other relaxation times than the series'.
        assert!(residual.unwrap().abs() < 1e-4, "{row:?}");
    }
    let [total, ..] = &found.fit.moments;
    assert!(total.low < 0.28 && 0.28 < total.high, "{total:?}");

    // The found series is valid in the case.
    let relaxing = pair().edited(|file| {
        let glass = file.material.get_mut("glass").unwrap();
        glass.relaxation = found.relaxation();
    });
    let sum: f64 = found.terms().iter().map(|term| term.weight).sum();
    let materials =
        relaxing.unwrap().scene().bodies().each_ref().map(|body| body.material().cloned().unwrap());
    for material in materials {
        let left = material.relaxation().unwrap().equilibrium_weight();
        assert!((left - (1.0 - sum)).abs() < 1e-12);
    }
}

#[test]
fn pairs_of_bodies_share_a_series() {
    let series = [TermTable::with_relaxation_time(0.3, "300 us")];
    let sizes = [10e-3, 22.2e-3];
    let collisions = [(0.2, sizes[0]), (0.2, sizes[1]), (1.0, sizes[0]), (1.0, sizes[1])];
    let data = restitutions(&series, &collisions);
    let measured = MeasuredPairs::sorted(data, |point| [Some(collisions[point].1), None]);
    let settings = Settings { times: Some((300e-6, 300e-6)), ..ting(1) };
    let found = Calibration::of(&pair(), measured, &settings).unwrap();
    assert_eq!(found.experiments.len(), 2);
    let weight = &found.fit.weight_ranges[0];
    assert!(weight.low < 0.3 && 0.3 < weight.high, "{weight:?}");
    let diameters: Vec<_> = found.residuals().map(|row| row[0].unwrap()).collect();
    assert_eq!(diameters, [sizes[0], sizes[1], sizes[0], sizes[1]]);

    // Curves of several pairs are over the contact time.
    let curves = found.curves().unwrap();
    assert_eq!((curves.over, curves.best.len()), (Abscissa::ContactTime, 4));
    assert!(curves.best.is_sorted_by(|a, b| a.0 <= b.0));
    // Contact times grow with the sphere and fall with the speed.
    assert!(curves.data[0].0 < curves.data[1].0 && curves.data[2].0 < curves.data[0].0);
    let numbers = serde_json::to_value(found.numbers("pair", Vec::new())).unwrap();
    assert_eq!(numbers["pairs"][0]["diameters_m"][0], sizes[0]);
    assert_eq!((&numbers["model"], &numbers["acts_on"]), (&"ting".into(), &"all".into()));
}

#[test]
fn elements_are_made_for_the_speeds() {
    let measured = Restitutions::of("glass", &[(0.5, 0.925)]);
    let settings = Settings { n_terms: 2, ..Settings::default() };
    let found = Calibration::of(&pair(), measured.into(), &settings).unwrap();
    let (smallest, largest) = found.experiments[0].elements_across.unwrap();
    // One speed: eight across the only contact.
    assert!((smallest - 8.0).abs() < 1e-9 && smallest == largest);
    assert!(found.fit.rms < 1e-4, "{}", found.fit.rms);
    let curves = found.curves().unwrap();
    assert_eq!((curves.over, curves.range), (Abscissa::Speed, (0.25, 1.0)));
    let toml = found.relaxation_toml();
    assert!(toml.contains("[material.glass.relaxation]\nacts_on = \"all\"\n"), "{toml}");

    let coarse = pair().edited(|file| {
        let size = Some("100 um".into());
        file.mesh = Some(MeshTable { contact_element_size: size, ..MeshTable::default() });
    });
    let measured = Restitutions::of("glass", &[(0.5, 0.925)]);
    let found = Calibration::of(&coarse.unwrap(), measured.into(), &settings).unwrap();
    let warnings = found.warnings(&SettingNames::default());
    let few = "elements across the smallest contact radius are too few";
    assert!(warnings.iter().any(|warning| warning.contains(few)), "{warnings:?}");
}

#[test]
fn advice_names_the_settings_as_the_caller_does() {
    let case = pair().edited(|file| file.model = Some(ModelTable::hertz())).unwrap();
    // 1 − e ∝ v^0.6, steeper than any series.
    let law = |speed: f64| (speed, 1.0 - 0.075 * (speed / 0.5f64).powf(0.6));
    let measured = Restitutions::of("law", &[0.1, 0.2, 0.5, 1.0, 2.0].map(law));
    let found = Calibration::of(&case, measured.into(), &ting(3)).unwrap();
    let exponent = found.loss_exponent().unwrap().value;
    assert!((exponent - 0.6).abs() < 1e-9, "{exponent}");
    let options = SettingNames { terms: "--terms", model: "--model", ..SettingNames::default() };
    for (names, terms, model) in
        [(SettingNames::default(), "n_terms", "model"), (options, "--terms", "--model")]
    {
        let warnings = found.warnings(&names);
        assert!(warnings[0].starts_with("restitution falls with speed"), "{warnings:?}");
        let more = format!("try more {terms} or other times");
        assert!(warnings.iter().any(|warning| warning.ends_with(&more)), "{warnings:?}");
        let unused = format!("model.hertz is ignored: {model} chooses the model, here ting");
        assert_eq!(warnings.last(), Some(&unused));
    }
}

#[test]
fn impossible_calibrations_are_rejected() {
    let refused = |points: &[(f64, f64)], settings: &Settings| {
        let measured = Restitutions::of("e", points);
        Calibration::of(&pair(), measured.into(), settings).unwrap_err()
    };
    let is_of_data = |fault: &CalibrationFault, text: &str| {
        assert!(matches!(fault, CalibrationFault::Data(_)), "{fault:?}");
        assert!(fault.to_string().contains(text), "{fault}");
    };
    is_of_data(&refused(&[], &ting(1)), "e: there is no restitution");
    is_of_data(&refused(&[(0.5, 0.9), (300.0, 0.9)], &ting(1)), "e: point 1: ");
    let unbound = Settings { regularisation: Some(0.0), ..ting(2) };
    let fault = refused(&[(0.5, 0.9)], &unbound);
    assert!(matches!(fault, CalibrationFault::Fit(FitError::TooFewData { .. })), "{fault:?}");
    for settings in [
        ting(0),
        Settings { times: Some((2.0, 1.0)), ..ting(1) },
        Settings { times: Some((0.0, 1.0)), ..ting(1) },
        Settings { regularisation: Some(-1.0), ..ting(1) },
        Settings { confidence: 95.0, ..ting(1) },
    ] {
        let fault = refused(&[(0.5, 0.9)], &settings);
        assert!(matches!(fault, CalibrationFault::Fit(FitError::OutOfRange { .. })), "{fault:?}");
    }
    let speedless = refused(&[(0.0, 0.9)], &ting(1));
    assert!(matches!(speedless, CalibrationFault::Fit(FitError::Law(_))), "{speedless:?}");
    let fault = refused(&[(1e-6, 0.9), (1e3, 0.9)], &Settings::default());
    assert!(matches!(fault, CalibrationFault::NoMesh { speeds: (1e-6, 1e3), .. }), "{fault:?}");
}
