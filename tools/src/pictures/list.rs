//! The pictures, each with the commands that make it.

/// A picture of `docs/images`.
pub struct Picture {
    /// Name of its file.
    pub name: &'static str,
    /// Command lines without the program's name. A command that several pictures need runs once.
    pub commands: &'static [&'static str],
    /// The file that becomes the picture.
    pub source: Source,
}

/// What becomes a picture.
pub enum Source {
    /// A figure that the commands have written.
    Figure(&'static str),
    /// The beginning of a page that the commands have written, in a window of this width and height, px.
    Page(&'static str, [u32; 2]),
    /// The beginning of the browser page.
    BrowserPage([u32; 2]),
}

/// Files beside the shipped cases: a case and sweeps.
pub const OWN_CASES: [(&str, &str); 7] = [
    ("ball.toml", include_str!("ball.toml")),
    ("keys.toml", include_str!("keys.toml")),
    ("metal.toml", include_str!("metal.toml")),
    ("metal_laws.toml", include_str!("metal_laws.toml")),
    ("relaxation.toml", include_str!("relaxation.toml")),
    ("sizes.toml", include_str!("sizes.toml")),
    ("steel.toml", include_str!("../../../docs/law/steel.toml")),
];

const fn figure(
    name: &'static str,
    commands: &'static [&'static str],
    path: &'static str,
) -> Picture {
    Picture { name, commands, source: Source::Figure(path) }
}

const fn page(
    name: &'static str,
    commands: &'static [&'static str],
    path: &'static str,
    size: [u32; 2],
) -> Picture {
    Picture { name, commands, source: Source::Page(path, size) }
}

const GLASS: &str = "cases/glass_0.5ms.toml";
const ELASTIC: &str = "cases/glass_0.5ms_elastic.toml";
const BLOCK: &str = "cases/ball_on_block.toml";
const SMALL_STRAIN: &str =
    "cases/soft_sphere.toml --set effects.finite_strain=off --out runs/soft_small_strain";

