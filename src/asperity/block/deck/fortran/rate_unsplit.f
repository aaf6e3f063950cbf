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
      SUBROUTINE ASPNEA(S,SIZE,H,HALF,D,E1,E2,XI,T)
C     Of the size S(3) after an increment, a part by the law along the
C     asperity, and all of it near the limit: by a slip across it the
C     step above misses the size by more than an asperity still bends.
C     SIZE: before; H, HALF: half-way, and its size; D: the slip.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(3),H(2),D(2),E1(2),E2(2),T(2,2),U(2)
      PARAMETER (ANEAR=0.5D0,ANEARR=0.75D0)
C
      PART = (SIZE-ANEAR)/(ANEARR-ANEAR)
      IF (PART.LE.0.D0 .OR. H(1)*D(1)+H(2)*D(2).LE.0.D0) RETURN
      PART = MIN(PART,1.D0)
      PART = PART*PART*(3.D0-2.D0*PART)
      EX = H(1)/HALF
      EY = H(2)/HALF
      ALONG = EX*D(1)+EY*D(2)
C     What is left of the limit before and after.
      REST = 1.D0-SIZE
      BASE = 1.D0+(XI-1.D0)*ALONG*REST**(XI-1.D0)
      REST1 = REST*BASE**(1.D0/(1.D0-XI))
      FX = S(1)/S(3)
      FY = S(2)/S(3)
      SIZE1 = S(3)+PART*(1.D0-REST1-S(3))
      DO 10 J = 1,2
        U(1) = 0.D0
        U(2) = 0.D0
        U(J) = E1(J)+E2(J)
        DHALF = 0.5D0*(EX*U(1)+EY*U(2))
        DALONG = EX*U(1)+EY*U(2)
     1   +((0.5D0*U(1)-EX*DHALF)*D(1)+(0.5D0*U(2)-EY*DHALF)*D(2))/HALF
        DS3 = FX*T(1,J)+FY*T(2,J)
        DSIZE1 = DS3+PART*(REST1**XI*DALONG-DS3)
        T(1,J) = (T(1,J)-FX*DS3)*SIZE1/S(3)+FX*DSIZE1
        T(2,J) = (T(2,J)-FY*DS3)*SIZE1/S(3)+FY*DSIZE1
   10 CONTINUE
      S(1) = FX*SIZE1
      S(2) = FY*SIZE1
      S(3) = SIZE1
      RETURN
      END
