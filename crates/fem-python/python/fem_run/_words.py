"""Messages of the command in Python's words: ``--contact-time`` becomes ``contact_time=True``."""

from __future__ import annotations

import re

#: Options whose Python name is another one.
_NAMES = {"out": "folder", "for": "code"}
#: Options without a value.
_FLAGS = {"as-elastic", "contact-time", "force", "prior", "robust", "vertical-shift"}
#: Options with a list of values after the name, separated by commas.
_LISTS = {"diameters", "free", "masses", "materials"}
#: Options with values by key.
_DICTS = {"bounds", "columns", "param"}
#: Words of a sentence that may follow an option; any other word is its value.
_PROSE = frozenset("above and applies are chooses gives in includes is must needs nor of or out that to with".split())

#: An option, in clap's messages in quotes with the kind of its value, else perhaps with a value.
_OPTION = re.compile(
    r"(?<![\w-])(?:'--(?P<quoted>[a-z-]+)[^'\n]*'|--(?P<name>[a-z]+(?:-[a-z]+)*)(?![\w-])(?: <[^>\n]+>(?:\.\.\.)?)?"
    r"(?:[ =](?P<value>\"(?:[^\"\\\n]|\\.)*\"|\S+?(?=[,:;.)]*(?:\s|$))))?)"
)
#: The name of an override, whose keys may have quotes.
_CHANGE = re.compile(r"--set ((?:\"[^\"\n]*\"|[^\s\"=])+)=…")
_INVALID = re.compile(r"invalid value ('[^\n]*?') for '--([a-z-]+)[^'\n]*'")
_RANGE = re.compile(r"'(\d[^'\n]*?)\.\.([^'\n]+)'|\b([A-Z]+)\.\.([A-Z]+)\b")
_CASE_FILE = re.compile(r"fem-run (\S+\.toml)\b")
#: Words of clap, and of the command.
_PHRASES = {
    "the following required arguments were not provided:": "missing arguments:",
    "fem-run materials": "fem_run.materials",
    "..=": " to ",
}


def in_python(text: str) -> str:
    """Returns a message of the command with options, values and calls as they are written in Python."""
    for phrase, ours in _PHRASES.items():
        text = text.replace(phrase, ours)
    text = _CASE_FILE.sub(r'fem_run.Case.load("\1")', text)
    text = _CHANGE.sub(lambda found: f"{{{_quoted(found[1])}: …}}", text)
    text = _INVALID.sub(lambda found: f"{_name(found[2])}={found[1]}", text)
    text = _OPTION.sub(_argument, text)
    return _RANGE.sub(lambda found: _pair(found[1], found[2]) if found[1] else f"({found[3]}, {found[4]})", text)


def _argument(found: re.Match[str]) -> str:
    option, value = found["quoted"] or found["name"], found["value"]
    name = _name(option)
    if option in _FLAGS:
        return f"{name}=True" + ("" if value is None else f" {value}")
    if value is None:
        return name
    if value in _PROSE:
        return f"{name} {value}"
    key, is_pair, inner = value.strip('"').partition("=")
    if is_pair and option in {*_DICTS, "set"}:
        pair = f'{{"{key}": {_value(inner)}}}'
        return pair if option == "set" else f"{name}={pair}"
    if option in _DICTS:
        return f"{name}[{_value(value)}]"
    if option in _LISTS:
        return f"{name}=[{', '.join(map(_value, value.split(',')))}]"
    return f"{name}={_value(value)}"


def _name(option: str) -> str:
    return _NAMES.get(option, option.replace("-", "_"))


def _value(text: str) -> str:
    """Returns a value as Python writes it; words in capitals stand for one."""
    if ".." in text:
        return _pair(*text.split("..", 1))
    stands_for_itself = text.isupper() or text[:1] in "\"'{["
    return text if stands_for_itself or re.fullmatch(r"[-+.\deE]+", text) else _quoted(text)


def _pair(low: str, high: str) -> str:
    return f"({_value(low)}, {_value(high)})"


def _quoted(text: str) -> str:
    return f"'{text}'" if '"' in text else f'"{text}"'
