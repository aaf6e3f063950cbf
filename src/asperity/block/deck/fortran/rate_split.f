C
      SUBROUTINE ASPRAT(EX,EY,SHARE,D1,D2,XI,DE,DSHARE,U1,U2,RATE,
     1 DRATE)
C     Relaxation over an increment with the two parts of the slip taken
C     one by one (split), and its derivative.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION D1(2),D2(2),DE(2),U1(2),U2(2)
      RATE = 0.D0
      DRATE = 0.D0
      CALL ASPTRM(EX,EY,SHARE,D1(1),D1(2),XI,DE,DSHARE,U1,RATE,DRATE)
      CALL ASPTRM(EX,EY,SHARE,D2(1),D2(2),XI,DE,DSHARE,U2,RATE,DRATE)
      RETURN
      END
C
      SUBROUTINE ASPNEA(SIZE,H,D,XI,PART)
C     How much of an increment is by the law along the asperity: nothing.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION H(2),D(2)
      PART = 0.D0
      RETURN
      END