/// All pictures, in the order of the pages.
pub const PICTURES: [Picture; 35] = [
    page("report.png", &[GLASS], "runs/glass_0.5ms/report.html", [1000, 1010]),
    page(
        "comparison.png",
        &[GLASS, ELASTIC, "report runs/glass_0.5ms runs/glass_0.5ms_elastic --out comparison.html"],
        "comparison.html",
        [1000, 1010],
    ),
    figure("oblique.svg", &["sweep cases/sweep_angle.toml"], "runs/sweep_angle/sweep.svg"),
    figure("sweep.svg", &["sweep cases/sweep_speed.toml"], "runs/sweep_speed/sweep.svg"),
    figure("sweep-keys.svg", &["sweep cases/keys.toml"], "runs/keys/sweep.svg"),
    figure("metal-laws.svg", &["sweep cases/metal_laws.toml"], "runs/metal_laws/sweep.svg"),
    figure("law-glass.svg", &["export cases/glass_0.5ms.toml --law --out law"], "law/export.svg"),
    figure("law-steel.svg", &["export cases/steel.toml --law --out steel"], "steel/export.svg"),
    figure(
        "cradle.svg",
        &[
            "cradle --length 0.2 --diameters 22.2mm,15.9mm --data validation/data/cradle_trials.csv --angle-uncertainty 0.1deg",
        ],
        "runs/cradle_trials_cradle/cradle.svg",
    ),
    figure(
        "measure.svg",
        &["measure validation/data/bounce_times.csv --height 50cm"],
        "runs/bounce_times_measure/measure.svg",
    ),
    figure(
        "dma-temperatures.svg",
        &["relaxation validation/data/dma_polymer.csv"],
        "runs/dma_polymer_relaxation/relaxation.svg",
    ),
    figure(
        "measure-sound.svg",
        &["measure validation/data/bounce_sound.wav"],
        "runs/bounce_sound_measure/measure.svg",
    ),
    figure(
        "measure-track.svg",
        &["measure validation/data/ball_track.csv"],
        "runs/ball_track_measure/measure.svg",
    ),
    figure(
        "measure-force.svg",
        &["measure validation/data/ball_force.csv --mass 10g --height 3cm"],
        "runs/ball_force_measure/measure.svg",
    ),
    figure(
        "dma-sweep.svg",
        &["sweep validation/data/polymer_sweep.toml"],
        "runs/polymer_sweep/sweep.svg",
    ),
    figure(
        "dma.svg",
        &["relaxation validation/data/dma_23_degc.csv"],
        "runs/dma_23_degc_relaxation/relaxation.svg",
    ),
    figure(
        "export.svg",
        &[
            "new mine --material soda-lime-glass",
            "export mine.toml --data validation/data/spreadsheet.csv --columns speed=v,restitution=COR,uncertainty=u",
        ],
        "runs/mine_export/export.svg",
    ),
    figure(
        "fit.svg",
        &[
            "new mine --material soda-lime-glass",
            "fit mine.toml --data validation/data/spreadsheet.csv --columns speed=v,restitution=COR,uncertainty=u \
             --law all",
        ],
        "runs/spreadsheet_fit/fit.svg",
    ),
    figure(
        "calibrate.svg",
        &["calibrate cases/glass_0.5ms.toml --data validation/data/synthetic_pairings.csv"],
        "runs/synthetic_pairings_calibrate/calibrate.svg",
    ),
    Picture { name: "page.png", commands: &[], source: Source::BrowserPage([1280, 900]) },
    // The gallery.
    figure(
        "gallery-1-glass.svg",
        &[GLASS, "plot runs/glass_0.5ms --what contours --out 1.svg"],
        "1.svg",
    ),
    figure(
        "gallery-2-elastic.svg",
        &[
            GLASS,
            ELASTIC,
            "plot runs/glass_0.5ms_elastic runs/glass_0.5ms --what force --out 2.svg",
        ],
        "2.svg",
    ),
    figure(
        "gallery-3-block.svg",
        &[BLOCK, "plot runs/ball_on_block --what energy --out 3.svg"],
        "3.svg",
    ),
    figure(
        "gallery-4-bounces.svg",
        &["cases/three_bounces.toml", "plot runs/three_bounces --what bounces --out 4.svg"],
        "4.svg",
    ),
    figure(
        "gallery-5-steel.svg",
        &["cases/steel_on_rubber.toml", "plot runs/steel_on_rubber --what contours --out 5.svg"],
        "5.svg",
    ),
    figure(
        "gallery-6-rubber.svg",
        &[
            "cases/soft_sphere.toml",
            SMALL_STRAIN,
            "plot runs/soft_sphere runs/soft_small_strain --what force --out 6.svg",
        ],
        "6.svg",
    ),
    figure(
        "gallery-7-dust.svg",
        &["cases/dust_grain.toml", "plot runs/dust_grain --what approach --out 7.svg"],
        "7.svg",
    ),
    figure(
        "gallery-8-polymer.svg",
        &["cases/polymer_ten_terms.toml", "plot runs/polymer_ten_terms --what radius --out 8.svg"],
        "8.svg",
    ),
    figure(
        "gallery-9-ice.svg",
        &[
            "fit cases/ice_2cm.toml --data validation/data/bridges_ice.csv --law bordbar_hyppanen --free a,n \
           --compare kuwabara_kono",
        ],
        "runs/bridges_ice_fit/fit.svg",
    ),
    figure(
        "gallery-10-dent.svg",
        &[
            "cases/steel_on_aluminium.toml",
            "plot runs/steel_on_aluminium --what dent --out dent.svg",
        ],
        "dent.svg",
    ),
    figure(
        "gallery-11-temperature.svg",
        &["sweep cases/sweep_temperature.toml"],
        "runs/sweep_temperature/sweep.svg",
    ),
    figure(
        "gallery-12-acrylic.svg",
        &[
            "new acrylic --material pmma --partner half-space",
            "acrylic.toml --set model=auto --out runs/acrylic",
            "plot runs/acrylic --what force --out 10.svg",
        ],
        "10.svg",
    ),
    // Why balls bounce as they do.
    figure("why-contact-time.svg", &["sweep cases/sizes.toml"], "runs/sizes/sweep.svg"),
    figure("why-relaxation.svg", &["sweep cases/relaxation.toml"], "runs/relaxation/sweep.svg"),
    figure(
        "why-loop.svg",
        &[
            "cases/ball.toml --set material.plastic.relaxation.terms.0.relaxation_time='10s' --out runs/in_10_s",
            "cases/ball.toml --out runs/in_10_us",
            "plot runs/in_10_s runs/in_10_us --what loop --out loop.svg",
        ],
        "loop.svg",
    ),
];
