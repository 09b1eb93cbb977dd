#!/usr/bin/env python3
"""Checks the files that hand a release over: one version everywhere, whole forms of issues, the checksums and notes of `.ci/release`."""

import hashlib
import json
import pathlib
import re
import subprocess
import tempfile

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEXTS = {
    ".binder/requirements.txt": r"fem-run\[plot\]==(\S+)",
    "packaging/fem-run.def": r"fem-run\[all\]==([0-9.]+)",
}


def text(path):
    return (ROOT / path).read_text()


def check_versions():
    version = re.search(r'^version = "(.*)"', text("Cargo.toml"), re.M)[1]
    found = {path: re.search(pattern, text(path))[1] for path, pattern in TEXTS.items()}
    found["label of the container"] = re.search(r"image.version (\S+)", text("packaging/fem-run.def"))[1]
    found["CITATION.cff"] = yaml.safe_load(text("CITATION.cff"))["version"]
    found[".zenodo.json"] = json.loads(text(".zenodo.json"))["version"]
    found["recipe.yaml"] = yaml.safe_load(text("packaging/conda/recipe.yaml"))["context"]["version"]
    assert all(other == version for other in found.values()), (version, found)
    return version


def check_forms():
    fields = {"textarea", "input", "dropdown", "checkboxes", "markdown"}
    for path in sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("[0-9]*.yml")):
        form = yaml.safe_load(path.read_text())
        assert {"name", "description", "body"} <= form.keys(), path
        ids = [field["id"] for field in form["body"]]
        assert len(ids) == len(set(ids)), path
        for field in form["body"]:
            assert field["type"] in fields and field["attributes"]["label"], (path, field)


def check_release(version):
    script = ROOT / ".ci/release"
    notes = subprocess.run([script, "notes", version], check=True, capture_output=True, text=True).stdout
    assert "### Added" in notes and "## [" not in notes, notes
    assert subprocess.run([script, "notes", "9.9.9"], capture_output=True, check=False).returncode == 1
    for _ in range(20):
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder, name) for name in ("a.tar.gz", "b c.whl", "-d.html")]
            for file in files:
                file.write_text(file.name)
            # A list that was begun before is not part of its own sums.
            pathlib.Path(folder, "SHA256SUMS").write_text("old\n")
            subprocess.run([script, "checksums", folder], check=True)
            lines = pathlib.Path(folder, "SHA256SUMS").read_text().splitlines()
            sums = {line[66:]: line[:64] for line in lines}
            assert sums == {file.name: hashlib.sha256(file.name.encode()).hexdigest() for file in files}, lines


if __name__ == "__main__":
    check_forms()
    check_release(check_versions())
    print("packaging: one version, whole forms, notes and checksums")
