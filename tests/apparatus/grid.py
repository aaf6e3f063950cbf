"""Grids of cases, a part of which stands for the whole in the ordinary part of the tests."""

import itertools

import pytest


def grid(*axes):
    """Return every combination of the axes' values as parameters of a test.

    Ordinary are as many of them as the longest axis has values, so that each value of each axis
    occurs; the others are slow, and parts of a campaign.

    Parameters
    ----------
    *axes : sequence
        Values of a parameter each.
    """
    most = max(map(len, axes))
    ordinary = {tuple(n % len(axis) for axis in axes) for n in range(most)}
    return [
        pytest.param(
            *(axis[n] for axis, n in zip(axes, place, strict=True)),
            marks=() if place in ordinary else (pytest.mark.slow, pytest.mark.campaign),
        )
        for place in itertools.product(*(range(len(axis)) for axis in axes))
    ]


def slow(*values):
    """Return a test's parameters that belong to its slow part."""
    return pytest.param(*values, marks=pytest.mark.slow)
