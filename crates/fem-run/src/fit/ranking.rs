//! All laws on the same data, as text and as a table.

use comfy_table::CellAlignment::{Left, Right};
use fem::laws::LawRanking;
use fem_report::law_figures::evidence;

use crate::standard_output::one_line;
use crate::tables::table;

/// What is printed: the best first.
pub fn ranking_text(ranking: &LawRanking) -> String {
    let header = ["law", "free", "rms error", "ΔAICc", "evidence"].map(String::from);
    let rows = ranking.laws.iter().map(|law| {
        let shown = |value: Option<f64>, digits: usize| {
            value.map_or("too few data".to_string(), |value| format!("{value:.digits$}"))
        };
        [
            law.family().name().to_string(),
            law.free.join(", "),
            format!("{:.4}", law.fit.rms),
            shown(law.difference, 1),
            law.weight.map_or(String::new(), evidence),
        ]
    });
    let rows: Vec<_> = std::iter::once(header).chain(rows).collect();
    let mut text = table(&[Left, Left, Right, Right, Right], rows);
    text += match ranking.laws.iter().any(|law| law.weight.is_some()) {
        true => "evidence: the share of each among these laws; none need be right\n",
        false => {
            "the data are too few to tell laws apart, and the first is merely one of the fewest parameters: \
             more speeds, or uncertainties, rank them\n"
        }
    };
    let mut of: Vec<&str> = ranking.twins.iter().map(|(_, of)| *of).collect();
    of.dedup();
    for of in of {
        let twins = ranking.twins.iter().filter(|twin| twin.1 == of).map(|twin| twin.0.as_str());
        let twins: Vec<&str> = twins.collect();
        text += &format!("the same curve as {of}: {}\n", twins.join(", "));
    }
    for (law, why) in &ranking.others {
        text += &format!("not ranked: {law}: {}\n", one_line(why));
    }
    text + "\n"
}

/// `ranking.csv`.
pub fn ranking_csv(ranking: &LawRanking) -> String {
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    let mut text = "law,free,rms_error,aicc_difference,evidence\n".to_string();
    for law in &ranking.laws {
        let (name, free) = (law.family().name(), law.free.join(" "));
        let (difference, weight) = (cell(law.difference), cell(law.weight));
        text += &format!("{name},{free},{},{difference},{weight}\n", law.fit.rms);
    }
    text
}
