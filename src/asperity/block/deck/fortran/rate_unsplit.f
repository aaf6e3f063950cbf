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
      SUBROUTINE ASPNEA(S,T,S0,SIZE,H,D,E1,E2,XI)
C     Near the limit an increment is by the law along the asperity,
C     exact for its size, unless the slip bends back: by a slip across,
C     the rate half-way misses that by more than an asperity there still
C     bends.
C     S, T: the increment by the rate half-way and its derivative,
C     changed; S0, SIZE: before; H: half-way; D: the slip.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(3),T(2,2),S0(2),H(2),D(2),E1(2),E2(2),U(2),W(2),DW(2)
      PARAMETER (ANEAR=0.5D0,ANEARR=0.6D0)
C
      IF (XI.LE.1.D0 .OR. SIZE.LE.ANEAR .OR. SIZE.GT.1.D0) RETURN
      IF (H(1)*D(1)+H(2)*D(2).LE.0.D0) RETURN
      PART = MIN((SIZE-ANEAR)/(ANEARR-ANEAR),1.D0)
      PART = PART*PART*(3.D0-2.D0*PART)
      HALF = SQRT(H(1)**2+H(2)**2)
      EX = H(1)/HALF
      EY = H(2)/HALF
      ALONG = EX*D(1)+EY*D(2)
C     What is left of the limit before and after.
      REST = 1.D0-SIZE
      BASE = 1.D0+(XI-1.D0)*ALONG*REST**(XI-1.D0)
      REST1 = REST*BASE**(1.D0/(1.D0-XI))
      SIZE1 = 1.D0-REST1
      BOTH = 0.5D0*(SIZE+SIZE1)
      RATE = (ALONG+SIZE-SIZE1)/BOTH
      CALL ASPREL(RATE,DECAY,GAIN,SLOPE)
      W(1) = S0(1)*DECAY+D(1)*GAIN
      W(2) = S0(2)*DECAY+D(2)*GAIN
      WSIZE = SQRT(W(1)**2+W(2)**2)
      FX = W(1)/WSIZE
      FY = W(2)/WSIZE
      DO 10 J = 1,2
        U(1) = 0.D0
        U(2) = 0.D0
        U(J) = E1(J)+E2(J)
        DHALF = 0.5D0*(EX*U(1)+EY*U(2))
        DALONG = EX*U(1)+EY*U(2)
     1   +((0.5D0*U(1)-EX*DHALF)*D(1)+(0.5D0*U(2)-EY*DHALF)*D(2))/HALF
        DSIZE1 = REST1**XI*DALONG
        DRATE = (DALONG-DSIZE1-0.5D0*RATE*DSIZE1)/BOTH
        DO 5 I = 1,2
          DW(I) = (D(I)*SLOPE-S0(I)*DECAY)*DRATE+GAIN*U(I)
    5   CONTINUE
        DWSIZE = FX*DW(1)+FY*DW(2)
        DW(1) = (DW(1)-FX*DWSIZE)*SIZE1/WSIZE+FX*DSIZE1
        DW(2) = (DW(2)-FY*DWSIZE)*SIZE1/WSIZE+FY*DSIZE1
        T(1,J) = T(1,J)+PART*(DW(1)-T(1,J))
        T(2,J) = T(2,J)+PART*(DW(2)-T(2,J))
   10 CONTINUE
      S(1) = S(1)+PART*(FX*SIZE1-S(1))
      S(2) = S(2)+PART*(FY*SIZE1-S(2))
      S(3) = SQRT(S(1)**2+S(2)**2)
      RETURN
      END
