#!/usr/bin/env python3
"""Breaks the program on purpose, one fault at a time, and reports which faults the tests catch.

    faults.py [NAME ...]     tries all faults, or those whose name or crate is given
    faults.py --list         lists the faults and checks that each still has its place in the source

Each fault replaces a piece of source text in a copy of the repository and runs the fast tests of one crate, which
must fail. A place is found by its text, whatever the file and the layout, so it survives moves. The exit status is 1
if a fault is missed, no longer compiles, or has lost its place: then the table below needs a new text.

The copies share the target directory CARGO_TARGET_DIR, or target/faults.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Name, crate whose tests run (with a filter of test names after a colon), source text, faulty text.
FAULTS = [
    # Materials
    ("shear_modulus_factor", "fem-material", "e / (2.0 * (1.0 + nu)))", "e / (2.0 * (1.0 - nu)))"),
    ("hooke_deviator", "fem-material", "rr * rr + yy * yy + tt * tt + 0.5 * strain[3] * strain[3]",
     "rr * rr + yy * yy + tt * tt + strain[3] * strain[3]"),
    ("relaxation_gain", "fem-material", "-(-ratio).exp_m1() / ratio", "(-ratio).exp()"),
    ("relaxation_weight_swapped", "fem-material", "weight: series / (series + kelvin),",
     "weight: kelvin / (series + kelvin),"),
    ("complex_modulus_parts", "fem-material", "[x * x / (1.0 + x * x), x / (1.0 + x * x)]",
     "[x / (1.0 + x * x), x * x / (1.0 + x * x)]"),
    ("wlf_sign", "fem-material", "-c1 * rise / (c2 + rise)", "c1 * rise / (c2 + rise)"),
    ("temperature_slows", "fem-case", "term.relaxation_time * factor", "term.relaxation_time / factor"),
    ("angular_frequency", "fem-data", "value } else { TAU * value }", "TAU * value } else { value }"),
    ("shear_of_young", "fem-data", "let factor = 3.0 * bulk / norm / norm;", "let factor = 3.0 * bulk / norm;"),
    ("hencky_volumetric", "fem-material", "N::splat(self.bulk - 2.0 / 3.0 * self.shear) * (rr + yy + tt)",
     "N::splat(self.bulk + 2.0 / 3.0 * self.shear) * (rr + yy + tt)"),
    ("ellipticity_sign", "fem-material", "0.5 * (rr + yy) - (half * half + ry * ry).sqrt()",
     "0.5 * (rr + yy) + (half * half + ry * ry).sqrt()"),
    # Elements and meshes
    ("hoop_strain", "fem-element", "strain[2] += self.hoop[a] * u[a][0];", "strain[2] += self.hoop[a] * u[a][1];"),
    ("hourglass_factor", "fem-element", "[4.0 / 3.0 * rr + yy, 4.0 / 3.0 * yy + rr, ry / 3.0]",
     "[4.0 / 3.0 * rr + yy, 4.0 / 3.0 * yy + rr, ry / 2.0]"),
    ("eigenvalue_axis", "fem-element", "let fixed = i % 2 == 0 && on_axis[corner];",
     "let fixed = i % 2 == 1 && on_axis[corner];"),
    ("cap_volume", "fem-mesh", "4.0 / 3.0 * PI * (radius * sin_half_angle).powi(3) * radial",
     "2.0 / 3.0 * PI * (radius * sin_half_angle).powi(3) * radial"),
    ("segment_share", "fem-mesh", "share * (2.0 * start[0] + end[0])", "share * (start[0] + end[0])"),
    ("mesh_quality_corner", "fem-mesh", "let (p, q) = (edges[(a + 3) % 4], edges[a]);",
     "let (p, q) = (edges[(a + 1) % 4], edges[a]);"),
    # Closed forms and contact laws
    ("hertz_stiffness", "fem-laws", "let stiffness = 4.0 / 3.0 * pair.contact_modulus()",
     "let stiffness = 3.0 / 4.0 * pair.contact_modulus()"),
    ("hertz_contact_time", "fem-laws", "2.0 * PI.sqrt() * gamma(1.4) / gamma(0.9)",
     "2.0 * PI.sqrt() * gamma(0.9) / gamma(1.4)"),
    ("hertz_axis_stress", "fem-laws", "(1.0 + poissons_ratio) * spread - 0.5 * axial",
     "(1.0 + poissons_ratio) * spread - axial"),
    ("tsuji_exponent", "fem-laws", "alpha * pair.effective_mass().sqrt() * stiffness.sqrt(), 0.25)",
     "alpha * pair.effective_mass().sqrt() * stiffness.sqrt(), 0.5)"),
    ("kuwabara_kono_factor", "fem-laws", "power(stiffness, 1.5, 1.5 * time * stiffness, 0.5)",
     "power(stiffness, 1.5, time * stiffness, 0.5)"),
    ("linear_damping", "fem-laws", "linear(mass * frequency * frequency, 2.0 * ratio * mass * frequency)",
     "linear(mass * frequency * frequency, ratio * mass * frequency)"),
    ("rayleigh_slope", "fem-laws", "let rise = 8.0 * x * (2.0 * x * x - 1.0);",
     "let rise = 4.0 * x * (2.0 * x * x - 1.0);"),
    ("slip_compliance", "fem-laws", "self.curvature * mismatch / (4.0 * PI)", "self.curvature * mismatch / (2.0 * PI)"),
    ("sticking_speed", "fem-laws", "(2.0 * self.separation_energy() / self.pair.effective_mass()).sqrt()",
     "(self.separation_energy() / self.pair.effective_mass()).sqrt()"),
    # Contact
    ("spring_force", "fem-contact", "point.projections[1].add(force, f_upper); total.force += force;",
     "point.projections[1].add(force, f_upper); total.force += point.area * force;"),
    ("contact_area", "fem-contact", "let area = 2.0 * PI * radius * half;", "let area = PI * radius * half;"),
    ("nodes_of_a_foot", "fem-contact", "f[self.nodes[1] as usize][1] += self.shape[1] * force;",
     "f[self.nodes[1] as usize][1] += self.shape[0] * force;"),
    ("dual_hat", "fem-contact", "-mass[0][1] * integral / determinant; 2]", "mass[0][1] * integral / determinant; 2]"),
    # What all models share
    ("von_mises_shear", "fem-collision", "(square + 3.0 * ry * ry).sqrt()", "(square + ry * ry).sqrt()"),
    ("common_velocity", "fem-collision", "let common = shares[1] * self.velocities[0] + shares[0] * self.velocities[1];",
     "let common = shares[0] * self.velocities[0] + shares[1] * self.velocities[1];"),
    ("dissipation_trapezoid", "fem-collision", "0.5 * (last.get(account).unwrap_or(0.0) + now) * time", "now * time"),
    # Condensed bodies
    ("complementarity_sign", "fem-condensed", "overlap[point] - closing", "overlap[point] + closing"),
    ("newmark_beta", "fem-condensed", "const BETA: f64 = 1.0 / 12.0;", "const BETA: f64 = 1.0 / 4.0;"),
    ("branch_history", "fem-condensed", "branch.weight * (branch.step.decay * q - branch.step.gain * z)",
     "branch.weight * (q - branch.step.gain * z)"),
    # Explicit elements
    ("weight_sign", "fem-explicit", "resultant -= weight;", "resultant += weight;"),
    ("potential_energy", "fem-explicit", "Account::Potential, self.acceleration * raised",
     "Account::Potential, -self.acceleration * raised"),
    ("critical_step_mass", "fem-explicit", "stiffness[node as usize] += eigenvalue * mass;",
     "stiffness[node as usize] += 0.5 * eigenvalue * mass;"),
    ("leapfrog_displacement", "fem-explicit", "*u += time_step * *v;", "*u += 0.5 * time_step * *v;"),
    ("bulk_viscosity_speed", "fem-explicit", "linear * material.dilatational_wave_speed(), quadratic * quadratic",
     "linear * material.dilatational_wave_speed(), quadratic"),
    ("strain_energy_half", "fem-explicit",
     "twice = constants.plus_twice_energy::<WIDE, true>(twice, shape, &corners);",
     "let _ = &corners; let _ = shape;"),
    # Cases
    ("unit_of_an_inch", "fem-case", 'plain_unit("in", LENGTH, -4, [254.0, 1.0])', 'plain_unit("in", LENGTH, -4, [245.0, 1.0])'),
    ("unit_power", "fem-case", "denominator: denominator.powi(size)", "denominator"),
    ("negative_quantity", "fem-case", "Some(if self.negative { -size } else { size })", "Some(size)"),
    ("relative_uncertainty", "fem-case", "Ok((value, Some(spread * value.abs()), dimension))",
     "Ok((value, Some(spread), dimension))"),
    ("measured_exponent", "fem-case:library", "(speed / reference).powf(self.exponent)",
     "(speed / reference).powf(-self.exponent)"),
    # Effects and error bars
    ("energy_of_adhesion", "fem-simulation:adhesion", "energies.add(Account::Adhesion, lost);",
     "energies.add(Account::Adhesion, 0.5 * lost);"),
    ("input_difference", "fem-simulation:uncertain_inputs", "0.5 * (above - below)", "above - below"),
    ("yield_in_error_bars", "fem-simulation:plastic_yield",
     "match status.is_lacking && !Onset::of_yielding(scene, estimate).is_empty() {",
     "match status.is_lacking && Onset::of_yielding(scene, estimate).is_empty() {"),
    ("error_of_a_law_that_dents", "fem:laws", "weight * (sign * (e - point.restitution) - error)",
     "weight * (sign * (e - point.restitution) - 0.1 * error)"),
    ("error_bars_of_later_contacts", "fem-simulation:gravity", "Some(parts.sum().max(floor))",
     "first.discretisation(restitution).filter(|_| parts.sum() + floor > 0.0)"),
    ("matters_before_the_run", "fem-simulation:what_matters", "let matters = is_physics || is_lacking && is_needed || is_warned;",
     "let matters = is_physics || is_lacking && is_needed; let _ = is_warned;"),
    ("matters_after_the_run", "fem-simulation:what_matters",
     "if let (Some(decision), false) = (own, warnings.is_empty()) { decision.matters = true; }", "let _ = own;"),
    # Files
    ("vtk_offsets", "fem-vtk", ".map(|cell| 4 * cell)", ".map(|cell| 4 * cell - 4)"),
    ("vtk_cell_type", "fem-vtk", "const VTK_QUAD: u8 = 9;", "const VTK_QUAD: u8 = 8;"),
    # Figures
    ("logarithmic_axis", "fem-figure", "true => (value / self.from).ln() / (self.to / self.from).ln()",
     "true => (value - self.from) / (self.to - self.from)"),
    ("contour_levels", "fem-figure", "let candidates = [(1, power), (2, power), (5, power), (1, power + 1)];",
     "let candidates = [(1, power), (2, power), (4, power), (1, power + 1)];"),
    # Fits
    ("cradle_angle", "fem-data", "let e = (1.0 + ratio) * b / a - 1.0;", "let e = (1.0 + ratio) * b / a;"),
    ("lammps_polynomial", "fem-data", "2f64.sqrt() * polynomial(entered)", "polynomial(entered)"),
    ("confidence_interval", "fem-data", "true => (value * (-reach).exp(), value * reach.exp())",
     "true => (value * (-reach).exp(), value)"),
    ("robust_influence", "fem-data:robust", "let slope = |w: &f64| w * (2.0 * w - 1.0);", "let slope = |w: &f64| *w;"),
    ("parts_of_the_rig", "fem-run:bars_have", "parts.iter().map(|part| part.changes[result].powi(2)).sum::<f64>().sqrt()",
     "parts.iter().map(|part| part.changes[result]).sum::<f64>().abs()"),
    # Records
    ("shared_instant", "fem-data:records", "(self.instants[1], -(later + earlier) * self.ends[1]),",
     "(self.instants[1], (later + earlier) * self.ends[1]),"),
    ("added_mass", "fem-data:records", "let inertia = 1.0 + 0.5 * ratio;", "let inertia = 1.0;"),
    ("flight_slope", "fem-data:records", "let [later, earlier] = [next.slopes[0] / landing, e * self.slopes[1] / landing];",
     "let [later, earlier] = [next.slopes[0] / landing, self.slopes[1] / landing];"),
    ("impossible_restitution", "fem-data:measured", 'value if value > 1.0 => ("above 1", value - 1.0),',
     'value if value > 1.1 => ("above 1", value - 1.0),'),
    ("names_of_uncertainties", "fem-data:measured", 'format!("{word}({name})")', 'format!("{word}[{name}]")'),
    # A whole collision
    ("summary_cost_unit", "fem-run:result_folder", "1e9 * cost.solve_s / updates as f64", "1e6 * cost.solve_s / updates as f64"),
    ("history_column", "fem-run:result_folder", 'column("contact_radius_m", &|row| row.contact_radius),',
     'column("contact_radius_m", &|row| Some(row.approach)),'),
    ("contact_file_slip", "fem-simulation:contact_profile", "let slip = place.radial[1] - place.radial[0];",
     "let slip = place.radial[0] - place.radial[1];"),
    # The command
    ("exit_status_of_bad_input", "fem-run:bad_input", "BadInput = 2,", "BadInput = 3,"),
    ("exit_status_of_an_interrupt", "fem-run:stopping", "Interrupted = 130,", "Interrupted = 131,"),
    # Claims
    ("claim_bound", "fem-validate", "(Tolerance::AtMost(most), _) => value <= most,",
     "(Tolerance::AtMost(most), _) => value >= most,"),
]


def sources():
    """Paths of the Rust sources that are not tests."""
    listed = subprocess.check_output(["git", "ls-files", "*.rs"], cwd=ROOT, text=True).split()
    return [path for path in listed if "/src/" in path and not re.search(r"(^|/)tests(/|\.rs)", path)]


def pattern(text):
    """A pattern of a text that may be broken over lines in other places."""
    return re.compile(r"\s+".join(re.escape(word) for word in text.split()))


def find(texts, old):
    """The only file with this text, or a message."""
    hits = [path for path, text in texts.items() for _ in pattern(old).finditer(text)]
    return (hits[0], None) if len(hits) == 1 else (None, f"the text stands in {len(hits)} places: {hits[:3]}")


def copy(to):
    """A copy of the files under version control, as they are now."""
    for path in subprocess.check_output(["git", "ls-files"], cwd=ROOT, text=True).splitlines():
        if (ROOT / path).is_file():
            (to / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / path, to / path)


def run_tests(folder, tests):
    """Whether the tests of a crate compile and pass, and the names of those that fail."""
    crate, _, names = tests.partition(":")
    env = dict(os.environ, CARGO_TARGET_DIR=os.environ.get("CARGO_TARGET_DIR", str(ROOT / "target/faults")))
    command = ["cargo", "test", "--locked", "-p", crate, "--tests", "--no-run"]
    built = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True)
    if built.returncode:
        return False, False, [line for line in built.stderr.splitlines() if line.startswith("error")][:2]
    ran = subprocess.run(command[:-1] + ["--", *names.split()], cwd=folder, env=env, capture_output=True, text=True)
    failed = re.findall(r"^test (\S+) .*FAILED$", ran.stdout, re.M)
    return True, ran.returncode == 0, failed


def main(arguments):
    wanted = [name for name in arguments if name != "--list"]
    chosen = [fault for fault in FAULTS if not wanted or {fault[0], fault[1].partition(":")[0]} & set(wanted)]
    texts = {path: (ROOT / path).read_text() for path in sources()}
    n_bad = 0
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        if "--list" not in arguments:
            copy(folder)
        for name, tests, old, new in chosen:
            path, message = find(texts, old)
            if message is None and "--list" not in arguments:
                began = time.monotonic()
                (folder / path).write_text(pattern(old).sub(lambda _: new, texts[path]))
                compiles, passes, failed = run_tests(folder, tests)
                (folder / path).write_text(texts[path])
                if not compiles:
                    message = f"does not compile: {failed}"
                elif passes:
                    message = "MISSED"
                took = f"{time.monotonic() - began:.0f} s"
                caught = f"caught by {len(failed)} tests, {', '.join(failed[:2])}"
            else:
                caught, took = path, ""
            n_bad += message is not None
            print(f"{name:30} {tests:24} {message or caught} {took}", flush=True)
    print(f"{len(chosen)} faults, {n_bad} to mend")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
