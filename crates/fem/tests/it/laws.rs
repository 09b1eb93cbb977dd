//! Fits, inversions and exports of contact laws through the library.

use std::path::Path;

use fem::fit::cradle::Measured;
use fem::laws::{
    ChosenLaw, DemExport, EndRule, FitError, ImpactCurve, LawFamily, LawFault, LawFit,
    LawInversion, LawRanking, ParameterError, RankedLaw, StandIn, family_of, needs_more,
};
use fem::measured::Restitutions;
use fem::schema::{ActsOn, BodyTable, MaterialTable, ModelTable, TermTable, TsujiTable};
use fem::{Case, CaseFile};

/// Returns the case of an ice ball on a wall.
fn ball(model: Option<ModelTable>) -> Case {
    let ice = MaterialTable::from_youngs_modulus_poissons_ratio(917.0, "9.3 GPa", 0.33);
    let ball = BodyTable::sphere("ball", "20 mm", "ice").approaching("0.1 m/s");
    let mut file = CaseFile::of_bodies(BodyTable::wall("floor"), ball).with_material("ice", ice);
    file.model = model;
    Case::of(file).unwrap()
}

fn tsuji(restitution: f64) -> ModelTable {
    ModelTable::law(TsujiTable { e: Some(restitution.into()), ..TsujiTable::default() })
}

/// Returns restitutions by Bordbar and Hyppänen's law with n = 0.65.
fn made(dissipation_time: f64, speeds: &[f64]) -> Restitutions {
    let case = ball(None);
    let law = ChosenLaw::of(&case, LawFamily::BordbarHyppanen, &[], None).unwrap();
    let point = |speed: &f64| {
        let made = law.model().outcome(&[dissipation_time, 0.65], *speed).unwrap();
        (*speed, made.restitution)
    };
    Restitutions::of("made", &speeds.iter().map(point).collect::<Vec<_>>())
}

#[test]
fn a_fit_recovers_the_law_of_the_data() {
    let (case, data) = (ball(None), made(1e-6, &[0.02, 0.04, 0.08, 0.1, 0.2, 0.5]));
    let law = ChosenLaw::of(&case, LawFamily::BordbarHyppanen, &[], None).unwrap();
    let problem = law.problem(&data.points, &["a", "n"]).unwrap();
    let exponent = problem.free[1];
    let fit = LawFit::of(&data, problem, 0.95).unwrap().with_profile(&exponent).unwrap();
    let fit = fit.compared_with(LawFamily::KuwabaraKono).unwrap();
    // The accuracy of the fit: finite differences of 1e-4 that are accurate to 1e-5.
    assert!((fit.fit.values[0] / 1e-6 - 1.0).abs() < 1e-3, "{:?}", fit.fit.values);
    assert!((fit.fit.values[1] - 0.65).abs() < 1e-3, "{:?}", fit.fit.values);
    let [(_, compared)] = &fit.compared[..] else { panic!("one is compared") };
    assert!(compared.rms > 100.0 * fit.fit.rms);
    assert!(fit.residuals().all(|row| row[4].unwrap().abs() < 1e-4));
    let numbers = serde_json::to_value(fit.numbers("ball")).unwrap();
    assert_eq!(
        (&numbers["law"], &numbers["end"]),
        (&"bordbar_hyppanen".into(), &"zero_force".into())
    );
    assert_eq!(numbers["profile"]["key"], "n");
    assert_eq!(numbers["parameters"][1]["free"], true);
    let profile = &fit.profile.as_ref().unwrap().points;
    assert_eq!((profile[0].value, profile[profile.len() - 1].value), (0.4, 1.1));
    // A law with another exponent leaves a trend in the residuals.
    let other = ChosenLaw::of(&case, LawFamily::KuwabaraKono, &[], None).unwrap();
    let other = LawFit::of(&data, other.problem(&data.points, &["a"]).unwrap(), 0.95).unwrap();
    assert!(other.warnings().iter().any(|warning| warning.contains("have a trend")));
}

