"""The pages of docs/ as a site of mdBook, whose preprocessor this is; `site.py check FOLDER` checks a built site.

On the site, links that leave docs/ lead to the repository, pictures from elsewhere in it are part of their page, and
equations are MathML. Needs `pip install latex2mathml`.
"""

import base64
import json
import os
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

MATH = r"^```math\n(?P<math>.*?)^```$"
FENCE = r"^```.*?^```$"
OUTSIDE = r"(?P<picture>!?)\[(?P<text>[^\]]*)\]\(\.\./(?P<path>[^)#]*)(?P<anchor>#[^)]*)?\)"
PARTS = re.compile(f"{MATH}|{FENCE}|{OUTSIDE}", re.MULTILINE | re.DOTALL)


def on_the_site(part: re.Match, root: Path, repository: str) -> str:
    """Returns a part of a page as the site has it: an equation, another fenced block, or a link that leaves docs/."""
    if part["math"] is not None:
        from latex2mathml.converter import convert

        return f'<div style="overflow-x: auto">{convert(part["math"].strip(), display="block")}</div>'
    if part["path"] is None:
        return part[0]
    target = root / part["path"]
    if part["picture"]:
        kind = {".svg": "image/svg+xml", ".png": "image/png"}[target.suffix]
        return f"![{part['text']}](data:{kind};base64,{base64.b64encode(target.read_bytes()).decode()})"
    view = "tree" if target.is_dir() else "blob"
    return f"[{part['text']}]({repository}/{view}/main/{part['path']}{part['anchor'] or ''})"


def preprocess() -> None:
    """Reads a book from the standard input and writes it to the standard output, both as mdBook's JSON."""
    context, book = json.load(sys.stdin)
    root, repository = Path(context["root"]), context["config"]["output"]["html"]["git-repository-url"]
    for chapter in (item["Chapter"] for item in book["items"] if "Chapter" in item):
        chapter["content"] = PARTS.sub(lambda part: on_the_site(part, root, repository), chapter["content"])
    json.dump(book, sys.stdout)


class Page(HTMLParser):
    """The links of a page and the names that links to it can have."""

    def __init__(self, file: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.names: set[str] = set()
        self.n_equations = 0
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.n_equations += tag == "math"
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name in ("id", "name") and value:
                self.names.add(value)


def check(site: Path) -> None:
    """Checks that each link within the site has its target, that no picture is fetched from elsewhere, and that there
    are equations and an index for the search."""
    pages = {file: Page(file) for file in site.glob("*.html")}
    faults, n_links = [], 0
    for file, page in pages.items():
        for link in (link for link in page.links if not re.match(r"https?:|data:|mailto:", link)):
            n_links += 1
            path, _, anchor = link.partition("#")
            target = Path(os.path.normpath(file.parent / unquote(path))) if path else file
            if not target.exists() or anchor and target in pages and unquote(anchor) not in pages[target].names:
                faults.append(f"{file.name}: {link}")
    n_equations = sum(page.n_equations for page in pages.values())
    assert not faults, "links that lead nowhere:\n" + "\n".join(faults)
    assert len(pages) > 20 and n_links > 500 and n_equations > 15, (len(pages), n_links, n_equations)
    assert list(site.glob("searchindex*.js")), "there is no index for the search"
    print(f"{len(pages)} pages, {n_links} links within them, {n_equations} equations")


if sys.argv[1:2] == ["check"]:
    check(Path(sys.argv[2]))
elif sys.argv[1:2] != ["supports"]:
    preprocess()
