"""Stress at the roots of a loaded wheel's teeth.

Enter by `asperity.drive.root_stress.study`, the command ``asperity roots``; `model` has the mesh
and its stresses. Docs: "At the roots" in docs/loaded-teeth.rst; tests:
tests/literature/test_root_stress*.py and tests/unit/test_drive_root_stress.py.
"""
