"""Where each number of a batch of bodies stands in its buffer: a row of one number a body."""

WIDTH = 32

# The last rows are those of bodies that are pressed, the very last what a step needs on its way.
(
    STRETCH, WX, WY, SX, SY,
    DRIVE, STIFFNESS, MOBILITY_X, MOBILITY_Y, BASE_X, BASE_Y,
    SUM_FREE, SUM_FX, SUM_FY, SUM_VX, SUM_VY, SUM_SLIP,
    MAX_FX, MIN_FX, MAX_FY, MIN_FY, WAITING, WAITED,
    RISE, HEIGHT, PENETRATION, LOAD, ELASTIC, LINEAR, ROOT, BASE_Z, MOBILITY_Z, LOSS,
    SUM_LOAD, SUM_PENETRATION, SUM_OPEN, SUM_LANDINGS, SUM_RISE, SUM_LOSS, SUM_GAIN, SUM_WEAR,
    MAX_LOAD, MIN_LOAD, MAX_PENETRATION, MIN_PENETRATION, MAX_APPROACH,
    LAST_LOAD, LAST_ELASTIC, APPROACH, LAST_SX, LAST_SY, DX, DY, FREE,
    ROWS,
) = range(55)  # fmt: skip

# What the window begins anew.
SUMS = (*range(SUM_FREE, MAX_FX), *range(SUM_LOAD, MAX_LOAD))
GREATEST = (MAX_FX, MAX_FY, MAX_LOAD, MAX_PENETRATION)
LEAST = (MIN_FX, MIN_FY, MIN_LOAD, MIN_PENETRATION)
