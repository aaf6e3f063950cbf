"""Make the files anew that the page and its tests bring along from others: make vendor.

Needs npm. Versions stand in package.json beside this file, and what is taken of each package in the
*.js beside it. VENDORED.toml beside the files says what they are.
"""

import hashlib
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE.parent / "src/asperity/web/static/vendor"
TESTS = HERE.parent / "tests/browser/vendor"

BUNDLED = {
    "preact.js": ("preact", "htm", "@preact/signals", "@preact/signals-core"),
    "three.js": ("three",),
}
"""Bundles of the modules beside this file, and the packages that are in them."""

COPIED = {
    TESTS / "axe.js": ("axe-core", "axe.min.js"),
}
ESBUILD = ("--bundle", "--minify", "--format=esm", "--target=es2022", "--legal-comments=none")


def main() -> None:
    """Install the packages in a temporary folder, bundle, copy, and write what was made."""
    with tempfile.TemporaryDirectory() as place:
        build = Path(place)
        for file in HERE.glob("*.js*"):
            shutil.copy(file, build)
        run = ("npm", "install", "--no-audit", "--no-fund", "--silent")
        subprocess.run(run, cwd=build, check=True)
        made: dict[Path, tuple[str, ...]] = {}
        for name, packages in BUNDLED.items():
            run = (str(build / "node_modules/.bin/esbuild"), name, *ESBUILD)
            subprocess.run((*run, f"--outfile={PAGE / name}"), cwd=build, check=True)
            (PAGE / name).write_text(bare((PAGE / name).read_text("utf-8")), "utf-8")
            made[PAGE / name] = packages
        for target, (package, source) in COPIED.items():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(build / "node_modules" / package / source, target)
            made[target] = (package,)
        for folder in (PAGE, TESTS):
            write_list(folder, {f: p for f, p in made.items() if f.parent == folder}, build)


def bare(text: str) -> str:
    """Return a bundle without what shaders have for readers alone.

    They are texts to the bundler: their indents, empty lines and lines of nothing but a comment.
    """
    lines = (line.lstrip(" \t") for line in text.split("\n"))
    return "\n".join(line for line in lines if line and not line.startswith("//")) + "\n"


def write_list(folder: Path, made: dict[Path, tuple[str, ...]], build: Path) -> None:
    """Write VENDORED.toml and the texts of the licences into a folder of vendored files."""
    lines = ["# What is brought along from others; made by `make vendor`."]
    licences = folder / "licences"
    licences.mkdir(exist_ok=True)
    for file, packages in made.items():
        data = file.read_bytes()
        lines += ["", f'["{file.name}"]', f'sha256 = "{hashlib.sha256(data).hexdigest()}"']
        lines.append("packages = [")
        for package in packages:
            source = build / "node_modules" / package
            about = json.loads((source / "package.json").read_text())
            text = f"{package.removeprefix('@').replace('/', '-')}.txt"
            shutil.copyfile(source / "LICENSE", licences / text)
            lines.append(
                f'  {{ name = "{package}", version = "{about["version"]}", '
                f'licence = "{about["license"]}", text = "licences/{text}" }},'
            )
        lines.append("]")
    (folder / "VENDORED.toml").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
