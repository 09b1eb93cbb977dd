"""What docs/python.md shows runs, but for the cluster."""

import re

import pytest

from conftest import ROOT


def test_the_page_runs(tmp_path, monkeypatch):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "python.md").read_text(), re.S)
    blocks = [block for block in blocks if "distributed" not in block]
    assert len(blocks) == 2
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {}
    for block in blocks:
        exec(block, names)
    assert (tmp_path / "runs" / "from_python" / "summary.json").exists()
    assert len(names["table"]["restitution"]) == 40


def test_a_snapshot_that_is_not_there_is_told(glass):
    import fem_run

    result = fem_run.Case.load(glass).with_({"model.ting": {}}).run()
    with pytest.raises(KeyError, match="there are: none"):
        result.snapshot("maximum")
