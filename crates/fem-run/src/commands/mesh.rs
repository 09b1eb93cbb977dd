//! `fem-run mesh CASE`: the mesh of each sphere as a VTK file.

use std::path::{Path, PathBuf};

use fem::{Plan, build_meshes};
use fem_mesh::SphereMesh;
use fem_vtk::{VtuFile, VtuWriter};

use crate::arguments::case::CaseArguments;
use crate::result_folder::whole_file::{MadeFolders, unwritten};
use crate::text::{Failure, mesh_table, shown, standard_output};

/// Field data that identifies a file of this command.
const MARK: &str = "fem-run mesh";

/// Write the mesh of each sphere as BODY.vtu
///
/// The coordinates are (r, y, 0) in metres with the contact pole at the origin. Such a file, from here or
/// elsewhere, replaces the built-in mesh: sphere = { diameter = …, mesh = "BODY.vtu" }.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    input: CaseArguments,
    /// Folder for the files [default: meshes/CASE, with the name of the case file]
    ///
    /// Existing files are replaced only if this command wrote them.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print nothing but errors and warnings
    #[arg(long, short)]
    quiet: bool,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let case = arguments.input.load()?;
    let meshes = build_meshes(case.scene(), &Plan::of_case(&case)?)
        .map_err(|refusal| refusal.in_case(&case))?;
    let default = || Path::new("meshes").join(arguments.input.stem());
    let out = arguments.out.clone().unwrap_or_else(default);
    let bodies = case.scene().bodies().iter().zip(&meshes);
    let files: Vec<(PathBuf, &SphereMesh)> = bodies
        .filter_map(|(body, mesh)| Some((out.join(format!("{}.vtu", body.name())), mesh.as_ref()?)))
        .collect();
    for (path, _) in &files {
        check_place(path)?;
    }
    let place = "name a folder in a place that you may write to with --out";
    let _made = MadeFolders::above(&out.join("mesh"));
    std::fs::create_dir_all(&out).map_err(|error| unwritten(&shown(&out), &error, place))?;
    for (k, (path, mesh)) in files.iter().enumerate() {
        write_mesh(path, mesh).map_err(|error| {
            let kept: Vec<_> = files[..k].iter().map(|(path, _)| shown(path)).collect();
            let kept = (k > 0).then(|| format!("kept: {}", kept.join(", ")));
            unwritten(&shown(path), &error, place).with_help_if(kept)
        })?;
    }
    if arguments.quiet {
        return Ok(());
    }
    let written = files.iter().map(|(path, _)| format!("written: {}\n", path.display()));
    let table = mesh_table(case.scene(), meshes.each_ref().map(Option::as_ref));
    standard_output::print(&(table + "\n" + &written.collect::<String>()))
}

/// Refuses to overwrite a file of another program.
fn check_place(path: &Path) -> Result<(), Failure> {
    let is_free = path.symlink_metadata().is_err();
    if is_free || VtuFile::open(path).is_ok_and(|file| file.field_data(MARK).is_ok()) {
        return Ok(());
    }
    let message = format!("{}: a file in the way was not written by fem-run mesh", path.display());
    Err(Failure::bad_input(message).with_help("move it away, or name another folder with --out"))
}

fn write_mesh(path: &Path, mesh: &SphereMesh) -> Result<(), fem_vtk::Error> {
    let points: Vec<[f64; 3]> = mesh.nodes().iter().map(|&[r, y]| [r, y, 0.0]).collect();
    VtuWriter::new(&points, mesh.quads()).field_data(MARK, 1, &[1_i32]).write(path)
}
