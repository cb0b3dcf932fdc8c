#!/usr/bin/env python3
"""Tells the service worker which files belong to a build. Trunk calls this (Trunk.toml) before it puts the page in place."""

import hashlib
import json
import os
import pathlib
import re

SERVICE = "service.js"


def hash_listed(folder: pathlib.Path) -> None:
    """Gives what the page lists in `meta` elements names with hashes, which Trunk gives to what it knows."""
    page = (folder / "index.html").read_text()
    for element, name in re.findall(r'(<meta name="?(?:text|font)-\w+"? content="?)([\w.-]+)', page):
        if re.search(r"-[0-9a-f]{16}\.", name):
            continue
        file = folder / name
        digest = hashlib.sha256(file.read_bytes()).hexdigest()[:16]
        hashed = file.rename(file.with_stem(f"{file.stem}-{digest}"))
        page = page.replace(element + name, element + hashed.name)
    (folder / "index.html").write_text(page)


def is_watched(folder: pathlib.Path) -> bool:
    """Whether `trunk serve` put its script into the page that reloads it; then lets the page run that script."""
    page = (folder / "index.html").read_text()
    if ".well-known/trunk/ws" not in page:
        return False
    for strict, loose in [("script-src 'self'", "script-src 'self' 'unsafe-inline'"), ("connect-src 'self'", "connect-src 'self' ws:")]:
        page = page.replace(strict, loose)
    (folder / "index.html").write_text(page)
    return True


def main() -> None:
    folder = pathlib.Path(os.environ["TRUNK_STAGING_DIR"])
    hash_listed(folder)
    # With an empty list the service worker keeps nothing: every reload shows the newest build.
    if is_watched(folder):
        return
    files = []
    for file in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = file.relative_to(folder).as_posix()
        if name != SERVICE:
            # The page is asked for by its folder: some hosts send index.html there.
            name = "./" if name == "index.html" else name
            files.append([name, hashlib.sha256(file.read_bytes()).hexdigest()])
    build = hashlib.sha256(json.dumps(files).encode()).hexdigest()[:16]
    text = (folder / SERVICE).read_text()
    for empty, full in [
        ('const BUILD = "unlisted";', f"const BUILD = {json.dumps(build)};"),
        ("const FILES = [];", f"const FILES = {json.dumps(files, indent=2)};"),
    ]:
        if text.count(empty) != 1:
            raise SystemExit(f"{SERVICE} has no line {empty!r}")
        text = text.replace(empty, full)
    (folder / SERVICE).write_text(text)


main()
