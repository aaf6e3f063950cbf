C
      DOUBLE PRECISION FUNCTION ASPWAV(CYCLES,CODE,RISE)
C     Displacement of the vibration over its amplitude, CYCLES after its
C     start; as at the start before. Straight between the samples of one
C     period. CODE and RISE are not used.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION W({points})
      SAVE W
{data}
      ASPWAV = W(1)
      IF (CYCLES.LE.0.D0) RETURN
      PLACE = (CYCLES-AINT(CYCLES))*{intervals}
      K = MIN(INT(PLACE)+1,{intervals})
      ASPWAV = W(K)+(PLACE-(K-1))*(W(K+1)-W(K))
      RETURN
      END
