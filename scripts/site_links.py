#!/usr/bin/env python3
"""Links of a built site: every one leads to a file of it, and to a place that the page has.

usage: site_links.py SITE_DIR      exit 1 and one line per link to nothing
"""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag


class Page(HTMLParser):
    """What a page links to, and the places it has."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("href", "src") and value is not None and tag != "link":
                self.links.append(value)
            elif key in ("id", "name") and value:
                self.places.add(value)


def main(site):
    pages = {path.resolve(): Page(path) for path in sorted(site.rglob("*.html"))}
    n_wrong = 0
    for path, page in pages.items():
        if path.name == "404.html":  # its links are those of a server's root
            continue
        for link in page.links:
            target, place = urldefrag(link)
            if ":" in target or link.startswith("#") and place in ("", "mkdocs_search_modal", "mkdocs_keyboard_modal"):
                continue
            to = (path.parent / unquote(target)).resolve() if target else path
            where = path.relative_to(site.resolve())
            if not to.exists():
                print(f"{where}: links to {target}, which is not there")
            elif to in pages and unquote(place) not in pages[to].places:
                print(f"{where}: links to #{place} of {to.name}, which has no such place")
            else:
                continue
            n_wrong += 1
    print(f"{len(pages)} pages, {sum(len(p.links) for p in pages.values())} links, {n_wrong} to nothing")
    return 1 if n_wrong or not pages else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1])))
