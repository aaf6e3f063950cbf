r"""A budget of uncertainty by the Guide (GUM, JCGM 100:2008): what makes a number uncertain.

Each cause moves one or several inputs of the number. With sensitivities :math:`c_i` of the number
by the inputs it leaves the variance :math:`\sum_{ij} c_i c_j u(x_i, x_j)` (GUM 13 and 16). The
variances of all causes add up, their degrees of freedom by Welch and Satterthwaite (GUM G.2b), and
Student's distribution gives the factor of the interval.
"""

import dataclasses
import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from asperity.arrays import FloatArray
from asperity.results.interval import Interval

Kind = Literal["A", "B"]
"""By statistics of observations, or by anything else that is known (GUM 3.3.5)."""


@dataclasses.dataclass(frozen=True)
class Cause:
    """What leaves an error in inputs, told by their covariance.

    Attributes
    ----------
    name : str
        What it is.
    kind : {'A', 'B'}
        How its uncertainty is known.
    covariance : ndarray, shape (n, n)
        Of the inputs.
    freedom : float
        Degrees of freedom of that; infinite where it is stated.
    """

    name: str
    kind: Kind
    covariance: FloatArray
    freedom: float = math.inf


@dataclasses.dataclass(frozen=True)
class Contribution:
    """What a cause brings to a number.

    Attributes
    ----------
    name, kind
        Of the cause.
    inputs : tuple of str
        What the cause moves; empty where it is a correlation between other causes.
    uncertainties : tuple of float
        Standard uncertainty of each, in its unit.
    sensitivities : tuple of float
        Of the number by each, in its unit over theirs.
    correlation : float
        Of two inputs; zero where there is one.
    variance : float
        What comes of it, in the number's unit squared; below zero where it cancels.
    freedom : float
        Degrees of freedom.
    """

    name: str
    kind: Kind
    inputs: tuple[str, ...]
    uncertainties: tuple[float, ...]
    sensitivities: tuple[float, ...]
    correlation: float
    variance: float
    freedom: float = math.inf

    @classmethod
    def of(
        cls, cause: Cause, inputs: Sequence[str], sensitivities: Sequence[float] | FloatArray
    ) -> "Contribution":
        """Return what a cause brings to a number that answers to its inputs so."""
        slope, covariance = np.asarray(sensitivities, dtype=float), cause.covariance
        sizes = np.sqrt(np.diag(covariance))
        mixed = 0.0
        if len(sizes) == 2 and sizes.all():
            mixed = float(covariance[0, 1] / (sizes[0] * sizes[1]))
        return cls(
            cause.name, cause.kind, tuple(inputs), tuple(sizes.tolist()), tuple(slope.tolist()),
            mixed, float(slope @ covariance @ slope), cause.freedom,
        )  # fmt: skip

    @property
    def size(self) -> float:
        """What it leaves in the number, u_i(y); below zero where it cancels of others."""
        return math.copysign(math.sqrt(abs(self.variance)), self.variance)

    def times(self, factor: float) -> "Contribution":
        """Return it for the number in another unit."""
        return dataclasses.replace(
            self, sensitivities=tuple(factor * one for one in self.sensitivities),
            variance=factor * factor * self.variance,
        )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Budget:
    """What makes a number uncertain.

    Attributes
    ----------
    value : float
        The number.
    contributions : tuple of Contribution
        What it is uncertain by.
    confidence : float
        Of its interval.
    """

    value: float
    contributions: tuple[Contribution, ...]
    confidence: float = 0.95

    @property
    def variance(self) -> float:
        """Combined, u_c squared."""
        return max(math.fsum(one.variance for one in self.contributions), 0.0)

    @property
    def uncertainty(self) -> float:
        """Combined standard uncertainty, u_c."""
        return math.sqrt(self.variance)

    @property
    def freedom(self) -> float:
        """Effective degrees of freedom; infinite where all are.

        Examples
        --------
        >>> cause = Cause("readings", "A", np.eye(1), 5.0)
        >>> Budget(0.0, (Contribution.of(cause, ["x"], [2.0]),)).freedom
        5.0
        """
        lost = math.fsum(
            one.variance**2 / one.freedom for one in self.contributions if one.freedom < math.inf
        )
        return self.variance**2 / lost if lost > 0.0 < self.variance else math.inf

    @property
    def coverage_factor(self) -> float:
        """k, by Student's distribution with these degrees of freedom."""
        from scipy.special import ndtri, stdtrit

        end, freedom = 0.5 + 0.5 * self.confidence, self.freedom
        return float(stdtrit(freedom, end) if freedom < math.inf else ndtri(end))

    @property
    def expanded(self) -> float:
        """U: half the interval."""
        return self.coverage_factor * self.uncertainty

    def share(self, contribution: Contribution) -> float:
        """Return the share of a contribution in the variance."""
        return contribution.variance / self.variance if self.variance > 0.0 else 0.0

    def times(self, factor: float) -> "Budget":
        """Return it for the number in another unit."""
        return dataclasses.replace(
            self, value=factor * self.value,
            contributions=tuple(one.times(factor) for one in self.contributions),
        )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Budgeted(Interval):
    """An interval that a budget leaves."""

    low: float
    high: float
    deviation: float
    budget: Budget = dataclasses.field(kw_only=True)

    @classmethod
    def of(cls, budget: Budget) -> "Budgeted":
        """Return the interval of a budget."""
        middle, half = budget.value, budget.expanded
        return cls(middle, middle - half, middle + half, budget.uncertainty, budget=budget)

    def times(self, factor: float) -> "Budgeted":
        """Return it in another unit."""
        return Budgeted.of(self.budget.times(factor))
