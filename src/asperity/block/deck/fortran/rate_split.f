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
      SUBROUTINE ASPNEA(S,T,S0,SIZE,H,D,E1,E2,XI)
C     Nothing else near the limit: the parts of the slip oppose each
C     other, and keep the asperity from it.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(3),T(2,2),S0(2),H(2),D(2),E1(2),E2(2)
      RETURN
      END