#[test]
fn given_parameters_replace_those_of_the_case_and_start_the_search() {
    let case = ball(Some(tsuji(0.9)));
    assert_eq!(family_of(case.scene()), Some(LawFamily::Tsuji));
    let data = Restitutions::of("e", &[(0.1, 0.8), (0.2, 0.8)]);
    let own = ChosenLaw::of(&case, LawFamily::Tsuji, &[], None).unwrap();
    let problem = own.problem(&data.points, &[]).unwrap();
    // The case's value is known, but does not start the search.
    assert!(problem.values[0] > 0.0 && problem.free[0].start.is_none());
    let given = ChosenLaw::of(&case, LawFamily::Tsuji, &[("alpha", 0.3)], None).unwrap();
    assert_eq!(given.problem(&data.points, &[]).unwrap().free[0].start, Some(0.3));
    let wall_end = Some(EndRule::ZeroOverlap);
    let end = ChosenLaw::of(&case, LawFamily::Tsuji, &[], wall_end).unwrap();
    assert_eq!(end.model().end_rule(), EndRule::ZeroOverlap);
}

#[test]
fn impossible_requests_are_rejected() {
    let case = ball(None);
    let of = |family, given: &[(&str, f64)], end| ChosenLaw::of(&case, family, given, end);
    let unknown = of(LawFamily::Tsuji, &[("n", 0.5)], None).unwrap_err();
    assert!(matches!(unknown, LawFault::Parameter(ParameterError::Unknown { .. })));
    let nan = of(LawFamily::Tsuji, &[("alpha", f64::NAN)], None).unwrap_err();
    assert!(matches!(nan, LawFault::Parameter(ParameterError::OutOfRange { .. })));
    let end = of(LawFamily::ZhangWhiten, &[], Some(EndRule::ZeroOverlap)).unwrap_err();
    assert_eq!(end, LawFault::Fit(FitError::OwnEnd { law: "zhang_whiten" }));
    assert_eq!(of(LawFamily::Ting, &[], None).unwrap_err(), LawFault::Fit(FitError::NoRelaxation));

    let data = Restitutions::of("e", &[(0.1, 0.8)]);
    let hunt = of(LawFamily::HuntCrossley, &[], None).unwrap();
    let missing = hunt.problem(&data.points, &["v"]).unwrap_err();
    let expected = LawFault::Missing { law: "hunt_crossley", key: "e", free: vec!["v"] };
    let words = "hunt_crossley needs a value of e";
    assert_eq!((missing.to_string().as_str(), missing), (words, expected));
    let lossless = of(LawFamily::Hertz, &[], None).unwrap();
    let fault = LawInversion::of(&lossless, None, 0.1, 0.9).unwrap_err();
    assert_eq!(fault, LawFault::Parameter(ParameterError::Lossless { law: "hertz" }));
}

#[test]
fn every_law_with_one_free_parameter_is_inverted() {
    let case = ball(None);
    for family in LawFamily::ALL.into_iter().filter(|family| *family != LawFamily::Ting) {
        if needs_more(family) {
            continue;
        }
        let law = ChosenLaw::of(&case, family, &[], None).unwrap();
        let found = LawInversion::of(&law, None, 0.1, 0.92).unwrap();
        assert!(!found.solutions().is_empty());
        for (value, contact_time) in found.solutions() {
            assert!(value > 0.0 && contact_time.unwrap() > 0.0, "{}", family.name());
        }
    }
    assert!(needs_more(LawFamily::Linear) && needs_more(LawFamily::Hertz));
}

