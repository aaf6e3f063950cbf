C
      DOUBLE PRECISION FUNCTION ASPEM1(X)
C     exp(X) - 1 without loss of digits for a small X.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      IF (ABS(X).GT.0.5D0) THEN
        ASPEM1 = EXP(X)-1.D0
        RETURN
      END IF
      SUM = 1.D0
      DO 10 K = 17,2,-1
        SUM = 1.D0+SUM*X/K
   10 CONTINUE
      ASPEM1 = X*SUM
      RETURN
      END
C
      DOUBLE PRECISION FUNCTION ASPL1P(X)
C     log(1 + X) without loss of digits for a small X.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      IF (ABS(X).GT.0.25D0) THEN
        ASPL1P = LOG(1.D0+X)
        RETURN
      END IF
      Z = X/(2.D0+X)
      SUM = 1.D0/21.D0
      DO 10 K = 19,1,-2
        SUM = 1.D0/K+SUM*Z*Z
   10 CONTINUE
      ASPL1P = 2.D0*Z*SUM
      RETURN
      END
C
      SUBROUTINE ASPREL(A,DECAY,GAIN,SLOPE)
C     exp(-A), (1 - exp(-A))/A and the derivative of the latter.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DECAY = EXP(-A)
      GAIN = 1.D0
      IF (A.GT.0.D0) GAIN = -ASPEM1(-A)/A
      IF (A.LT.1.D-4) THEN
        SLOPE = -0.5D0+A*(1.D0/3.D0-A*0.125D0)
      ELSE
        SLOPE = (DECAY*(A+1.D0)-1.D0)/(A*A)
      END IF
      RETURN
      END
