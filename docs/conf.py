"""Configuration of the documentation."""

import sys
from pathlib import Path

import asperity

sys.path.insert(0, str(Path(__file__).parent))
from draw_tower import draw
from draw_walks import draw_all

draw(Path(__file__).parent / "_static" / "tower.png")
draw_all()

project = "asperity"
author = "the asperity authors"
project_copyright = "2026, the asperity authors"
version = release = asperity.__version__

extensions = [
    "case_tables",
    "compared",
    "mathml",
    "sphinx.ext.autodoc",
    "top_names",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build"]

html_math_renderer = "mathml"
autodoc_typehints = "none"
autodoc_default_options = {"exclude-members": "model_config"}
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "abort_on_example_error": True,
    "within_subsection_order": "FileNameSortKey",
    "show_memory": False,
    # That page asks other sites for its scripts.
    "write_computation_times": False,
}

html_theme = "furo"
html_title = "asperity"
html_static_path = ["_static"]
html_css_files = ["pages.css"]
html_show_sourcelink = False
html_copy_source = False
