"""Configuration of the documentation."""

import sys
from pathlib import Path

import asperity

sys.path.insert(0, str(Path(__file__).parent))
from draw_tower import draw

draw(Path(__file__).parent / "_static" / "tower.png")

project = "asperity"
author = "the asperity authors"
project_copyright = "2026, the asperity authors"
version = release = asperity.__version__

extensions = [
    "case_tables",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
]
templates_path = ["_templates"]
exclude_patterns = ["_build"]

autosummary_generate = True
autodoc_typehints = "none"
# Names of types that take arguments have no signature that could be written.
suppress_warnings = ["autodoc"]
autodoc_default_options = {"exclude-members": "model_config"}
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "abort_on_example_error": True,
    "within_subsection_order": "FileNameSortKey",
    "show_memory": False,
}

html_theme = "alabaster"
html_theme_options = {"description": "Vibration and friction between sliding surfaces"}
