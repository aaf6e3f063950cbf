C
      SUBROUTINE ASPRAT(EX,EY,SHARE,D1,D2,XI,DE,DSHARE,U1,U2,RATE,
     1 DRATE)
C     Relaxation over an increment with the two parts of the slip taken
C     together (unsplit), and its derivative.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION D1(2),D2(2),DE(2),U1(2),U2(2),U(2)
      RATE = 0.D0
      DRATE = 0.D0
      U(1) = U1(1)+U2(1)
      U(2) = U1(2)+U2(2)
      CALL ASPTRM(EX,EY,SHARE,D1(1)+D2(1),D1(2)+D2(2),XI,DE,DSHARE,U,
     1 RATE,DRATE)
      RETURN
      END
C
      SUBROUTINE ASPNEA(SIZE,H,D,XI,PART)
C     How much of an increment is by the law along the asperity: all of
C     it near the limit, unless the slip bends back.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION H(2),D(2)
      PARAMETER (ANEAR=0.5D0,ANEARR=0.6D0)
      PART = 0.D0
      IF (XI.LE.1.D0 .OR. SIZE.LE.ANEAR .OR. SIZE.GT.1.D0) RETURN
      IF (H(1)*D(1)+H(2)*D(2).LE.0.D0) RETURN
      PART = MIN((SIZE-ANEAR)/(ANEARR-ANEAR),1.D0)
      PART = PART*PART*(3.D0-2.D0*PART)
      RETURN
      END
