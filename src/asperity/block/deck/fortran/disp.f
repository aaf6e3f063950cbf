C
      SUBROUTINE DISP(U,KSTEP,KINC,TIME,NODE,NOEL,JDOF,COORDS)
C     Motion of the base: displacement along JDOF 1 (with the drive) or
C     2 (across it), its velocity, and no acceleration, for the base has
C     no mass.
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION U(3),TIME(2),COORDS(3)
      PARAMETER (FREQ={frequency},START={start})
      PARAMETER (UX={along},UY={across})
      PARAMETER (CODE={code},RISE={rise},STEP=1.D-6)
      C = FREQ*(TIME(2)-START)
      AMP = UX
      IF (JDOF.EQ.2) AMP = UY
      U(1) = AMP*ASPWAV(C,CODE,RISE)
      U(2) = AMP*FREQ*(ASPWAV(C+STEP,CODE,RISE)
     1 -ASPWAV(C-STEP,CODE,RISE))/(2.D0*STEP)
      U(3) = 0.D0
      RETURN
      END
