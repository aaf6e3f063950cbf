"""``asperity rig import --look FILE``, which is ``asperity rig look FILE``."""

from collections.abc import Sequence

_IMPORT, _LOOK = ["rig", "import"], "--look"
_KEPT = frozenset(("--rate", "--columns", "--units", "--language", "--out", "--format"))
_LEFT_OUT = frozenset(("--set", "--start"))


def looking(arguments: Sequence[str]) -> list[str]:
    """Return a command line that looks at a file where one was to be imported by ``--look``.

    A look needs no configuration, so that one that is given is left out, with what is set of it.

    Examples
    --------
    >>> looking(["rig", "import", "--look", "a.csv", "my-rig.toml", "--join", "b.csv", "--json"])
    ['rig', 'look', 'a.csv', 'b.csv', '--json']
    """
    given = list(arguments)
    if given[:2] != _IMPORT or _LOOK not in given[2:]:
        return given
    files: list[str] = []
    joined: list[str] = []
    options: list[str] = []
    rest = iter(one for one in given[2:] if one != _LOOK)
    for one in rest:
        name, sign, value = one.partition("=")
        if name in _LEFT_OUT or name == "--join":
            value = value if sign else next(rest, "")
            joined += [value] if name == "--join" else []
        elif name in _KEPT:
            options += [one] if sign else [one, *([found] if (found := next(rest, "")) else [])]
        elif one.startswith("--"):
            options.append(one)
        else:
            files.append(one)
    return ["rig", "look", *files[:1], *joined, *options]
