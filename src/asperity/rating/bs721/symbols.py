"""Symbols of BS 721-2:1983: the unit of each, and what is allowed."""

from typing import Annotated

from asperity.arrays import Real
from asperity.formulas import Symbol, acute, not_negative, positive
from asperity.sources import Source

VERIFIED = Source("BS 721-2:1983", "verified")
FROM_MEMORY = Source("BS 721-2:1983", "from memory")
JGMA = Source("JGMA 405-01", "from memory")

# Where a table ends is checked where it is read.
z_1 = Annotated[Real, Symbol("z_1", "", positive)]
q = Annotated[Real, Symbol("q", "", positive)]
m = Annotated[Real, Symbol("m", "mm", positive)]
gamma = Annotated[Real, Symbol("gamma", "rad", acute)]
d_a1 = Annotated[Real, Symbol("d_a1", "mm", positive)]
d_2 = Annotated[Real, Symbol("d_2", "mm", positive)]
b = Annotated[Real, Symbol("b", "mm", positive)]
v_s = Annotated[Real, Symbol("v_s", "m/s", not_negative)]
n = Annotated[Real, Symbol("n", "rpm", positive)]
U = Annotated[Real, Symbol("U", "h", not_negative)]

X_c = Annotated[Real, Symbol("X_c", "", positive)]
S_c = Annotated[Real, Symbol("S_c", "MPa", positive)]
Z = Annotated[Real, Symbol("Z", "", positive)]
X_b = Annotated[Real, Symbol("X_b", "", positive)]
S_b = Annotated[Real, Symbol("S_b", "MPa", positive)]
l_r = Annotated[Real, Symbol("l_r", "mm", positive)]
