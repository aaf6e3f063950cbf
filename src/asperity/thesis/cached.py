"""What exhibits share and what takes long: solved once, and kept for all runs of this user."""

from collections.abc import Callable
from typing import TypeVar

from asperity.thesis.cases import Shipped

T = TypeVar("T")


def once(shipped: Shipped, of: type[T], module: str, solve: Callable[[], T]) -> T:
    """Return what a shipped case came to, solved where it is not kept.

    Parameters
    ----------
    shipped : Shipped
        The case and its settings.
    of : type
        What it comes to: a dataclass of numbers and arrays.
    module : str
        Whose code it follows from, with all that it imports.
    solve : callable
        Solves it.
    """
    from asperity.files.shipped import shipped_cases
    from asperity.runs.cache import Cache
    from asperity.runs.key import code_key, key
    from asperity.runs.tree import from_tree, to_tree

    case = shipped_cases()[shipped.case].read_bytes()
    name = key(code_key(module), of.__name__, case, *shipped.settings)
    cache = Cache.of_this_user("thesis")
    tree = cache.get(name)
    if tree is None:
        tree = to_tree(solve())
        cache.put(name, tree)
    return from_tree(of, tree)
