"""The formulas of a standard, wherever in its package they stand."""

import importlib
import pkgutil


def formulas_of(package):
    """Return the formulas of a package by name."""
    modules = [
        importlib.import_module(f"{package.__name__}.{found.name}")
        for found in pkgutil.iter_modules(package.__path__)
    ]
    formulas = {
        name: thing
        for module in modules
        for name, thing in vars(module).items()
        if hasattr(thing, "equation") and thing.__module__ == module.__name__
    }
    assert formulas
    return formulas
