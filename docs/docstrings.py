"""Check the docstrings of the public names with numpydoc's validation: ``make lint``.

The public names are those of ``asperity.__all__`` and of the pages of ``docs/reference``, with the
members that those pages show. Each says its parameters with type and meaning, what it returns and
what it raises; what it says is there.
"""

import ast
import dataclasses
import importlib
import inspect
import re
import sys
import textwrap
from collections.abc import Collection, Iterator
from pathlib import Path

from numpydoc.docscrape import get_doc_object
from numpydoc.validate import Validator, validate

import asperity
from asperity.casefile import Table
from asperity.results import Quantities

REFERENCE = Path(__file__).parent / "reference"

# A parameter: PR01 is not said, PR02 is said and not there, PR03 stands in another order, PR04 has
# no type, PR05 a type with a period, PR07 no meaning, PR10 no space before its colon. RT01 no
# Returns, RT03 without meaning, YD01 no Yields. GL06 an unknown section, GL07 sections in another
# order, GL08 nothing at all, SS01 no summary. Of this check: RS01 an error is raised and not named,
# SH01 an array has no shape.
CODES = {
    *("PR01", "PR02", "PR03", "PR04", "PR05", "PR07", "PR10"),
    *("RT01", "RT03", "YD01", "GL06", "GL07", "GL08", "SS01"),
}
# What a method that stands in for one of a base leaves to that.
INHERITED = {"PR01", "RT01", "YD01"}


def public_names(reference: Path = REFERENCE) -> list[str]:
    """Return the dotted names of functions, classes and methods that stay."""
    found = [f"asperity.{name}" for name in asperity.__all__]
    for page in sorted(reference.glob("*.rst")):
        for kind, name, options in _directives(page.read_text("utf-8")):
            named = _of_module(name, options) if kind == "module" else [name]
            found += named
            if kind == "module" or "members" in options:
                hidden = options.get("exclude-members", ())
                found += [member for owner in named for member in _methods(owner, hidden)]
    places = {}
    for name in found:
        value = _value(name)
        if callable(value):
            places.setdefault((value.__module__, value.__qualname__), name)
    return list(places.values())


def _directives(text: str) -> Iterator[tuple[str, str, dict[str, list[str]]]]:
    """Yield what a page shows by autodoc: module, class or function, its name, its options."""
    for match in re.finditer(r"^\.\. auto(\w+):: (\S+)\n((?:   :.*\n?)*)", text, re.MULTILINE):
        options = re.findall(r":([\w-]+):(.*)", match[3])
        yield match[1], match[2], {key: re.findall(r"\w+", said) for key, said in options}


def _of_module(name: str, options: dict[str, list[str]]) -> list[str]:
    if "members" not in options:
        return []
    module = importlib.import_module(name)
    own = [
        key
        for key, value in vars(module).items()
        if not key.startswith("_") and getattr(value, "__module__", None) == name
    ]
    named = options["members"] or getattr(module, "__all__", own)
    return [f"{name}.{key}" for key in named if key not in options.get("exclude-members", ())]


def _methods(owner: str, hidden: Collection[str]) -> list[str]:
    value = _value(owner)
    if not inspect.isclass(value):
        return []
    own = {key: getattr(value, key) for key in vars(value) if not key.startswith("_")}
    return [
        f"{owner}.{key}"
        for key, found in own.items()
        if inspect.isroutine(found) and key not in hidden
    ]


def _value(name: str):
    return Validator._load_obj(name)


