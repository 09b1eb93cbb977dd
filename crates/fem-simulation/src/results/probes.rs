//! `probes.csv`.

use std::io::Write;

use fem_collision::{ProbeRequest, Snapshot};

/// The name of the file.
pub const PROBES_FILE: &str = "probes.csv";

/// What is told of a place, with its unit: displacement since the start of the case, velocity, Cauchy
/// stress, tension positive.
const QUANTITIES: [&str; 8] = [
    "u_r_m",
    "u_y_m",
    "v_r_m_s",
    "v_y_m_s",
    "sigma_rr_pa",
    "sigma_yy_pa",
    "sigma_tt_pa",
    "sigma_ry_pa",
];

/// Writes what probes saw, a row an instant, eight columns a probe. Numbers are the shortest that read
/// back as the same.
///
/// # Errors
/// `to` cannot be written to.
pub fn probes_csv(to: impl Write, probes: &[ProbeRequest], seen: &[Snapshot]) -> csv::Result<()> {
    let mut file = csv::Writer::from_writer(to);
    let columns =
        (0..probes.len()).flat_map(|k| QUANTITIES.map(|quantity| format!("probe_{k}_{quantity}")));
    file.write_record(["time_s".to_string()].into_iter().chain(columns))?;
    for one in seen {
        let displacements = [0, 1].map(|side| one.displacement(side));
        let of_probe = |(k, probe): (usize, &ProbeRequest)| {
            let fields = &one.bodies[probe.side];
            let ([u_r, u_y], [v_r, v_y]) = (displacements[probe.side][k], fields.velocity[k]);
            let [rr, yy, tt, ry] = fields.stress[k];
            [u_r, u_y, v_r, v_y, rr, yy, tt, ry]
        };
        let numbers: Vec<f64> = probes.iter().enumerate().flat_map(of_probe).collect();
        file.serialize((one.time, numbers))?;
    }
    Ok(file.flush()?)
}
