"""Check the types of the page's modules: make page-types.

Needs npm, which brings TypeScript; ``--version`` says which one, and fails where it cannot be had.
What is vendored is taken as it is.
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
MODULES = HERE.parent / "src/asperity/web/static/js"
OPTIONS = {
    "allowJs": True, "checkJs": True, "noEmit": True, "strict": True,
    # What a function takes stands in its comment where it is not seen at once.
    "noImplicitAny": False, "useUnknownInCatchVariables": False,
    "target": "es2023", "module": "esnext", "moduleResolution": "bundler",
    "lib": ["es2023", "dom", "dom.iterable"], "types": [],
}  # fmt: skip
TAKEN = re.compile(r'import \{([^}]*)\} from "[./]*/vendor/(\w+)\.js"')


def tsc(*arguments: str) -> int:
    """Run TypeScript, of the version in package.json; returns its exit code."""
    if shutil.which("npm") is None:
        print("npm is not installed")
        return 2
    version = json.loads((HERE / "package.json").read_text())["devDependencies"]["typescript"]
    run = ["npm", "exec", "--yes", f"--package=typescript@{version}", "--", "tsc", *arguments]
    return subprocess.run(run, check=False).returncode


def main() -> int:
    """Copy the modules beside names that stand for what is vendored, and check them."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        shutil.copytree(MODULES, folder / "js")
        (folder / "vendor").mkdir()
        taken: dict[str, set[str]] = {}
        for path in MODULES.rglob("*.js"):
            for names, module in TAKEN.findall(path.read_text("utf-8")):
                taken.setdefault(module, set()).update(map(str.strip, names.split(",")))
        for module, names in taken.items():
            lines = [f"export const {name}: any;" for name in sorted(names - {""})]
            (folder / f"vendor/{module}.d.ts").write_text("\n".join(lines) + "\n")
        # It is loaded later, and each of its names asked for then.
        (folder / "vendor/three.d.ts").write_text("declare const three: any;\nexport = three;\n")
        settings = {"compilerOptions": OPTIONS, "include": ["js"]}
        (folder / "tsconfig.json").write_text(json.dumps(settings))
        return tsc("-p", str(folder))


if __name__ == "__main__":
    sys.exit(tsc("--version") if "--version" in sys.argv else main())
