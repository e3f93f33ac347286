# SPDX-License-Identifier: BSD-3-Clause
"""Check the built site: python docs/check_site.py build/docs.

No broken link or anchor, no picture without words, no file from a network, a description on each
page, a first page that is light, and a search that finds the words of the field. The exit status
is 1 if something is wrong.
"""

import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

FIRST_PAGE = 300_000
"""Most bytes of the first page with all of its files."""
WORDS = ("minimum", "film", "thick")
"""Stems that the search must find on one page."""
# Made by other programs: their contents are not checked
FOREIGN = ("fortran/",)


class Page(HTMLParser):
    """Links, anchors, pictures and files of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.files: list[str] = []
        self.anchors: set[str] = set()
        self.without_words: list[str] = []
        self.described = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Record the targets and files of a tag."""
        have = {name: value or "" for name, value in attrs}
        self.anchors |= {have[name] for name in ("id", "name") if name in have}
        if tag == "a" and "href" in have:
            self.links.append(have["href"])
        if tag in ("script", "img", "source", "iframe") and "src" in have:
            self.files.append(have["src"])
        if tag == "link" and have.get("rel") in ("stylesheet", "icon"):
            self.files.append(have["href"])
        if tag == "img" and not have.get("alt", "").strip():
            self.without_words.append(have.get("src", ""))
        self.described |= tag == "meta" and have.get("name") == "description"


def faults(site: Path) -> list[str]:
    """List all faults of a site."""
    pages = {
        path: Page(path.read_text(encoding="utf-8"))
        for path in sorted(site.rglob("*.html"))
        if not path.relative_to(site).as_posix().startswith((*FOREIGN, "_modules/"))
    }
    result = []
    for path, page in pages.items():
        name = path.relative_to(site).as_posix()
        for link in page.links:
            if re.match(r"\w+:|//", link):
                continue
            target, anchor = urldefrag(link)
            file = (path.parent / unquote(target.partition("?")[0])).resolve() if target else path
            if file.relative_to(site).as_posix().startswith(FOREIGN):
                continue
            if not file.exists():
                result.append(f"{name}: broken link {link}")
            elif anchor and file in pages and unquote(anchor) not in pages[file].anchors:
                result.append(f"{name}: no such place {link}")
        for source in page.files:
            if re.match(r"https?:|//", source):
                result.append(f"{name}: a file from a network: {source}")
            elif not source.startswith("data:"):
                file = path.parent / unquote(source.partition("?")[0])
                if not file.exists():
                    result.append(f"{name}: missing file {source}")
        result += [f"{name}: picture without words: {source}" for source in page.without_words]
        if not page.described and path.stem not in ("search", "genindex", "py-modindex"):
            result.append(f"{name}: no description")
    result += of_site(site, pages)
    print(f"{len(pages)} pages, {len(result)} faults")
    return result


def of_site(site: Path, pages: dict[Path, Page]) -> list[str]:
    """List the faults of the first page and of the search."""
    result = []
    first = site / "index.html"
    files = {site / f.partition("?")[0] for f in pages[first].files if not f.startswith("data:")}
    size = sum(file.stat().st_size for file in (first, *files) if file.exists())
    if size > FIRST_PAGE:
        result.append(f"index.html: {size} bytes with its files, more than {FIRST_PAGE}")
    text = (site / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[text.index("{") : text.rindex("}") + 1])
    pages_of = [index["terms"].get(word, []) for word in WORDS]
    common = set.intersection(*({at} if isinstance(at, int) else set(at) for at in pages_of))
    if not common:
        result.append(f"search: no page has {' '.join(WORDS)}")
    print(f"first page {size / 1000:.0f} kB")
    return result


if __name__ == "__main__":
    wrong = faults(Path(sys.argv[1]).resolve())
    print("\n".join(wrong))
    sys.exit(bool(wrong))
