"""No message that Python shows has an option of the command; each of its arguments is one of the function."""

import inspect
import json
import re
from typing import get_args, get_type_hints

import pytest

import fem_run
from fem_run import _native, _words
from fem_run._words import in_python

from conftest import ROOT

FUNCTIONS = {name: getattr(fem_run, name) for name in ("calibrate", "cradle", "export", "fit", "invert", "measure", "relaxation")}
#: Options about the command's files and screen, and those of its case.
OF_THE_COMMAND = {"at", "data", "force", "json", "out", "quiet", "set", "verbose"}
#: Sources whose messages only the command prints.
NOT_IN_PYTHON = re.compile(
    r"fem-run/src/(sweep/|commands/(accuracy|mesh|new|report|run|shell|sweep|validate)|arguments/mod|result_folder/(restart|whole_file))"
    r"|fem-report/src/accuracy|fem-(page|python)/"
)
#: Values in messages that look like a word of a sentence.
EXAMPLES = {"all", "friction", "kuwabara_kono", "lib", "mean_pressure", "shear", "ting"}
TOKENS = re.compile(r'//[^\n]*|\'(?:[^\'\\\n]|\\[^u]|\\u\{\w+\})\'|r#".*?"#|"((?:[^"\\]|\\.)*)"', re.S)


def messages():
    """Yields the texts with options in the sources that Python reaches."""
    for path in sorted((ROOT / "crates").glob("*/src/**/*.rs")):
        if NOT_IN_PYTHON.search(path.as_posix()):
            continue
        source = path.read_text().split("#[cfg(test)]")[0]
        for found in TOKENS.finditer(source):
            text = re.sub(r"\\\n\s*", "", found[1] or "").replace('\\"', '"')
            if re.search(r"(^|\s)--[a-z]", text) and not text.startswith("cargo"):
                yield path.name, text


def test_every_message_is_in_pythons_words():
    arguments = {name for function in FUNCTIONS.values() for name in inspect.signature(function).parameters}
    arguments |= set(inspect.signature(fem_run.Result.save).parameters)
    n = 0
    for file, text in messages():
        n += 1
        shown = in_python(re.sub(r"\{[^}]*\}", "X", text))
        assert not re.search(r"(^|\W)--[a-z]", shown), (file, text, shown)
        for option, after in re.findall(r"--([a-z][a-z-]*)(?:[ =]([^\s,:;.)]+))?", text):
            assert option == "set" or _words._name(option) in arguments, (file, text)
            is_value = not re.fullmatch(r"[a-z_]+", after) or after in EXAMPLES
            assert not after or is_value or after in _words._PROSE, f"{file}: add {after!r} to _PROSE or EXAMPLES: {text}"
    assert n > 30


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ('--set body.0.name=…:1:3: "x"', '{"body.0.name": …}:1:3: "x"'),
        ('--set material."my glass".density=…:1:1', "{'material.\"my glass\".density': …}:1:1"),
        ("--law is missing; try --law ting, or --law all.", 'law is missing; try law="ting", or law="all".'),
        ("90 % is --restitution 0.9", "90 % is restitution=0.9"),
        ("give --param n=VALUE, or fit it with --free a,n", 'give param={"n": VALUE}, or fit it with free=["a", "n"]'),
        ('--bounds "n=3..1": the range is empty', 'bounds={"n": (3, 1)}: the range is empty'),
        ("a column contact_time_s and --contact-time", "a column contact_time_s and contact_time=True"),
        ("invalid value 'x' for '--speeds <LOW..HIGH>': write LOW..HIGH, such as '5 cm/s..2 m/s'",
         "speeds='x': write (LOW, HIGH), such as (\"5 cm/s\", \"2 m/s\")"),
        ("the argument '--data <FILE>' cannot be used with '--alpha <ANGLE>'", "the argument data cannot be used with alpha"),
        ("name a folder, such as --out runs/first", 'name a folder, such as folder="runs/first"'),
        ("a--b.csv: 3 -- 4", "a--b.csv: 3 -- 4"),
    ],
)
def test_options_become_arguments(text, shown):
    assert in_python(text) == shown == in_python(shown)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_arguments_are_the_options_of_the_command(name):
    """Declared types and the command's table cannot differ."""
    options = json.loads(_native.options())[name]
    function = FUNCTIONS[name]
    hints = get_type_hints(function)
    declared = set(inspect.signature(function).parameters) - {"case", "data"}
    assert declared == {_words._name(option) for option in options} - {"folder", *OF_THE_COMMAND}
    # The data are an argument of these commands.
    assert ("data" in inspect.signature(function).parameters) == ("data" in options or name in ("measure", "relaxation"))
    for option, found in options.items():
        if option in OF_THE_COMMAND:
            continue
        hint = hints[_words._name(option)]
        assert (hint is bool) == found["flag"], option
        # The law of a fit has a value.
        assert not found["flag"] or option in _words._FLAGS or (name, option) == ("export", "law")
        literals = {value for one in [hint, *get_args(hint)] for value in get_args(one) if isinstance(value, str)}
        literals |= {value for one in get_args(hint) for inner in get_args(one) for value in get_args(inner) if isinstance(value, str)}
        assert literals - {"all"} == set(found["values"] or []) - {"all"}, option


def test_warnings_and_reasons_are_in_pythons_words(glass):
    case = fem_run.Case.load(glass)
    data = {"speed_m_s": [0.1, 0.3, 1.0, 2.0], "restitution": [0.95, 0.85, 0.7, 0.9]}
    found = fem_run.calibrate(case, data, model="ting", terms=2, uncertainty=1e-4)
    assert any("uncertainty" in warning or "terms" in warning for warning in found["warnings"])
    texts = [*found["warnings"], *fem_run.invert(case, 0.3)["unsolved"].values()]
    assert not any("--" in text for text in texts)