/// Elements have e = 0.691 ± 0.010 for steel on aluminium of 276 MPa at 1 m/s, so each law that dents has to find that strength within
/// its error, which is none of the measurement, and so has a fit to what that law makes of it.
#[test]
fn a_strength_has_the_error_of_its_law() {
    const STRENGTH: f64 = 276e6;
    let case = Case::parse(
        "case.toml",
        include_str!("../../../../cases/steel_on_aluminium.toml"),
        Path::new(""),
        &[],
    )
    .unwrap();
    let exact = Measured { value: 0.691, uncertainty: 0.0 };
    let laws = [LawFamily::MeanPressure, LawFamily::JacksonGreen, LawFamily::Brake, LawFamily::Mdr];
    for family in laws {
        let law = ChosenLaw::of(&case, family, &[], None).unwrap();
        let found = LawInversion::of(&law, Some("yield_strength"), 1.0, exact.value).unwrap();
        let found = found.with_inputs(&case, &law, exact, None);
        let ([(strength, _)], Some(error)) = (&found.solutions()[..], found.standard_error(0))
        else {
            panic!("{family:?}")
        };
        assert!((strength - STRENGTH).abs() < 2.0 * error, "{family:?}: {strength:e} ± {error:e}");
        assert!(error < *strength, "{family:?}: {strength:e} ± {error:e}");
        let data = Restitutions::of("one", &[(1.0, 0.691), (1.0, 0.691)]);
        let problem = law.problem(&data.points, &["yield_strength"]).unwrap();
        let fit = LawFit::of(&data, problem, 0.95).unwrap().with_inputs(&case, &law);
        let fitted = fit.fit.estimates[0].standard_error.unwrap();
        assert!((strength - STRENGTH).abs() < 2.0 * fitted, "{family:?}: {fitted:e}");
        assert!((0.5..1.5).contains(&(fitted / error)), "{family:?}: {fitted:e} beside {error:e}");
        // Bodies that hardly flow may be of any larger strength.
        let found = LawInversion::of(&law, Some("yield_strength"), 1.0, 0.9965);
        let least = found
            .ok()
            .map(|it| it.with_inputs(&case, &law, Measured { value: 0.9965, ..exact }, None));
        assert!(
            least.is_none_or(|it| it.at_least(0).is_some_and(|least| least < 2e9)),
            "{family:?}"
        );
    }
    // A law whose parameter has no meaning apart from it has no error of its own.
    let law = ChosenLaw::of(&case, LawFamily::KuwabaraKono, &[], None).unwrap();
    let found = LawInversion::of(&law, None, 1.0, exact.value).unwrap();
    assert_eq!(found.with_inputs(&case, &law, exact, None).standard_error(0), None);
}

#[test]
fn an_export_has_its_range_of_validity() {
    let case = ball(Some(tsuji(0.9)));
    let curve = ImpactCurve::computed(&case, Some((0.05, 0.5)), false).unwrap();
    assert!(!curve.has_hertz_times && curve.points.len() == 13);
    let export = DemExport::of(&case, curve, 0.01).unwrap();
    let [constant, _, viscoelastic, _] = &export.laws[..] else { panic!("{:?}", export.laws) };
    // The law has this restitution at each speed within its tolerance.
    assert!((export.export.restitution - 0.9).abs() < 1e-7);
    assert_eq!(constant.validity[..2], [0.05, 0.5]);
    assert!(viscoelastic.validity[2] > 0.01);
    let numbers = export.numbers("ball", &export.export.snippets().unwrap());
    let numbers = serde_json::to_value(numbers).unwrap();
    assert_eq!(numbers["wall"], true);
    assert!(numbers["snippets"][0]["entries"].as_object().is_some_and(|all| !all.is_empty()));

    // Hertz' contact times replace missing ones; a single speed is not sufficient.
    let measured =
        |points: &[(f64, f64)]| ImpactCurve::measured(case.scene(), &Restitutions::of("e", points));
    assert!(measured(&[(0.2, 0.9), (0.1, 0.9)]).unwrap().has_hertz_times);
    let one = measured(&[(0.2, 0.9)]).unwrap_err();
    assert_eq!(one.to_string(), "e: one speed only");
}

