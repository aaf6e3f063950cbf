C
      DOUBLE PRECISION FUNCTION ASPWAV(CYCLES,CODE,RISE)
C     Displacement of the vibration over its amplitude, CYCLES after its
C     start; 0 before. CODE 0 sine, 1 triangle, 2 square with flanks of
C     RISE cycles.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      ASPWAV = 0.D0
      IF (CYCLES.LE.0.D0) RETURN
      PHASE = CYCLES-AINT(CYCLES)
      IF (CODE.LT.0.5D0) THEN
        ASPWAV = SIN(8.D0*ATAN(1.D0)*PHASE)
        RETURN
      END IF
C     Way in phase from the nearest passage through zero, with the sign
C     of the displacement.
      IF (PHASE.LT.0.25D0) THEN
        WAY = PHASE
      ELSE IF (PHASE.LT.0.75D0) THEN
        WAY = 0.5D0-PHASE
      ELSE
        WAY = PHASE-1.D0
      END IF
      IF (CODE.LT.1.5D0) THEN
        ASPWAV = 4.D0*WAY
      ELSE
        ASPWAV = MAX(-1.D0,MIN(1.D0,2.D0*WAY/RISE))
      END IF
      RETURN
      END