class Docstring(Validator):
    """A docstring beside what it is of."""

    def __init__(self, obj_name: str) -> None:
        super().__init__(get_doc_object(_value(obj_name)))
        owner, _, name = obj_name.rpartition(".")
        of = _value(owner)
        bases = of.__mro__[1:] if inspect.isclass(of) else ()
        self.overrides = any(
            name in vars(base) and base.__module__.startswith("asperity.") for base in bases
        )

    @property
    def by_name(self) -> bool:
        """Whether all that it takes is given by name, in any order."""
        return inspect.isclass(self.obj) and issubclass(self.obj, Table | Quantities)

    @property
    def said_by_summary(self) -> bool:
        """Whether it is a line that says what comes of a method which takes nothing."""
        return (
            not self.signature_parameters and re.match("(Return|Yield) ", self.summary) is not None
        )

    @property
    def is_function_or_method(self) -> bool:
        """Whether it is called for what it returns: kernels and methods of classes as well."""
        return inspect.isroutine(self.code_obj)

    @property
    def method_source(self) -> str:
        """The lines of what is called, not of what is put around it."""
        try:
            return textwrap.dedent(inspect.getsource(self.code_obj))
        except (OSError, TypeError):
            return ""

    @property
    def is_generator_function(self) -> bool:
        """Whether it yields anything; what is entered by ``with`` may yield nothing."""
        tree = ast.parse(self.method_source)
        return any(
            isinstance(node, ast.YieldFrom) or (isinstance(node, ast.Yield) and node.value)
            for node in ast.walk(tree)
        )

    @property
    def signature_parameters(self) -> tuple[str, ...]:
        """What it takes: of a table its keys, of an answer what is not said with its field."""
        if not inspect.isclass(self.obj):
            return tuple(n for n in super().signature_parameters if not n.startswith("_"))
        if getattr(self.obj, "_is_protocol", False):
            return ()
        if issubclass(self.obj, Table) and self.obj is not Table:
            # What is excluded is made by the table itself, or said elsewhere.
            return tuple(
                key
                for key, field in self.obj.model_fields.items()
                if not field.exclude or key in self._doc_parameters(["Parameters"])
            )
        if dataclasses.is_dataclass(self.obj):
            said = {
                *getattr(self.obj, "_labels", ()),
                *(field.name for field in dataclasses.fields(self.obj) if field.metadata),
            }
            fields = (field.name for field in dataclasses.fields(self.obj) if field.init)
            hidden = said | ({"notes"} if issubclass(self.obj, Quantities) else set())
            return tuple(n for n in fields if n not in hidden and not n.startswith("_"))
        return super().signature_parameters

    @property
    def doc_all_parameters(self) -> dict[str, tuple[str, list[str]]]:
        """What is said of what it takes; of a class that may stand among its attributes."""
        said = super().doc_all_parameters
        if inspect.isclass(self.obj):
            taken = self.signature_parameters
            attributes = self._doc_parameters(["Attributes"])
            # What a class has besides is no parameter of it; what a base says need not be repeated.
            said |= {n: a for n, a in attributes.items() if n in taken or not self._has(n)}
            for base in self.obj.__bases__:
                if base.__module__.startswith("asperity."):
                    inherited = Docstring(f"{base.__module__}.{base.__qualname__}")
                    said = {
                        **{n: a for n, a in inherited.doc_all_parameters.items() if n in taken},
                        **said,
                    }
        return said

    def _has(self, name: str) -> bool:
        code = f"self.{name} = "
        return (
            hasattr(self.obj, name)
            or any(name in vars(base).get("__annotations__", {}) for base in self.obj.__mro__)
            or code in inspect.getsource(self.obj)
        )

    @property
    def unsaid_errors(self) -> list[str]:
        """Names of the errors that its own lines raise, and its docstring does not name."""
        if not self.is_function_or_method:
            return []
        tree = ast.parse(self.method_source)
        raised = {
            node.exc.func.id
            for node in ast.walk(tree)
            if isinstance(node, ast.Raise)
            and isinstance(node.exc, ast.Call)
            and isinstance(node.exc.func, ast.Name)
        }
        if hasattr(self.obj, "body"):
            # What checks a formula's numbers is its decorator.
            raised.add("Raises")
        return sorted(name for name in raised if name not in self.raw_doc)

    @property
    def shapeless(self) -> list[str]:
        """Types of arrays that are taken or returned and said without their shape."""
        types = [type_ for type_, _ in self.doc_all_parameters.values()]
        types += [returned.type for returned in (*self.returns, *self.yields)]
        return [
            type_ for type_ in types if re.search(r"\bndarray\b", type_) and "shape" not in type_
        ]


def faults(name: str) -> list[str]:
    """Return what is wrong with the docstring of a public name, a line each."""
    docstring = Docstring(name)
    left_out = INHERITED if docstring.overrides else set()
    if docstring.said_by_summary:
        left_out = left_out | {"RT01", "YD01"}
    if docstring.by_name:
        left_out = left_out | {"PR03"}
    found = [
        f"{code} {said}"
        for code, said in validate(name, Docstring)["errors"]
        if code in CODES - left_out
    ]
    found += [f"RS01 {error} is raised and not said" for error in docstring.unsaid_errors]
    return found + [f"SH01 {type_} has no shape" for type_ in docstring.shapeless]


def main() -> int:
    """Print what is wrong, and how many names were looked at."""
    names = public_names()
    wrong = [f"{name}: {fault}" for name in names for fault in faults(name)]
    print(*wrong, f"{len(names)} public names, {len(wrong)} faults in their docstrings", sep="\n")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