#[test]
fn ting_replaces_elements_if_a_body_relaxes() {
    // A bound that is accepted is that of elastic bodies.
    let elastic = ImpactCurve::computed(&ball(None), None, true).unwrap();
    assert!(elastic.points.iter().all(|point| point.restitution == 1.0));
    assert_eq!(elastic.bounds.len(), 1, "{:?}", elastic.bounds);
    let lossless = DemExport::of(&ball(None), elastic, 0.01).unwrap();
    assert_eq!(lossless.export.restitution, 1.0);
    let bound = ImpactCurve::computed(&ball(None), None, false).unwrap_err();
    assert!(matches!(bound, LawFault::Bound(_)), "{bound}");
    let case = ball(None).edited(|file| {
        let ice = file.material.remove("ice").unwrap();
        let ice = ice.relaxing(ActsOn::All, [TermTable::with_relaxation_time(0.5, "1 ms")]);
        file.material.insert("ice".to_string(), ice);
    });
    let curve = ImpactCurve::computed(&case.unwrap(), None, false).unwrap();
    let (low, high) = curve.speeds();
    // A decade around the case's speed; powers round.
    assert!((high / low - 10.0).abs() < 1e-9 && (low * high - 0.01).abs() < 1e-12);
    assert!(curve.points.iter().all(|point| point.restitution < 1.0));
}

/// If the data cannot distinguish laws, a law with the fewest parameters comes first.
#[test]
fn few_data_prefer_the_fewest_parameters() {
    for points in [[(0.05, 0.93), (0.2, 0.9)].as_slice(), &[(0.05, 0.93), (0.1, 0.915), (0.2, 0.9)]]
    {
        let ranking = LawRanking::of(
            &ball(None),
            &Restitutions::of("few", points),
            &LawFamily::ALL,
            None,
            false,
        )
        .unwrap();
        let fewest = ranking.laws.iter().map(|law| law.free.len()).min().unwrap();
        let most = ranking.laws.iter().map(|law| law.free.len()).max().unwrap();
        assert!(
            fewest < most && ranking.laws.iter().all(|law| law.weight.is_none()),
            "{ranking:?}"
        );
        assert_eq!(ranking.laws[0].free.len(), fewest, "{ranking:?}");
        let best = |law: &&RankedLaw| law.free.len() == fewest;
        let least = ranking.laws.iter().filter(best).map(|law| law.fit.rms).reduce(f64::min);
        assert_eq!(Some(ranking.laws[0].fit.rms), least, "{ranking:?}");
    }
}

