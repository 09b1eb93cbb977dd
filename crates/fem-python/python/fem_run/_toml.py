"""Python values as TOML."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from typing import Any


def value(found: Any) -> str:
    """Returns a value in one line: numbers, text, booleans, lists and dicts, also of numpy."""
    if isinstance(found, bool):
        return "true" if found else "false"
    if isinstance(found, int):
        return str(found)
    if isinstance(found, float):
        if math.isnan(found):
            return "nan"
        if math.isinf(found):
            return "inf" if found > 0 else "-inf"
        return repr(float(found))
    if isinstance(found, (str, os.PathLike)):
        return json.dumps(os.fspath(found), ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(found, Mapping):
        pairs = (f"{key(name)} = {value(inner)}" for name, inner in found.items() if inner is not None)
        return "{ " + ", ".join(pairs) + " }"
    if hasattr(found, "tolist"):
        return value(found.tolist())
    if isinstance(found, (list, tuple)):
        return "[" + ", ".join(map(value, found)) + "]"
    if found is None:
        raise TypeError("a case holds no None; leave the key out or give its default")
    raise TypeError(f"a case holds no {type(found).__name__}")


def key(name: str) -> str:
    """Returns a key, in quotes if TOML requires them."""
    bare = name and all(c.isascii() and (c.isalnum() or c in "-_") for c in name)
    return name if bare else json.dumps(name, ensure_ascii=False)


def document(found: Mapping[str, Any]) -> str:
    """Returns a whole file."""
    lines = (f"{key(name)} = {value(inner)}" for name, inner in found.items() if inner is not None)
    return "".join(line + "\n" for line in lines)


def parts(dotted: str) -> list[str]:
    """Returns the parts of a dotted key, ``material."my glass".density``."""
    found, part, quote = [], "", ""
    for c in dotted:
        if quote:
            quote, part = ("", part) if c == quote else (quote, part + c)
        elif c in "\"'":
            quote = c
        elif c == ".":
            found.append(part.strip())
            part = ""
        else:
            part += c
    return [*found, part.strip()]
