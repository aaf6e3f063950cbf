"""The Fortran of the thesis's Appendix E, compiled, against its scheme as a kernel.

The thesis's Appendix E and section 7.3, equations (79) to (141).
"""

import ctypes
import subprocess

import numpy as np
import pytest

from asperity.drive.deck.appendix_e import appendix_e
from asperity.thesis.drive.appendix_e import Subroutine, friction_of_path

pytestmark = pytest.mark.usefixtures("plain_kernels")

STUB = "      implicit real*8(a-h,o-z)\n      parameter (nprecd=2)\n"
DRIVER = """\
      SUBROUTINE DRIVE(N,DGAM,PRESS,PROPS,STATEV,TAU,DDTDDG,DDTDDP,
     1 STATES)
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION DGAM(2,N),PRESS(N),PROPS(3),STATEV(5),TAU(2,N),
     1 DDTDDG(2,2,N),DDTDDP(2,N),STATES(5,N),Z(4),TIME(2),D(2)
      CHARACTER*80 NAME
      DATA Z/4*0.D0/
      NAME = 'FLANKS'
      TIME(1) = 0.D0
      TIME(2) = 0.D0
      DO 10 I = 1,N
        LM = 0
        CALL FRIC(LM,TAU(1,I),DDTDDG(1,1,I),DDTDDP(1,I),D,SED,SFD,Z,
     1   PNEWDT,STATEV,DGAM(1,I),Z,PRESS(I),0.D0,0.D0,Z,1,1,TIME,
     2   1.D-6,1,NAME,NAME,NAME,1,1,1,Z,Z,Z,Z,Z,2,3,1,5,1.D0,PROPS,3)
        DO 5 K = 1,5
          STATES(K,I) = STATEV(K)
    5   CONTINUE
   10 CONTINUE
      RETURN
      END
"""
LAW = Subroutine(0.1344, 70e-9, 1.0)


@pytest.fixture(scope="module")
def drive(tmp_path_factory):
    folder = tmp_path_factory.mktemp("appendix-e")
    written = appendix_e(LAW.mu, LAW.exponent, LAW.max_deflection)
    (folder / "ABA_PARAM.INC").write_text(STUB)
    (folder / "fric.f").write_text(written.text)
    (folder / "driver.f").write_text(DRIVER)
    strict = ["gfortran", "-std=legacy", "-Wall", "-Werror", "-Wno-unused-dummy-argument", "-O1"]
    subprocess.run([*strict, "-c", "fric.f"], cwd=folder, check=True)
    subprocess.run(
        ["gfortran", "-O1", "-shared", "-fPIC", "-o", "all.so", "driver.f", "fric.f"],
        cwd=folder, check=True,
    )  # fmt: skip
    library = ctypes.CDLL(str(folder / "all.so"))

    def run(slips, pressure, state=None):
        n = len(slips)
        state = np.zeros(5) if state is None else np.array(state, float)
        out = [np.full((n, *shape), np.nan) for shape in ((2,), (2, 2), (2,), (5,))]
        given = [np.ascontiguousarray(a, float) for a in (slips, pressure, written.properties)]
        pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (*given, state, *out)]
        library.drive_(ctypes.byref(ctypes.c_int(n)), *pointers)
        stress, by_slip, by_pressure, states = out
        return stress, np.swapaxes(by_slip, 1, 2), by_pressure, states

    return run


def paths():
    """Small slips, slips that pass the limit, and a contact that opens again and again."""
    random = np.random.default_rng(3)
    n = 600
    size = np.repeat([5e-9, 90e-9, 200e-9], n // 3)
    slips = size[:, None] * random.normal(size=(n, 2)) + [4e-9, 0.0]
    pressure = 1e8 * np.maximum(1.0 + np.sin(0.05 * np.arange(n)) * 1.2, 0.0)
    return slips, pressure


def test_the_fortran_is_the_scheme_over_elastic_plastic_and_open_increments(drive):
    slips, pressure = paths()
    stress, *_ = drive(slips, pressure)
    expected = friction_of_path(LAW, slips, pressure)
    assert np.abs(stress - expected).max() < 1e-12 * np.abs(expected).max()
    full = np.hypot(*expected.T) >= (1.0 - 1e-12) * LAW.mu * pressure
    assert (pressure == 0.0).sum() > 20
    assert (full & (pressure > 0.0)).sum() > 20
    assert (~full).sum() > 100


def test_its_derivatives_belong_to_its_stress(drive):
    slips, pressure = paths()
    states = drive(slips, pressure)[3]
    tried = [n for n in range(1, len(slips)) if pressure[n] > 1e6][::7]
    worst = 0.0
    for n in tried:
        before, slip = states[n - 1], slips[n]
        _, by_slip, by_pressure, _ = drive([slip], [pressure[n]], before)
        scale = LAW.mu * pressure[n] / LAW.max_deflection
        for axis in range(2):
            step = np.zeros(2)
            step[axis] = 1e-5 * LAW.max_deflection
            ends = [drive([slip + sign * step], [pressure[n]], before)[0][0] for sign in (1, -1)]
            found = (ends[0] - ends[1]) / (2.0 * step[axis])
            worst = max(worst, np.abs(found - by_slip[0, :, axis]).max() / scale)
        ends = [
            drive([slip], [pressure[n] * (1.0 + sign * 1e-6)], before)[0][0] for sign in (1, -1)
        ]
        found = (ends[0] - ends[1]) / (2e-6 * pressure[n])
        assert found == pytest.approx(by_pressure[0], abs=1e-6)
    assert len(tried) > 50
    assert worst < 1e-6


def test_where_an_increment_passes_the_limit_the_root_stays(drive):
    _, _, _, states = drive([[1e-9, 0.0], [200e-9, 0.0]], [1e8, 1e8])
    assert states[1][2:] == pytest.approx(states[0][2:], abs=0.0)
    assert states[1][0] == pytest.approx(201e-9, rel=1e-12)


def test_its_head_says_that_it_is_no_sound_law_and_what_it_needs():
    text = appendix_e(0.1344, 1.0, 70e-9).text
    assert max(map(len, text.splitlines())) <= 72
    head = " ".join(line[1:].strip() for line in text.splitlines() if line.startswith("C"))
    for said in ("not a sound law", "0.1344", "7e-08", "1 must be along the sliding"):
        assert said in head