/// For data of one law with a scatter of 0.003 that law comes first, a law with one more parameter is penalised, and a law
/// that does not fit has no weight.
#[test]
fn laws_are_ranked_by_their_evidence() {
    let case = ball(None);
    let speeds: Vec<f64> = (0..8).map(|k| 0.02 * 1.8_f64.powi(k)).collect();
    let law = ChosenLaw::of(&case, LawFamily::KuwabaraKono, &[], None).unwrap();
    let scatter = [1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0];
    let point = |(speed, sign): (&f64, f64)| {
        (*speed, law.model().outcome(&[1e-6], *speed).unwrap().restitution + 0.003 * sign)
    };
    let mut data =
        Restitutions::of("made", &speeds.iter().zip(scatter).map(point).collect::<Vec<_>>());
    let own = LawFit::of(&data, law.problem(&data.points, &["a"]).unwrap(), 0.95).unwrap();
    assert_eq!(own.warnings(), [""; 0], "scatter is no trend");
    for is_weighted in [false, true] {
        if is_weighted {
            data.set_uncertainty(0.003).unwrap();
        }
        let ranking = LawRanking::of(&case, &data, &LawFamily::ALL, None, false).unwrap();
        let place = |family: LawFamily, n_free: usize| {
            let is_it = |law: &&RankedLaw| (law.family(), law.free.len()) == (family, n_free);
            ranking.laws.iter().find(is_it).unwrap()
        };
        assert_eq!(ranking.laws[0].family(), LawFamily::KuwabaraKono, "{ranking:?}");
        let (own, more) = (place(LawFamily::KuwabaraKono, 1), place(LawFamily::BordbarHyppanen, 2));
        assert!(more.fit.rms <= own.fit.rms && own.difference == Some(0.0), "{ranking:?}");
        // By hand: what a parameter more costs of 8 data, less what it gains in the misfit.
        let (n, ratio) = (8.0, (more.fit.rms / own.fit.rms).powi(2));
        let misfit = match is_weighted {
            true => n * (more.fit.rms.powi(2) - own.fit.rms.powi(2)),
            false => n * ratio.ln(),
        };
        let price = |q: f64| 2.0 * q + 2.0 * q * (q + 1.0) / (n - q - 1.0);
        let q = if is_weighted { 1.0 } else { 2.0 };
        let expected = misfit + price(q + 1.0) - price(q);
        assert!((more.difference.unwrap() - expected).abs() < 1e-9, "{ranking:?}");
        assert!(place(LawFamily::Linear, 1).weight.unwrap() < 1e-3, "{ranking:?}");
        let sum: f64 = ranking.laws.iter().filter_map(|law| law.weight).sum();
        assert!((sum - 1.0).abs() < 1e-12);
        // One curve has one place, and a law that has one is in no other list.
        let twin_of =
            |name: &str| ranking.twins.iter().find(|twin| twin.0 == name).map(|(_, of)| *of);
        assert_eq!(twin_of("schwager_poeschel"), Some("kuwabara_kono"), "{ranking:?}");
        assert_eq!(twin_of("bordbar_hyppanen with n = 0.5"), Some("kuwabara_kono"), "{ranking:?}");
        assert_eq!(twin_of("tsuji"), Some("linear"), "{ranking:?}");
        // A ball that does not relax has no decay rate; all others are fitted by their own loss.
        let others: Vec<_> = ranking.others.iter().map(|(name, _)| *name).collect();
        assert_eq!(others, ["ting"], "{ranking:?}");
    }
}

/// Restitutions determine the loss alone. Other parameters of a law have stand-ins that do not change the restitution.
#[test]
fn a_law_is_fitted_by_its_loss_alone() {
    let case = ball(None);
    let points: Vec<(f64, f64)> = vec![(0.02, 0.9), (0.1, 0.85), (0.5, 0.8)];
    let data = Restitutions::of("made", &points);
    let fit = |given: &[(&str, f64)]| {
        let law = ChosenLaw::of(&case, LawFamily::Linear, given, None).unwrap();
        let fit = LawFit::of(&data, law.problem(&data.points, &[]).unwrap(), 0.95).unwrap().fit;
        (fit.values, fit.rms, fit.estimates.len())
    };
    let (values, rms, n) = fit(&[]);
    let law = ChosenLaw::of(&case, LawFamily::Linear, &[], None).unwrap();
    assert_eq!((law.stand_in(0), n), (Some(StandIn::HertzTime), 1));
    // Hertz' contact time at 0.1 m/s, T = π√(m*/k) of the spring.
    let time = fem_laws::HertzImpact::new(law.model().pair(), 0.1).unwrap().contact_time();
    let own = std::f64::consts::PI * (law.model().pair().effective_mass() / values[0]).sqrt();
    assert!((own / time - 1.0).abs() < 1e-12, "{own} {time}");
    // Another stiffness changes the damping but not the misfit.
    let (other, other_rms, _) = fit(&[("k", 7.0 * values[0])]);
    assert!((other[1] / values[1] - 7.0_f64.sqrt()).abs() < 1e-5 && (rms - other_rms).abs() < 1e-8);
    let refused = law.problem(&data.points, &["c", "k"]).unwrap_err();
    assert!(matches!(refused, LawFault::NeedsTimes { key: "k", .. }), "{refused}");
    let hunt = ChosenLaw::of(&case, LawFamily::HuntCrossley, &[], None).unwrap();
    let problem = hunt.problem(&data.points, &[]).unwrap();
    assert!((problem.values[1] - 0.1).abs() < 1e-12, "{:?}", problem.values);
}
