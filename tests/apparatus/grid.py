"""Grids of cases, a part of which stands for the whole in the ordinary part of the tests."""

import itertools

import pytest


def grid(*axes, ordinary=None):
    """Return every combination of the axes' values as parameters of a test.

    Ordinary are as many of them as the longest axis has values, so that each value of each axis
    occurs; the others are slow, and parts of a campaign.

    Parameters
    ----------
    *axes : sequence
        Values of a parameter each.
    ordinary : sequence of tuple or int, optional
        The combinations that are ordinary, or one of so many is; the others are slow, and parts of
        no campaign.
    """
    if ordinary is not None:
        every = [*itertools.product(*axes)]
        kept = every[::ordinary] if isinstance(ordinary, int) else ordinary
        assert all(values in every for values in kept), "what is to be ordinary is none of them"
        return [pytest.param(*one) if one in kept else slow(*one) for one in every]
    most = max(map(len, axes))
    some = {tuple(n % len(axis) for axis in axes) for n in range(most)}
    return [
        pytest.param(
            *(axis[n] for axis, n in zip(axes, place, strict=True)),
            marks=() if place in some else (pytest.mark.slow, pytest.mark.campaign),
        )
        for place in itertools.product(*(range(len(axis)) for axis in axes))
    ]


def slow(*values):
    """Return a test's parameters that belong to its slow part."""
    return pytest.param(*values, marks=pytest.mark.slow)
