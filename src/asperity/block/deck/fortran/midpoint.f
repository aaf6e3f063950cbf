C
      SUBROUTINE ASPLAW(S,D1,D2,E1,E2,XI,ONESID,T)
C     Dahl's law relaxed along the asperity, by an exponential step with
C     the rate half-way through it; everything over SMAX.
C     S(1), S(2): deflection, changed from start to end of increment;
C     S(3): its size.
C     D1, D2: the slip, in two parts; E1, E2: derivatives by the slip.
C     T(I,J): derivative of S(I) by the slip along axis J.
C     ONESID is not used: this law knows no forced direction.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION S(3),D1(2),D2(2),E1(2),E2(2),T(2,2),D(2),H(2),V(2),
     1 U1(2),U2(2),DA(2),DS(2),S0(2)
      LOGICAL ONESID
      PARAMETER (TINY=1.D-150)
C
      D(1) = D1(1)+D2(1)
      D(2) = D1(2)+D2(2)
      SIZE = SQRT(S(1)**2+S(2)**2)
      SIZED = MAX(SIZE,TINY)
C
C     The rate at the start matters only where the exponent makes the
C     rate depend on the size.
      V(1) = 0.D0
      V(2) = 0.D0
      FIRST = 0.D0
      IF (XI.NE.1.D0 .AND. SIZE.GT.TINY)
     1 CALL ASPRAT(S(1)/SIZED,S(2)/SIZED,MIN(SIZE,1.D0),D1,D2,XI,
     2 V,0.D0,V,V,FIRST,DUMMY)
      H(1) = S(1)+0.5D0*D(1)
      H(2) = S(2)+0.5D0*D(2)
      HALF = SQRT(H(1)**2+H(2)**2)
      SCALE = 1.D0+0.5D0*FIRST
      S0(1) = S(1)
      S0(2) = S(2)
C
      RATE = 0.D0
      DO 10 J = 1,2
        DA(J) = 0.D0
        U1(1) = 0.D0
        U1(2) = 0.D0
        U2(1) = 0.D0
        U2(2) = 0.D0
        U1(J) = E1(J)
        U2(J) = E2(J)
        IF (HALF.GT.TINY) THEN
          DFIRST = 0.D0
          IF (XI.NE.1.D0 .AND. SIZE.GT.TINY)
     1     CALL ASPRAT(S(1)/SIZED,S(2)/SIZED,MIN(SIZE,1.D0),D1,D2,XI,
     2     V,0.D0,U1,U2,FIRST,DFIRST)
          EX = H(1)/HALF
          EY = H(2)/HALF
          DX = 0.5D0*(U1(1)+U2(1))
          DY = 0.5D0*(U1(2)+U2(2))
          DHALF = EX*DX+EY*DY
          DS(1) = (DX-EX*DHALF)/HALF
          DS(2) = (DY-EY*DHALF)/HALF
          SHARE = HALF/SCALE
          DSHARE = (DHALF-0.5D0*SHARE*DFIRST)/SCALE
          IF (SHARE.GE.1.D0) THEN
            SHARE = 1.D0
            DSHARE = 0.D0
          END IF
          CALL ASPRAT(EX,EY,SHARE,D1,D2,XI,DS,DSHARE,U1,U2,RATE,DA(J))
        ELSE IF (SIZE.GT.TINY) THEN
C         Half-way the asperity passes through zero, on its own line.
          CALL ASPRAT(S(1)/SIZED,S(2)/SIZED,0.D0,D1,D2,XI,
     1     V,0.D0,U1,U2,RATE,DA(J))
        END IF
   10 CONTINUE
C
      CALL ASPREL(RATE,DECAY,GAIN,SLOPE)
      DO 20 J = 1,2
        DO 15 I = 1,2
          T(I,J) = (D(I)*SLOPE-S(I)*DECAY)*DA(J)
          IF (I.EQ.J) T(I,J) = T(I,J)+GAIN*(E1(J)+E2(J))
   15   CONTINUE
   20 CONTINUE
      S(1) = S(1)*DECAY+D(1)*GAIN
      S(2) = S(2)*DECAY+D(2)*GAIN
C
C     A coarse increment can pass the limit a little: back onto it.
      BOUND = MAX(1.D0,SIZE)
      S(3) = SQRT(S(1)**2+S(2)**2)
      IF (S(3).GT.BOUND) THEN
        EX = S(1)/S(3)
        EY = S(2)/S(3)
        BACK = BOUND/S(3)
        DO 30 J = 1,2
          ALONG = EX*T(1,J)+EY*T(2,J)
          T(1,J) = (T(1,J)-EX*ALONG)*BACK
          T(2,J) = (T(2,J)-EY*ALONG)*BACK
   30   CONTINUE
        S(1) = EX*BOUND
        S(2) = EY*BOUND
        S(3) = BOUND
      END IF
      CALL ASPNEA(S,T,S0,SIZE,H,D,E1,E2,XI)
      RETURN
      END
C
      SUBROUTINE ASPTRM(EX,EY,SHARE,DX,DY,XI,DE,DSHARE,U,RATE,DRATE)
C     One term of the relaxation over an increment: the slip D along the
C     unit vector E, times Dahl's factor c at a deflection SHARE; added
C     to RATE, its derivative for changes DE, DSHARE, U of E, SHARE, D
C     to DRATE.
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION DE(2),U(2)
      ALONG = EX*DX+EY*DY
      SGN = SIGN(1.D0,ALONG)
      IF (ALONG.EQ.0.D0) SGN = 1.D0
      C = 1.D0
      DC = 0.D0
      IF (XI.NE.1.D0) THEN
        REST = 1.D0-SGN*SHARE
        IF (SHARE.LT.1.D-9) THEN
          C = XI
          DC = -0.5D0*XI*(XI-1.D0)*SGN
        ELSE IF (REST.LE.0.D0) THEN
          C = 0.D0
          IF (XI.GT.0.D0) C = 1.D0/SHARE
          IF (XI.GT.0.D0) DC = -1.D0/SHARE**2
        ELSE
          C = -SGN*ASPEM1(XI*ASPL1P(-SGN*SHARE))/SHARE
          DC = (XI*REST**(XI-1.D0)-C)/SHARE
        END IF
      END IF
      RATE = RATE+C*ABS(ALONG)
      DRATE = DRATE+C*SGN*(DE(1)*DX+DE(2)*DY+EX*U(1)+EY*U(2))
     1 +DC*DSHARE*ABS(ALONG)
      RETURN
      END
